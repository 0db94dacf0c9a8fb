"""What espeak-ng is given to read: plain text, with names and words of two sounds spelt out."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from dataclasses import dataclass

from hri.speech.notation.reading import Spoken, spoken
from hri.speech.pronunciation import heteronyms
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.pronunciation.names import OPENING, is_name
from hri.speech.pronunciation.phones import VOWELS, Phones
from hri.speech.pronunciation.scripts import in_latin

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
_PART = re.compile(r"\w+(?:['\N{RIGHT SINGLE QUOTATION MARK}]\w+)*|[^\w\s]")
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

    With a lexicon it is English: numbers and signs are read as the natural voice reads them; names,
    and words that are said in several ways, sound as the lexicon and the words around them say.
    """
    text = plain(text)
    if lexicon is None:
        return Reading(text, tuple(range(len(text))))
    read = spoken(text)
    words = _spelt(read.text, lexicon)
    taken = {place for start, end, _ in words for place in range(start, end)}
    names = sorted([*words, *(letter for letter in _letters(read) if letter[0] not in taken)])
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


def _spelt(text: str, lexicon: Lexicon) -> list[tuple[int, int, str]]:
    """Where words stand that the library may not say right, and how they are spelt in mnemonics."""
    found = []
    parts = list(_PART.finditer(text))
    words = [in_latin(part[0]) for part in parts]
    begins = True
    for place, (part, word) in enumerate(zip(parts, words, strict=True)):
        phones: Phones = ()
        if word[0].isalnum():
            phones = (
                lexicon.of_user(word)
                or heteronyms.said(words, place)
                or (lexicon.spoken(word) if is_name(word, begins_sentence=begins) else ())
            )
        if phones or word != part[0]:
            # Behind a bracket or a quote, without spaces, the library would leave it out.
            spelt = f"[[{mnemonics(phones)}]]" if phones else word
            found.append((part.start(), part.end(), f" {spelt} "))
        begins = word in OPENING
    return found


def _letters(read: Spoken) -> Iterator[tuple[int, int, str]]:
    """Where the letter A stands, which would be taken for the article."""
    for place in read.letters:
        if read.text[place] == "A":
            yield place, place + 1, " [['eI]] "


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
