import pytest

from hri.bench import emotion
from hri.bench.emotion import STIMULI, lived, rates
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import whole
from hri.emotion.personality import Personality


def test_the_robot_that_is_measured_feels_six_emotions_from_three_causes() -> None:
    model = Dynamics(Personality("bench"), STIMULI)
    affect = lived(model)
    assert len(whole(affect.outlook.charges)) == 6
    names = {origin.name for origin in model.ledger(affect)}
    assert {"praise", "scold", "petted", "drive.company", "drive.energy"} < names


def test_the_rate_makes_no_difference_but_to_the_peer(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(emotion, "SECONDS", 30)
    monkeypatch.setattr(emotion, "RATES_HZ", (10, 100))
    figures = rates()
    assert figures["largest_difference"] < 1e-9
    assert figures["wasabi_peak_mood"]["10_hz"] == pytest.approx(11.9, abs=0.1)
    assert figures["wasabi_50_hz_over_10_hz"] > 4.5
