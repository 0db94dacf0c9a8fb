"""One picture: what is asked for is what is seen, and nothing else moves."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.face import load_face, render_face
from hri.face.motion.affect_map import AffectMap
from hri.face.still import still_vector

MODEL = load_face("robot")
LOOKS = st.sampled_from(sorted(MODEL.expressions))


def difference(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.abs(one - other).max())


@given(LOOKS, st.floats(0, 1))
@settings(max_examples=30, deadline=None)
def test_a_named_expression_is_at_its_apex_times_the_intensity(
    label: str, intensity: float
) -> None:
    vector = still_vector(MODEL, label, intensity)
    whole = MODEL.vector(MODEL.expression(label))
    moved = ~np.array([channel.startswith("eyeLook") for channel in MODEL.channels])
    assert difference(vector[moved], intensity * whole[moved]) < 1e-5


def test_time_moves_idle_life_only() -> None:
    apex = still_vector(MODEL, "happy", viseme="aa")
    alive = [still_vector(MODEL, "happy", viseme="aa", time=t, seed=3) for t in (0.3, 7.1, 99.9)]
    mouth = np.array([name.startswith(("mouth", "jaw")) for name in MODEL.channels])
    for vector in alive:
        assert difference(vector[mouth], apex[mouth]) < 1e-6
        assert difference(vector, apex) > 1e-3
    assert difference(alive[0], alive[1]) > 1e-3


def test_who_is_asleep_does_not_blink() -> None:
    shut = MODEL.channels.index("eyeBlinkLeft")
    lids = [still_vector(MODEL, "asleep", time=t)[shut] for t in np.arange(0, 20, 0.1)]
    assert np.ptp(lids) < 1e-6


def test_valence_and_arousal_are_a_mood_below_the_expression() -> None:
    pupils = MODEL.vector(MODEL.settings.pupils)
    mood = AffectMap(MODEL).weights(0.8, 0.4) + 0.4 * pupils
    assert difference(still_vector(MODEL, valence=0.8, arousal=0.4), mood) < 1e-6
    assert difference(still_vector(MODEL, valence=0.8), AffectMap(MODEL).weights(0.8, 0.0)) < 1e-6
    sad = MODEL.vector(MODEL.expression("sad"))
    half = still_vector(MODEL, "sad", 0.5, valence=0.8, arousal=0.4)
    steady = np.array(["eye" not in channel for channel in MODEL.channels])
    assert difference(half[steady], (0.5 * mood + 0.5 * sad)[steady]) < 1e-5


def test_the_mouth_of_a_talking_face_is_the_visemes() -> None:
    open_wide = MODEL.channels.index("jawOpen")
    shut = still_vector(MODEL, "happy", viseme="PP")
    assert shut[open_wide] < 0.02 < still_vector(MODEL, "happy")[open_wide]


@pytest.mark.skipif(MODEL.settings.head is None, reason="the head does not turn")
def test_yaw_and_pitch_turn_the_head_by_degrees() -> None:
    head = MODEL.settings.head
    assert head is not None
    vector = still_vector(MODEL, yaw=head.yaw, pitch=-head.pitch / 2)
    assert vector[MODEL.channels.index("headYaw")] == pytest.approx(1.0)
    assert vector[MODEL.channels.index("headPitch")] == pytest.approx(-0.5)
    left, right = (render_face(MODEL, yaw=yaw, size=(160, 120)) for yaw in (-head.yaw, head.yaw))
    assert np.abs(left.astype(int) - right).mean() > 1


def test_the_same_arguments_give_the_same_bytes() -> None:
    pictures = [render_face("robot", "sad", 0.7, time=4.2, seed=5, size=(96, 72)) for _ in "ab"]
    assert np.array_equal(*pictures)
    other = render_face("robot", "sad", 0.7, time=4.2, seed=6, size=(96, 72))
    assert not np.array_equal(pictures[0], other)


NAN = float("nan")


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        ({"expression": "hapy"}, 'no expression "hapy" - did you mean "happy"'),
        ({"viseme": "ahh"}, "no viseme"),
        ({"viseme": {"aa": NAN}}, "the viseme aa is nan"),
        ({"weights": {"jawOpn": 1.0}}, "jawOpn"),
        ({"weights": {"jawOpen": NAN}}, "nan"),
        ({"intensity": 1.5}, "intensity is 1.5 - give a number from 0 to 1"),
        ({"gaze": (0.0, NAN)}, "gaze y is nan"),
        ({"valence": -2.0}, "valence is -2 - give a number from -1 to 1"),
        ({"arousal": NAN}, "arousal is nan"),
        ({"yaw": 90.0}, "yaw|does not turn"),
        ({"pitch": NAN}, "pitch|does not turn"),
        ({"time": NAN}, "time is nan"),
    ],
)
def test_what_cannot_be_shown_is_refused_in_a_line(arguments: dict[str, object], what: str) -> None:
    with pytest.raises(HriError, match=what):
        still_vector(MODEL, **arguments)  # type: ignore[arg-type]
