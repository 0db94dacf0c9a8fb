"""Valence and arousal as a face."""

import math

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError
from hri.face import load_face
from hri.face.motion.affect_map import NEIGHBORS, AffectMap
from hri.face.motion.lids import Lids
from tests.face.pixels import MODEL

MAP = AffectMap(MODEL)
SIDE = st.floats(-1, 1)


@pytest.mark.parametrize("label", MAP.labels)
def test_at_its_own_point_an_expression_is_all_that_shows(label: str) -> None:
    valence, arousal = MODEL.settings.affect[label]
    assert MAP.shares(valence, arousal)[label] == pytest.approx(1.0, abs=1e-9)
    shown = AffectMap(MODEL).weights(valence, arousal)
    marks = MODEL.vector(dict.fromkeys(MODEL.settings.signs, 1.0)) != 0
    assert shown == pytest.approx(MODEL.vector(MODEL.expression(label)) * ~marks, abs=1e-6)


@pytest.mark.parametrize("name", ["robot", "astronaut", "person", "eyes"])
def test_no_mood_shows_marks_such_as_tears(name: str) -> None:
    model = load_face(name)
    affect = AffectMap(model)
    marks = model.vector(dict.fromkeys(model.settings.signs, 1.0)) != 0
    assert marks.any()
    sides = np.linspace(-1, 1, 21)
    shown = np.array([affect.weights(valence, arousal) for valence in sides for arousal in sides])
    assert not shown[:, marks].any()
    assert any(model.vector(weights)[marks].any() for weights in model.expressions.values())


@pytest.mark.parametrize("name", ["robot", "astronaut", "person", "eyes"])
def test_calm_and_pleasure_look_content_and_awake(name: str) -> None:
    model = load_face(name)
    lids = Lids(model)
    for valence, arousal in ((0.6, -0.4), (0.5, -0.5), (1.0, -1.0), (0.3, -0.2)):
        assert lids.shut(AffectMap(model).weights(valence, arousal).astype(float)) < 0.15
    smile = model.channels.index("mouthSmileLeft") if "mouthSmile" in model.targets else None
    if smile is not None:
        assert AffectMap(model).weights(0.6, -0.4)[smile] > 0.2


def test_in_the_middle_of_the_circle_is_the_neutral_face() -> None:
    assert MAP.shares(0.0, 0.0) == {"neutral": 1.0}


@given(SIDE, SIDE)
def test_a_few_neighbors_share_the_face_between_them(valence: float, arousal: float) -> None:
    shares = MAP.shares(valence, arousal)
    assert 1 <= len(shares) <= NEIGHBORS
    assert sum(shares.values()) == pytest.approx(1.0)
    assert min(shares.values()) > 0


@given(SIDE, SIDE, st.floats(0, 2 * math.pi))
def test_a_small_change_of_feeling_is_a_small_change_of_face(
    valence: float, arousal: float, way: float
) -> None:
    step = 1e-5
    here = MAP.weights(valence, arousal)
    there = MAP.weights(valence + step * math.cos(way), arousal + step * math.sin(way))
    assert np.abs(here - there).max() < 200 * step


@given(st.floats(0, 2 * math.pi), st.floats(1, 100))
def test_beyond_the_circle_is_its_rim(way: float, length: float) -> None:
    rim = MAP.weights(math.cos(way), math.sin(way))
    beyond = MAP.weights(length * math.cos(way), length * math.sin(way))
    assert beyond == pytest.approx(rim, abs=1e-4)


def test_feelings_that_are_not_finite_are_refused() -> None:
    with pytest.raises(HriError, match="the valence is nan - give a number from -1 to 1"):
        MAP.weights(math.nan, 0.0)
