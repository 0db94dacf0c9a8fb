"""The same arguments give the same picture: byte for byte here, up to rounding elsewhere.

Only the blend of the drawings is left to a library that computes differently on other processors.
OpenBLAS can be asked to do here what it does on an old one; another library ignores that.
"""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from hri.testing.golden import difference

PROGRAM = """
import sys
import numpy as np
from hri.face import face_bits, load_face
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector

pictures = {}
for face in ("robot", "astronaut", "person", "eyes"):
    model = load_face(face)
    renderer = Renderer(model, (320, 240))
    for label in ("happy", "sad", "excited", "skeptical"):
        vector = still_vector(model, label, viseme="aa", time=1.7, gaze=(0.3, 0.1), valence=0.3)
        pictures[f"{face} {label}"] = renderer.render(vector)
        pictures[f"{face} {label} in bits"] = face_bits(model, vector)
np.savez(sys.argv[1], **pictures)
"""


def drawn(file: Path, **environment: str) -> dict[str, np.ndarray]:
    words = [sys.executable, "-c", PROGRAM, str(file)]
    subprocess.run(words, check=True, env={**os.environ, **environment})
    with np.load(file) as pictures:
        return dict(pictures)


@pytest.fixture(scope="module")
def here(tmp_path_factory: pytest.TempPathFactory) -> dict[str, np.ndarray]:
    return drawn(tmp_path_factory.mktemp("here") / "a.npz")


def test_another_process_draws_the_same_bytes(here: dict[str, np.ndarray], tmp_path: Path) -> None:
    again = drawn(tmp_path / "b.npz", OPENBLAS_NUM_THREADS="1", PYTHONHASHSEED="5")
    assert all(np.array_equal(again[name], here[name]) for name in here)


def test_another_processor_draws_the_same_up_to_rounding(
    here: dict[str, np.ndarray], tmp_path: Path
) -> None:
    there = drawn(tmp_path / "b.npz", OPENBLAS_CORETYPE="Nehalem")
    for name, picture in here.items():
        if "bits" in name:
            assert np.count_nonzero(there[name] != picture) <= 2, name
        else:
            apart = np.abs(there[name].astype(int) - picture)
            assert apart.max() <= 2, name
            assert np.count_nonzero(apart.any(axis=2)) <= 20, name
            assert difference(there[name], picture) == "", name
