from itertools import pairwise

import numpy as np
from hypothesis import given, settings, strategies as st

from hri.core.signals import Samples
from hri.simulation.acoustics import RATE, Sound


def tone(frequency: float, seconds: float, rate: int) -> Samples:
    times = np.arange(int(seconds * rate)) / rate
    return (8000 * np.sin(2 * np.pi * frequency * times)).astype(np.int16)


def test_a_voice_is_heard_at_its_time_at_its_pitch_and_loudness() -> None:
    sound = Sound()
    sound.add(tone(1000, 0.5, 22050), 22050, at=1.0, gain=0.5)
    heard = sound.between(0, 2 * RATE).astype(float)
    loud = np.flatnonzero(np.abs(heard) > 400)
    assert abs(loud[0] - RATE) < 32
    assert abs(loud[-1] - 1.5 * RATE) < 32
    middle = heard[int(1.1 * RATE) : int(1.4 * RATE)]
    assert np.argmax(np.abs(np.fft.rfft(middle))) * RATE / len(middle) == 1000
    assert abs(np.abs(middle).max() - 4000) < 60


def test_two_voices_add_and_are_cut_at_full_scale() -> None:
    sound = Sound()
    for _ in range(9):
        sound.add(tone(500, 0.2, RATE), RATE, at=0.0)
    heard = sound.between(0, RATE // 5)
    assert heard.max() == 32767
    assert heard.min() == -32767


def test_noise_has_its_level_and_repeats_by_its_seed() -> None:
    heard = Sound(seed=1, noise_db=-60).between(0, 4 * RATE)
    assert abs(20 * np.log10(heard.std() / 32767) + 60) < 0.5
    assert np.array_equal(heard, Sound(seed=1, noise_db=-60).between(0, 4 * RATE))
    assert not np.array_equal(heard, Sound(seed=2, noise_db=-60).between(0, 4 * RATE))


@settings(max_examples=25, deadline=None)
@given(st.lists(st.integers(0, 9000), max_size=20))
def test_how_it_is_sliced_does_not_matter(lengths: list[int]) -> None:
    sound = Sound(seed=5, noise_db=-50)
    sound.add(tone(300, 0.4, 22050), 22050, at=0.3)
    ends = np.minimum(np.cumsum([0, *lengths, 40000]), 40000)
    slices = [sound.between(int(a), int(b)) for a, b in pairwise(ends)]
    assert np.array_equal(np.concatenate(slices), sound.between(0, 40000))


def test_no_time_holds_no_sound() -> None:
    assert len(Sound().between(5, 5)) == 0
    assert len(Sound().between(5, 3)) == 0


def test_a_sound_that_is_cut_ends_there_and_what_was_heard_stays() -> None:
    sound = Sound()
    source = sound.add(np.full(RATE, 1000, np.int16), RATE, at=1.0)
    before = sound.between(RATE, RATE + 4000)
    sound.cut(source, 1.5)
    sound.cut(source, 1.2)

    assert np.array_equal(sound.between(RATE, RATE + 4000), before)
    assert not sound.between(RATE + RATE // 2, 2 * RATE).any()
