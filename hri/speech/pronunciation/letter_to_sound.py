"""How a word that no dictionary knows is spoken: espeak-ng's rules, in the phones of CMU's."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Mapping

from hri.core.errors import HriError
from hri.speech.pronunciation.phones import Phones
from hri.speech.synthesizers.espeak_library import load_espeak

PHONES = {
    # Consonants.
    "p": "P", "b": "B", "t": "T", "d": "D", "k": "K", "g": "G", "t#": "D", "?": "T",
    "f": "F", "v": "V", "T": "TH", "D": "DH", "s": "S", "z": "Z", "S": "SH", "Z": "ZH", "h": "HH",
    "tS": "CH", "dZ": "JH", "m": "M", "n": "N", "N": "NG", "l": "L", "r": "R", "j": "Y", "w": "W",
    "n-": "AH N", "@L": "AH L", "m-": "AH M", "x": "K", "r-": "R",
    "t2": "T", ";": "",
    # Vowels.
    "a": "AE", "aa": "AE", "a#": "AH", "A:": "AA", "A@": "AA R", "0": "AA", "0#": "AA",
    "O:": "AO", "O": "AO", "O2": "AO", "A~": "AA N", "O@": "AO R", "o@": "AO R",
    "E": "EH", "E2": "EH", "E#": "EH",
    "I": "IH", "I#": "IH", "I2": "IH", "i": "IY", "i:": "IY", "i@": "IY AH", "i@3": "IH R",
    "e@": "EH R", "eI": "EY", "@": "AH", "@2": "AH", "@5": "AH", "@-": "AH", "3": "ER",
    "3:": "ER", "V": "AH", "U": "UH", "u:": "UW", "u": "UW", "U@": "UH R", "oU": "OW",
    "aI": "AY", "aI@": "AY AH", "aI3": "AY ER", "aU": "AW", "aU@": "AW ER", "OI": "OY",
}  # fmt: skip
"""espeak-ng's mnemonics of American English, by phones of the CMU dictionary."""


VARIANTS = {"t#": "T", "@": "IH", "I#": "AH", "I2": "AH", "0": "AO", "O:": "AA", "O2": "AA"}
"""Phones that people say instead of those of PHONES: no flap, and vowels that are merging."""


def pronounce(word: str) -> Phones:
    """The likeliest phones of a word. Raises HriError when it cannot be spoken as English."""
    return guesses(word)[0]


def guesses(word: str) -> tuple[Phones, ...]:
    """One or two pronunciations of a word, the likeliest first.

    Raises HriError when it cannot be spoken as English, NotAvailable without espeak-ng.
    """
    spelt = [mnemonic.lstrip("',") for mnemonic in load_espeak().phonemes_of(word)]
    spelt = [mnemonic for mnemonic in spelt if mnemonic.strip("_:")]
    is_known = bool(spelt) and all(mnemonic in PHONES for mnemonic in spelt)
    if not (is_known and _is_latin(word)):
        hearing = "" if _is_latin(word) else ", or hear it with a Vosk model of its language"
        remedy = f"write in English letters how it sounds{hearing}"
        raise HriError(f'nobody knows how "{word}" sounds in English - {remedy}')
    likely = _phones(PHONES, spelt)
    other = _phones({**PHONES, **VARIANTS}, spelt)
    return (likely,) if likely == other else (likely, other)


def _is_latin(word: str) -> bool:
    """Whether its letters are; those of other scripts would be named ("Chinese letter")."""
    return all(
        unicodedata.name(letter, "LATIN").startswith("LATIN") for letter in word if letter.isalpha()
    )


def _phones(table: Mapping[str, str], spelt: Iterable[str]) -> Phones:
    return tuple(" ".join(table[mnemonic] for mnemonic in spelt).split())
