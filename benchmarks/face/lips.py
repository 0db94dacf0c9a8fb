"""How well the lips keep time with the voice, at the frames that are drawn."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from benchmarks.face.lip_timing import lip_timing
from hri.bench.face.live import SENTENCES
from hri.bench.table import Row, amount, at_most
from hri.core.clock import RealClock
from hri.face.model import FaceModel
from hri.hal.manager import ResourceManager
from hri.hal.resource import Description
from hri.speech.synthesizers.espeak import EspeakVoice

LATE_MS = 20.0


def rows(model: FaceModel) -> Iterator[Row]:
    """Milliseconds between a sound and its shape, and between changes of both.

    Raises NotAvailable without the voice.
    """
    shapes: list[float] = []
    changes: list[float] = []
    with ResourceManager((), RealClock()) as resources:
        voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), resources)
        resources.substitute("voice", voice)
        voice.activate()
        for sentence in SENTENCES:
            timing = lip_timing(model, voice.synthesize(sentence))
            shapes += timing.shapes
            changes += timing.changes
    late = float(np.percentile(1e3 * np.abs(shapes), 95))
    told = {
        "sounds": len(shapes),
        "change_median_ms": round(1e3 * float(np.median(changes)), 1),
        "change_p95_ms": round(1e3 * float(np.percentile(np.abs(changes), 95)), 1),
    }
    yield amount("viseme track against phoneme times, p95", late, "ms", at_most(LATE_MS), **told)
