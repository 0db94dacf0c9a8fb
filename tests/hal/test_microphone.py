"""All who listen to a microphone hear all of it."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.hal.drivers.memory import MemoryMicrophone
from hri.hal.drivers.resampling import GrowingSound, resample, resample_blocks
from hri.hal.microphone import LONGEST_BACKLOG
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

from .sounds import similarity, tone


def open_microphone(clock, rate=16000):
    description = Description("m", "Hri.MemoryMicrophone", {"rate": str(rate)})
    microphone = MemoryMicrophone(description, ResourceManager((), clock))
    microphone.activate()
    return microphone


@given(st.lists(st.sampled_from([0, 1]), min_size=1, max_size=30))
def test_two_ears_hear_the_same_in_whatever_order_they_listen(turns):
    clock = FakeClock()
    microphone = open_microphone(clock)
    microphone.hear(tone(16000, 5.0))
    ears = [microphone.listen(), microphone.listen()]
    heard = [[], []]
    for turn in [*turns, 0, 1]:
        clock.advance(0.03)
        heard[turn].append(ears[turn].read(clock.now()))
    heard[0].append(ears[0].read(clock.now()))
    assert np.array_equal(np.concatenate(heard[0]), np.concatenate(heard[1]))


def test_an_ear_that_was_closed_takes_nothing_from_the_others():
    clock = FakeClock()
    microphone = open_microphone(clock)
    first, second = microphone.listen(), microphone.listen()
    first.close()
    first.close()
    microphone.hear(tone(16000, 0.1))
    clock.advance(0.1)
    assert len(second.read(clock.now())) == 1600


def test_an_ear_that_does_not_listen_keeps_the_newest_seconds():
    clock = FakeClock()
    microphone = open_microphone(clock)
    forgotten, listening = microphone.listen(), microphone.listen()
    for _ in range(200):
        clock.advance(0.1)
        listening.read(clock.now())
    assert len(forgotten.read(clock.now())) == pytest.approx(LONGEST_BACKLOG * 16000, abs=1600)


@pytest.mark.parametrize("rate", [8000, 22050, 44100, 48000])
def test_a_microphone_of_another_rate_is_heard_at_the_rate_asked_for(rate):
    clock = FakeClock()
    microphone = open_microphone(clock, rate)
    ear = microphone.listen(16000)
    microphone.hear(tone(rate, 2.0))
    blocks = []
    for _ in range(200):
        clock.advance(0.01)
        blocks.append(ear.read(clock.now()))
    heard = np.concatenate(blocks)
    assert abs(len(heard) - 32000) < 500
    assert similarity(heard, tone(16000, 2.0)) > 0.999


@given(st.sampled_from([8000, 16000, 44100]), st.integers(1, 5000))
def test_resampling_in_blocks_loses_nothing(rate, size):
    sound = tone(rate, 0.5)
    blocks = (sound[i : i + size] for i in range(0, len(sound), size))
    converted = np.concatenate(list(resample_blocks(blocks, rate, 16000)))
    assert abs(len(converted) - 8000) <= 1
    assert similarity(converted, tone(16000, 0.5)) > 0.999


@given(
    st.sampled_from([(22050, 48000), (24000, 22050), (8000, 44100), (48000, 16000), (1000, 37801)]),
    st.lists(st.integers(1, 6000), min_size=1, max_size=12),
)
def test_a_growing_sound_is_what_it_would_be_as_a_whole(rates, sizes):
    rate, wanted = rates
    whole = np.random.default_rng(1).normal(scale=3000, size=sum(sizes)).astype(np.int16)
    parts = np.split(whole, np.cumsum(sizes)[:-1])
    sound = GrowingSound(parts[0], rate, wanted)
    for part in parts[1:]:
        sound.extend(part)
    expected = resample(whole, rate, wanted)
    assert len(sound.samples) == len(expected)
    # Each conversion rounds by chance, by up to two steps.
    assert np.abs(sound.samples.astype(int) - expected).max(initial=0) <= 5
    assert sound.seconds == pytest.approx(len(whole) / rate)
