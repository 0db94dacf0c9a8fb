"""Springs, idle life, lips, and what the animator makes of them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hri.core.signals import Expression, Gaze, Phoneme, Speech
from hri.face import idle
from hri.face.animator import Animator
from hri.face.lipsync import CLOSED, DOUBLE, SINGLE, lip_track, visemes_of
from hri.face.spring import Spring
from hri.face.vocabulary import VISEMES
from tests.face.pixels import MODEL

RATE = 16000
TICK = 1 / 30


def spoken(*names: str, each: float = 0.09) -> Speech:
    """A speech of phonemes that last equally long."""
    phonemes = tuple(Phoneme(name, n * each, each) for n, name in enumerate(names))
    return Speech("", np.zeros(round(len(names) * each * RATE), np.int16), RATE, phonemes)


@given(st.lists(st.floats(0.001, 0.5), min_size=1, max_size=20), st.floats(1, 80))
def test_a_spring_ends_in_the_same_place_whatever_the_steps(steps: list[float], w: float) -> None:
    fine, coarse = Spring(w), Spring(w)
    for spring in (fine, coarse):
        spring.jump(0.0, 1.0)
    for step in steps:
        value = float(fine.follow(1.0, step))
    assert value == pytest.approx(float(coarse.follow(1.0, sum(steps))), abs=1e-9)
    assert 0 <= value <= 1 + 1e-9, "it never overshoots"


def test_a_spring_does_not_jump_when_its_goal_does() -> None:
    spring = Spring(10.0)
    spring.jump(0.0, 1.0)
    spring.follow(1.0, 0.1)
    before, speed = float(spring.follow(1.0, 1e-9)), (float(spring.follow(1.0, 1e-6)))
    spring.jump(1.0, -3.0)
    assert float(spring.follow(-3.0, 1e-9)) == pytest.approx(before, abs=1e-4)
    assert speed >= before


@given(st.integers(0, 5), st.floats(0, 1000))
def test_idle_life_is_a_smooth_function_of_time(seed: int, t: float) -> None:
    dt = 1e-3
    blink, life = MODEL.settings.blink, MODEL.settings.idle
    assert abs(idle.blink_closure(blink, seed, t + dt) - idle.blink_closure(blink, seed, t)) < 0.05
    now, then = idle.wandering(life, seed, t), idle.wandering(life, seed, t + dt)
    assert abs(now.x - then.x) < 0.05
    assert abs(now.y - then.y) < 0.05
    assert idle.sway(life, seed, t) == idle.sway(life, seed, t)


def test_the_eyes_blink_about_as_often_as_people_do() -> None:
    blink = MODEL.settings.blink
    shut = [idle.blink_closure(blink, 1, t) > 0.9 for t in np.arange(0, 600, 0.02)]
    blinks = np.count_nonzero(np.diff(np.array(shut, int)) == 1) / 10
    assert 11 < blinks < 24


def test_every_viseme_has_sounds_and_every_sound_a_viseme() -> None:
    assert set(SINGLE) == set(VISEMES)
    for pair in DOUBLE.values():
        assert set(pair.split()) <= set(VISEMES)
    assert visemes_of("p") == (("PP",), 1.0)
    assert visemes_of("'aI") == (("aa", "ih"), 1.0)
    assert visemes_of("i:") == (("ih",), 1.0)
    assert visemes_of("@")[1] < 1
    assert visemes_of("§")[0] == ("kk",)


SOUNDS = st.sampled_from([*"aEsktlrmpbfvSh@wn", "i:", "oU", "u:", "_:"])


@given(st.lists(SOUNDS, min_size=1, max_size=25), st.floats(0.03, 0.2), st.floats(0, TICK))
@settings(max_examples=40, deadline=None)
def test_the_lips_meet_for_p_b_m_f_v_in_at_least_one_frame(
    names: list[str], each: float, phase: float
) -> None:
    speech = spoken(*names, each=each)
    track = lip_track(speech)
    frames = np.arange(phase - 1, speech.duration + 1, TICK)
    for number, name in enumerate(names):
        (viseme, *_), _ = visemes_of(name)
        neighbors = {visemes_of(other)[0][0] for other in names[max(number - 2, 0) : number + 3]}
        if viseme in CLOSED and len(neighbors & set(CLOSED)) == 1:
            near = frames[np.abs(frames - (number + 0.5) * each) < each / 2 + 0.07]
            assert max(track.weights(t).get(viseme, 0.0) for t in near) >= 0.9


@given(st.lists(SOUNDS, min_size=1, max_size=12), st.floats(-1, 4))
@settings(deadline=None)
def test_lip_weights_stay_in_range_and_continuous(names: list[str], t: float) -> None:
    track = lip_track(spoken(*names))
    now, then = track.weights(t), track.weights(t + 1e-3)
    for viseme in VISEMES:
        assert 0 <= now.get(viseme, 0.0) <= 1.2
        assert abs(now.get(viseme, 0.0) - then.get(viseme, 0.0)) < 0.08


def test_the_mouth_rests_before_and_after_the_words() -> None:
    track = lip_track(spoken("a", "m", "a"))
    assert max(track.weights(-1.0).values(), default=0) < 0.05
    assert max(track.weights(2.0).values(), default=0) < 0.05
    assert track.weights(0.02)["aa"] > 0.6


def test_a_voice_without_phonemes_moves_the_mouth_with_its_loudness() -> None:
    t = np.arange(RATE) / RATE
    loud = np.where((t > 0.4) & (t < 0.7), 12000, 0) * np.sin(2 * np.pi * 180 * t)
    track = lip_track(Speech("", loud.astype(np.int16), RATE))
    assert track.weights(0.55)["aa"] > 0.4
    assert track.weights(0.2) == {}
    assert track.weights(5.0) == {}
    assert lip_track(Speech("", np.zeros(0, np.int16), RATE)).weights(0.1) == {}


def animate(animator: Animator, seconds: float, start: float = 0.0, speech_at: float | None = None):  # type: ignore[no-untyped-def]
    """Weights of all channels tick by tick."""
    for number in range(round(seconds / TICK)):
        position = None if speech_at is None else speech_at + number * TICK
        weights = animator.step(start + number * TICK, TICK, position)
        yield MODEL.vector(weights.values)


def test_speech_moves_the_mouth_of_a_happy_face_and_leaves_its_brows() -> None:
    animator = Animator(MODEL)
    animator.express(Expression("happy"))
    list(animate(animator, 2.0))
    animator.speak(spoken("m", "m", "m", "m", "m", "m"))
    *_, last = animate(animator, 0.4, 2.0, 0.0)
    weights = MODEL.weights(last)
    assert weights.get("jawOpen", 0.0) < 0.02, "closed for m, though happy opens it"
    assert weights["mouthSmileLeft"] == pytest.approx(0.5, abs=0.1)
    assert weights["browInnerUp"] > 0.15


def test_the_mouth_shuts_within_100_ms_of_a_cut() -> None:
    animator = Animator(MODEL)
    animator.speak(spoken(*["a"] * 20))
    *_, talking = animate(animator, 1.0, 0.0, 0.0)
    assert MODEL.weights(talking)["jawOpen"] > 0.5
    animator.speak(None)
    *_, shut = animate(animator, 0.1, 1.0)
    assert abs(MODEL.weights(shut).get("jawOpen", 0.0)) < 0.05


LABELS = st.sampled_from(sorted(MODEL.expressions))


@given(st.lists(st.tuples(LABELS, st.floats(0, 1), st.booleans()), min_size=1, max_size=4))
@settings(max_examples=15, deadline=None)
def test_no_interruption_makes_the_face_jump(asked: list[tuple[str, float, bool]]) -> None:
    """Steps of a millisecond stay small, whatever is asked for in between."""
    animator = Animator(MODEL, seed=2)
    now, last = 0.0, None
    for label, intensity, talks in asked:
        animator.express(Expression(label, intensity))
        animator.look(Gaze(intensity, -intensity))
        animator.speak(spoken("a", "u:", "m", "a") if talks else None)
        for number in range(30):
            now += 1e-3
            position = 0.1 + number * 1e-3 if talks else None
            vector = MODEL.vector(animator.step(now, 1e-3, position).values)
            assert last is None or np.abs(vector - last).max() < 0.12
            last = vector


def test_an_expression_arrives_in_half_a_second_and_stays() -> None:
    animator = Animator(MODEL)
    animator.express(Expression("sad"))
    *_, soon = animate(animator, 0.6)
    weights = MODEL.weights(soon)
    assert weights["mouthFrownLeft"] > 0.9 * MODEL.expressions["sad"]["mouthFrown"]


def test_arousal_widens_the_pupils() -> None:
    excited, calm = Animator(MODEL), Animator(MODEL)
    excited.feel(1.0)
    *_, wide = animate(excited, 4.0)
    *_, rest = animate(calm, 4.0)
    assert MODEL.weights(wide)["pupilWide"] > MODEL.weights(rest).get("pupilWide", 0.0) + 0.4
