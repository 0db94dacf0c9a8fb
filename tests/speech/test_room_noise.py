from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.speech.room_noise import RoomListener, room_noise

RATE = 16000
TIME = np.arange(3 * RATE) / RATE


def sound(wave, level):
    wave = wave / np.sqrt(np.mean(wave**2))
    return np.clip(wave * 32768 * 10 ** (level / 20), -32768, 32767).astype(np.int16)


def hiss():
    return np.random.default_rng(1).normal(size=len(TIME))


def music():
    return np.sin(2 * np.pi * 440 * TIME) * (np.sin(2 * np.pi * 2 * TIME) > 0)


@pytest.mark.parametrize(
    ("wave", "level", "kind"),
    [
        (hiss(), -60.0, "quiet"),
        (hiss(), -35.0, "hiss"),
        (np.sin(2 * np.pi * 100 * TIME), -30.0, "hum"),
        (music(), -35.0, "unsteady"),
    ],
)
def test_a_noise_has_a_kind_and_what_disturbs_has_a_remedy(wave, level, kind):
    found = room_noise(sound(wave, level), RATE)
    assert found.kind == kind
    assert found.level == pytest.approx(level, abs=0.5)
    assert bool(found.advice) == (kind != "quiet")


@given(st.integers(0, 3000), st.integers(0, 32767))
def test_any_sound_has_a_noise(count, loudness):
    chance = np.random.default_rng(count)
    samples = chance.integers(-loudness, loudness + 1, count).astype(np.int16)
    assert -120.0 <= room_noise(samples, RATE).level <= 0.1


def test_a_stream_is_judged_every_two_seconds():
    listener = RoomListener(RATE)
    found = []
    for part in np.array_split(sound(hiss(), -35.0), 30):
        listener.hear(part)
        found.append(listener.noise)
    assert found[18] is None
    assert found[20] is found[29]
    assert found[20].kind == "hiss"
