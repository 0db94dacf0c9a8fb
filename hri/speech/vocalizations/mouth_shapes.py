"""Shapes of the mouth: their resonances, and the phonemes by which lips make them.

The resonances of vowels are those of women in J. Hillenbrand, L. A. Getty, M. J. Clark and K.
Wheeler, "Acoustic characteristics of American English vowels", JASA 97 (1995).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

CLOSED = "_"
"""The phoneme of a mouth at rest."""


@dataclass(frozen=True, slots=True)
class MouthShape:
    """What a mouth does to a sound, and looks like."""

    formants: tuple[float, float, float, float, float]
    """Hertz."""
    phoneme: str
    """A mnemonic of espeak-ng."""
    nose: float = 0.0
    """How far the sound goes through the nose, 0 to 1."""
    hiss_hz: float = 0.0
    """Where air between lips or teeth is loudest; 0: it does not hiss."""


SHAPES: Mapping[str, MouthShape] = {
    "ee": MouthShape((437, 2761, 3372, 4352, 5200), "i:"),
    "ih": MouthShape((483, 2365, 3053, 4334, 5200), "I"),
    "eh": MouthShape((731, 2058, 2979, 4294, 5200), "E"),
    "a": MouthShape((669, 2349, 2972, 4290, 5200), "a"),
    "ah": MouthShape((936, 1551, 2815, 4299, 5200), "A:"),
    "aw": MouthShape((781, 1136, 2824, 3923, 5000), "O:"),
    "oh": MouthShape((555, 1035, 2828, 3927, 5000), "oU"),
    "oo": MouthShape((459, 1105, 2735, 4115, 5000), "u:"),
    "uh": MouthShape((753, 1426, 2933, 4092, 5000), "V"),
    "er": MouthShape((523, 1588, 1929, 3914, 5000), "3:"),
    "w": MouthShape((320, 700, 2500, 3700, 4800), "w"),
    "y": MouthShape((320, 2600, 3300, 4300, 5200), "j"),
    "m": MouthShape((280, 1100, 2400, 3500, 4700), "m", nose=1.0),
    "n": MouthShape((300, 1700, 2700, 3800, 4900), "n", nose=1.0),
    "ng": MouthShape((300, 2000, 2700, 3800, 4900), "N", nose=1.0),
    "f": MouthShape((400, 1100, 2300, 3500, 4700), "f", hiss_hz=5500),
    "s": MouthShape((400, 1700, 2700, 3900, 5000), "s", hiss_hz=7000),
    "sh": MouthShape((400, 1800, 2600, 3800, 5000), "S", hiss_hz=3600),
    "k": MouthShape((400, 1900, 2600, 3900, 5000), "k"),
    "t": MouthShape((400, 1800, 2800, 3900, 5000), "t", hiss_hz=4500),
    "b": MouthShape((300, 900, 2400, 3500, 4700), "b"),
    "shut": MouthShape((300, 1200, 2500, 3600, 4800), CLOSED),
}
