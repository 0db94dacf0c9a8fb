# ruff: noqa: RUF001, RUF002 - letters of the International Phonetic Alphabet are meant.
"""The phones of the CMU Pronouncing Dictionary: how each is made, and how far apart two sound.

Place, manner, height and backness are the multi-valued features of ALINE (G. Kondrak, "A New
Algorithm for the Alignment of Phonetic Sequences", NAACL 2000, tables 2 and 3), and so are the
saliences of the consonants' features. Vowels weigh more than there: Kondrak aligns words of sister
languages, whose vowels drift, while a listener distinguishes "bit" and "bat" well.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

Phones = tuple[str, ...]
"""A pronunciation: names of phones, without stress unless it is said otherwise."""

_BILABIAL, _LABIODENTAL, _DENTAL, _ALVEOLAR = 1.0, 0.95, 0.9, 0.85
_RETROFLEX, _PALATO_ALVEOLAR, _PALATAL, _VELAR, _GLOTTAL = 0.8, 0.75, 0.7, 0.6, 0.1
_STOP, _AFFRICATE, _FRICATIVE, _APPROXIMANT = 1.0, 0.9, 0.8, 0.6


@dataclass(frozen=True, slots=True)
class Consonant:
    """How a consonant is made."""

    place: float
    """Where the tongue or the lips close: 1 at the lips, 0.1 at the glottis."""
    manner: float
    """How much they close: 1 is a stop, 0.6 an approximant."""
    is_voiced: bool = False
    is_nasal: bool = False
    is_lateral: bool = False
    is_retroflex: bool = False


@dataclass(frozen=True, slots=True)
class Vowel:
    """How a vowel is made, or one end of a diphthong."""

    height: float
    """Of the tongue: 1 is high (IY), 0 is low (AA)."""
    front: float
    """Where the tongue is highest: 1 in front (IY), 0 in the back (UW)."""
    is_round: bool = False
    is_long: bool = False
    is_retroflex: bool = False


CONSONANTS = {
    "B": Consonant(_BILABIAL, _STOP, is_voiced=True),
    "CH": Consonant(_PALATO_ALVEOLAR, _AFFRICATE),
    "D": Consonant(_ALVEOLAR, _STOP, is_voiced=True),
    "DH": Consonant(_DENTAL, _FRICATIVE, is_voiced=True),
    "F": Consonant(_LABIODENTAL, _FRICATIVE),
    "G": Consonant(_VELAR, _STOP, is_voiced=True),
    "HH": Consonant(_GLOTTAL, _FRICATIVE),
    "JH": Consonant(_PALATO_ALVEOLAR, _AFFRICATE, is_voiced=True),
    "K": Consonant(_VELAR, _STOP),
    "L": Consonant(_ALVEOLAR, _APPROXIMANT, is_voiced=True, is_lateral=True),
    "M": Consonant(_BILABIAL, _STOP, is_voiced=True, is_nasal=True),
    "N": Consonant(_ALVEOLAR, _STOP, is_voiced=True, is_nasal=True),
    "NG": Consonant(_VELAR, _STOP, is_voiced=True, is_nasal=True),
    "P": Consonant(_BILABIAL, _STOP),
    "R": Consonant(_RETROFLEX, _APPROXIMANT, is_voiced=True, is_retroflex=True),
    "S": Consonant(_ALVEOLAR, _FRICATIVE),
    "SH": Consonant(_PALATO_ALVEOLAR, _FRICATIVE),
    "T": Consonant(_ALVEOLAR, _STOP),
    "TH": Consonant(_DENTAL, _FRICATIVE),
    "V": Consonant(_LABIODENTAL, _FRICATIVE, is_voiced=True),
    "W": Consonant(_BILABIAL, _APPROXIMANT, is_voiced=True),
    "Y": Consonant(_PALATAL, _APPROXIMANT, is_voiced=True),
    "Z": Consonant(_ALVEOLAR, _FRICATIVE, is_voiced=True),
    "ZH": Consonant(_PALATO_ALVEOLAR, _FRICATIVE, is_voiced=True),
}

_A, _E, _O = Vowel(0.0, 0.5), Vowel(0.5, 1.0), Vowel(0.5, 0.0, is_round=True)
_LAX_I, _LAX_U = Vowel(1.0, 0.8), Vowel(1.0, 0.2, is_round=True)

VOWELS: dict[str, tuple[Vowel, Vowel]] = {
    "AA": (Vowel(0.0, 0.2, is_long=True),) * 2,
    "AE": (Vowel(0.1, 1.0),) * 2,
    "AH": (Vowel(0.4, 0.4),) * 2,
    "AO": (Vowel(0.3, 0.0, is_round=True, is_long=True),) * 2,
    "AW": (_A, _LAX_U),
    "AY": (_A, _LAX_I),
    "EH": (_E,) * 2,
    "ER": (Vowel(0.5, 0.5, is_long=True, is_retroflex=True),) * 2,
    "EY": (_E, _LAX_I),
    "IH": (_LAX_I,) * 2,
    "IY": (Vowel(1.0, 1.0, is_long=True),) * 2,
    "OW": (_O, _LAX_U),
    "OY": (_O, _LAX_I),
    "UH": (_LAX_U,) * 2,
    "UW": (Vowel(1.0, 0.0, is_round=True, is_long=True),) * 2,
}
"""Start and end of each vowel; only those of diphthongs differ."""

PHONES: tuple[str, ...] = tuple(sorted([*CONSONANTS, *VOWELS]))
"""All 39, in the order of the alphabet."""

IPA = {
    "AA": "ɑ", "AE": "æ", "AH": "ʌ", "AO": "ɔ", "AW": "aʊ", "AY": "aɪ", "B": "b", "CH": "tʃ",
    "D": "d", "DH": "ð", "EH": "ɛ", "ER": "ɝ", "EY": "eɪ", "F": "f", "G": "ɡ", "HH": "h",
    "IH": "ɪ", "IY": "i", "JH": "dʒ", "K": "k", "L": "l", "M": "m", "N": "n", "NG": "ŋ",
    "OW": "oʊ", "OY": "ɔɪ", "P": "p", "R": "ɹ", "S": "s", "SH": "ʃ", "T": "t", "TH": "θ",
    "UH": "ʊ", "UW": "u", "V": "v", "W": "w", "Y": "j", "Z": "z", "ZH": "ʒ",
}  # fmt: skip
"""Each phone in the International Phonetic Alphabet."""

VOICELESS = frozenset(("P", "T", "K", "F", "TH"))
"""The consonants after which an s of grammar is "s" ("cats"); after others it is "z"."""
HISSING = frozenset(("S", "Z", "SH", "ZH", "CH", "JH"))
"""Those after which it takes a vowel ("foxes")."""

DROPPED = 0.5
"""What a phone costs that is said or heard too much; two unlike phones cost 1."""
_ALIKE = {frozenset(("Y", "IY")), frozenset(("W", "UW")), frozenset(("R", "ER"))}
"""A vowel and the consonant that is made in the same place."""


@cache
def distance(one: str, other: str) -> float:
    """How unlike two phones sound: 0 is the same, 1 cannot be taken for each other."""
    if one == other:
        return 0.0
    if one in CONSONANTS and other in CONSONANTS:
        return min(_between_consonants(CONSONANTS[one], CONSONANTS[other]), 1.0)
    if one in VOWELS and other in VOWELS:
        ends = zip(VOWELS[one], VOWELS[other], strict=True)
        return min(sum(_between_vowels(a, b) for a, b in ends) / 2, 1.0)
    return 0.4 if frozenset((one, other)) in _ALIKE else 1.0


def _between_consonants(one: Consonant, other: Consonant) -> float:
    """Saliences of ALINE over 50, that of the manner of speaking."""
    return (
        0.8 * abs(one.place - other.place)
        + 1.0 * abs(one.manner - other.manner)
        + 0.2 * (one.is_voiced != other.is_voiced)
        + 0.2 * (one.is_nasal != other.is_nasal)
        + 0.2 * (one.is_lateral != other.is_lateral)
        + 0.2 * (one.is_retroflex != other.is_retroflex)
    )


def _between_vowels(one: Vowel, other: Vowel) -> float:
    return (
        0.5 * abs(one.height - other.height)
        + 0.5 * abs(one.front - other.front)
        + 0.1 * (one.is_round != other.is_round)
        + 0.1 * (one.is_long != other.is_long)
        + 0.2 * (one.is_retroflex != other.is_retroflex)
    )


def in_ipa(phones: Phones) -> str:
    """The phones as they stand in other dictionaries: ("G", "OW") is "ɡoʊ"."""
    return "".join(IPA[phone] for phone in phones)


def without_stress(phones: Phones) -> Phones:
    """The phones without the digits behind vowels: ("G", "OW1") is ("G", "OW")."""
    return tuple(phone.rstrip("012") for phone in phones)


def with_s(phones: Phones) -> Phones:
    """A word with the s of a plural, of a possessive, or of "she works"."""
    if phones[-1] in HISSING:
        return (*phones, "IH0", "Z")
    return (*phones, "S" if phones[-1] in VOICELESS else "Z")
