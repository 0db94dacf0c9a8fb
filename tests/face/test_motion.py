"""Springs, idle life, lips, and what the animator makes of them."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.core.signals import Expression, Gaze, Phoneme, Speech
from hri.face.animator import Animator
from hri.face.motion import idle
from hri.face.motion.blinking import blink_closure
from hri.face.motion.spring import ARRIVAL, Follower, Spring
from hri.face.regions import region_of
from tests.face.pixels import MODEL

RATE = 16000
TICK = 1 / 30


def spoken(*names: str, each: float = 0.09) -> Speech:
    """A speech of phonemes that last equally long."""
    phonemes = tuple(Phoneme(name, n * each, each) for n, name in enumerate(names))
    return Speech("", np.zeros(round(len(names) * each * RATE), np.int16), RATE, phonemes)


@given(st.lists(st.floats(0.001, 0.5), min_size=1, max_size=20), st.floats(1, 80))
def test_a_follower_ends_in_the_same_place_whatever_the_steps(steps: list[float], w: float) -> None:
    fine, coarse = Follower(0.0), Follower(0.0)
    for step in steps:
        value = float(fine.follow(1.0, step, w))
    assert value == pytest.approx(float(coarse.follow(1.0, sum(steps), w)), abs=1e-9)


GOALS = st.tuples(st.floats(-1, 1), st.floats(0.5, 80), st.integers(1, 40))


@given(st.lists(GOALS, min_size=1, max_size=10), st.floats(1e-4, 0.1))
def test_a_follower_never_leaves_what_was_asked_for(
    goals: list[tuple[float, float, int]], dt: float
) -> None:
    follower, asked = Follower(0.0), [0.0]
    for goal, stiffness, steps in goals:
        asked.append(goal)
        for _ in range(steps):
            value = float(follower.follow(goal, dt, stiffness))
            assert min(asked) - 1e-12 <= value <= max(asked) + 1e-12


@given(st.lists(GOALS, min_size=2, max_size=10))
def test_neither_a_follower_nor_its_speed_ever_jumps(goals: list[tuple[float, float, int]]) -> None:
    dt, fastest = 2e-4, 80.0
    follower, path = Follower(0.0), [0.0]
    for goal, stiffness, steps in goals:
        path += [float(follower.follow(goal, dt, stiffness)) for _ in range(steps)]
    # From goal to goal at most 2 apart: no force beyond that of the stiffest spring.
    assert np.abs(np.diff(path, 2)).max(initial=0) < 4 * fastest**2 * dt**2


def test_a_follower_arrives_in_the_time_of_its_stiffness() -> None:
    follower = Follower(0.0)
    assert float(follower.follow(1.0, 0.35, ARRIVAL / 0.35)) == pytest.approx(0.9, abs=0.01)


@given(st.floats(6, 80), st.floats(0.01, 0.3), st.floats(-1, 1))
@settings(max_examples=30)
def test_a_spring_stays_on_a_moving_goal_and_glides_when_it_leaps(
    w: float, cut: float, to: float
) -> None:
    spring, dt = Spring(1, w), 1e-3
    path = [spring.follow(np.sin([9 * n * dt]), dt)[0] for n in range(round(cut / dt))]
    assert path == pytest.approx([np.sin(9 * n * dt) for n in range(len(path))])
    path += [spring.follow(np.array([to]), dt, leaps=n == 0)[0] for n in range(800)]
    assert np.abs(np.diff(path, 2)).max() < 4 * max(w, 9) ** 2 * dt**2 + 9 * w * dt * dt
    assert path[-1] == pytest.approx(to, abs=0.2)


@given(st.integers(0, 5), st.floats(0, 1000), st.sampled_from(sorted(idle.STATES)))
def test_idle_life_is_a_smooth_function_of_time(seed: int, t: float, state: str) -> None:
    dt = 1e-3
    blink, life = MODEL.settings.blink, MODEL.settings.idle
    lids = [blink_closure(blink, seed, time, blink.rate) for time in (t, t + dt)]
    assert np.abs(np.subtract(*lids)).max() < 0.05
    now, then = (idle.wandering(life, seed, time, state) for time in (t, t + dt))
    assert abs(now.x - then.x) < 0.05
    assert abs(now.y - then.y) < 0.05
    assert idle.sway(life, seed, t, state) == idle.sway(life, seed, t, state)
    assert idle.sway(life, seed, t, state) == pytest.approx(
        idle.sway(life, seed, t + dt, state), abs=2e-3
    )


@pytest.mark.parametrize(
    ("state", "least", "most"),
    [("resting", 13, 22), ("talking", 19, 33), ("attending", 3, 8), ("asleep", 0, 0)],
)
def test_the_eyes_blink_as_often_as_what_they_do_asks_for(
    state: str, least: float, most: float
) -> None:
    blink, life = MODEL.settings.blink, idle.STATES[state]
    closures = np.array(
        [max(blink_closure(blink, 1, t, blink.rate * life.blinks)) for t in np.arange(0, 600, 0.04)]
    )
    blinks = np.count_nonzero(np.diff((closures > 0.3).astype(int)) == 1) / 10
    assert least <= blinks <= most


def test_eyes_turn_away_oftener_and_longer_in_talk_than_in_listening() -> None:
    """Eyes Alive: a listener looks at the speaker most of the time."""
    life = MODEL.settings.idle

    def share_away(state: str) -> float:
        looks = [idle.wandering(life, 2, t, state) for t in np.arange(0, 400, 0.1)]
        return float(np.mean([abs(look.x) + abs(look.y) > 0.09 for look in looks]))

    assert share_away("asleep") == 0
    assert share_away("listening") < share_away("resting") < share_away("talking")
    assert share_away("listening") < 0.06
    assert share_away("talking") > 0.1


def test_who_sleeps_breathes_slower_and_deeper() -> None:
    def breaths(state: str) -> tuple[int, float]:
        life = idle.STATES[state]
        air = [idle.breathing(MODEL.settings.idle, 1, t, life) for t in np.arange(0, 120, 0.05)]
        return int(np.count_nonzero(np.diff(np.sign(air)) > 0)), max(air)

    (awake, shallow), (asleep, deep) = breaths("resting"), breaths("asleep")
    assert 12 <= awake / 2 <= 16
    assert asleep < 0.7 * awake
    assert deep > 1.5 * shallow


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


def test_a_smile_leaves_rounded_lips_round() -> None:
    corners = {}
    for sound in ("m", "u:"):
        animator = Animator(MODEL)
        animator.express(Expression("happy"))
        list(animate(animator, 2.0))
        animator.speak(spoken(sound, each=0.6))
        *_, last = animate(animator, 0.4, 2.0, 0.0)
        corners[sound] = MODEL.weights(last)["mouthSmileLeft"]
    assert 0 < corners["u:"] < 0.4 * corners["m"]


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


def test_an_expression_arrives_in_its_time_and_stays() -> None:
    animator = Animator(MODEL)
    animator.express(Expression("sad"))
    *_, soon = animate(animator, MODEL.settings.timing["sad"].onset_s + 0.1)
    assert MODEL.weights(soon)["mouthFrownLeft"] > 0.9 * MODEL.expressions["sad"]["mouthFrown"]
    *_, later = animate(animator, 8.0, 1.0)
    assert MODEL.weights(later)["mouthFrownLeft"] > 0.98 * MODEL.expressions["sad"]["mouthFrown"]


def test_arousal_widens_the_pupils() -> None:
    excited, calm = Animator(MODEL), Animator(MODEL)
    excited.feel(1.0)
    *_, wide = animate(excited, 4.0)
    *_, rest = animate(calm, 4.0)
    assert MODEL.weights(wide)["pupilWide"] > MODEL.weights(rest).get("pupilWide", 0.0) + 0.4


SHOWN = ("happy", "sad", "angry", "surprised", "asleep", "neutral")
ASKED = st.tuples(
    st.sampled_from(SHOWN), st.floats(0, 1), st.floats(-1, 1), st.integers(10, 150),
    st.sampled_from(["", *idle.STATES]),
)  # fmt: skip


@given(st.lists(ASKED, min_size=2, max_size=5))
@settings(max_examples=10, deadline=None)
def test_whatever_is_asked_for_no_speed_jumps(
    asked: list[tuple[str, float, float, int, str]],
) -> None:
    """C1: steps of a millisecond bend the path of brows, cheeks and corners a little at most."""
    animator, now, path, step = Animator(MODEL, seed=2), 0.0, [], 1e-3
    for label, intensity, mood, steps, state in asked:
        animator.express(Expression(label, intensity, None if mood > 0 else -mood))
        animator.feel(mood, intensity)
        animator.be(state)
        for _ in range(steps):
            now += step
            path.append(animator.vector(now, step))
    calm = [
        number
        for number, channel in enumerate(MODEL.channels)
        if region_of(channel) in ("brows", "corners", "cheeks", "mouth", "other")
        # A blink takes these to where it wants them, as fast as a blink is.
        and not channel.startswith(("browDown", "cheekSquint"))
    ]
    bends = np.diff(np.array(path)[:, calm], 2, axis=0)
    assert np.abs(bends).max(initial=0) < 2e-3


def test_an_expression_with_a_duration_rises_holds_and_falls_back_to_the_mood() -> None:
    timing = MODEL.settings.timing["happy"]
    smile = MODEL.channels.index("mouthSmileLeft")
    full = MODEL.vector(MODEL.expressions["happy"])[smile]
    animator = Animator(MODEL)
    animator.express(Expression("happy", duration=1.5))
    path = np.array([vector[smile] for vector in animate(animator, 4.0)]) / full
    at = {name: round(seconds / TICK) for name, seconds in (
        ("onset", timing.onset_s), ("end", 1.4), ("gone", 1.5 + 1.3 * timing.offset_s),
    )}  # fmt: skip
    assert 0.75 < path[at["onset"]] < 0.98
    assert path[at["end"]] > 0.98
    assert path[at["gone"]] < 0.12
    assert path[-1] < 0.02


def test_an_expression_of_no_seconds_lasts_as_long_as_the_face_holds_it() -> None:
    timing = MODEL.settings.timing["sad"]
    animator = Animator(MODEL)
    animator.express(Expression("sad", duration=0.0))
    frown = MODEL.channels.index("mouthFrownLeft")
    path = [vector[frown] for vector in animate(animator, timing.onset_s + timing.apex_s + 2)]
    held = np.count_nonzero(np.array(path) > 0.5 * max(path)) * TICK
    assert held == pytest.approx(timing.onset_s + timing.apex_s, abs=0.5)


def test_a_mood_shows_weakly_wherever_no_expression_does() -> None:
    smile, frown = (MODEL.channels.index(f"mouth{what}Left") for what in ("Smile", "Frown"))
    animator = Animator(MODEL)
    animator.feel(*reversed(MODEL.settings.affect["happy"]))
    *_, moody = animate(animator, 4.0)
    full = MODEL.vector(MODEL.expressions["happy"])[smile]
    assert 0.3 * full < moody[smile] < 0.8 * full
    animator.express(Expression("sad"))
    *_, sad = animate(animator, 3.0, 4.0)
    assert sad[smile] < 0.02
    assert sad[frown] > 0.8
    animator.express(None)
    *_, again = animate(animator, 4.0, 7.0)
    assert again[smile] == pytest.approx(moody[smile], abs=0.02)


@pytest.mark.parametrize("label", ["scared", "sad", "angry", "guilty", "rejected"])
def test_a_feeling_is_not_contradicted_by_a_mood_or_a_gesture(label: str) -> None:
    """A faint fear in high spirits does not smile, nor does it while it nods or winks."""
    smile, frown = (MODEL.channels.index(f"mouth{what}Left") for what in ("Smile", "Frown"))
    own = MODEL.vector(MODEL.expressions[label])[smile]
    animator = Animator(MODEL)
    animator.feel(*reversed(MODEL.settings.affect["happy"]))
    animate(animator, 3.0)
    animator.express(Expression(label, 0.3))
    *_, afraid = animate(animator, 3.0, 3.0)
    assert afraid[smile] <= 0.3 * own + 0.03
    animator.gesture("wink")
    winking = animate(animator, 1.0, 6.0)
    assert max(vector[smile] for vector in winking) <= 0.3 * own + 0.03
    animator.express(Expression("happy", 0.3))
    *_, glad = animate(animator, 3.0, 7.0)
    assert glad[smile] > 0.3
    animator.feel(*reversed(MODEL.settings.affect["sad"]))
    *_, both = animate(animator, 3.0, 10.0)
    assert both[frown] < 0.03


def test_an_override_wins_everywhere_it_names_and_nowhere_else() -> None:
    animator, plain = Animator(MODEL, 8), Animator(MODEL, 8)
    for each in (animator, plain):
        each.express(Expression("happy"))
        each.speak(spoken(*["a"] * 30))
    animator.override({"jawOpen": 0.0, "browDown": 0.7})
    *_, one = animate(animator, 1.2, 0.0, 0.0)
    *_, other = animate(plain, 1.2, 0.0, 0.0)
    named = MODEL.vector({"jawOpen": 1.0, "browDown": 1.0}) != 0
    wanted = MODEL.vector({"browDown": 0.7})
    assert one[named] == pytest.approx(wanted[named], abs=1e-3)
    assert one[~named] == pytest.approx(other[~named], abs=1e-6)
    animator.override({})
    *_, free = animate(animator, 0.6, 1.2, 1.2)
    assert MODEL.weights(free)["jawOpen"] > 0.5


def test_states_have_a_look_and_a_life_of_their_own() -> None:
    looks = {}
    for state in ("resting", "listening", "thinking", "asleep"):
        animator = Animator(MODEL, 3)
        animator.be(state)
        *_, looks[state] = animate(animator, 3.0)
    for one in looks:
        for other in looks:
            assert one == other or np.abs(looks[one] - looks[other]).max() > 0.2, (one, other)
    animator = Animator(MODEL, 3)
    animator.express(Expression("surprised"))
    animator.be("asleep")
    *_, sleeping = animate(animator, 3.0)
    # Who sleeps is not surprised.
    assert MODEL.weights(sleeping)["eyeBlinkLeft"] > 0.9
    assert MODEL.weights(sleeping).get("eyeWideLeft", 0.0) < 0.05
    with pytest.raises(HriError, match=r'no state "asleap" - did you mean "asleep"'):
        Animator(MODEL).be("asleap")


def test_who_is_asleep_neither_blinks_nor_looks_around() -> None:
    animator = Animator(MODEL, 3)
    animator.express(Expression("asleep"))
    path = np.array(list(animate(animator, 12.0)))[60:]
    lids = [n for n, channel in enumerate(MODEL.channels) if channel.startswith("eyeBlink")]
    eyes = [n for n, channel in enumerate(MODEL.channels) if channel.startswith("eyeLook")]
    assert np.ptp(path[:, lids]) < 0.02
    assert np.ptp(path[:, eyes], axis=0).max() < 0.02


def test_stressed_syllables_lift_the_brows() -> None:
    brow = MODEL.channels.index("browOuterUpLeft")
    highest = {}
    for stressed in (False, True):
        phonemes = tuple(Phoneme("a", 0.2 * n, 0.2, stressed and n == 2) for n in range(6))
        animator = Animator(MODEL, 1)
        animator.speak(Speech("", np.zeros(round(1.2 * RATE), np.int16), RATE, phonemes))
        highest[stressed] = max(v[brow] for v in animate(animator, 1.0, 0.0, 0.0))
    assert highest[True] > highest[False] + 0.2


def test_lips_that_are_late_are_dropped() -> None:
    """Sound that jumps ahead takes the lips with it: nothing of what was between is shown."""
    shown = Animator(MODEL)
    shown.speak(spoken(*["a"] * 5, *["u:"] * 10, *["m"] * 10))
    list(animate(shown, 0.3, 0.0, 0.0))
    path = np.array(list(animate(shown, 0.3, 0.3, 1.6)))
    pucker, press = (MODEL.channels.index(name) for name in ("mouthPucker", "mouthPressLeft"))
    assert path[:, pucker].max() < 0.1
    assert path[-1, press] > 0.8


def test_two_faces_with_one_seed_move_alike() -> None:
    paths = []
    for _ in range(2):
        animator = Animator(MODEL, 12)
        animator.express(Expression("excited" if "excited" in MODEL.expressions else "happy"))
        animator.look(Gaze(point=(0.8, 0.3, 0.1)))
        paths.append(np.array(list(animate(animator, 2.0))))
    assert np.array_equal(*paths)


@pytest.mark.parametrize(
    ("ask", "error"),
    [
        (lambda face: face.express(Expression("hapy")), "did you mean"),
        (lambda face: face.express(Expression("happy", float("nan"))), "the intensity is nan"),
        (lambda face: face.express(Expression("happy", 1.0, -1.0)), "an expression for -1.0 s"),
        (lambda face: face.express(Expression("sad", valence=float("nan"))), "the valence is nan"),
        (lambda face: face.feel(float("nan")), "the arousal is nan"),
        (lambda face: face.feel(0.1, float("inf")), "the valence is inf"),
        (lambda face: face.override({"trunkUp": 1.0}), 'no target "trunkUp"'),
        (lambda face: face.override({"jawOpen": float("nan")}), "the weight of jawOpen is nan"),
    ],
)
def test_what_cannot_be_shown_leaves_the_face_as_it_was(ask, error) -> None:  # type: ignore[no-untyped-def]
    animator, plain = Animator(MODEL, 1), Animator(MODEL, 1)
    with pytest.raises(HriError, match=error):
        ask(animator)
    for one, other in zip(animate(animator, 0.5), animate(plain, 0.5), strict=True):
        assert np.array_equal(one, other)


def test_a_speech_that_grows_moves_the_lips_as_the_whole_does() -> None:
    first = Speech("a b", np.zeros(0, np.int16), RATE).then(spoken(*["a", "m"] * 4), 0)
    whole = first.then(spoken(*["u:", "m"] * 4), 2)
    assert whole.continues(first)
    assert not whole.continues(Speech("a b", whole.samples, RATE, whole.phonemes))
    at_once, growing = Animator(MODEL, seed=3), Animator(MODEL, seed=3)
    is_mouth = np.array([region_of(channel) == "mouth" for channel in MODEL.channels])
    for tick in range(36):
        now = tick * TICK
        at_once.speak(whole)
        growing.speak(first if now < 0.4 else whole)
        frames = [animator.vector(now, TICK, now)[is_mouth] for animator in (at_once, growing)]
        assert np.allclose(*frames, atol=1e-3), now
