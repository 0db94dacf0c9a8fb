from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from hri.speech.path_confidence import PathFigures, confidence


def test_a_clear_command_is_trusted_and_a_poor_one_is_not():
    assert confidence(PathFigures(score=0.76, word_frames=164, frames=201)) > 0.6
    assert confidence(PathFigures(score=0.4, word_frames=100, frames=120)) < 0.5


def test_foreign_speech_behind_a_short_command_costs_trust():
    assert confidence(PathFigures(score=0.69, word_frames=85, frames=110)) > 0.5
    assert confidence(PathFigures(score=0.69, word_frames=85, frames=474)) < 0.01


@given(st.floats(), st.integers(-5, 2000), st.integers(0, 2000))
def test_it_stays_between_nothing_and_certain(score, word_frames, frames):
    assert 0.0 <= confidence(PathFigures(score, word_frames, frames)) <= 1.0


def test_nothing_is_worth_nothing():
    assert confidence(PathFigures(0.0, 0, 100)) == 0.0
    assert confidence(PathFigures(1.0, 100, 100)) == pytest.approx(1.0)
