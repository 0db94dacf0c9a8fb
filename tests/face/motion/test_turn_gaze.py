"""Who speaks looks away as a longer turn begins, and at the listener at its end."""

import numpy as np
import pytest

from hri.core.signals import Phoneme, Speech
from hri.face.animator import Animator
from hri.face.motion.turn_gaze import AWAY, BACK, LONGER, TurnGaze
from tests.face.pixels import MODEL

RATE = 16000
STEP = 0.02


def speech(text: str, seconds: float) -> Speech:
    sounds = (Phoneme("a", 0.1, 0.1),)
    return Speech(text, np.zeros(round(seconds * RATE), np.int16), RATE, sounds)


def looks(said: Speech, seed: int = 0) -> dict[float, tuple[float, float, float]]:
    """By the time: how far it looks away to the side and up, and how much it stays."""
    turn, found = TurnGaze(1.0, seed), {}
    for number in range(round(said.duration / STEP)):
        look = turn.follow(said, number * STEP, STEP)
        found[round(number * STEP, 2)] = (look.away.x, look.away.y, look.kept)
    return found


def test_a_longer_turn_begins_with_a_look_away_and_a_short_one_does_not() -> None:
    long, short = looks(speech("x" * LONGER, 5.0)), looks(speech("Yes.", 5.0))
    assert long[0.0] == pytest.approx((0, 0, 0))
    x, y, _ = long[0.5]
    assert (abs(x), y) == pytest.approx(AWAY, abs=0.02)
    assert long[1.2][:2] == pytest.approx((0, 0), abs=0.02)
    assert all(x == y == 0 for x, y, _ in short.values())


def test_the_side_is_drawn_from_seed_and_text() -> None:
    sides = {looks(speech(f"{n} xyz" * LONGER, 1.0))[0.5][0] > 0 for n in range(12)}
    assert sides == {False, True}
    again = [looks(speech("y" * LONGER, 1.0), seed=3) for _ in range(2)]
    assert again[0] == again[1]


def test_the_eyes_are_back_before_the_end() -> None:
    found = looks(speech("Hello.", 3.0))
    assert found[2.0][2] == 0
    assert found[3.0 - BACK / 2][2] > 0.9


def test_a_face_does_not_look_away_as_it_ends() -> None:
    """Over many seeds, with the glances of talk."""
    late, early = [], []
    for seed in range(12):
        animator, said = Animator(MODEL, seed), speech("Hello.", 4.0)
        animator.speak(said)
        for number in range(round(4.0 / STEP)):
            weights = animator.step(10 + seed + number * STEP, STEP, number * STEP).values
            looked = max((w for n, w in weights.items() if n.startswith("eyeLook")), default=0)
            (late if number * STEP > 3.7 else early).append(looked)
    assert max(late) < 0.1
    assert max(early) > 0.2
