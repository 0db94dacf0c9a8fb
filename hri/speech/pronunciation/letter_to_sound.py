"""How a word that no dictionary knows is spoken: espeak-ng's rules, in the phones of CMU's."""

from __future__ import annotations

from hri.core.errors import HriError
from hri.speech.synthesizers.espeak_library import load_espeak

PHONES = {
    # Consonants.
    "p": "P", "b": "B", "t": "T", "d": "D", "k": "K", "g": "G", "t#": "D", "?": "T",
    "f": "F", "v": "V", "T": "TH", "D": "DH", "s": "S", "z": "Z", "S": "SH", "Z": "ZH", "h": "HH",
    "tS": "CH", "dZ": "JH", "m": "M", "n": "N", "N": "NG", "l": "L", "r": "R", "j": "Y", "w": "W",
    "n-": "AH N", "@L": "AH L", "m-": "AH M", "x": "K", "r-": "R",
    # Vowels.
    "a": "AE", "aa": "AE", "a#": "AH", "A:": "AA", "A@": "AA R", "0": "AA", "0#": "AA",
    "O:": "AO", "O": "AO", "O@": "AO R", "o@": "AO R", "E": "EH", "E2": "EH", "E#": "EH",
    "I": "IH", "I#": "IH", "I2": "IH", "i": "IY", "i:": "IY", "i@": "IY AH", "i@3": "IH R",
    "e@": "EH R", "eI": "EY", "@": "AH", "@2": "AH", "@5": "AH", "@-": "AH", "3": "ER",
    "3:": "ER", "V": "AH", "U": "UH", "u:": "UW", "u": "UW", "U@": "UH R", "oU": "OW",
    "aI": "AY", "aI@": "AY AH", "aI3": "AY ER", "aU": "AW", "aU@": "AW ER", "OI": "OY",
}  # fmt: skip
"""espeak-ng's mnemonics of American English, by phones of the CMU dictionary."""


def pronounce(word: str) -> tuple[str, ...]:
    """The phones of a word. Raises HriError when it cannot be spoken as English."""
    phones: list[str] = []
    for mnemonic in load_espeak().phonemes_of(word):
        phone = PHONES.get(mnemonic.lstrip("',"))
        if phone is None and mnemonic.strip("',_:"):
            phones.clear()
            break
        phones += (phone or "").split()
    if not phones:
        raise HriError(f'nobody knows how "{word}" sounds - write it as English words')
    return tuple(phones)
