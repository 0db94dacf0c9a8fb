from __future__ import annotations

from hri.speech.recognizers.ctc.confidence import Fit, confidence


def test_in_quiet_a_sentence_may_be_said_at_any_pace():
    slow, fast = (Fit(-1.0, -0.5, 2.5, pace) for pace in (6.0, 2.0))
    assert confidence(slow) == confidence(fast)


def test_the_better_a_sentence_fits_the_more_it_is_trusted_in_quiet_and_in_noise():
    better, worse = (Fit(margin, -0.5, 2.5, 4.0) for margin in (0.0, -3.0))
    for noise in (0.0, 0.5, 1.0):
        assert confidence(better, noise) > confidence(worse, noise)
