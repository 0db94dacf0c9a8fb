"""The face: against skia-python, how well its lips keep time, and what a network sees in it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from benchmarks.face import judge, lips, skia
from hri.bench.table import Row, attempted
from hri.bench.threads import one_thread
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel


def rows(model: FaceModel, talking: Sequence[Vector], size: tuple[int, int]) -> Iterator[Row]:
    """What `hri bench face` measures in a checkout beside its own."""
    with one_thread():
        what = "the same frames by skia-python"
        yield from attempted(what, lambda: skia.rows(model, talking, size))
    yield from attempted("viseme track against phoneme times", lambda: lips.rows(model))
    what = "expressions that an independent network names"
    yield from attempted(what, lambda: judge.rows("robot", *judge.HUMAN))
