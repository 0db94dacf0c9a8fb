"""Sound through windows that overlap, to a microphone that is fed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st

from hri.core.errors import HriError
from hri.core.signals import SoundWindow
from hri.hal.drivers.fed_microphone import FedMicrophone
from hri.speech.sound_trail import WINDOW, SoundTrail

RATE = 16000
SOUND = np.random.default_rng(1).integers(-9000, 9000, 5 * RATE).astype(np.int16)


@settings(
    max_examples=50, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(st.lists(st.tuples(st.integers(0, 1600), st.booleans()), max_size=30))
def test_each_sample_is_heard_once_though_windows_are_missed(open_driver, pieces):
    """As long as no more is missed at a time than a window holds."""
    trail, microphone = SoundTrail(RATE), open_driver(FedMicrophone)
    said, missed, heard = 0, 0, []
    for size, is_missed in [*pieces, (0, False)]:
        window = trail.after(SOUND[said : said + size])
        said += size
        missed += size
        if is_missed and missed + 1600 <= WINDOW * RATE:
            continue
        microphone.feed(window)
        missed = 0
        heard.append(microphone.read(0.0))
    assert np.array_equal(np.concatenate(heard), SOUND[:said])


def test_what_was_missed_is_silence_and_who_begins_again_is_heard(open_driver):
    microphone = open_driver(FedMicrophone)
    for end in (3200, 8000, 3200):
        microphone.feed(SoundWindow(SOUND[:3200], RATE, end))
    heard = microphone.read(0.0)
    assert len(heard) == 3200 + 4800 + 3200
    assert not heard[3200:4800].any()
    assert np.array_equal(heard[4800:8000], SOUND[:3200])
    assert np.array_equal(heard[8000:], SOUND[:3200])


def test_an_endless_backlog_is_not_kept(open_driver):
    microphone = open_driver(FedMicrophone)
    for number in range(100):
        microphone.feed(SoundWindow(SOUND[:3200], RATE, 3200 * number))
    assert len(microphone.read(0.0)) == 10 * RATE


@pytest.mark.parametrize(
    "window",
    [
        SoundWindow(SOUND[:3200], 44100, 3200),
        SoundWindow(np.zeros((2, 2, 2), np.int16), RATE, 8),
        SoundWindow(SOUND[:3200].astype(np.float32), RATE, 3200),
    ],
)
def test_other_sound_is_refused(open_driver, window):
    with pytest.raises(HriError, match="hears int16 of 16000 Hz"):
        open_driver(FedMicrophone).feed(window)
