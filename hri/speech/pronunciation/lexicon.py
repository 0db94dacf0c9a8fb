"""How words sound: the user's own lexicon, then the CMU dictionary, then letter-to-sound rules.

The dictionary knows one American's way of many words that others say otherwise: beside its own
there are those of `variants.txt`, from general American and British speech ("almond" with an L, the
broad A of "fast", "schedule" with SH). It lacks some names of today; `more_names.txt` has them.

A lexicon is a text file in the format of the CMU dictionary: a word, spaces, its phones. A word
that stands in several lines may be said in several ways, the likeliest first; a lexicon's entries
for a word replace the dictionary's. Stress (the digits 0, 1 and 2 behind vowels) may be written and
is used by the voice; a line that begins with `#` or `;` is a comment.

    # our cat
    schrodinger   SH R OW1 D IH0 NG ER0
    schrodinger   SH R EY1 D IH0 NG ER0
"""

from __future__ import annotations

import os
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Literal

from hri.core import paths
from hri.core.errors import AuthoringError, HriError, Place, did_you_mean
from hri.core.ownership import require_of_user
from hri.core.privacy import folder_for
from hri.core.reading import read_text
from hri.core.writing import PRIVATE, write_text
from hri.speech.pronunciation.dictionary import Dictionary, cmu_dictionary
from hri.speech.pronunciation.guesses import Guesses
from hri.speech.pronunciation.phones import PHONES, VOWELS, Phones, with_s, without_stress

Origin = Literal["user", "dictionary", "guessed"]

VARIANTS = Path(__file__).with_name("variants.txt")
"""More ways to say words of the dictionary, in the format of a lexicon."""
MORE_NAMES = Path(__file__).with_name("more_names.txt")
"""Names that the dictionary lacks, or says as few people do, in the format of a lexicon."""
VARIABLE = "HRI_LEXICON"
"""Names the user's lexicon when it is not in the folder of settings."""
MOST_VARIANTS = 8
"""Pronunciations of one word."""
MOST_PHONES = 60
"""In one pronunciation."""


class Lexicon:
    """Pronunciations of any English word."""

    def __init__(
        self,
        own: Mapping[str, tuple[Phones, ...]],
        dictionary: Dictionary,
        variants: Mapping[str, tuple[Phones, ...]] | None = None,
        guesses: Guesses | None = None,
        names: Mapping[str, tuple[Phones, ...]] | None = None,
    ) -> None:
        """`own` are the words of the user, their phones with or without stress.

        `variants` are more ways to say words of the dictionary, `names` words that it lacks, or
        that people say in a likelier way.
        """
        self._own = own
        self._dictionary = dictionary
        self._variants = variants or {}
        self._guesses = guesses or Guesses()
        self._names = names or {}

    def extended(self, sounds: Sequence[tuple[str, Phones]]) -> Lexicon:
        """This lexicon with phones for some words, instead of what it says of them."""
        if not sounds:
            return self
        own = {_folded(word): (phones,) for word, phones in sounds}
        parts = (self._dictionary, self._variants, self._guesses, self._names)
        return Lexicon({**self._own, **own}, *parts)

    def of_users(self) -> frozenset[tuple[str, tuple[Phones, ...]]]:
        """All words of the user, with their phones as they are written."""
        return frozenset(self._own.items())

    def pronunciations(self, word: str) -> tuple[Phones, ...]:
        """All ways to say a word, without stress, the likeliest first.

        Raises HriError when nobody knows how it is said.
        """
        word = _folded(word)
        return self.known(word) or _heard(self._made(word)) or self._guesses[word]

    def spoken(self, word: str) -> Phones:
        """The likeliest way to say a word, with its stress; empty when it would be guessed."""
        word = _folded(word)
        return self.of_user(word) or next(iter(self._listed(word) or self._made(word)), ())

    def of_user(self, word: str) -> Phones:
        """The likeliest way to say a word as the user says it, or one of the user's with 's.

        Stress is there where it is written. Empty for all other words.
        """
        word = self._spelled(_folded(word))
        if own := self._own.get(word):
            return own[0]
        stem = self._own.get(self._spelled(word.removesuffix("'s")))
        return with_s(stem[0]) if stem else ()

    def origin(self, word: str) -> Origin:
        """Who knows how a word is said."""
        word = _folded(word)
        if self._spelled(word) in self._own:
            return "user"
        return "dictionary" if self._listed(word) else "guessed"

    def __contains__(self, word: str) -> bool:
        """Whether the user or the dictionary knows a word, so that it need not be guessed."""
        return self.origin(word) != "guessed"

    def known(self, word: str) -> tuple[Phones, ...]:
        """What the user or the dictionary says of a word; empty when it would be guessed."""
        word = _folded(word)
        own = () if word in self._own else self._variants.get(word, ())
        return _heard((*self._listed(word), *own))

    def _listed(self, word: str) -> tuple[Phones, ...]:
        """What the user or the dictionary says of a word, with stress."""
        word = self._spelled(word)
        if own := self._own.get(word):
            return own
        return (*self._names.get(word, ()), *self._dictionary.pronunciations(word))

    def _spelled(self, word: str) -> str:
        """The word as it is listed: "jose" for "josé", where that one is not."""
        listed = (self._own, self._names, self._dictionary)
        is_listed = word.isascii() or any(word in words for words in listed)
        return word if is_listed else without_accents(word)

    def _made(self, word: str) -> tuple[Phones, ...]:
        """A form of a known word, or one made of known ones: better known than guessed."""
        for stem in _stems(word):
            if found := self._listed(stem):
                ends_alike = stem == word.rstrip("'")
                return found if ends_alike else tuple(map(with_s, found))
        stem, mark, rest = word.partition("'")
        if (end := CONTRACTIONS.get(mark + rest)) and (found := self._listed(stem)):
            return tuple((*phones, *end) for phones in found)
        parts = [self._part(part) for part in _PARTS.sub(r"\1 ", word).replace("-", " ").split()]
        if len(parts) > 1 and all(parts):
            *before, last = parts
            return ((*(_weaker(phone) for part in before for phone in part), *last),)
        return ()

    def _part(self, part: str) -> Phones:
        return PREFIXES.get(part) or next(iter(self._listed(part)), ())


