"""Whether the natural voice asks, states and exclaims, and speaks as fast as it is asked to.

librosa's pYIN (M. Mauch and S. Dixon, ICASSP 2014), which knows nothing of the voice, finds the
pitch of its sound.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib.util import find_spec
from itertools import pairwise
from pathlib import Path

import numpy as np

from hri.bench.table import Row, amount, at_least, at_most, share
from hri.core.clock import FakeClock
from hri.core.errors import NotAvailable
from hri.core.signals import Prosody, Speech
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.synthesizers.network_voice import PLAIN_WPM

WHAT = "melody: phrases that end as a linguist marks them"
PACES = np.linspace(90, 300, 20)
"""Words a minute."""
STORY = (
    "One night, a star fell into the garden. Mia ran down the corridor, past the kitchen, and"
    ' opened the door. "Who is there?" she asked. Nobody answered. Under the apple tree lay a small'
    " stone, and it was still warm. She picked it up and carried it to her room. In the morning, it"
    " had turned into a little bird. It looked at her, sang three notes, and flew out of the"
    " window."
)
LOWEST_HZ, HIGHEST_HZ = 70.0, 550.0
HOP_S = 0.01
LAST_S = 0.25
"""Seconds of voice whose direction counts."""
FAINT_DB = 30.0
"""Below the loudest, from which on a voice is not heard."""
_FULL = 32768


def sentences() -> list[tuple[str, str]]:
    """The direction, "up" or "down", and the sentence."""
    lines = Path(__file__).with_name("melody.txt").read_text(encoding="utf-8").splitlines()
    parted = (line.partition(" ") for line in lines if line and not line.startswith("#"))
    return [(direction, sentence) for direction, _, sentence in parted]


def rows() -> Iterator[Row]:
    """How many of the sentences end in their direction, and how far the pace is off."""
    with ResourceManager((), FakeClock()) as resources:
        voice = NaturalVoice(Description("voice", "Hri.NaturalVoice"), resources)
        voice.activate()
        yield from _paces(voice)
        if find_spec("librosa") is None:
            raise NotAvailable("librosa is not installed - pip install librosa")
        marked = sentences()
        right = [
            (rise(voice.synthesize(sentence)) > 0) == (direction == "up")
            for direction, sentence in marked
        ]
        yield share(WHAT, sum(right), len(right), at_least(0.95))
        voice.deactivate()


def _paces(voice: NaturalVoice) -> Iterator[Row]:
    words = len(STORY.split())
    measured = [
        60 * words / voice.synthesize(STORY, Prosody(rate=wpm / PLAIN_WPM)).duration
        for wpm in PACES
    ]
    error = max(abs(one / wpm - 1) for one, wpm in zip(measured, PACES, strict=True))
    asked = PACES[1] - PACES[0]
    step = max((after - before) / asked for before, after in pairwise(measured))
    yield amount("pace, 90 to 300 words a minute: largest error", error, "", at_most(0.05))
    yield amount("pace: largest step against the asked step", step, "", at_most(1.5))


def rise(speech: Speech) -> float:
    """Semitones by which the last quarter of a second of the voice that is heard goes up."""
    import librosa

    sound, hop = speech.samples / _FULL, round(HOP_S * speech.rate)
    frame = 6 * hop
    pitch, _, _ = librosa.pyin(
        sound, fmin=LOWEST_HZ, fmax=HIGHEST_HZ, sr=speech.rate, hop_length=hop, frame_length=frame
    )
    level = librosa.feature.rms(y=sound, hop_length=hop, frame_length=frame)[0][: len(pitch)]
    is_heard = np.isfinite(pitch) & (level > level.max() * 10 ** (-FAINT_DB / 20))
    frames = np.flatnonzero(is_heard)
    last = frames[frames > frames[-1] - LAST_S / HOP_S]
    if len(last) < 3:
        return 0.0
    slope, _ = np.polyfit(last * HOP_S, 12 * np.log2(pitch[last]), 1)
    return float(slope * (last[-1] - last[0]) * HOP_S)
