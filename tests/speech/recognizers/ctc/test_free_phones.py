from __future__ import annotations

import numpy as np
from hypothesis import given, settings, strategies as st

from hri.speech.pronunciation.phones import PHONES
from hri.speech.recognizers.ctc.classes import BLANK, CLASSES
from hri.speech.recognizers.ctc.free_phones import SHORTEST, free_phones


def clear(*phones, other=0.001):
    """[frames, classes] Each phone for a frame, with a blank before and after."""
    rows = np.full((2 * len(phones) + 1, len(CLASSES)), other)
    rows[0::2, BLANK] = 1.0
    rows[range(1, len(rows), 2), [CLASSES.index(phone) for phone in phones]] = 1.0
    return rows


def alone(rows):
    """Nothing stands before and behind."""
    frames = len(rows)
    silent = np.concatenate([[1.0], rows[:, BLANK].cumprod()])
    return rows, silent, np.eye(frames + 1)[frames]


def test_what_is_clearly_heard_comes_first():
    said = ("Z", "AO", "R", "V", "IH", "N")
    assert free_phones(*alone(clear(*said)), most=3)[0].phones == said


def test_a_phone_twice_needs_a_blank_between():
    rows = clear("AE", "D", "D", "AH")
    assert free_phones(*alone(rows), most=1)[0].phones == ("AE", "D", "D", "AH")
    rows[4] = rows[3]
    assert free_phones(*alone(rows), most=1)[0].phones == ("AE", "D", "AH")


def test_of_two_that_fit_alike_the_one_that_names_have_is_first():
    rows = clear("M", "AA", "R", "IY")
    rows[1, CLASSES.index("NG")] = 1.0
    assert free_phones(*alone(rows), most=1)[0].phones == ("M", "AA", "R", "IY")


@settings(deadline=None)
@given(st.integers(0, 2**32), st.integers(0, 12), st.integers(1, 5))
def test_any_sound_gives_phones_in_order(seed, frames, most):
    rows = np.random.default_rng(seed).dirichlet(np.full(len(CLASSES), 0.1), frames)
    rows = rows.reshape(frames, len(CLASSES))
    found = free_phones(*alone(rows), most=most)
    assert len(found) <= most
    assert [one.score for one in found] == sorted((one.score for one in found), reverse=True)
    assert all(len(one.phones) >= SHORTEST and set(one.phones) <= set(PHONES) for one in found)
