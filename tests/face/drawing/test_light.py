"""Light stays on its shape when the head turns: gradients go with outlines."""

from collections.abc import Iterator

import numpy as np
import pytest
from hypothesis import given, strategies as st
from numpy.typing import NDArray

from hri.face import load_face
from hri.face.drawing.baking import Item, Opening, Shape
from hri.face.drawing.light import with_light
from hri.face.drawing.outline import Points
from hri.face.drawing.paint import Gradient, Stop
from hri.face.model import FaceModel

ANGLES = np.linspace(0, 2 * np.pi, 24, endpoint=False)
RING = np.column_stack([80 + 30 * np.cos(ANGLES), 60 + 20 * np.sin(ANGLES)])
FADING = (Stop(0, (255, 0, 0)), Stop(1, (255, 0, 0), 0.0))
ROUND = Gradient(np.array([[80.0, 60], [110, 60], [80, 80]]), FADING)
UPRIGHT = Gradient(np.array([[80.0, 40], [80, 80]]), FADING)


def light(points: Points, anchors: Points) -> NDArray[np.float64]:
    """How far along its gradient each point is, 0 to 1."""
    if len(anchors) == 3:
        axes = anchors[1:] - anchors[0]
        return np.asarray(np.hypot(*((points - anchors[0]) @ np.linalg.inv(axes)).T))
    way = anchors[1] - anchors[0]
    return np.asarray((points - anchors[0]) @ way / (way @ way))


MATRICES = st.lists(st.floats(-0.02, 0.02), min_size=4, max_size=4).map(np.array)
SHIFTS = st.tuples(st.floats(-20, 20), st.floats(-20, 20)).map(np.array)


@given(MATRICES, SHIFTS, st.sampled_from([ROUND, UPRIGHT]))
def test_light_goes_where_an_affine_motion_takes_its_shape(
    matrix: NDArray[np.float64], shift: NDArray[np.float64], paint: Gradient
) -> None:
    middle = RING.mean(axis=0)
    move = with_light(RING, paint, (RING - middle) @ matrix.reshape(2, 2).T + shift)
    outline, anchors = RING + move[: len(RING)], paint.anchors + move[len(RING) :]
    # Lines of equal color of a linear gradient follow to first order.
    assert light(outline, anchors) == pytest.approx(light(RING, paint.anchors), abs=5e-3)


@given(st.floats(-0.02, 0.02), st.floats(-0.3, 0.3))
def test_a_soft_spot_keeps_its_soft_rim_however_it_is_bent(bend: float, shear: float) -> None:
    x, y = (RING - RING.mean(axis=0)).T
    move = np.column_stack([bend * x * x + shear * y, bend * x * y])
    moved = with_light(RING, ROUND, move)
    outline, anchors = RING + moved[: len(RING)], ROUND.anchors + moved[len(RING) :]
    assert light(outline, anchors).min() > 0.999


def test_a_line_says_nothing_about_how_it_grows_thick() -> None:
    line = np.column_stack([np.linspace(0, 100, 9), np.full(9, 50.0)])
    moved = with_light(line, ROUND, np.column_stack([line[:, 0] * 0.1, np.full(9, 3.0)]))
    assert np.abs(moved).max() < 20


def shapes(items: tuple[Item, ...]) -> Iterator[Shape]:
    for item in items:
        if isinstance(item, Opening):
            yield from shapes(item.content)
        else:
            yield item


def lights(face: FaceModel, shape: Shape, **turns: float) -> NDArray[np.float64]:
    points = face.blend(face.vector(turns))[0].astype(float)
    first, (last, end) = shape.contours[0][0], shape.anchors
    return light(points[first:last], points[last:end])


@pytest.mark.parametrize("name", ["robot", "astronaut", "person", "eyes"])
def test_no_soft_shape_gets_a_rim_when_the_head_turns(name: str) -> None:
    face = load_face(name)
    soft = [
        shape
        for shape in shapes(face.display.items)
        if isinstance(shape.paint, Gradient) and shape.paint.stops[-1].opacity == 0
    ]
    assert soft
    for shape in soft:
        rest = lights(face, shape)
        for yaw, pitch in ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0)):
            turned = lights(face, shape, headYaw=yaw, headPitch=pitch)
            # What was at the transparent end still is: a fading of an eighth is not seen.
            assert turned[rest > 0.99].min(initial=1.0) > 0.87, shape.id
