"""Which sound makes which shape of the mouth: one table from phonemes to visemes.

Two notations are read: the mnemonics of espeak-ng, as the built-in voice gives them, and
ARPAbet, as CMUdict and the voices built on it do. "D" is the sound of "this" in the one and of
"day" in the other, so a whole speech is read in one notation, never a sound alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass


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

ARPABET = {
    "sil": "SIL SP PAU",
    "PP": "P B M EM",
    "FF": "F V",
    "TH": "TH DH",
    "DD": "T D DX",
    "kk": "K G NG ENG Q",
    "CH": "CH JH SH ZH",
    "SS": "S Z",
    "nn": "N L EL EN NX",
    "RR": "R ER AXR",
    "aa": "AA AE AH",
    "E": "EH",
    "ih": "IH IY Y IX",
    "oh": "AO",
    "ou": "UH UW W WH UX",
}
"""ARPAbet by viseme."""

ARPABET_GLIDES = {"AY": "aa ih", "AW": "aa ou", "EY": "E ih", "OW": "oh ou", "OY": "oh ih"}
ARPABET_REDUCED = "AX AH0"

BREATH = ("h", "HH")
"""Sounds without their own mouth shape: the mouth is already at the next one."""
_SCHWA = Sound(("E",), 0.5)
_UNKNOWN = Sound(("kk",), 0.3)
_STRESS = "'%,=|"
_LENGTH = ":~#"


def _table(singles: Mapping[str, str], glides: Mapping[str, str], reduced: str) -> dict[str, Sound]:
    table = {name: Sound((viseme,)) for viseme, names in singles.items() for name in names.split()}
    table |= {name: Sound(tuple(pair.split())) for name, pair in glides.items()}
    return table | dict.fromkeys(reduced.split(), _SCHWA)


_ESPEAK = _table(ESPEAK, ESPEAK_GLIDES, ESPEAK_REDUCED)
_ARPABET = _table(ARPABET, ARPABET_GLIDES, ARPABET_REDUCED)
_ONLY_ARPABET = {name for name in _ARPABET if len(name) > 1} - set(_ESPEAK)


def is_arpabet(names: Iterable[str]) -> bool:
    """Whether the sounds of a speech are ARPAbet, as its two-letter vowels show."""
    return any(name.strip("012") in _ONLY_ARPABET for name in names)


def sound_of(name: str, *, arpabet: bool = False) -> Sound:
    """How the mouth makes a sound; an unknown one is a slightly open mouth.

    Marks of stress and of length are ignored where the table does not name them.
    """
    if arpabet:
        return _ARPABET.get(name) or _ARPABET.get(name.rstrip("012")) or _UNKNOWN
    plain = name.strip(_STRESS)
    for candidate in (plain, plain.rstrip(_LENGTH), plain.rstrip(_LENGTH + "0123456789")):
        if candidate in _ESPEAK:
            return _ESPEAK[candidate]
    return _ESPEAK.get(plain[:1], _UNKNOWN)
