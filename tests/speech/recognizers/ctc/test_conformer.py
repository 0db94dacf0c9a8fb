from __future__ import annotations

import math
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError
from hri.speech.recognizers.ctc.classes import CLASSES, TOKENS, folding
from hri.speech.recognizers.ctc.conformer import _gelu, load_network
from hri.speech.recognizers.ctc.features import WIDTH, log_mel, padded
from hri.speech.recognizers.ctc.weights import find_weights, read_tensors
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
        return scaled * weights[f"{name}.weight"] + weights[f"{name}.bias"]

    def sigmoid(x):
        return 1 / (1 + np.exp(-x))

    def feed_forward(h, name, number):
        inner = normalized(h, f"{name}.norm") @ weights[f"onnx::MatMul_{number}"]
        inner += weights[f"{name}.fc1.bias"]
        outer = (inner * sigmoid(inner)) @ weights[f"onnx::MatMul_{number + 1}"]
        return 0.5 * (outer + weights[f"{name}.fc2.bias"])

    def attention(h, name, number):
        three = normalized(h, f"{name}.attn_norm") @ weights[f"onnx::MatMul_{number}"]
        q, k, v = np.split(three + weights[f"{name}.attn.in_proj_bias"], 3, axis=1)
        heads = []
        for head in range(4):
            part = slice(36 * head, 36 * head + 36)
            likeness = np.exp(q[:, part] @ k[:, part].T / 6)
            heads.append(likeness / likeness.sum(1, keepdims=True) @ v[:, part])
        out = np.concatenate(heads, 1) @ weights[f"onnx::MatMul_{number + 4}"]
        return out + weights[f"{name}.attn.out_proj.bias"]

    def convolution(h, name, number):
        both = normalized(h, f"{name}.norm") @ weights[f"{name}.pointwise1.weight"][:, :, 0].T
        both += weights[f"{name}.pointwise1.bias"]
        gated = np.pad(both[:, :144] * sigmoid(both[:, 144:]), ((15, 15), (0, 0)))
        taps = weights[f"onnx::Conv_{number}"][:, 0]
        c = sum(gated[t : t + len(h)] * taps[:, t] for t in range(31))
        c = c + weights[f"onnx::Conv_{number + 1}"]
        out = (c * sigmoid(c)) @ weights[f"{name}.pointwise2.weight"][:, :, 0].T
        return out + weights[f"{name}.pointwise2.bias"]

    mel = np.pad(log_mel(padded(samples), tensors["mel_fb"]).astype(float), ((1, 1), (0, 0)))
    stem = weights["onnx::Conv_801"]
    count = (len(mel) - 3) // 2 + 1
    h = np.stack([np.einsum("tb,obt->o", mel[2 * i : 2 * i + 3], stem) for i in range(count)])
    h += weights["onnx::Conv_802"]
    h *= 0.5 * (1 + np.vectorize(math.erf)(h / math.sqrt(2)))
    for i in range(4):
        name = f"acoustic_model.model.blocks.{i}"
        h = h + feed_forward(h, f"{name}.ffn1", 829 + 9 * i)
        h = h + attention(h, name, 831 + 9 * i)
        h = h + convolution(h, f"{name}.conv", 804 + 3 * i)
        h = h + feed_forward(h, f"{name}.ffn2", 836 + 9 * i)
        h = normalized(h, f"{name}.norm")
    scores = h @ weights["acoustic_model.model.proj.weight"][:, :, 0].T
    scores = np.exp(scores + weights["acoustic_model.model.proj.bias"])
    folded = scores @ folding()
    return folded / folded.sum(1, keepdims=True)


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


def test_every_phone_has_tokens_and_every_token_a_class():
    matrix = folding()
    assert matrix.shape == (TOKENS, len(CLASSES))
    assert (matrix.sum(axis=0) >= 1).all()
    assert (matrix.sum(axis=1) >= 1).all()
    flap = matrix[116]
    assert {CLASSES[i] for i in np.flatnonzero(flap)} == {"D", "T"}


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
    assert heard == "S EH V AH N AO F K L AH B Z", "seven of clubs"


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
    from hri.speech.recognizers.ctc.conformer import Conformer

    with pytest.raises(HriError, match="another network"):
        Conformer({**tensors, "mel_fb": np.zeros((2, 2), np.float32)})
