"""What the natural voice is given to read: sentences in its alphabet, each symbol with its word."""

from __future__ import annotations

import re
import unicodedata
from bisect import bisect_left, bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import Any, NamedTuple

from hri.speech.notation.intonation import Tone, boundaries, pause_between
from hri.speech.notation.reading import Spoken, spoken
from hri.speech.notation.sentences import sentences
from hri.speech.pronunciation import heteronyms
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.names import OPENING, is_name
from hri.speech.pronunciation.phones import Phones, with_s
from hri.speech.pronunciation.scripts import in_latin
from hri.speech.synthesizers.espeak_text import plain, stressed
from hri.speech.synthesizers.natural_symbols import SPACE, symbols_of

_WORD = re.compile(r"\S+")
_SIGNS = re.compile(r"(?<![\u0370-\u03ff\u2126])[\u0370-\u03ff\u2126µº](?![\u0370-\u03ff])")
"""Signs of units and of mathematics."""
LONGEST_WORD = 28
"""Letters of a word that is read as one."""
_LONG = re.compile(rf"\S{{{LONGEST_WORD + 1},}}")
_SHOUTED = re.compile(r"[^\W\d_]{2,}+")
_BLANK_LINE = re.compile(r"\n[^\S\n]*\n")
_MARKUP = str.maketrans("[]", "()")
"""Brackets would be taken as a link that gives symbols."""
_POSSESSIVE = ("'s", "\N{RIGHT SINGLE QUOTATION MARK}s")
_FOREIGN = 0.5
"""Share of letters of other scripts from which a sentence is another voice's."""


class Ending(NamedTuple):
    """The end of a phrase."""

    symbol: int
    """The number of symbols before it."""
    tone: Tone
    pause_s: float
    """Seconds of silence after it, at the usual pace."""


class Accent(NamedTuple):
    """Symbols with more or less weight than the rest."""

    begin: int
    end: int
    weight: float
    """-1 to 1."""


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
    endings: tuple[Ending, ...] = ()
    """Of its phrases."""

    def written(self) -> list[tuple[str, int]]:
        """Its words, and how many characters of it are before each."""
        return [(match[0], match.start()) for match in _WORD.finditer(self.text)]

    def position_of(self, symbol: int) -> int:
        """How many of its characters are before the word of a symbol."""
        return self.written()[self.words[symbol]][1] if symbol < len(self.words) else len(self.text)

    def accents(self, emphases: Iterable[tuple[int, int, float]]) -> tuple[Accent, ...]:
        """The symbols of those words that characters of the whole text lay weight on."""
        written = self.written()
        begins = [place for _, place in written]
        ends = [place + len(word) for word, place in written]
        found = []
        for begin, end, weight in emphases:
            first = bisect_right(ends, begin - self.position)
            last = bisect_left(begins, end - self.position)
            symbols = bisect_left(self.words, first), bisect_left(self.words, last)
            if symbols[0] < symbols[1]:
                found.append(Accent(*symbols, weight))
        return tuple(found)


class Reader:
    """Reads English text; words of the user's lexicon as they are written there."""

    def __init__(self, g2p: Any, lexicon: Lexicon) -> None:
        """`g2p` makes symbols of words."""
        self._g2p = g2p
        self._lexicon = lexicon

    def sentences(self, text: str, sounds: Sequence[tuple[str, Phones]] = ()) -> Iterator[Sentence]:
        """The sentences of a text; one of another script, or of signs alone, has no symbols.

        `sounds` are phones of words, before those of the lexicon.
        """
        text, lexicon = _in_paragraphs(text), self._lexicon.extended(sounds)
        for begin, end in sentences(text):
            sentence = text[begin:end]
            latin = in_latin(sentence)
            symbols, words = ("", ()) if is_foreign(latin) else self._tried(latin, lexicon)
            yield Sentence(sentence, begin, symbols, words, _endings(sentence, words, text[end:]))

    def _tried(self, sentence: str, lexicon: Lexicon) -> tuple[str, tuple[int, ...]]:
        """Nothing where hibari fails, as it does for digits of rare scripts beside letters."""
        try:
            return self._read(sentence, lexicon)
        except (LookupError, TypeError, ValueError):
            return "", ()

    def _read(self, sentence: str, lexicon: Lexicon) -> tuple[str, tuple[int, ...]]:
        read = _parted(spoken(_unshouted(sentence, lexicon).translate(_MARKUP)))
        tokens = self._g2p.tokenize(_with_letters(read))
        self._say(tokens, lexicon)
        origins = [origin for _, origin in _words_of(read, sentence)]
        symbols: list[str] = []
        words: list[int] = []
        sounding = self._g2p.phonemize_tokens(tokens)
        for token, number in zip(sounding, _numbers(sounding), strict=True):
            of_token = (token.phonemes or "") + (SPACE if token.whitespace else "")
            symbols.append(of_token)
            words += [origins[min(number, len(origins) - 1)]] * len(of_token)
        return "".join(symbols), tuple(words)

    def _say(self, tokens: Sequence[Any], lexicon: Lexicon) -> None:
        """Give symbols to the words that the voice's own dictionary lacks, or should not say."""
        words = [token.text for token in tokens]
        begins = True
        said: Phones = ()
        for place, token in enumerate(tokens):
            if token.text in _POSSESSIVE and said:
                phones = with_s(said)[len(said) :]
            else:
                phones = (
                    lexicon.of_user(token.text)
                    or heteronyms.said(words, place, token.tag)
                    or self._named(token, begins, lexicon)
                )
            if phones and not token.phonemes:
                token.phonemes = symbols_of(stressed(phones))
            said = () if token.whitespace else phones
            begins = token.text[-1] in OPENING

    def _named(self, token: Any, begins: bool, lexicon: Lexicon) -> Phones:
        """What the dictionary says of a name or a word that the voice does not know."""
        is_asked = is_name(token.text, begins_sentence=begins) or not self._knows(token)
        return lexicon.spoken(token.text) if is_asked else ()

    def _knows(self, token: Any) -> bool:
        """Whether the voice has the word in its own dictionary, or knows how to read it."""
        from hibari.g2p import Context

        symbols, _ = self._g2p.lexicon(token, Context())
        return symbols is not None


