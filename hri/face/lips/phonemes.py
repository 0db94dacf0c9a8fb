"""Which sound makes which shape of the mouth: one table from phonemes to visemes.

A voice names its sounds by the mnemonics of espeak-ng. Files and calls may have ARPAbet instead,
which is translated where they are read: "D" is the sound of "this" in the one and of "day" in the
other, so that is done for a whole speech, never for a sound alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum


@dataclass(frozen=True, slots=True)
class Sound:
    """How the mouth makes a sound."""

    visemes: tuple[str, ...]
    """One, or two for a sound that glides."""
    strength: float = 1.0
    """How far the mouth goes there, 0 to 1: reduced vowels are hardly opened."""


ESPEAK = {
    "sil": "_ _: _:: _! _| ; ?",
    "PP": "p b m m-",
    "FF": "f v v#",
    "TH": "T D",
    "DD": "t t# t2 d d# d[ t[ *",
    "kk": "k g N x c q C Q",
    "CH": "tS dZ S Z S; Z;",
    "SS": "s z z# z/2",
    "nn": "n n- l l/ l/2 l/3 l^ L @L N- n^",
    "RR": "r r/ r- 3 3: R",
    "aa": "a a2 a#2 aa A A: A~ 0 02 0# V &",
    "E": "E E# E2 e: e# e E~",
    "ih": "I I2 I2# i i: j Y y",
    "oh": "O O2 O: o o: O~ oU# 2 9 W",
    "ou": "U u u: w w#",
}
"""Mnemonics of espeak-ng by viseme (its English tables, with some of German and French)."""

ESPEAK_GLIDES = {
    "aI": "aa ih", "aU": "aa ou", "eI": "E ih", "oU": "oh ou", "OI": "oh ih",
    "i@": "ih E", "e@": "E E", "U@": "ou E", "aI@": "aa E", "aU@": "aa E",
    "A@": "aa RR", "O@": "oh RR", "o@": "oh RR", "IR": "ih RR", "VR": "aa RR",
    "i@3": "ih RR", "e@3": "E RR", "U@3": "ou RR", "aI3": "aa RR", "aU3": "aa RR",
}  # fmt: skip
"""Sounds that glide from one viseme to another."""

ESPEAK_REDUCED = "@ @2 @5 @# @- - I# a#"
"""Vowels that hardly open the mouth."""

ARPABET: Mapping[str, str] = {
    "SIL": "_", "SP": "_", "PAU": "_", "P": "p", "B": "b", "M": "m", "EM": "m-", "F": "f", "V": "v",
    "TH": "T", "DH": "D", "T": "t", "D": "d", "DX": "*", "K": "k", "G": "g", "NG": "N", "ENG": "N",
    "Q": "q", "CH": "tS", "JH": "dZ", "SH": "S", "ZH": "Z", "S": "s", "Z": "z", "N": "n", "L": "l",
    "EL": "@L", "EN": "n-", "NX": "n", "R": "r", "HH": "h", "W": "w", "WH": "w", "Y": "j",
    "AA": "A:", "AE": "a", "AH": "V", "AH0": "@", "AO": "O:", "AW": "aU", "AX": "@", "AXR": "3",
    "AY": "aI", "EH": "E", "ER": "3:", "EY": "eI", "IH": "I", "IX": "I2", "IY": "i:", "OW": "oU",
    "OY": "OI", "UH": "U", "UW": "u:", "UX": "u:",
}  # fmt: skip
"""The mnemonic of each sound of ARPAbet, as CMUdict and TIMIT write it."""
STRESSES = "012"
"""Marks that follow a vowel of ARPAbet: none, the first, the second stress."""


class Alphabet(StrEnum):
    """How the sounds of a speech are written."""

    ESPEAK = "espeak"
    """Mnemonics of espeak-ng, in which the lips read them."""
    ARPABET = "arpabet"


BREATH = "h"
"""The sound without its own mouth shape: the mouth is already at the next one."""
_SCHWA = Sound(("E",), 0.5)
_UNKNOWN = Sound(("kk",), 0.3)
_STRESS = "'%,=|"
_LENGTH = ":~#"


def _table(singles: Mapping[str, str], glides: Mapping[str, str], reduced: str) -> dict[str, Sound]:
    table = {name: Sound((viseme,)) for viseme, names in singles.items() for name in names.split()}
    table |= {name: Sound(tuple(pair.split())) for name, pair in glides.items()}
    return table | dict.fromkeys(reduced.split(), _SCHWA)


_ESPEAK = _table(ESPEAK, ESPEAK_GLIDES, ESPEAK_REDUCED)
_ONLY_ARPABET = {name for name in ARPABET if len(name) > 1} - set(_ESPEAK)


def mnemonics(names: Sequence[str], alphabet: Alphabet | None = None) -> list[str]:
    """The sounds of a whole speech by their mnemonics; unknown names stay as they are.

    Without an alphabet, one that has a two-letter vowel of ARPAbet is taken for that.
    """
    if alphabet is None:
        is_arpabet = any(name.strip(STRESSES) in _ONLY_ARPABET for name in names)
        alphabet = Alphabet.ARPABET if is_arpabet else Alphabet.ESPEAK
    if alphabet is Alphabet.ESPEAK:
        return list(names)
    return [ARPABET.get(name) or ARPABET.get(name.rstrip(STRESSES), name) for name in names]


def sound_of(name: str) -> Sound:
    """How the mouth makes a sound; an unknown one is a slightly open mouth.

    Marks of stress and of length are ignored where the table does not name them.
    """
    plain = name.strip(_STRESS)
    for candidate in (plain, plain.rstrip(_LENGTH), plain.rstrip(_LENGTH + "0123456789")):
        if candidate in _ESPEAK:
            return _ESPEAK[candidate]
    return _ESPEAK.get(plain[:1], _UNKNOWN)
