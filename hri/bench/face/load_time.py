"""How long a face takes in a new process: to load, from drawings or from what was kept of it, and
to draw first, when its loops are not compiled yet.
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Iterator

import numpy as np

from hri.bench.table import Row, amount, at_most
from hri.core import child
from hri.core.errors import HriError

ROUNDS = 5
RAW_S, BAKED_S, COMPILED_S = 1.5, 0.15, 3.0
_LOAD = """
import time
from hri.face.model import load_face
begun = time.process_time()
load_face()
print(time.process_time() - begun)
"""
_DRAW = """
import time
from hri.face.model import load_face
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
model = load_face()
begun = time.process_time()
Renderer(model).render(still_vector(model))
print(time.process_time() - begun)
"""


def rows() -> Iterator[Row]:
    """Seconds of the processor for a face that was never loaded, for one that was, and for the
    first picture of a new installation.
    """
    raw, baked = [], []
    for _ in range(ROUNDS):
        with tempfile.TemporaryDirectory() as cache:
            raw.append(_seconds(_LOAD, cache))
            baked.append(_seconds(_LOAD, cache))
    with tempfile.TemporaryDirectory() as cache:
        first = _seconds(_DRAW, cache)
    yield amount("cold load of a baked face", float(np.median(baked)), "s", at_most(BAKED_S))
    yield amount("cold load of raw SVG", float(np.median(raw)), "s", at_most(RAW_S))
    yield amount("first picture, its loops not compiled yet", first, "s", at_most(COMPILED_S))


def _seconds(program: str, cache: str) -> float:
    environment = child.environment(XDG_CACHE_HOME=cache)
    environment.pop("NUMBA_CACHE_DIR", None)
    run = subprocess.run(
        child.command("-c", program), env=environment, capture_output=True, text=True
    )
    if run.returncode:
        raise HriError(f"the face cannot be drawn: {run.stderr.strip()[-300:]} - hri face check")
    return float(run.stdout)
