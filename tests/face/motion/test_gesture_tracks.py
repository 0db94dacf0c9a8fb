"""Gestures: their file, how they are made, and how they end early."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Expression
from hri.face.animator import Animator
from hri.face.model import load_face
from hri.face.motion.gesture_tracks import Gesture, load_gestures, read_gestures, track_of
from hri.face.regions import region_of
from tests.face.pixels import MODEL
from tests.face.test_motion import TICK, animate, spoken

GESTURES = load_gestures(MODEL)
INDEX = {channel: number for number, channel in enumerate(MODEL.channels)}


def made(name: str, strength: float = 1.0, seconds: float = 0.0, ahead: float = 0.5) -> np.ndarray:
    """What a gesture does to a calm face, [ticks, channels]."""
    with_it, without = Animator(MODEL, 5), Animator(MODEL, 5)
    with_it.gesture(name, strength, seconds)
    length = (seconds or GESTURES[name].duration) + ahead
    pairs = zip(animate(with_it, length), animate(without, length), strict=True)
    return np.array([one - other for one, other in pairs])


def test_the_gestures_that_people_know_are_all_there() -> None:
    wanted = "nod shake wink eyeRoll yawn laugh sigh think doze startle tilt sneeze"
    assert set(wanted.split()) <= set(GESTURES)


@pytest.mark.parametrize("face", ["robot", "astronaut", "person", "eyes"])
def test_every_face_has_something_to_move_for_each_gesture(face: str) -> None:
    model = load_face(face)
    for name, gesture in load_gestures(model).items():
        track = track_of(gesture, model)
        moments = [track.at(time) for time in gesture.times]
        most = max(max(np.abs(values).max(), np.abs(gaze).max()) for values, gaze in moments)
        assert most > 0.4, name


@pytest.mark.parametrize("name", sorted(GESTURES))
def test_a_gesture_is_seen_and_then_gone(name: str) -> None:
    difference = np.abs(made(name))
    assert difference.max() > 0.4
    assert difference[-1].max() < 0.02
    assert difference[0].max() < 0.1, "it sets in softly"


def test_a_wink_shuts_one_eye() -> None:
    left, right = (made("wink")[:, INDEX[f"eyeBlink{side}"]].max() for side in ("Left", "Right"))
    assert left > 0.9
    assert right < 0.05


def test_strength_and_seconds_stretch_a_gesture() -> None:
    full, half = made("tilt"), made("tilt", strength=0.5)
    roll = INDEX["headRoll"]
    assert half[:, roll].max() == pytest.approx(full[:, roll].max() / 2, rel=0.02)
    slow = made("tilt", seconds=3.4)
    assert slow[:, roll].argmax() == pytest.approx(2 * full[:, roll].argmax(), abs=4)


def test_a_yawn_takes_the_mouth_from_a_smile_and_gives_it_back() -> None:
    animator = Animator(MODEL)
    animator.express(Expression("happy"))
    list(animate(animator, 1.5))
    playing = animator.gesture("yawn")
    smiles = [v[INDEX["mouthSmileLeft"]] for v in animate(animator, 4.5, 1.5)]
    assert min(smiles) < 0.05
    assert smiles[-1] > 0.9
    assert playing.is_over


def test_a_talking_mouth_is_left_alone_by_a_gesture() -> None:
    plain, laughing = Animator(MODEL, 1), Animator(MODEL, 1)
    laughing.gesture("laugh")
    for animator in (plain, laughing):
        animator.speak(spoken(*["a", "m"] * 12))
    mouth = [INDEX["jawOpen"], INDEX["mouthPressLeft"]]
    for one, other in zip(
        animate(plain, 1.5, 0.0, 0.0), animate(laughing, 1.5, 0.0, 0.0), strict=True
    ):
        assert one[mouth] == pytest.approx(other[mouth], abs=0.25)
    assert other[INDEX["cheekSquintLeft"]] > 0.5


@given(st.sampled_from(sorted(GESTURES)), st.sampled_from(sorted(GESTURES)), st.floats(0.0, 1.0))
@settings(max_examples=12, deadline=None)
def test_a_gesture_that_is_cut_glides_away(name: str, other: str, share: float) -> None:
    """Steps of two milliseconds change the speed of no channel at once."""
    animator, step = Animator(MODEL, 4), 2e-3
    playing = animator.gesture(name)
    begin = share * GESTURES[name].duration
    animator.vector(0.0, 0.0)
    now, path = begin, [animator.vector(begin, begin), animator.vector(begin + step, step)]
    now += step
    for count, cut in ((40, playing.cancel), (40, lambda: animator.gesture(other)), (40, None)):
        if cut is not None:
            cut()
        for _ in range(count):
            now += step
            path.append(animator.vector(now, step))
    head = [number for channel, number in INDEX.items() if region_of(channel) in ("head", "brows")]
    bend = np.diff(np.array(path)[:, head], 2, axis=0)
    assert np.abs(bend).max() < 0.012
    assert playing.is_over


def test_a_gesture_gives_way_to_the_next_one() -> None:
    animator = Animator(MODEL)
    first = animator.gesture("nod")
    list(animate(animator, 0.3))
    second = animator.gesture("wink")
    assert first.is_over
    list(animate(animator, 0.9, 0.3))
    assert second.is_over


def test_what_a_face_lacks_is_left_out() -> None:
    gesture = Gesture("wave", 1.0, (0.5,), {"trunkUp": (1.0,), "jawOpen": (0.5,), "gazeX": (1.0,)})
    values, gaze = track_of(gesture, MODEL).at(0.5)
    assert values[INDEX["jawOpen"]] == pytest.approx(0.5)
    assert np.count_nonzero(values) == 1
    assert gaze == pytest.approx((1.0, 0.0))


@given(
    st.lists(st.floats(-2, 2), min_size=1, max_size=8),
    st.floats(0, 1),
)
def test_between_keyframes_no_weight_leaves_what_they_say(row: list[float], share: float) -> None:
    times = tuple((np.arange(len(row)) + 1.0).tolist())
    track = track_of(Gesture("g", len(row) + 1.0, times, {"jawOpen": tuple(row)}), MODEL)
    values, _ = track.at(share * track.duration)
    assert min(0, *row) - 1e-9 <= values[INDEX["jawOpen"]] <= max(0, *row) + 1e-9
    end, _ = track.at(track.duration)
    assert not end.any()


def test_an_unknown_gesture_is_refused_with_the_nearest_name() -> None:
    with pytest.raises(HriError, match=r'no gesture "nodd" - did you mean "nod"\?'):
        Animator(MODEL).gesture("nodd")
    for strength, seconds in ((2.0, 0.0), (float("nan"), 0.0), (1.0, 1e9), (1.0, float("nan"))):
        with pytest.raises(HriError, match="a gesture of"):
            Animator(MODEL).gesture("nod", strength, seconds)


@pytest.mark.parametrize(
    ("line", "error"),
    [
        ("weights.jawOpne = [1]", 'no face has a target "jawOpne" - did you mean "jawOpen"'),
        ("weights.jawOpen = [1, 2]", "jawOpen has 2 numbers - write 1"),
        ("weights.jawOpen = [9]", "jawOpen goes beyond 2"),
        ("weights.jawOpen = [nan]", "jawOpen holds something that is not a number"),
        ("at = [0.5, 0.2]", "4:1: keyframes at 0.5, 0.2 s"),
        ("at = [1.5]", "below duration_s, 1"),
        ("at = []", "0 keyframes"),
        ("duration_s = 99", "duration_s is 99"),
        ('owns = ["mout"]', 'no region "mout" - did you mean "mouth"'),
        ("speed = 2", 'unknown key "speed"'),
    ],
)
def test_a_mistake_in_the_file_is_told_with_its_place(
    line: str, error: str, tmp_path: Path
) -> None:
    lines = {"duration_s": "duration_s = 1", "at": "at = [0.5]", "weights": "weights.jawOpen = [1]"}
    lines[line.split()[0].split(".")[0]] = line
    file = tmp_path / "gestures.toml"
    file.write_text("\n".join(["# a file", "[wave]", *lines.values()]))
    with pytest.raises(AuthoringError, match=error) as raised:
        read_gestures(file)
    assert str(raised.value).startswith(f"{file}:")


def test_ticks_of_any_length_end_a_gesture() -> None:
    animator = Animator(MODEL)
    playing = animator.gesture("sneeze")
    animator.vector(0.0, TICK)
    animator.vector(100.0, 100.0)
    assert playing.is_over
