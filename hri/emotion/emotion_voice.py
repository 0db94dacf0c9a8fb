"""What an emotion does to the voice by itself: `[voice.of]` of `emotions/display.toml`."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields

from hri.core.signals import PLAIN_QUALITY, VoiceQuality
from hri.core.toml import Table

LEAST, MOST = 0.5, 2.0
"""Of a factor."""
LOWEST = {"breath": 0.0, "tremble": 0.0}
"""Of those qualities that have no opposite; of the others, -1."""
FACTORS = ("rate", "pitch", "volume", "range")
QUALITIES = tuple(field.name for field in fields(VoiceQuality))


@dataclass(frozen=True, slots=True)
class EmotionVoice:
    """The voice of an emotion at its full strength."""

    rate: float
    """A factor, as the next three, on what pleasure, arousal and dominance do."""
    pitch: float
    volume: float
    range: float
    quality: VoiceQuality


PLAIN = EmotionVoice(1.0, 1.0, 1.0, 1.0, PLAIN_QUALITY)


def read_voice(table: Table) -> EmotionVoice:
    """The voice of one emotion. Raises AuthoringError."""
    rate, pitch, volume, range = (
        table.number(name, 1.0, minimum=LEAST, maximum=MOST) for name in FACTORS
    )
    qualities = {
        name: table.number(name, 0.0, minimum=LOWEST.get(name, -1.0), maximum=1.0)
        for name in QUALITIES
    }
    table.finish()
    return EmotionVoice(rate, pitch, volume, range, VoiceQuality(**qualities))


def blended(voices: Mapping[str, EmotionVoice], emotions: Mapping[str, float]) -> EmotionVoice:
    """The voice of several emotions by their intensities, 0 to 1: the strongest counts most.

    Where one is felt alone, it is that one's by its intensity.
    """
    felt = [(voices[name], share) for name, share in emotions.items() if share and name in voices]
    if not felt:
        return PLAIN
    whole = sum(share for _, share in felt)
    weighed = [(voice, share * share / whole) for voice, share in felt]

    def factor(name: str) -> float:
        return math.exp(
            math.fsum(math.log(getattr(voice, name)) * weight for voice, weight in weighed)
        )

    def quality(name: str) -> float:
        return math.fsum(getattr(voice.quality, name) * weight for voice, weight in weighed)

    rate, pitch, volume, range = map(factor, FACTORS)
    qualities = VoiceQuality(**{name: quality(name) for name in QUALITIES})
    return EmotionVoice(rate, pitch, volume, range, qualities)
