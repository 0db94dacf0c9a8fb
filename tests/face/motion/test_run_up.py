"""Head and brows have weight: they draw back before they go, and the head settles."""

import numpy as np
import pytest

from hri.core.signals import Expression
from hri.face import load_face
from hri.face.motion.expression_blender import ExpressionBlender
from hri.face.motion.run_up import SUDDEN
from hri.face.regions import region_of
from tests.face.pixels import MODEL

STEP = 2e-3
TIMING = MODEL.settings.timing


def shown(blender: ExpressionBlender, start: float, seconds: float) -> np.ndarray:
    moments = start + STEP * np.arange(round(seconds / STEP))
    return np.array([blender.follow(now, STEP) for now in moments])


def share_of_way(path: np.ndarray, region: str, model=MODEL) -> np.ndarray:  # type: ignore[no-untyped-def]
    """Of the channels of a region that move, how far each has come: 0 to 1."""
    moved = [
        number
        for number, channel in enumerate(model.channels)
        if region_of(channel) == region and abs(path[-1, number]) > 0.05
    ]
    return path[:, moved] / path[-1, moved]


@pytest.mark.parametrize("name", ["robot", "person", "eyes"])
@pytest.mark.parametrize("label", ["happy", "angry"])
def test_head_and_brows_draw_back_for_a_moment(name: str, label: str) -> None:
    model = load_face(name)
    blender = ExpressionBlender(model)
    blender.show(Expression(label))
    path = shown(blender, 0.0, 4.0)
    for region in ("head", "brows"):
        share = share_of_way(path, region, model)
        if share.size:
            assert -0.12 <= share.min() <= -0.08, region
            back = np.count_nonzero(share[:, 0] < 0) * STEP
            assert 0.06 <= back <= 0.16, region
    assert share_of_way(path, "mouth", model).min(initial=0.0) >= 0.0


def test_the_head_settles_from_a_little_beyond_and_nothing_else_does() -> None:
    blender = ExpressionBlender(MODEL)
    blender.show(Expression("happy"))
    path = shown(blender, 0.0, 4.0)
    assert 1.02 < share_of_way(path, "head").max() < 1.07
    for region in ("brows", "mouth", "corners"):
        assert share_of_way(path, region).max() < 1.0 + 1e-6, region


def test_brows_lead_in_spite_of_their_run_up() -> None:
    blender = ExpressionBlender(MODEL)
    blender.show(Expression("happy"))
    path = shown(blender, 0.0, 4.0)
    brows, corners = (
        np.argmax(share_of_way(path, region)[:, 0] > 0.9) * STEP for region in ("brows", "corners")
    )
    assert brows < corners - 0.03


def test_who_is_startled_takes_no_run_up() -> None:
    assert TIMING["surprised"].onset_s < SUDDEN
    blender = ExpressionBlender(MODEL)
    blender.show(Expression("surprised"))
    path = shown(blender, 0.0, 3.0)
    for region in ("head", "brows"):
        share = share_of_way(path, region)
        assert share.min() >= 0.0
        assert share.max() <= 1.0 + 1e-6


@pytest.mark.parametrize("cut", [0.02, 0.06, 0.1, 0.3])
@pytest.mark.parametrize("how", ["falls", "weaker", "asleep", "other"])
def test_whatever_cuts_a_run_up_it_bends_smoothly(cut: float, how: str) -> None:
    blender = ExpressionBlender(MODEL)
    blender.show(Expression("angry"))
    before = shown(blender, 0.0, cut)
    if how == "falls":
        blender.fall()
    elif how == "asleep":
        blender.be("asleep")
    else:
        blender.show(Expression("angry" if how == "weaker" else "happy", 0.3))
    path = np.concatenate([before, shown(blender, cut, 3.0)])
    brow_or_head = [region_of(channel) in ("brows", "head") for channel in MODEL.channels]
    assert np.abs(np.diff(path[:, brow_or_head], 2, axis=0)).max() < 1200 * STEP**2
    if how == "falls":
        assert np.abs(path[-1]).max() < 0.01
        assert np.abs(path[:, brow_or_head]).max() <= np.abs(before).max() + 0.1


def test_an_expression_that_only_grows_takes_no_run_up() -> None:
    blender = ExpressionBlender(MODEL)
    blender.show(Expression("happy", 0.3))
    shown(blender, 0.0, 4.0)
    blender.show(Expression("happy", 1.0))
    path = shown(blender, 4.0, 4.0)
    share = share_of_way(path, "head")
    assert share.min() > 0.29
    assert share.max() < 1.0 + 1e-6
