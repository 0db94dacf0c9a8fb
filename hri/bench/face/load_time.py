"""How long a face takes in a new process: to load, from drawings or from what was kept of it, and
to draw, when its loops are not compiled yet.
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
RAW_S, BAKED_S, FIRST_S, COMPILED_S = 1.5, 0.15, 0.4, 3.0
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
from hri.face.renderers.painter import UNCOMPILED
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
model = load_face()
taken = []
for _ in range(UNCOMPILED + 1):
    begun = time.process_time()
    Renderer(model).render(still_vector(model))
    taken.append(time.process_time() - begun)
print(taken[0], taken[-1])
"""


def rows() -> Iterator[Row]:
    """Seconds of the processor for a face that was never loaded, for one that was, and of a new
    installation for the first picture and the one for which the loops are compiled.
    """
    raw, baked = list[float](), list[float]()
    for _ in range(ROUNDS):
        with tempfile.TemporaryDirectory() as cache:
            raw += _seconds(_LOAD, cache)
            baked += _seconds(_LOAD, cache)
    with tempfile.TemporaryDirectory() as cache:
        first, compiled = _seconds(_DRAW, cache)
    yield amount("cold load of a baked face", float(np.median(baked)), "s", at_most(BAKED_S))
    yield amount("cold load of raw SVG", float(np.median(raw)), "s", at_most(RAW_S))
    yield amount("first picture", first, "s", at_most(FIRST_S))
    yield amount("picture for which the loops are compiled", compiled, "s", at_most(COMPILED_S))


def _seconds(program: str, cache: str) -> list[float]:
    environment = child.environment(XDG_CACHE_HOME=cache)
    environment.pop("NUMBA_CACHE_DIR", None)
    run = subprocess.run(
        child.command("-c", program), env=environment, capture_output=True, text=True
    )
    if run.returncode:
        raise HriError(f"the face cannot be drawn: {run.stderr.strip()[-300:]} - hri face check")
    return [float(number) for number in run.stdout.split()]
