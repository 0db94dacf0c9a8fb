"""A face in one bit, from its layers: its silhouette, contours, ink, and nothing behind it."""

from pathlib import Path

import numpy as np
import pytest

from hri.face import FaceModel, face_bits, load_face
from hri.face.renderers.bits import BitRenderer
from hri.face.renderers.renderer import Renderer
from hri.face.renderers.small_screens import one_bit
from hri.face.still import still_vector
from hri.testing.golden import Golden
from tests.face.small_face import write_face

PERSON = load_face("person")
LOOKS = ("neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted")
LAYERS = """
[layers]
body = ["neck"]
face = ["head"]
ink = ["eye*", "brow", "dark"]
"""


def small_face(folder: Path, more: str = LAYERS) -> FaceModel:
    write_face(folder)
    with (folder / "face.toml").open("a") as file:
        file.write(more)
    return load_face(folder)


def at(bits: np.ndarray, x: float, y: float) -> bool:
    """The pixel at a place in a drawing of 100 x 100 units."""
    height, width = bits.shape
    return bool(bits[int(y * height / 100), int(x * width / 100)])


def test_the_face_is_lit_and_its_features_are_dark(tmp_path: Path) -> None:
    model = small_face(tmp_path)
    bits = face_bits(model, model.vector({"jawOpen": 1.0}), (64, 64))
    assert bits.dtype == bool
    assert at(bits, 50, 55)
    assert not any(at(bits, x, y) for x, y in [(35, 45), (65, 45), (50, 35), (50, 75)])
    assert not at(bits, 2, 2), "the background is white there"


def test_a_contour_parts_the_head_from_what_is_behind_it(tmp_path: Path) -> None:
    model = small_face(tmp_path)
    bits = face_bits(model, model.vector({}), (100, 100))
    column = bits[80:, 50]
    assert column[:9].all(), "the head ends at 90"
    assert not column[10]
    assert column[13:].all(), "the neck"


def test_on_a_lit_ground_the_contour_is_dark(tmp_path: Path) -> None:
    model = small_face(tmp_path)
    row = face_bits(model, model.vector({}), (100, 100), ground=True)[50]
    dark = np.flatnonzero(~row[:30])
    assert dark.tolist() in ([8, 9], [9, 10], [8], [9])
    assert row[:7].all()


def test_ink_may_be_the_light_on_a_dark_face(tmp_path: Path) -> None:
    model = small_face(tmp_path, LAYERS + 'lit = ["ink"]')
    bits = face_bits(model, model.vector({}), (64, 64))
    assert at(bits, 35, 45)
    assert not at(bits, 50, 55)
    assert bits[32, :10].any(), "a contour shows where the head ends"


def test_the_thinnest_line_is_seen_at_any_size(tmp_path: Path) -> None:
    model = small_face(tmp_path)
    for side in (24, 32, 64, 128):
        brow = face_bits(model, model.vector({}), (side, side))
        rows = brow[int(0.3 * side) : int(0.38 * side) + 1, int(0.5 * side)]
        assert np.count_nonzero(~rows) >= 1, side


def test_without_layers_the_colors_decide() -> None:
    model = load_face("eyes")
    vector = still_vector(model, "happy")
    expected = one_bit(Renderer(model, (128, 64)).render(vector))
    assert np.array_equal(face_bits(model, vector), expected)


@pytest.mark.parametrize("label", LOOKS)
@pytest.mark.parametrize("face", ["robot", "astronaut", "person"])
def test_the_looks_are_as_approved(face: str, label: str, golden: Golden) -> None:
    model = load_face(face)
    # As a picture with colors: on another processor a pixel may differ.
    picture = BitRenderer(model, (64, 64)).picture(still_vector(model, label))
    golden.check(f"{face}/{label}", picture)


def test_a_picture_does_not_depend_on_the_one_before() -> None:
    old = BitRenderer(PERSON, (64, 64))
    for label in LOOKS:
        vector = still_vector(PERSON, label, viseme="aa")
        assert np.array_equal(old.render(vector), face_bits(PERSON, vector, (64, 64)))
