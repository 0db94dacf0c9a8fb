from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.speech.recognizers.ctc.conformer import FARTHEST, load_network
from hri.speech.recognizers.ctc.posterior_stream import AHEAD, CHUNK, PosteriorStream


@pytest.fixture(scope="module")
def network():
    return load_network()


def noise(count):
    return np.random.default_rng(1).normal(0, 3000, count).astype(np.int16)


def streamed(stream, sound, cuts):
    pieces = np.split(sound, sorted(cuts))
    return np.concatenate([*(stream.push(piece) for piece in pieces), stream.finish()])


@settings(max_examples=15, deadline=None)
@given(count=st.integers(0, 40_000), cuts=st.lists(st.integers(0, 40_000), max_size=6))
def test_it_matters_little_how_the_sound_is_cut(network, count, cuts):
    sound = noise(count)
    whole = streamed(PosteriorStream(network), sound, [])
    assert len(whole) == len(network.posteriors(sound))
    assert streamed(PosteriorStream(network), sound, cuts) == pytest.approx(whole, abs=1e-3)


def test_one_chunk_of_everything_is_the_network_itself(network):
    sound = noise(20_000)
    frames = streamed(PosteriorStream(network, chunk=1000), sound, [5000])
    assert frames == pytest.approx(network.posteriors(sound), abs=1e-3)


def test_frames_come_while_the_sound_does(network):
    stream = PosteriorStream(network)
    needed = 320 * (CHUNK + AHEAD) + 400
    assert len(stream.push(noise(needed // 2))) == 0
    assert len(stream.push(noise(needed))) >= CHUNK


def test_memory_is_bounded_however_long_it_goes_on(network):
    stream = PosteriorStream(network, chunk=400, ahead=0)
    for _ in range(4):
        stream.push(noise(400 * 320))
    assert all(past.keys.shape[1] <= FARTHEST for past in stream._past)
    assert len(stream._sound) < 2 * 400 * 320
