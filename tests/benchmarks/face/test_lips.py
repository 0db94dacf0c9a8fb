import numpy as np
import pytest

from benchmarks.face.lips import CLOSURES, ROUNDINGS, lip_timing, lips_seen
from hri.core.signals import Phoneme, Speech
from hri.face import load_face
from hri.face.lips import spans

MODEL = load_face("robot")
NAMES = ("m", "a", "s", "u:", "f", "E", "k", "i:", "b", "O", "n", "a", "p", "I", "m", "oU")
PHONEMES = tuple(Phoneme(name, 0.11 * n, 0.11) for n, name in enumerate(NAMES))
SPEECH = Speech("", np.zeros(round(0.11 * len(NAMES) * 16000), np.int16), 16000, PHONEMES)


@pytest.mark.parametrize("rate", [30.0, 24.0])
def test_every_shape_is_there_while_its_sound_is_heard(rate: float) -> None:
    timing = lip_timing(MODEL, SPEECH, rate)
    assert len(timing.shapes) == len(NAMES) + 1, "oU has two"
    assert np.percentile(np.abs(timing.shapes), 95) <= 0.02
    assert abs(np.median(timing.changes)) < 0.02
    assert np.percentile(timing.changes, 95) < 0.03, "early rather than late"


@pytest.mark.parametrize("ahead", [0.05, -0.05])
def test_lips_that_are_off_are_found_out(ahead: float) -> None:
    timing = lip_timing(MODEL, SPEECH, ahead=ahead)
    assert np.median(timing.changes) == pytest.approx(-ahead, abs=0.01)
    assert np.percentile(np.abs(timing.shapes), 95) > 0.01


@pytest.mark.parametrize("rate", [30.0, 25.0])
def test_every_closure_and_rounding_of_slow_talk_is_seen(rate: float) -> None:
    seen = lips_seen(MODEL, SPEECH, rate, phase=0.5)
    assert seen == {CLOSURES: [True] * 5, ROUNDINGS: [True] * 4}


def test_lips_that_do_not_round_are_found_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sounds that the lips leave out count as well."""
    monkeypatch.setattr(spans, "SHORTEST_ROUNDING", 0.5)
    assert lips_seen(MODEL, SPEECH)[ROUNDINGS].count(False) >= 3
