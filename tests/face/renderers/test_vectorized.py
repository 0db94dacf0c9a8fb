"""Pictures that numpy draws are those of the compiled loops, byte for byte."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.face import load_face
from hri.face.drawing.baking import Item, Opening, Shape
from hri.face.drawing.paint import Gradient, Solid, Stop
from hri.face.renderers import painter
from hri.face.renderers.instructions import Program
from hri.face.renderers.kernel import paint
from hri.face.renderers.program import program_of, scratch_for
from hri.face.renderers.renderer import Renderer
from hri.face.renderers.strokes import Strokes
from hri.face.renderers.vectorized import paint_slowly
from hri.face.still import still_vector

SIZE = WIDTH, HEIGHT = (40, 30)
STEPS = st.integers(-20 * 256, 60 * 256)
CORNERS = st.lists(st.tuples(STEPS, STEPS), min_size=3, max_size=8)
BYTE = st.integers(0, 255)
COLORS = st.tuples(BYTE, BYTE, BYTE)
SHARES = st.floats(0, 1, width=32)
STOPS = st.builds(Stop, SHARES, COLORS, SHARES)
PAINTS = st.one_of(
    st.builds(Solid, COLORS, SHARES),
    st.builds(
        lambda count, first, last: Gradient(np.zeros((count, 2)), (first, last)),
        st.sampled_from([2, 3]),
        STOPS,
        STOPS,
    ),
)
DRAWN = st.lists(st.tuples(CORNERS, PAINTS, st.floats(0, 1.5, width=32)), min_size=1, max_size=6)


def drawing(drawn: list, opened: int) -> tuple[Program, np.ndarray, np.ndarray]:
    """Shapes behind each other, the last ones seen through the one before; and their numbers."""
    shapes: list[Shape] = []
    vertices: list[tuple[int, int]] = []
    for number, (corners, fill, _) in enumerate(drawn):
        first, last = len(vertices), len(vertices) + len(corners)
        # Three more are where a gradient lies.
        vertices += [*corners, *corners[:3]]
        shapes.append(
            Shape(str(number), ((first, last, True),), fill, (last, last + 3), number, False, True)
        )
    items: list[Item] = list(shapes)
    if opened < len(shapes) - 1:
        items = [*shapes[:opened], Opening(shapes[opened], tuple(shapes[opened + 1 :]))]
    opacities = np.array([opacity for *_, opacity in drawn], np.float32)
    return program_of(items, Strokes([])), np.array(vertices, np.int32), opacities


@settings(max_examples=150)
@given(DRAWN, st.integers(0, 5), st.sampled_from([0, 0xFF336699]))
def test_shapes_of_all_kinds_are_the_same(drawn: list, opened: int, ground: int) -> None:
    program, vertices, opacities = drawing(drawn, opened)
    fast, slow = (np.full((HEIGHT, WIDTH), ground, np.uint32) for _ in range(2))
    paint(program, vertices, opacities, scratch_for(program, *SIZE), fast)
    paint_slowly(program, vertices, opacities, slow)
    assert np.array_equal(fast, slow)


@pytest.mark.parametrize("face", ["robot", "astronaut", "person", "eyes"])
@pytest.mark.parametrize("transparent", [False, True])
def test_faces_are_the_same(face: str, transparent: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    model = load_face(face)
    renderer = Renderer(model, (200, 150), transparent=transparent)
    for label in ("happy", "sad", "excited", "asleep"):
        vector = still_vector(model, label, viseme="aa", time=1.3)
        vector[-4:] += (2.0, 1.0, 0.7, 1.5)  # partly out of the picture, and turned
        monkeypatch.setattr(painter, "_painted", itertools.count())
        slow = renderer.render(vector)
        monkeypatch.setattr(painter, "_painted", itertools.count(painter.UNCOMPILED))
        assert np.array_equal(renderer.render(vector), slow)
