"""Sounds as they are written elsewhere: the International Phonetic Alphabet, X-SAMPA, and ARPAbet.

X-SAMPA: J. C. Wells, "Computer-coding the IPA" (1995). Each symbol is taken as the nearest phone of
American English.
"""

# ruff: noqa: RUF001 - letters of the International Phonetic Alphabet are meant.
from __future__ import annotations

from collections.abc import Iterator, Mapping

from hri.speech.pronunciation.phones import PHONES, VOWELS, Phones

_SHARED = {
    "aɪ": "AY", "aʊ": "AW", "eɪ": "EY", "oʊ": "OW", "əʊ": "OW", "ɔɪ": "OY", "tʃ": "CH",
    "dʒ": "JH", "ɪə": "IH R", "eə": "EH R", "ʊə": "UH R",
}  # fmt: skip
IPA = {
    **_SHARED, "t͡ʃ": "CH", "d͡ʒ": "JH", "ʧ": "CH", "ʤ": "JH", "ɑ": "AA", "ɒ": "AA", "a": "AE",
    "æ": "AE", "ʌ": "AH", "ə": "AH", "ɐ": "AH", "ɔ": "AO", "e": "EH", "ɛ": "EH", "ɜ": "ER",
    "ɝ": "ER", "ɚ": "ER", "ɪ": "IH", "ɨ": "IH", "i": "IY", "o": "OW", "ʊ": "UH", "u": "UW",
    "b": "B", "d": "D", "ð": "DH", "f": "F", "ɡ": "G", "g": "G", "h": "HH", "k": "K", "l": "L",
    "ɫ": "L", "m": "M", "n": "N", "ŋ": "NG", "p": "P", "ɹ": "R", "r": "R", "ɾ": "T", "s": "S",
    "ʃ": "SH", "t": "T", "θ": "TH", "v": "V", "w": "W", "j": "Y", "z": "Z", "ʒ": "ZH",
}  # fmt: skip
X_SAMPA = {
    "aI": "AY", "aU": "AW", "eI": "EY", "oU": "OW", "@U": "OW", "OI": "OY", "tS": "CH",
    "dZ": "JH", "I@": "IH R", "e@": "EH R", "U@": "UH R", "A": "AA", "Q": "AA", "a": "AE",
    "{": "AE", "V": "AH", "@": "AH", "6": "AH", "O": "AO", "e": "EH", "E": "EH", "3": "ER",
    "@`": "ER", "3`": "ER", "I": "IH", "i": "IY", "o": "OW", "U": "UH", "u": "UW", "b": "B",
    "d": "D", "D": "DH", "f": "F", "g": "G", "h": "HH", "k": "K", "l": "L", "m": "M", "n": "N",
    "N": "NG", "p": "P", "r\\": "R", "r": "R", "4": "T", "s": "S", "S": "SH", "t": "T",
    "T": "TH", "v": "V", "w": "W", "j": "Y", "z": "Z", "Z": "ZH",
}  # fmt: skip
STRESSES = {"ˈ": "1", "'": "1", "ˌ": "2", ",": "2"}
SAMPA_STRESSES = {'"': "1", "%": "2"}
_SILENT = " .ː:‿|"
"""Marks of length and of syllables, which change no phone."""


def from_ipa(text: str) -> Phones:
    """The phones of a word in IPA. Raises ValueError with the symbol that is unknown."""
    return tuple(_phones(text, IPA, STRESSES))


def from_x_sampa(text: str) -> Phones:
    """The phones of a word in X-SAMPA. Raises ValueError with the symbol that is unknown."""
    return tuple(_phones(text, X_SAMPA, SAMPA_STRESSES))


def from_arpabet(text: str) -> Phones:
    """The phones of a word in the CMU dictionary's spelling, spaces between. Raises ValueError."""
    phones = tuple(text.upper().split())
    for phone in phones:
        if phone.rstrip("012") not in PHONES:
            raise ValueError(phone)
    return phones


def _phones(text: str, symbols: Mapping[str, str], stresses: Mapping[str, str]) -> Iterator[str]:
    """The symbols from left to right, the longest that fits; a stress goes to the next vowel."""
    longest = max(map(len, symbols))
    place, stress = 0, ""
    while place < len(text):
        if text[place] in stresses:
            stress = stresses[text[place]]
            place += 1
        elif text[place] in _SILENT:
            place += 1
        else:
            sizes = range(longest, 0, -1)
            size = next((s for s in sizes if text[place : place + s] in symbols), 0)
            if not size:
                raise ValueError(text[place])
            for phone in symbols[text[place : place + size]].split():
                yield phone + (stress if phone in VOWELS else "")
                stress = "" if phone in VOWELS else stress
            place += size
