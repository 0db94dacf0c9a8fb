from __future__ import annotations

import math
import os
import re
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.speech.pronunciation.lexicon import load_lexicon
from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.confidence import scores_of
from hri.speech.recognizers.ctc.conformer import Conformer, _gelu, block_count, load_network
from hri.speech.recognizers.ctc.features import WIDTH, log_mel, padded
from hri.speech.recognizers.ctc.likelihood import likelihoods
from hri.speech.recognizers.ctc.weights import find_weights, read_tensors
from hri.speech.recognizers.ctc.word_habits import Habits
from tests.recorded import spoken_by_a_person
from tests.speech.recognizers.speaking import spoken


@pytest.fixture(scope="module")
def network():
    return load_network()


@pytest.fixture(scope="module")
def tensors():
    return read_tensors(find_weights())


def noise(count, seed=0):
    return np.random.default_rng(seed).normal(0, 3000, count).astype(np.int16)


def straightforward(tensors, samples):
    """The network as its layers are written in papers, in double precision and without tricks."""
    weights = {name: tensor.astype(float) for name, tensor in tensors.items()}

    def normalized(h, name):
        centered = h - h.mean(1, keepdims=True)
        scaled = centered / np.sqrt((centered**2).mean(1, keepdims=True) + 1e-5)
        return scaled * weights[f"{name}.gain"] + weights[f"{name}.shift"]

    def product(h, name):
        return h @ weights[f"{name}.matrix"] + weights[f"{name}.bias"]

    def sigmoid(x):
        return 1 / (1 + np.exp(-x))

    def feed_forward(h, name):
        inner = product(normalized(h, f"{name}.norm"), f"{name}.out")
        return 0.5 * product(inner * sigmoid(inner), f"{name}.back")

    def attention(h, name):
        three = product(normalized(h, f"{name}.norm"), f"{name}.inward")
        q, k, v = np.split(three, 3, axis=1)
        heads = []
        for head in range(4):
            part = slice(36 * head, 36 * head + 36)
            likeness = np.exp(q[:, part] @ k[:, part].T / 6)
            heads.append(likeness / likeness.sum(1, keepdims=True) @ v[:, part])
        return product(np.concatenate(heads, 1), f"{name}.outward")

    def convolution(h, name):
        both = product(normalized(h, f"{name}.norm"), f"{name}.inward")
        gated = np.pad(both[:, :144] * sigmoid(both[:, 144:]), ((15, 15), (0, 0)))
        taps = weights[f"{name}.taps.matrix"]
        c = sum(gated[t : t + len(h)] * taps[:, t] for t in range(31))
        c = c + weights[f"{name}.taps.bias"]
        return product(c * sigmoid(c), f"{name}.outward")

    mel = np.pad(log_mel(padded(samples), tensors["filters"]).astype(float), ((1, 1), (0, 0)))
    count = (len(mel) - 3) // 2 + 1
    windows = np.stack([mel[2 * i : 2 * i + 3].ravel() for i in range(count)])
    h = product(windows, "stem")
    h *= 0.5 * (1 + np.vectorize(math.erf)(h / math.sqrt(2)))
    for block in range(block_count(tensors)):
        h = h + feed_forward(h, f"{block}.first")
        h = h + attention(h, f"{block}.attention")
        h = h + convolution(h, f"{block}.convolution")
        h = h + feed_forward(h, f"{block}.second")
        h = normalized(h, f"{block}.norm")
    scores = np.exp(product(h, "head"))
    return scores / scores.sum(1, keepdims=True)


def test_it_computes_the_network_as_papers_write_it(network, tensors):
    sound = noise(16000)
    expected = straightforward(tensors, sound)
    assert np.exp(network.posteriors(sound)) == pytest.approx(expected, abs=1e-4)


@settings(max_examples=20, deadline=None)
@given(count=st.integers(0, 12000), seed=st.integers(0, 3))
def test_frames_are_probabilities_twenty_milliseconds_apart(network, count, seed):
    frames = network.posteriors(noise(count, seed))
    assert frames.shape == (1 + count // 320 if count >= WIDTH else 0, len(CLASSES))
    assert frames.dtype == np.float32
    assert np.exp(frames).sum(axis=1) == pytest.approx(np.ones(len(frames)), abs=1e-4)


@pytest.mark.parametrize(
    "sound",
    [
        np.zeros(8000, np.int16),
        np.full(8000, -32768, np.int16),
        np.tile(np.array([32767, -32768], np.int16), 4000),
    ],
    ids=["silence", "stuck", "clipped"],
)
def test_the_worst_sounds_give_finite_frames(network, sound):
    assert np.isfinite(network.posteriors(sound)).all()


def test_a_constant_offset_leaves_no_trace(network):
    sound = noise(16000)
    away_from_ends = slice(40, -40)
    plain = network.log_mel(padded(sound))[away_from_ends]
    moved = network.log_mel(padded(sound + np.int16(5000)))[away_from_ends]
    assert moved == pytest.approx(plain, abs=1e-3)


def test_the_error_function_is_exact_to_a_millionth():
    values = np.linspace(-6, 6, 1001, dtype=np.float32)
    exact = [x * (1 + math.erf(x / math.sqrt(2))) / 2 for x in values.tolist()]
    assert _gelu(values) == pytest.approx(exact, abs=2e-6)


def test_spoken_words_show_as_their_phones(network):
    frames = network.posteriors(spoken("hello robot"))
    best = [CLASSES[i] for i in frames.argmax(axis=1)]
    heard = [
        phone
        for before, phone in zip(["blank", *best], best, strict=False)
        if phone not in ("blank", before)
    ]
    assert "L" in heard
    assert heard.index("L") < heard.index("B") < heard.index("T")


def test_a_person_is_heard_phone_by_phone(network):
    best = network.posteriors(spoken_by_a_person("cards003")).argmax(axis=1)
    changes = best[np.flatnonzero(np.diff(best, prepend=0))]
    heard = " ".join(CLASSES[i] for i in changes if i)
    # It is unsure of two sounds, which it learned to be under noise; the next test decides them.
    assert re.fullmatch("S EH V AH N AO F [KG] L AH [BV] Z", heard), "seven of clubs"


def test_of_all_cards_the_one_that_a_person_names_is_likeliest(network):
    ranks = (
        "ace", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "jack",
        "queen", "king",
    )  # fmt: skip
    suits = ("clubs", "diamonds", "hearts", "spades")
    cards = [(rank, "of", suit) for rank in ranks for suit in suits]
    scores = scores_of(network.posteriors(spoken_by_a_person("cards003")))
    found = likelihoods(scores, cards, Habits(load_lexicon()))
    assert cards[int(found.argmax())] == ("seven", "of", "clubs")


@pytest.mark.parametrize(("chosen", "threads"), [("", "1"), ("2", "2")])
def test_one_thread_does_the_arithmetic_unless_the_user_says_otherwise(chosen, threads):
    environment = {k: v for k, v in os.environ.items() if k != "OPENBLAS_NUM_THREADS"}
    if chosen:
        environment["OPENBLAS_NUM_THREADS"] = chosen
    program = "import hri, os; print(os.environ['OPENBLAS_NUM_THREADS'])"
    command = [sys.executable, "-c", program]
    answer = subprocess.run(command, capture_output=True, text=True, env=environment)
    assert answer.stdout.strip() == threads


def test_tensors_of_another_shape_are_refused(tensors):
    with pytest.raises(HriError, match="another network"):
        Conformer({**tensors, "filters": np.zeros((2, 2), np.float32)})
