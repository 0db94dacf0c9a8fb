"""How words sound: the user's own lexicon, then the CMU dictionary, then letter-to-sound rules.

The dictionary knows one American's way of many words that others say otherwise: beside its own
there are those of `variants.txt`, from general American and British speech ("almond" with an L, the
broad A of "fast", "schedule" with SH).

A lexicon is a text file in the format of the CMU dictionary: a word, spaces, its phones. A word
that stands in several lines may be said in several ways, the likeliest first; what a lexicon says
of a word replaces what the dictionary says. Stress (the digits 0, 1 and 2 behind vowels) may be
written and is used by the voice; a line that begins with `#` or `;` is a comment.

    # our cat
    schrodinger   SH R OW1 D IH0 NG ER0
    schrodinger   SH R EY1 D IH0 NG ER0
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
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
from hri.speech.pronunciation.phones import PHONES, VOWELS, Phones

Origin = Literal["user", "dictionary", "guessed"]

VARIANTS = Path(__file__).with_name("variants.txt")
"""More ways to say words of the dictionary, in the format of a lexicon."""
VARIABLE = "HRI_LEXICON"
"""Names the user's lexicon when it is not in the folder of settings."""
MOST_VARIANTS = 8
"""Pronunciations of one word."""
MOST_PHONES = 60
"""In one pronunciation."""
_VOICELESS = frozenset(("P", "T", "K", "F", "TH"))
_HISSING = frozenset(("S", "Z", "SH", "ZH", "CH", "JH"))


class Lexicon:
    """Pronunciations of any English word."""

    def __init__(
        self,
        own: Mapping[str, tuple[Phones, ...]],
        dictionary: Dictionary,
        variants: Mapping[str, tuple[Phones, ...]] | None = None,
        guesses: Guesses | None = None,
    ) -> None:
        """`own` are the words of the user, their phones with or without stress.

        `variants` are more ways to say words of the dictionary.
        """
        self._own = own
        self._dictionary = dictionary
        self._variants = variants or {}
        self._guesses = guesses or Guesses()

    def extended(self, sounds: Sequence[tuple[str, Phones]]) -> Lexicon:
        """This lexicon with phones for some words, instead of what it says of them."""
        if not sounds:
            return self
        own = {_folded(word): (phones,) for word, phones in sounds}
        return Lexicon({**self._own, **own}, self._dictionary, self._variants, self._guesses)

    def pronunciations(self, word: str) -> tuple[Phones, ...]:
        """All ways to say a word, without stress, the likeliest first.

        Raises HriError when nobody knows how it is said.
        """
        word = _folded(word)
        return self.known(word) or self._inflected(word) or self._guesses[word]

    def origin(self, word: str) -> Origin:
        """Who knows how a word is said."""
        word = _folded(word)
        if word in self._own:
            return "user"
        return "dictionary" if word in self._dictionary else "guessed"

    def __contains__(self, word: str) -> bool:
        """Whether the user or the dictionary knows a word, so that it need not be guessed."""
        return self.origin(word) != "guessed"

    def with_stress(self, word: str) -> tuple[Phones, ...]:
        """What the user's lexicon says of a word, stress as it is written; empty when nothing."""
        return self._own.get(_folded(word), ())

    def known(self, word: str) -> tuple[Phones, ...]:
        """What the user or the dictionary says of a word; empty when it would be guessed."""
        word = _folded(word)
        own = self._own.get(word)
        if own is None:
            usual = self._dictionary.pronunciations(word)
            return (*usual, *self._variants.get(word, ()))
        return tuple(dict.fromkeys(tuple(map(_without_stress, phones)) for phones in own))

    def _inflected(self, word: str) -> tuple[Phones, ...]:
        """A word with 's, or made of known ones with hyphens: better known than guessed."""
        if word.endswith("'s"):
            return tuple((*phones, *_possessive(phones[-1])) for phones in self.known(word[:-2]))
        parts = [self.known(part) for part in word.split("-") if part]
        if len(parts) > 1 and all(parts):
            return (tuple(phone for part in parts for phone in part[0]),)
        return ()


def _possessive(last: str) -> Phones:
    if last in _HISSING:
        return ("IH", "Z")
    return ("S",) if last in _VOICELESS else ("Z",)


def _folded(word: str) -> str:
    return word.lower().replace("\N{RIGHT SINGLE QUOTATION MARK}", "'")


def _without_stress(phone: str) -> str:
    return phone.rstrip("012")


def load_lexicon(*files: Path) -> Lexicon:
    """The user's lexicon, these files (a later one wins), and the built-in lexicon. Raises
    AuthoringError for a mistake in a file, HriError when one cannot be read.
    """
    own: dict[str, tuple[Phones, ...]] = {}
    for path in (*_of_user(), *files):
        own |= read_lexicon(path)
    return Lexicon(own, cmu_dictionary(), read_lexicon(VARIANTS))


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
            remedy = did_you_mean(_without_stress(phone), PHONES)
            raise HriError(f'no phone "{phone}" - {remedy}')
    return phones


def _is_phone(text: str) -> bool:
    phone = _without_stress(text.upper())
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
