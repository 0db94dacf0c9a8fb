"""The sounds of the natural voice: what each symbol of its alphabet is to the rest of the project.

The alphabet is misaki's, in which Kokoro's texts are written: IPA, with one capital letter for each
diphthong (https://github.com/hexgrad/misaki, EN_PHONES.md).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from hri.core.signals import Phoneme
from hri.speech.pronunciation.phones import VOWELS, Phones

PAUSE = "_:"
"""espeak-ng's mnemonic of a pause."""
SPACE = " "
VOWEL_SYMBOLS = frozenset("aæɑɐɒʌəᵊɜɚɛeiɪɨᵻyøœɔoɤʊɯuAIOQWY")
STRESSES = "ˈˌ"
"""These come before what they stress."""
MODIFIERS = "ː̃ʰʲᵝ"
"""These are part of the sound before them."""

MNEMONICS = {
    # vowels
    "a": "a", "æ": "a", "ɑ": "A:", "ɐ": "a#", "ɒ": "0", "ʌ": "V", "ə": "@", "ᵊ": "@", "ɜ": "3:",
    "ɚ": "3", "ɛ": "E", "e": "e", "i": "i:", "ɪ": "I", "ɨ": "I2", "ᵻ": "I2", "y": "y", "ø": "Y",
    "œ": "9", "ɔ": "O:", "o": "o", "ɤ": "V", "ʊ": "U", "u": "u:", "ɯ": "u",
    "A": "eI", "I": "aI", "O": "oU", "Q": "oU", "W": "aU", "Y": "OI",
    # consonants
    "b": "b", "p": "p", "m": "m", "f": "f", "v": "v", "ʋ": "v", "ɸ": "f", "β": "v",
    "w": "w", "ɥ": "w", "ɰ": "w", "θ": "T", "ð": "D",
    "t": "t", "d": "d", "T": "t#", "ɾ": "t#", "ʈ": "t", "ɖ": "d", "n": "n", "ɲ": "n^", "ɳ": "n",
    "l": "l", "ʎ": "l^", "r": "r", "ɹ": "r", "ɻ": "r", "ɽ": "r", "ʁ": "R",
    "s": "s", "z": "z", "S": "s", "ʦ": "s", "ʣ": "z", "ꭧ": "tS",
    "ʃ": "S", "ʒ": "Z", "ʂ": "S", "ɕ": "S", "ʧ": "tS", "ʤ": "dZ", "ʨ": "tS", "ʥ": "dZ",
    "k": "k", "ɡ": "g", "ɟ": "g", "q": "k", "c": "c", "x": "x", "χ": "x", "ɣ": "g", "ç": "C",
    "ŋ": "N", "ɴ": "N", "h": "h", "j": "j", "ʝ": "j",
    "ʔ": "_|",
}  # fmt: skip
"""espeak-ng's mnemonic of each symbol that sounds, in which every voice names its phonemes."""

SYMBOLS = {
    "AA": "ɑ", "AE": "æ", "AH": "ʌ", "AO": "ɔ", "AW": "W", "AY": "I", "B": "b", "CH": "ʧ",
    "D": "d", "DH": "ð", "EH": "ɛ", "ER": "ɜɹ", "EY": "A", "F": "f", "G": "ɡ", "HH": "h",
    "IH": "ɪ", "IY": "i", "JH": "ʤ", "K": "k", "L": "l", "M": "m", "N": "n", "NG": "ŋ",
    "OW": "O", "OY": "Y", "P": "p", "R": "ɹ", "S": "s", "SH": "ʃ", "T": "t", "TH": "θ",
    "UH": "ʊ", "UW": "u", "V": "v", "W": "w", "Y": "j", "Z": "z", "ZH": "ʒ",
}  # fmt: skip
"""The symbols of the phones of the CMU dictionary."""
WEAK = {"AH": "ə", "ER": "əɹ"}
"""The same for vowels without stress."""
_STRESS = {"0": "", "1": "ˈ", "2": "ˌ"}


@dataclass(frozen=True, slots=True)
class Sounded:
    """A symbol that was spoken."""

    symbol: str
    start: float
    """Seconds."""
    duration: float
    """Seconds."""

    @property
    def end(self) -> float:
        return self.start + self.duration


def symbols_of(phones: Phones) -> str:
    """A word of the CMU dictionary's phones, stress written or not, in the voice's alphabet.

    The network learned American English, in which the t of "Katie" is a flap, and the last syllable
    of "Michael" is an l without a vowel.
    """
    symbols = []
    for before, phone, after in zip(("", *phones), phones, (*phones[1:], ""), strict=False):
        if phone == "T" and _is_flap(before, after):
            symbols.append("T")
        elif phone in ("AH", "AH0") and after == "L" and before:
            symbols.append("ᵊ")
        else:
            symbols.append(_symbol(phone))
    return "".join(symbols)


def _symbol(phone: str) -> str:
    name = phone.rstrip("012")
    stress = _STRESS.get(phone[len(name) :], "")
    return stress + SYMBOLS[name] if stress else WEAK.get(name, SYMBOLS[name])


def _is_flap(before: str, after: str) -> bool:
    """Whether a t stands between a vowel or an r and a vowel without stress."""
    is_voiced = before == "R" or before.rstrip("012") in VOWELS
    return is_voiced and after.rstrip("02") in VOWELS and not after.endswith("2")


def phonemes(spoken: Iterable[Sounded]) -> Iterator[Phoneme]:
    """The phonemes of what was spoken, without gaps.

    The network gives a time to a mark of stress, and one to the space between two words:
    the mark belongs to the sound after it, the space to the sound before.
    """
    name, start, end, stressed = "", 0.0, 0.0, False
    mark: Sounded | None = None
    for one in spoken:
        if one.symbol in STRESSES:
            mark = mark or one
        elif name and (one.symbol in MODIFIERS or one.symbol == SPACE) and mark is None:
            end = one.end
        else:
            if name:
                yield Phoneme(name, start, (mark or one).start - start, stressed)
            name = MNEMONICS.get(one.symbol, PAUSE)
            start, stressed = (mark or one).start, mark is not None
            end, mark = one.end, None
    if name:
        yield Phoneme(name, start, end - start, stressed)


def longest_parts(symbols: str, most: int) -> Sequence[tuple[int, int]]:
    """Where to part symbols that are more than the network takes at once: [begin, end) of each.

    After a comma or the like where there is one, else between two words, else anywhere.
    """
    parts, begin = [], 0
    while len(symbols) - begin > most:
        window = symbols[begin : begin + most]
        clause = max(window.rfind(mark + SPACE) for mark in ",;:—") + 2
        end = begin + (clause if clause > 1 else window.rfind(SPACE) + 1 or most)
        parts.append((begin, end))
        begin = end
    return [*parts, (begin, len(symbols))]