CONTRACTIONS: Mapping[str, Phones] = {
    "'d": ("D",),
    "'ll": ("AH0", "L"),
    "'re": ("ER0",),
    "'ve": ("AH0", "V"),
}
"""Verbs at the end of a word, and how they are said."""
PREFIXES: Mapping[str, Phones] = {
    "mc": ("M", "AH0", "K"),
    "o'": ("OW0",),
    "d'": ("D",),
}
"""What names begin with, and how it is said."""
_PARTS = re.compile(rf"^({'|'.join(PREFIXES)})(?=\w{{3}})")


def _stems(word: str) -> tuple[str, ...]:
    """What a word may be a form of: "james's", "james'", and "karens" of "james" and "karen"."""
    if word.endswith("'s"):
        return (word[:-2],)
    if word.endswith("s'"):
        return (word[:-1], word[:-2])
    if word.endswith("s") and not word.endswith("ss"):
        is_long = word.endswith(("ses", "zes", "xes", "ches", "shes"))
        return (word[:-1], word[:-2]) if is_long else (word[:-1],)
    return ()


def _weaker(phone: str) -> str:
    """A phone of a part before the last of a compound: the last has the main stress."""
    return phone.replace("1", "2")


def _heard(spoken: Iterable[Phones]) -> tuple[Phones, ...]:
    """The different ways without stress."""
    return tuple(dict.fromkeys(map(without_stress, spoken)))


def _folded(word: str) -> str:
    return unicodedata.normalize("NFC", word.lower()).replace(
        "\N{RIGHT SINGLE QUOTATION MARK}", "'"
    )


def without_accents(word: str) -> str:
    """The word in plain letters: "zoe" for "zoë", "soren" for "søren"."""
    split = unicodedata.normalize("NFKD", word.translate(_PLAIN_LETTERS))
    return "".join(letter for letter in split if not unicodedata.combining(letter))


_PLAIN_LETTERS = str.maketrans(
    {"ø": "o", "ł": "l", "ß": "ss", "æ": "ae", "œ": "oe", "đ": "d", "ð": "d", "þ": "th"}
)


def load_lexicon(*files: Path) -> Lexicon:
    """The user's lexicon, these files (a later one wins), and the built-in lexicon. Raises
    AuthoringError for a mistake in a file, HriError when one cannot be read.
    """
    own: dict[str, tuple[Phones, ...]] = {}
    for path in (*_of_user(), *files):
        own |= read_lexicon(path)
    return Lexicon(own, cmu_dictionary(), _built_in(VARIANTS), names=_built_in(MORE_NAMES))


