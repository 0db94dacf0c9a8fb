"""The classes that sound is told apart by, and how the network's own tokens fold into them."""

# ruff: noqa: RUF001 - the letters of the phonetic alphabet are meant.
from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hri.speech.pronunciation.phones import PHONES

CLASSES = ("blank", *PHONES)
"""What a frame can be: nothing new (silence, or the phone before goes on), or a phone."""
TOKENS = 191
"""Size of the network's own vocabulary: phones of English and Korean, marks, special tokens."""

_SPELLINGS: dict[str, dict[str, int]] = {
    "AA": {"ɑ": 80, "ɒ": 81, "a": 7, "ä": 64},
    "AE": {"æ": 66},
    "AH": {"ə": 89, "ʌ": 125, "ɐ": 79, "ᵊ": 175, "ɨ": 100},
    "AO": {"ɔ": 83},
    "AW": {"aʊ": 9},
    "AY": {"aɪ": 8},
    "B": {"b": 10},
    "CH": {"t͡ʃ": 47, "t͡ɕ": 44, "t͡ɕʰ": 45},
    "D": {"d": 12, "ɾ": 116},
    "DH": {"ð": 69},
    "EH": {"ɛ": 91},
    "ER": {"ɝ": 93, "ɚ": 90, "ɜ": 92},
    "EY": {"eɪ": 16, "e": 14},
    "F": {"f": 17},
    "G": {"g": 18, "ɡ": 95},
    "HH": {"h": 19, "ɦ": 99},
    "IH": {"ɪ": 101},
    "IY": {"i": 20},
    "JH": {"d͡ʒ": 13},
    "K": {"k": 27, "kʰ": 28},
    "L": {"l": 30, "ɫ": 103},
    "M": {"m": 31},
    "N": {"n": 32},
    "NG": {"ŋ": 75},
    "OW": {"oʊ": 34, "o": 33},
    "OY": {"ɔɪ": 84},
    "P": {"p": 35, "pʰ": 36},
    "R": {"ɹ": 113, "r": 38, "ɻ": 114},
    "S": {"s": 39},
    "SH": {"ʃ": 120, "ɕ": 85},
    "T": {"t": 41, "tʰ": 42, "ʔ": 131, "ɾ": 116},
    "TH": {"θ": 173},
    "UH": {"ʊ": 123},
    "UW": {"u": 48, "ʉ": 122},
    "V": {"v": 49},
    "W": {"w": 50},
    "Y": {"j": 21},
    "Z": {"z": 57},
    "ZH": {"ʒ": 130},
}
"""Which tokens are heard as which phone: their IPA, and their index in the network's vocabulary."""


def folding() -> NDArray[np.float32]:
    """The matrix [TOKENS, CLASSES] that sums the tokens' probabilities into classes.

    The flap is both T and D: "ladder" and "latter" sound the same. Every other token is in one
    class. Korean's aspirated stops go with the English ones, which sound alike; what no phone
    claims (word boundaries, marks, the rest of Korean) is blank. Over 68 recordings of English
    speech, 0.6 % of the probability of phones is lost that way, most of it on marks of place that
    follow their phone, and Korean's tokens get less than 0.001 % together.
    """
    matrix = np.zeros((TOKENS, len(CLASSES)), np.float32)
    for phone, tokens in _SPELLINGS.items():
        matrix[list(tokens.values()), CLASSES.index(phone)] = 1.0
    matrix[matrix.sum(axis=1) == 0.0, CLASSES.index("blank")] = 1.0
    return matrix
