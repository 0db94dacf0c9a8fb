"""One channel of many, whatever way round they are wired."""

import numpy as np
import pytest
import soundfile
from hypothesis import given, strategies as st

from hri.hal.drivers.channels import OneChannel
from hri.hal.drivers.wav_file import load_sound
from tests.hal.sounds import similarity, tone

RATE = 16000
SOUND = tone(RATE, 1.0)


def mixed(frames, size=320, choice="mix"):
    channels = OneChannel(choice)
    blocks = (frames[at : at + size].astype(np.int16) for at in range(0, len(frames), size))
    return np.concatenate([channels.take(block) for block in blocks]), channels


@given(
    st.lists(st.sampled_from([-1.0, -0.8, -0.3, 0.0, 0.3, 0.8, 1.0]), min_size=2, max_size=6),
    st.sampled_from([100, 320, 16000]),
)
def test_a_sound_is_heard_whatever_the_signs_of_its_channels(gains, size):
    frames = SOUND[:, None] * np.array(gains)
    heard, channels = mixed(frames, size)
    mean = np.abs(gains).mean()
    assert np.abs(np.abs(heard) - np.abs(SOUND * mean)).max() <= 3
    signs = {np.sign(gain) for gain in gains} - {0.0}
    assert channels.is_any_inverted == (len(signs) == 2 and bool(mean))


def test_channels_with_noise_of_their_own_are_added_and_none_is_turned_round():
    noise = np.random.default_rng(0).normal(size=(len(SOUND), 2)) * 2000
    heard, channels = mixed(SOUND[:, None] + noise)
    assert not channels.is_any_inverted
    assert similarity(heard, SOUND) > similarity((SOUND + noise[:, 0]).astype(np.int16), SOUND)


def test_a_channel_that_is_inverted_no_more_is_turned_back():
    upright, inverted = np.stack([SOUND, SOUND], axis=1), np.stack([SOUND, -SOUND], axis=1)
    heard, channels = mixed(np.concatenate([inverted, upright, upright, upright, upright]))
    assert not channels.is_any_inverted
    assert np.abs(heard[-len(SOUND) :] - SOUND).max() <= 1


@pytest.mark.parametrize("name", ["inverted.wav", "inverted.flac", "float.wav"])
def test_a_file_with_an_inverted_side_is_heard_and_told(tmp_path, name):
    path = tmp_path / name
    subtype = "FLOAT" if name == "float.wav" else "PCM_16"
    soundfile.write(path, np.stack([SOUND, -SOUND], axis=1) / 32768.0, RATE, subtype=subtype)
    told = []
    samples, _ = load_sound(path, tell=told.append)
    assert np.abs(np.abs(samples) - np.abs(SOUND)).max() <= 1
    assert told == [
        f"{path}: a channel is the opposite of the other and was turned round"
        " - check the wires of the microphone"
    ]


@pytest.mark.parametrize("choice", ["left", "right", "loudest"])
def test_a_chosen_channel_is_as_it_is(choice):
    heard, channels = mixed(np.stack([SOUND, -SOUND], axis=1), choice=choice)
    assert np.array_equal(np.abs(heard), np.abs(SOUND))
    assert not channels.is_any_inverted