@cache
def _built_in(path: Path) -> Mapping[str, tuple[Phones, ...]]:
    return read_lexicon(path)


def user_lexicon() -> Path:
    """The file of the user's own words: $HRI_LEXICON, else in the folder of settings."""
    named = os.environ.get(VARIABLE)
    return paths.expanded(named) if named else paths.settings_folder() / "lexicon.txt"


def _of_user() -> tuple[Path, ...]:
    path = user_lexicon()
    if os.environ.get(VARIABLE):  # by the user, who may share it: it must be there
        return (path,)
    if not path.exists():
        return ()
    require_of_user(path, "lexicon")
    return (path,)


def read_lexicon(path: Path) -> dict[str, tuple[Phones, ...]]:
    """The words of a file, their phones with stress as it is written.

    Raises AuthoringError for the first mistake, HriError when it cannot be read.
    """
    words: dict[str, tuple[Phones, ...]] = {}
    for number, line in enumerate(read_text(path, "lexicon").splitlines(), start=1):
        if line.strip() and not line.lstrip().startswith(("#", ";")):
            word, phones = _entry(path, number, line)
            variants = dict.fromkeys((*words.get(word, ()), phones))
            if len(variants) > MOST_VARIANTS:
                what = f'"{word}" has more than {MOST_VARIANTS} pronunciations'
                raise AuthoringError(Place(path, number), what, "keep the likeliest")
            words[word] = tuple(variants)
    return words


def _entry(path: Path, number: int, line: str) -> tuple[str, Phones]:
    """The word and the phones of a line; "read(2)" is another way to say "read"."""
    word, *spelt = line.partition(" #")[0].split()
    try:
        phones = read_phones(" ".join(spelt))
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        wrong = next((phone for phone in spelt if not _is_phone(phone)), word)
        column = line.index(wrong, 0 if wrong == word else line.index(word) + len(word)) + 1
        raise AuthoringError(Place(path, number, column), what, remedy) from error
    return _word(word), phones


def _word(written: str) -> str:
    """The word that a line begins with: "read" for "read(2)"."""
    return _folded(written.partition("(")[0] or written)


def read_phones(text: str) -> Phones:
    """The phones of a text such as "R OW1 B AA2 T", stress kept. Raises HriError."""
    phones = tuple(text.upper().split())
    if not phones or len(phones) > MOST_PHONES:
        what = "too many phones" if phones else "no phones"
        raise HriError(f"{what} - write some such as R OW B AA T for robot")
    for phone in phones:
        if not _is_phone(phone):
            remedy = did_you_mean(phone.rstrip("012"), PHONES)
            raise HriError(f'no phone "{phone}" - {remedy}')
    return phones


def _is_phone(text: str) -> bool:
    phone = text.upper().rstrip("012")
    stress = len(text) - len(phone)
    return phone in PHONES and stress <= (1 if phone in VOWELS else 0)


def add_to_lexicon(path: Path, word: str, *variants: Phones) -> tuple[Phones, ...]:
    """Write the ways to say a word into a lexicon, which is made when it is not there.

    They take the place of what it said of the word before, which is returned.
    Raises AuthoringError when the file has a mistake already, HriError for a text that is not a
    word, has more than MOST_VARIANTS pronunciations, or cannot be written.
    """
    if len(word.split()) != 1 or word.startswith(("#", ";")) or "(" in word:
        raise HriError(f'"{word}" is not a single word - add one word at a time')
    if len(variants) > MOST_VARIANTS:
        raise HriError(f"more than {MOST_VARIANTS} pronunciations - keep the likeliest")
    word = _folded(word)
    before = read_lexicon(path).get(word, ()) if path.exists() else ()
    lines = read_text(path, "lexicon").splitlines() if path.exists() else []
    kept = [line for line in lines if not line.strip() or _word(line.split()[0]) != word]
    kept += [f"{word}  {' '.join(phones)}" for phones in dict.fromkeys(variants)]
    folder_for(path)
    is_own = path.parent == paths.settings_folder()
    write_text(path, "\n".join(kept) + "\n", PRIVATE if is_own else None)
    return before
