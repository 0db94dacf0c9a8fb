"""What espeak-ng is given to read: plain text, with the names of the user's lexicon spelt out."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass

from hri.speech.notation.reading import Spoken, spoken
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.phones import VOWELS, Phones

MNEMONICS = {
    "AA": "A:", "AE": "a", "AH": "V", "AO": "O:", "AW": "aU", "AY": "aI", "B": "b", "CH": "tS",
    "D": "d", "DH": "D", "EH": "E", "ER": "3:", "EY": "eI", "F": "f", "G": "g", "HH": "h",
    "IH": "I", "IY": "i:", "JH": "dZ", "K": "k", "L": "l", "M": "m", "N": "n", "NG": "N",
    "OW": "oU", "OY": "OI", "P": "p", "R": "r", "S": "s", "SH": "S", "T": "t", "TH": "T",
    "UH": "U", "UW": "u:", "V": "v", "W": "w", "Y": "j", "Z": "z", "ZH": "Z",
}  # fmt: skip
"""espeak-ng's mnemonics of American English for the phones of the CMU dictionary."""
WEAK = {"AH": "@", "ER": "3", "IY": "i"}
"""The same for vowels without stress."""
STRESSES = {"0": "", "1": "'", "2": ","}

_EASILY_WEAK = ("AH", "ER", "IH")
_WORD = re.compile(r"\w+(?:['\N{RIGHT SINGLE QUOTATION MARK}]\w+)*")
_PHONEME_BRACKETS = str.maketrans("[]", "  ")


@dataclass(frozen=True, slots=True)
class Reading:
    """A text as the library gets it."""

    text: str
    origins: tuple[int, ...]
    """For each of its characters the one of the author's text that it stands for."""
    has_phonemes: bool = False
    """Whether [[ ]] in it hold mnemonics."""


def plain(text: str) -> str:
    """The text with spaces for all characters that the library would obey or cannot take.

    It takes orders (faster, another voice) from control characters; half of a surrogate pair
    cannot be encoded. Markup needs no care: it is only understood where it is asked for.
    """
    return "".join(" " if unicodedata.category(c) in ("Cc", "Cs") else c for c in text)


def reading(text: str, lexicon: Lexicon | None = None) -> Reading:
    """The text as the library gets it.

    With a lexicon it is English: numbers and signs are read as the natural voice reads them, and
    words that the lexicon holds sound as it says.
    """
    text = plain(text)
    if lexicon is None:
        return Reading(text, tuple(range(len(text))))
    read = spoken(text)
    spelt_out = {name[0]: name for name in (*_letters(read), *_names(read.text, lexicon))}
    names = sorted(spelt_out.values())
    if not names:
        return Reading(read.text, read.origins)
    text, places = read.text.translate(_PHONEME_BRACKETS), read.origins
    parts: list[str] = []
    origins: list[int] = []
    done = 0
    for start, end, spelt in names:
        parts += text[done:start], spelt
        origins += [*places[done:start], *[places[start]] * len(spelt)]
        done = end
    return Reading("".join((*parts, text[done:])), (*origins, *places[done:]), True)


def _names(text: str, lexicon: Lexicon) -> list[tuple[int, int, str]]:
    """Where words of the user's lexicon stand, and how they are spelt in mnemonics."""
    found = []
    for match in _WORD.finditer(text):
        phones = user_phones(match[0], lexicon)
        if phones:
            # Behind a bracket or a quote, without spaces, the library would leave it out.
            found.append((match.start(), match.end(), f" [[{mnemonics(phones)}]] "))
    return found


def _letters(read: Spoken) -> Iterator[tuple[int, int, str]]:
    """Where the letter A stands, which would be taken for the article."""
    for place in read.letters:
        if read.text[place] == "A":
            yield place, place + 1, " [['eI]] "


def user_phones(word: str, lexicon: Lexicon) -> Phones:
    """The likeliest phones of a word of the user's, or of one with 's; empty for other words."""
    own = lexicon.with_stress(word)
    if own:
        return own[0]
    own = (
        lexicon.with_stress(word[:-2]) if word[-2:-1] in "'\N{RIGHT SINGLE QUOTATION MARK}" else ()
    )
    return (*own[0], *lexicon.pronunciations(word)[0][len(own[0]) :]) if own else ()


def mnemonics(phones: Phones) -> str:
    """The phones of a word for the library: ("R", "OW1", "B") is "r|'oU|b"."""
    return "|".join(_mnemonic(phone) for phone in stressed(phones))


def stressed(phones: Phones) -> Phones:
    """The phones of a word with its stress as it is written.

    Where none is written, it falls on the first vowel that is seldom weak, as in most English
    names.
    """
    if any(phone[-1] in STRESSES for phone in phones):
        return phones
    vowels = [number for number, phone in enumerate(phones) if phone in VOWELS]
    strong = [number for number in vowels if phones[number] not in _EASILY_WEAK]
    chosen = (strong or vowels or [-1])[0]
    return tuple(f"{phone}1" if number == chosen else phone for number, phone in enumerate(phones))


def _mnemonic(phone: str) -> str:
    name = phone.rstrip("012")
    stress = STRESSES.get(phone[len(name) :], "")
    return stress + MNEMONICS[name] if stress else WEAK.get(name, MNEMONICS[name])