def _in_paragraphs(text: str) -> str:
    """The text in which a line ends only where a paragraph does: others are cut to fit a page."""
    signs = list(plain(text))
    for blank_line in _BLANK_LINE.finditer(text):
        signs[blank_line.start()] = "\n"
    return "".join(signs)


def _endings(sentence: str, words: Sequence[int], rest: str) -> tuple[Ending, ...]:
    """The ends of the phrases of a sentence, of whose symbols `words` are the words.

    `rest` is the text after it.
    """
    begins = [match.start() for match in _WORD.finditer(sentence)]
    endings = []
    for boundary in boundaries(sentence):
        last = bisect_right(begins, boundary.end - 1) - 1
        endings.append(Ending(bisect_right(words, last), boundary.tone, boundary.pause_s))
    if endings:
        endings[-1] = endings[-1]._replace(pause_s=pause_between(sentence, rest))
    return tuple(endings)


def _unshouted(sentence: str, lexicon: Lexicon) -> str:
    """A sentence all in capitals with its words in small letters, so that none is spelled."""
    words = [word for word in sentence.split() if _SHOUTED.match(word)]
    if not sentence.isupper() or len(words) < 2:
        return sentence
    return _SHOUTED.sub(lambda m: m[0].capitalize() if lexicon.spoken(m[0]) else m[0], sentence)


def _parted(read: Spoken) -> Spoken:
    """The same with spaces within what is longer than any word.

    hibari takes time that grows with the third power of the parts of a word.
    """
    if not _LONG.search(read.text):
        return read
    text: list[str] = []
    origins: list[int] = []
    letters: list[int] = []
    length = 0
    for place, sign in enumerate(read.text):
        origin = read.origins[place]
        length = 0 if sign.isspace() else length + 1
        if length > LONGEST_WORD:
            text.append(" ")
            origins.append(origin)
            length = 1
        if place in read.letters:
            letters.append(len(text))
        text.append(sign)
        origins.append(origin)
    return Spoken("".join(text), tuple(origins), frozenset(letters))


def _with_letters(read: Spoken) -> str:
    """The text with the sound of each letter A, which would be taken for the article."""
    return "".join(
        "[A](/ˈA/)" if sign == "A" and place in read.letters else sign
        for place, sign in enumerate(read.text)
    )


def _numbers(tokens: Sequence[Any]) -> list[int]:
    """The word in which each token begins: tokens without a space between them are one."""
    spaces = [sum(part.isspace() for part in token.text + token.whitespace) for token in tokens]
    return [0, *accumulate(spaces)][: len(tokens)]


def words_read(text: str) -> list[tuple[str, int]]:
    """The words that an English text is read as, each with the number of its written word.

    The letter A is "ay", the article is not.
    """
    read = spoken(text)
    said = "".join(
        "\0" if sign == "A" and place in read.letters else sign
        for place, sign in enumerate(read.text)
    )
    words = _words_of(replace(read, text=said), text)
    return [(word.replace("\0", "ay"), origin) for word, origin in words]


def _words_of(read: Spoken, text: str) -> Iterator[tuple[str, int]]:
    starts = [match.start() for match in _WORD.finditer(text)]
    for match in _WORD.finditer(read.text):
        yield match[0], max(0, bisect_right(starts, read.origins[match.start()]) - 1)


def is_foreign(text: str) -> bool:
    """Whether most letters of a text are none of the Latin script."""
    letters = [letter for letter in _SIGNS.sub("", text) if letter.isalpha()]
    foreign = sum("LATIN" not in unicodedata.name(letter, "") for letter in letters)
    return foreign > _FOREIGN * len(letters)
