"""The face: how fast it is drawn and loaded, and whether frames are lost while it talks.

All rows but that of talking take the time of the thread or the process, on one core without a GPU,
so that what else the machine does counts as little as possible; the frames are those of a face that
talks, blinks, sways and changes its expression, in order.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial
from typing import Any

from hri.bench.checkout import research
from hri.bench.face import frames, live, load_time
from hri.bench.table import Row, attempted, report
from hri.bench.threads import one_thread
from hri.face.model import load_face

SIZE = (800, 600)
SECONDS = 60.0
QUICK_SECONDS = 5.0
FRAMES = 600


def measure(quick: bool = False) -> dict[str, Any]:
    """All rows; what is being done is told on standard error. `quick` takes a tenth of the time."""
    told = list(rows(FRAMES // 10 if quick else FRAMES, QUICK_SECONDS if quick else SECONDS))
    return report("face", told, quick)


def rows(count: int, seconds: float) -> Iterator[Row]:
    """All rows in the order of the table: from a number of frames, and of seconds of talking."""
    tell = partial(print, file=sys.stderr, flush=True)
    model = load_face()
    tell("frames")
    with one_thread():
        talking = frames.talking(model, count)
        yield from attempted("frames", lambda: frames.rows(model, talking, SIZE))
    tell("loading")
    yield from attempted("loading", load_time.rows)
    tell(f"{seconds:g} s of talking")
    yield from attempted("frames dropped while talking", lambda: live.rows(seconds))
    if (compared := research("face")) is not None:
        yield from compared.rows(model, talking[: max(count // 2, 60)], SIZE)
