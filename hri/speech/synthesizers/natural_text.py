"""What the natural voice is given to read: sentences in its alphabet, each symbol with its word."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher
from importlib.util import find_spec
from itertools import accumulate, zip_longest
from typing import Any

from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.notation import goes_on, read_aloud
from hri.speech.pronunciation.phones import Phones
from hri.speech.synthesizers.espeak_text import plain, stressed, user_phones
from hri.speech.synthesizers.natural_symbols import SPACE, symbols_of

_WORD = re.compile(r"\S+")
_MARKUP = str.maketrans("[]", "()")
"""Brackets would be taken as a link that gives symbols."""
_FOREIGN = 0.5
"""Share of letters of other scripts from which a sentence is another voice's."""


@dataclass(frozen=True, slots=True)
class Sentence:
    """A sentence as the network gets it."""

    text: str
    """As it is written."""
    position: int
    """Characters of the whole text before it."""
    symbols: str
    words: tuple[int, ...]
    """Of each symbol, the number of the word that it belongs to."""

    def written(self) -> list[tuple[str, int]]:
        """Its words, and how many characters of it are before each."""
        return [(match[0], match.start()) for match in _WORD.finditer(self.text)]


class Reader:
    """Reads English text; words of the user's lexicon as they are written there."""

    def __init__(self, g2p: Any, split: Any, lexicon: Lexicon) -> None:
        """`g2p` makes symbols of words, `split` sentences of a text."""
        self._g2p = g2p
        self._split = split
        self._lexicon = lexicon

    def sentences(self, text: str, sounds: Sequence[tuple[str, Phones]] = ()) -> Iterator[Sentence]:
        """The sentences of a text; one of another script, or of signs alone, has no symbols.

        `sounds` are phones of words, before those of the lexicon.
        """
        text, lexicon = plain(text), self._lexicon.extended(sounds)
        done = 0
        for sentence in _whole(self._split(text), text):
            position = text.index(sentence, done)
            done = position + len(sentence)
            symbols, words = ("", ()) if is_foreign(sentence) else self._read(sentence, lexicon)
            yield Sentence(sentence, position, symbols, words)

    def _read(self, sentence: str, lexicon: Lexicon) -> tuple[str, tuple[int, ...]]:
        from hibari.g2p.normalize import normalize

        normal = normalize(read_aloud(sentence.translate(_MARKUP)))
        tokens = self._g2p.tokenize(normal)
        for token in tokens:
            if phones := user_phones(token.text, lexicon):
                token.phonemes = symbols_of(stressed(phones))
        origins = aligned(_WORD.findall(sentence), normal.split())
        symbols: list[str] = []
        words: list[int] = []
        spoken = self._g2p.phonemize_tokens(tokens)
        for token, number in zip(spoken, _numbers(spoken), strict=True):
            of_token = (token.phonemes or "") + (SPACE if token.whitespace else "")
            symbols.append(of_token)
            words += [origins[min(number, len(origins) - 1)]] * len(of_token)
        return "".join(symbols), tuple(words)


def _whole(parts: Sequence[str], text: str) -> Iterator[str]:
    """The sentences of a text, without parting it after abbreviations before a number."""
    begin = done = 0
    for part, after in zip_longest(parts, parts[1:], fillvalue=""):
        begin = text.index(part, done) if begin == done else begin
        done = text.index(part, done) + len(part)
        if not goes_on(part, after):
            yield text[begin:done]
            begin = done


def _numbers(tokens: Sequence[Any]) -> list[int]:
    """The word in which each token begins: tokens without a space between them are one."""
    spaces = [sum(part.isspace() for part in token.text + token.whitespace) for token in tokens]
    return [0, *accumulate(spaces)][: len(tokens)]


def words_read(text: str) -> list[tuple[str, int]]:
    """The words that an English text is read as, each with the number of its written word.

    Without hibari, prices and dates stay as they are written.
    """
    read = read_aloud(text)
    if find_spec("hibari") is not None:
        from hibari.g2p.normalize import normalize

        read = normalize(read)
    words = read.split()
    return list(zip(words, aligned(text.split(), words), strict=True))


def aligned(written: Sequence[str], read: Sequence[str]) -> list[int]:
    """Which written word each word that is read stands for ("$5" is read "five dollars")."""
    matcher = SequenceMatcher(
        None, [word.lower() for word in written], [word.lower() for word in read], autojunk=False
    )
    origins: list[int] = []
    for _, begin, end, first, last in matcher.get_opcodes():
        count, of = last - first, max(1, end - begin)
        origins += [min(begin + place * of // count, len(written) - 1) for place in range(count)]
    return origins


def is_foreign(text: str) -> bool:
    """Whether most letters of a text are none of the Latin script."""
    letters = [letter for letter in text if letter.isalpha()]
    foreign = sum("LATIN" not in unicodedata.name(letter, "") for letter in letters)
    return foreign > _FOREIGN * len(letters)
