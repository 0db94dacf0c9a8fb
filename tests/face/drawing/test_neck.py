"""A head that moves leaves its shoulders where they are."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import AuthoringError
from hri.face import load_face
from hri.face.drawing.outline import apply
from hri.face.model import FaceModel
from tests.face.small_face import write_face

PERSON = load_face("person")
TOP, BOTTOM = PERSON.settings.motion.neck or (0.0, 0.0)
REST = PERSON.blend(PERSON.vector({}))[0]
MOVES = st.fixed_dictionaries(
    dict.fromkeys(("headX", "headY", "headRoll", "headSize"), st.floats(-1, 1))
)


@given(MOVES)
@settings(max_examples=20)
def test_all_above_the_neck_moves_with_the_head_and_nothing_below(moves: dict[str, float]) -> None:
    vector = PERSON.vector({**moves, "jawOpen": 0.7})
    points, scalars = PERSON.placed(vector)
    alone, same = PERSON.blend(vector)
    assert np.array_equal(scalars, same)
    moved = apply(PERSON.motion(vector), alone.astype(float))
    above, below = REST[:, 1] < TOP, REST[:, 1] > BOTTOM
    for shape in PERSON.display.items:
        # Anchors of gradients count as within their shape, see below.
        anchors = getattr(shape, "anchors", (0, 0))
        above[slice(*anchors)] = below[slice(*anchors)] = False
    assert above.sum() > 500
    assert below.sum() > 50
    assert points[above] == pytest.approx(moved[above], abs=2e-3)
    assert np.array_equal(points[below], alone[below])


@given(MOVES)
def test_a_neck_bends_and_never_folds(moves: dict[str, float]) -> None:
    """Points of its outline that lie close together move alike."""
    neck = next(s for s in PERSON.display.items if getattr(s, "id", "") == "neck")
    first, last, _ = neck.contours[0]  # type: ignore[union-attr]
    way = (PERSON.placed(PERSON.vector(moves))[0] - REST)[first:last]
    gaps = np.hypot(*np.diff(REST[first:last], axis=0).T)
    change = np.hypot(*np.diff(way, axis=0).T)
    assert (change <= 0.05 + gaps).all()


def test_the_light_of_a_shirt_stays_on_the_shirt() -> None:
    shirt = next(s for s in PERSON.display.items if getattr(s, "id", "") == "shirt")
    first, (last, end) = shirt.contours[0][0], shirt.anchors  # type: ignore[union-attr]
    points, _ = PERSON.placed(PERSON.vector({"headX": 1.0, "headRoll": 1.0}))
    moved = np.hypot(*(points - REST)[first:end].T)
    assert moved[last - first :].max() <= moved[: last - first].max() + 1e-4


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return write_face(tmp_path / "mine")


def with_neck(folder: Path, neck: str) -> FaceModel:
    file = folder / "face.toml"
    file.write_text(file.read_text().replace("pivot =", f"neck = {neck}\npivot =", 1))
    return load_face(folder)


def test_without_a_neck_all_moves_as_one(folder: Path) -> None:
    face = load_face(folder)
    vector = face.vector({"headX": 1.0, "headRoll": 0.5})
    points, _ = face.placed(vector)
    moved = apply(face.motion(vector), face.blend(vector)[0].astype(float))
    assert points == pytest.approx(moved, abs=1e-3)


def test_a_neck_that_stands_on_its_head_is_refused(folder: Path) -> None:
    with pytest.raises(AuthoringError, match=r"face.toml:.*neck is 90, 80 - write the y of its to"):
        with_neck(folder, "[90, 80]")


def test_a_sign_must_be_a_target(folder: Path) -> None:
    file = folder / "face.toml"
    file.write_text('signs = ["tera"]\n' + file.read_text())
    with pytest.raises(AuthoringError, match=r'no target "tera" - did you mean "tear"'):
        load_face(folder)
