"""Recorders that were killed: their sizes were never written, their sound is there."""

import struct

import numpy as np
import pytest
import soundfile

from hri.hal.drivers.wav_file import load_sound
from tests.hal.sounds import tone

RATE = 16000
SOUND = tone(RATE, 1.0)
CHUNK = b"LIST" + struct.pack("<I", 10) + b"INFOabcdef"


def wav(subtype, tmp_path):
    """The bytes of a whole file, and where its data begin."""
    path = tmp_path / "whole.wav"
    soundfile.write(path, SOUND / 32768.0, RATE, subtype=subtype)
    whole = path.read_bytes()
    return whole, whole.index(b"data") + 8


def with_sizes(whole, start, riff, data):
    patched = bytearray(whole)
    patched[4:8] = struct.pack("<I", riff)
    patched[start - 4 : start] = struct.pack("<I", data)
    return bytes(patched)


def read(tmp_path, content):
    told = []
    path = tmp_path / "recording.wav"
    path.write_bytes(content)
    samples, rate = load_sound(path, tell=told.append)
    assert rate == RATE
    return samples, told


@pytest.mark.parametrize("subtype", ["PCM_16", "PCM_U8", "PCM_24", "FLOAT", "ULAW"])
@pytest.mark.parametrize(
    ("riff", "data"), [(0, 0), (36, 0), (0xFFFFFFFF, 0), (0x7FFFFFFF, 0), (4036, 4000), (0, 4000)]
)
def test_a_killed_recording_is_heard_to_its_end_and_told(tmp_path, subtype, riff, data):
    whole, start = wav(subtype, tmp_path)
    samples, told = read(tmp_path, with_sizes(whole, start, riff, data))
    assert len(samples) == len(SOUND)
    assert np.abs(samples.astype(int) - SOUND).max() < 600
    assert told == [
        f"{tmp_path}/recording.wav: its recorder ended before it wrote the length"
        " - it was read to its end"
    ]


def test_a_file_without_its_own_size_is_heard(tmp_path):
    whole, start = wav("PCM_16", tmp_path)
    samples, told = read(tmp_path, with_sizes(whole, start, 0, len(whole) - start))
    assert np.array_equal(samples, SOUND)
    assert told


@pytest.mark.parametrize("riff", ["right", "without what follows", "endless"])
def test_what_follows_the_sound_is_not_heard(tmp_path, riff):
    whole, start = wav("PCM_16", tmp_path)
    size = {"right": len(whole) + len(CHUNK) - 8, "endless": 0xFFFFFFFF}.get(riff, len(whole) - 8)
    samples, told = read(tmp_path, with_sizes(whole + CHUNK, start, size, len(whole) - start))
    assert np.array_equal(samples, SOUND)
    assert not told


@pytest.mark.parametrize("sizes", [(0xFFFFFFFF, 0xFFFFFFFF), (0x7FFFFFFF, 0x7FFFFFFF)])
def test_endless_sizes_of_a_stream_need_no_word(tmp_path, sizes):
    whole, start = wav("PCM_16", tmp_path)
    samples, told = read(tmp_path, with_sizes(whole, start, *sizes))
    assert np.array_equal(samples, SOUND)
    assert not told
