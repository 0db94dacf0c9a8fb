"""What drawings become: sides, products of two targets, and a head that turns."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st
from numpy.typing import NDArray

from hri.core.errors import HriError
from hri.face import load_face
from hri.face.drawing.baking import Shape
from hri.face.drawing.blending import Blend
from hri.face.model import FaceModel
from tests.face.small_face import write_face, write_target


@pytest.fixture(scope="module")
def face(tmp_path_factory: pytest.TempPathFactory) -> Iterator[FaceModel]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield load_face(write_face(tmp_path_factory.mktemp("faces") / "small"))


def shapes(face: FaceModel) -> dict[str, Shape]:
    found = {}
    for item in face.display.items:
        shape = item if isinstance(item, Shape) else item.clip
        found[shape.id] = shape
    return found


def part(face: FaceModel, id: str, **weights: float) -> NDArray[np.float32]:
    """The points of a part for weights by name."""
    points, _ = face.blend(face.vector(weights))
    contours = shapes(face)[id].contours
    return points[contours[0][0] : contours[-1][1]]


def test_a_target_at_1_looks_as_it_was_drawn(face: FaceModel) -> None:
    assert part(face, "lips", jawOpen=1)[:, 1].max() == pytest.approx(82, abs=0.1)
    assert part(face, "lips", mouthSmile=1)[:, 0].min() == pytest.approx(31)


def test_a_side_moves_its_own_half_only(face: FaceModel) -> None:
    rest, left = part(face, "lips"), part(face, "lips", mouthSmileLeft=1)
    assert left[:, 0].max() == pytest.approx(69, abs=0.6)
    assert left[:, 0].min() == pytest.approx(rest[:, 0].min(), abs=0.3)


def test_both_sides_add_up_to_the_drawing(face: FaceModel) -> None:
    whole = part(face, "lips", mouthSmile=0.7)
    assert np.allclose(whole, part(face, "lips", mouthSmileLeft=0.7, mouthSmileRight=0.7))


def test_two_targets_at_1_look_as_their_corrective_was_drawn(face: FaceModel) -> None:
    lips = part(face, "lips", mouthSmile=1, jawOpen=1)
    assert lips[:, 0].min() == pytest.approx(29, abs=0.01)
    assert lips[:, 0].max() == pytest.approx(71, abs=0.01)
    assert lips[:, 1].max() == pytest.approx((62 + 99) / 2, abs=0.1)
    assert face.correctives[:2] != ()
    assert {"mouthSmileLeft*jawOpen", "mouthSmileRight*jawOpen"} <= set(face.correctives)


@given(smile=st.floats(0, 1), jaw=st.floats(0, 1))
def test_a_corrective_comes_with_the_product_of_both(
    face: FaceModel, smile: float, jaw: float
) -> None:
    rest = part(face, "lips")
    alone = part(face, "lips", mouthSmile=smile) + part(face, "lips", jawOpen=jaw) - rest
    both = part(face, "lips", mouthSmile=smile, jawOpen=jaw)
    full = part(face, "lips", mouthSmile=1, jawOpen=1)
    full_alone = part(face, "lips", mouthSmile=1) + part(face, "lips", jawOpen=1) - rest
    assert np.allclose(both - alone, smile * jaw * (full - full_alone), atol=1e-3)


def test_a_corrective_cannot_be_weighted_by_hand_and_has_no_say_below_0(face: FaceModel) -> None:
    for name in ("mouthSmile+jawOpen", "mouthSmileLeft*jawOpen"):
        with pytest.raises(HriError, match="no target"):
            face.vector({name: 1.0})
    rest = part(face, "lips")
    alone = part(face, "lips", mouthSmile=-0.5) + part(face, "lips", jawOpen=1) - rest
    assert np.allclose(part(face, "lips", mouthSmile=-0.5, jawOpen=1), alone, atol=1e-3)


def test_two_paired_targets_meet_on_the_same_side_only(tmp_path: Path) -> None:
    folder = write_face(tmp_path / "mine")
    write_target(
        folder, "mouthPress", '<path id="lips" d="M 36,70 Q 50,70 64,70 Q 50,71 36,70 Z"/>'
    )
    write_target(
        folder,
        "mouthSmile+mouthPress",
        '<path id="lips" d="M 33,66 Q 50,68 67,66 Q 50,70 33,66 Z"/>',
    )
    found = {name for name in load_face(folder).correctives if "mouthPress" in name}
    assert found == {"mouthSmileLeft*mouthPressLeft", "mouthSmileRight*mouthPressRight"}


def test_opacity_and_stroke_width_morph(face: FaceModel) -> None:
    tear, brow = shapes(face)["tear"], shapes(face)["brow"]
    for weight in (0.0, 0.5, 1.0):
        _, scalars = face.blend(face.vector({"tear": weight, "browInnerUp": weight}))
        assert scalars[tear.opacity] == pytest.approx(weight)
        assert scalars[brow.opacity + 1] == pytest.approx(3 - 2 * weight)


@given(turn=st.floats(0.01, 1) | st.floats(-1, -0.01))
def test_a_head_that_turns_takes_its_face_along_and_leaves_its_rim(
    face: FaceModel, turn: float
) -> None:
    for channel, axis, way in (("headYaw", 0, 1), ("headPitch", 1, -1)):
        moved = part(face, "lips", **{channel: turn}).mean(axis=0) - part(face, "lips").mean(axis=0)
        assert moved[axis] * way * np.sign(turn) >= 0
        assert abs(moved[axis]) >= 4 * abs(turn)
        assert np.allclose(part(face, "head", **{channel: turn}), part(face, "head"), atol=0.35)
        assert np.array_equal(part(face, "neck", **{channel: turn}), part(face, "neck"))


def test_what_lies_in_front_moves_farther(face: FaceModel) -> None:
    eye = part(face, "eyeLeft", headYaw=1).mean(axis=0) - part(face, "eyeLeft").mean(axis=0)
    dome = 40 * (1 - np.hypot(15 / 40, 5 / 40) ** 3)
    flat = 15 * (np.cos(np.radians(25)) - 1)
    assert eye[0] == pytest.approx((dome + 5) * np.sin(np.radians(25)) + flat, abs=0.4)


def test_a_head_turned_to_both_limits_is_seen_as_after_both_rotations(face: FaceModel) -> None:
    yaw, pitch = np.radians(25), np.radians(15)
    x, y, z = 15, -5, 40 * (1 - np.hypot(15 / 40, 5 / 40) ** 3) + 5
    after_pitch = y * np.cos(pitch) - z * np.sin(pitch), z * np.cos(pitch) + y * np.sin(pitch)
    seen = 50 + x * np.cos(yaw) + after_pitch[1] * np.sin(yaw), 50 + after_pitch[0]
    eye = part(face, "eyeLeft", headYaw=1, headPitch=1)
    middle = (eye.min(axis=0) + eye.max(axis=0)) / 2
    assert middle == pytest.approx(seen, abs=1.0)


def test_no_weight_turns_the_head_beyond_its_limit(face: FaceModel) -> None:
    assert np.array_equal(part(face, "lips", headYaw=1), part(face, "lips", headYaw=1.5))


@given(seed=st.integers(0, 2**32 - 1), share=st.floats(0.01, 1))
def test_blocks_give_the_product_of_the_whole_matrix(seed: int, share: float) -> None:
    random = np.random.default_rng(seed)
    rows = random.normal(size=(9, 300)) * (random.random((9, 300)) < share)
    rows[:, 100:] *= random.random(9)[:, None] < share
    neutral, weights = random.normal(size=300), random.normal(size=9)
    blended = Blend(neutral.astype(np.float32), rows.astype(np.float32))(weights.astype(np.float32))
    assert np.allclose(blended, neutral + weights @ rows, atol=1e-4)


def test_a_face_without_targets_stays_as_it_is(tmp_path: Path) -> None:
    assert np.array_equal(Blend(np.ones(3, np.float32), np.zeros((0, 3), np.float32))(EMPTY), ONES)


EMPTY, ONES = np.zeros(0, np.float32), np.ones(3, np.float32)
