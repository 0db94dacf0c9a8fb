"""The network that ours grew from, as it comes in the package `hama` 1.7.0, in our own form.

    python origin.py speech.npz origin.npz

writes a weight file with 4 blocks and 40 classes instead of the package's 191 tokens, of which
several may sound alike; how these are told apart is fitted to some of the speech. Nothing of the
package's code runs. Its network listens well to clean speech and falls silent in noise; it is the
teacher of `train.py`.
"""

# ruff: noqa: RUF001 - the letters of the phonetic alphabet are meant.
from __future__ import annotations

import argparse
import hashlib
import importlib.util
import struct
from collections.abc import Iterator, Mapping
from pathlib import Path

import network
import numpy as np
import torch
from numpy.typing import NDArray

from hri.speech.recognizers.ctc.classes import CLASSES
from hri.speech.recognizers.ctc.features import log_mel, padded

Tensor = NDArray[np.float32]

SHA256 = "a9fcfe73e179ca48e399cd76a90a6b3e1887bf5037ecc52b778d13a149563328"
"""Of the file, as RECORD of the package's wheel has it."""
BLOCKS = 4
TYPES = {0: "<f4", 1: "<f2", 2: "<i8", 3: "<i4"}
ALIGNMENT = 16
PEAK_WEIGHT = 9.0
"""How much more a frame weighs in which there is a phone."""
ITERATIONS = 200
FITTED = 600
"""Clips of speech."""
MODEL = "acoustic_model.model"

TOKENS_OF: dict[str, dict[str, int]] = {
    "AA": {"ɑ": 80, "ɒ": 81, "a": 7, "ä": 64}, "AE": {"æ": 66},
    "AH": {"ə": 89, "ʌ": 125, "ɐ": 79, "ᵊ": 175, "ɨ": 100}, "AO": {"ɔ": 83}, "AW": {"aʊ": 9},
    "AY": {"aɪ": 8}, "B": {"b": 10}, "CH": {"t͡ʃ": 47, "t͡ɕ": 44, "t͡ɕʰ": 45},
    "D": {"d": 12, "ɾ": 116}, "DH": {"ð": 69}, "EH": {"ɛ": 91}, "ER": {"ɝ": 93, "ɚ": 90, "ɜ": 92},
    "EY": {"eɪ": 16, "e": 14}, "F": {"f": 17}, "G": {"g": 18, "ɡ": 95}, "HH": {"h": 19, "ɦ": 99},
    "IH": {"ɪ": 101}, "IY": {"i": 20}, "JH": {"d͡ʒ": 13}, "K": {"k": 27, "kʰ": 28},
    "L": {"l": 30, "ɫ": 103}, "M": {"m": 31}, "N": {"n": 32}, "NG": {"ŋ": 75},
    "OW": {"oʊ": 34, "o": 33}, "OY": {"ɔɪ": 84}, "P": {"p": 35, "pʰ": 36},
    "R": {"ɹ": 113, "r": 38, "ɻ": 114}, "S": {"s": 39}, "SH": {"ʃ": 120, "ɕ": 85},
    "T": {"t": 41, "tʰ": 42, "ʔ": 131, "ɾ": 116}, "TH": {"θ": 173}, "UH": {"ʊ": 123},
    "UW": {"u": 48, "ʉ": 122}, "V": {"v": 49}, "W": {"w": 50}, "Y": {"j": 21}, "Z": {"z": 57},
    "ZH": {"ʒ": 130},
}  # fmt: skip
"""Which tokens are heard as which phone: their IPA, and their index in the package's vocabulary.
The flap is both T and D; what no phone claims (marks, the rest of Korean) is blank."""


def raw_tensors() -> dict[str, Tensor]:
    """The tensors of the package's file under their own names.

    The file: "HAMAPK", version 1, kind 2, u32 count; of each tensor u16 length of its name, name,
    u8 type, u8 rank, u32 dimensions, u64 offset, u64 bytes; the data from the next multiple of 16
    on. Everything is little endian.
    """
    spec = importlib.util.find_spec("hama")
    if spec is None or not spec.submodule_search_locations:
        raise SystemExit("the package hama is missing - pip install hama==1.7.0")
    raw = Path(spec.submodule_search_locations[0], "assets", "asr_waveform.hama").read_bytes()
    if hashlib.sha256(raw).hexdigest() != SHA256:
        raise SystemExit("not the file of hama 1.7.0 - pip install hama==1.7.0")
    (count,) = struct.unpack_from("<I", raw, 8)
    position = 12
    entries = []
    for _ in range(count):
        (length,) = struct.unpack_from("<H", raw, position)
        name = raw[position + 2 : position + 2 + length].decode()
        position += 2 + length
        kind, rank = struct.unpack_from("<BB", raw, position)
        shape = struct.unpack_from(f"<{rank}I", raw, position + 2)
        offset, size = struct.unpack_from("<QQ", raw, position + 2 + 4 * rank)
        position += 18 + 4 * rank
        entries.append((name, TYPES[kind], shape, offset, size))
    data = raw[-(-position // ALIGNMENT) * ALIGNMENT :]
    return {
        name: np.frombuffer(data[offset : offset + size], kind).reshape(shape).astype(np.float32)
        for name, kind, shape, offset, size in entries
    }


def renamed(raw: Mapping[str, Tensor]) -> dict[str, Tensor]:
    """The tensors in the form of `hri.speech.recognizers.ctc.conformer`, but for the head."""
    found = {
        "filters": raw["mel_fb"],
        "stem.matrix": raw["onnx::Conv_801"].transpose(2, 1, 0).reshape(-1, 144),
        "stem.bias": raw["onnx::Conv_802"],
    }
    for block in range(BLOCKS):
        found |= {f"{block}.{name}": tensor for name, tensor in _block(raw, block)}
    return found


def _block(raw: Mapping[str, Tensor], block: int) -> Iterator[tuple[str, Tensor]]:
    old = f"{MODEL}.blocks.{block}"
    product, filter = 829 + 9 * block, 804 + 3 * block
    for mine, theirs, number in (("first", "ffn1", product), ("second", "ffn2", product + 7)):
        yield from _norm(raw, f"{mine}.norm", f"{old}.{theirs}.norm")
        yield f"{mine}.out.matrix", raw[f"onnx::MatMul_{number}"]
        yield f"{mine}.out.bias", raw[f"{old}.{theirs}.fc1.bias"]
        yield f"{mine}.back.matrix", raw[f"onnx::MatMul_{number + 1}"]
        yield f"{mine}.back.bias", raw[f"{old}.{theirs}.fc2.bias"]
    yield from _norm(raw, "attention.norm", f"{old}.attn_norm")
    yield "attention.inward.matrix", raw[f"onnx::MatMul_{product + 2}"]
    yield "attention.inward.bias", raw[f"{old}.attn.in_proj_bias"]
    yield "attention.outward.matrix", raw[f"onnx::MatMul_{product + 6}"]
    yield "attention.outward.bias", raw[f"{old}.attn.out_proj.bias"]
    yield from _norm(raw, "convolution.norm", f"{old}.conv.norm")
    for mine, theirs in (("inward", "pointwise1"), ("outward", "pointwise2")):
        yield f"convolution.{mine}.matrix", raw[f"{old}.conv.{theirs}.weight"][:, :, 0].T
        yield f"convolution.{mine}.bias", raw[f"{old}.conv.{theirs}.bias"]
    yield "convolution.taps.matrix", raw[f"onnx::Conv_{filter}"][:, 0]
    yield "convolution.taps.bias", raw[f"onnx::Conv_{filter + 1}"]
    yield from _norm(raw, "norm", f"{old}.norm")


def _norm(raw: Mapping[str, Tensor], mine: str, theirs: str) -> Iterator[tuple[str, Tensor]]:
    yield f"{mine}.gain", raw[f"{theirs}.weight"]
    yield f"{mine}.shift", raw[f"{theirs}.bias"]


def head_of(raw: Mapping[str, Tensor], frames: Tensor) -> tuple[Tensor, Tensor]:
    """A matrix [144, classes] and a bias for classes instead of tokens.

    The logarithm of a sum over the tokens of a class is not linear in the `frames` [count, 144] of
    real speech: these are the nearest, by Kullback and Leibler's measure.
    """
    tokens = frames @ raw[f"{MODEL}.proj.weight"][:, :, 0].T + raw[f"{MODEL}.proj.bias"]
    chances = np.exp(tokens - tokens.max(axis=1, keepdims=True)) @ folding()
    wanted = torch.from_numpy((chances / chances.sum(axis=1, keepdims=True)).astype(np.float32))
    # A phone's frames are rare, and what they are heard as is what counts.
    weight = 1.0 + PEAK_WEIGHT * (1.0 - wanted[:, 0])
    given = torch.from_numpy(frames)
    likeliest = chances.argmax(axis=1)
    best = [
        int(tokens[likeliest == c].sum(axis=0)[folding()[:, c] > 0].argmax())
        for c in range(len(CLASSES))
    ]
    rows = [np.flatnonzero(folding()[:, c] > 0)[best[c]] for c in range(len(CLASSES))]
    matrix = torch.tensor(raw[f"{MODEL}.proj.weight"][rows, :, 0].T.copy(), requires_grad=True)
    bias = torch.tensor(raw[f"{MODEL}.proj.bias"][rows].copy(), requires_grad=True)
    optimizer = torch.optim.LBFGS(
        [matrix, bias], max_iter=ITERATIONS, line_search_fn="strong_wolfe"
    )

    def cost() -> torch.Tensor:
        optimizer.zero_grad()
        heard = (given @ matrix + bias).log_softmax(dim=1)
        value = -((wanted * heard).sum(dim=1) * weight).mean()
        value.backward()
        return value

    optimizer.step(cost)
    return matrix.detach().numpy(), bias.detach().numpy()


def folding() -> NDArray[np.float64]:
    """The matrix [tokens, classes] that sums the tokens' probabilities into classes."""
    matrix = np.zeros((191, len(CLASSES)))
    for phone, tokens in TOKENS_OF.items():
        matrix[list(tokens.values()), CLASSES.index(phone)] = 1.0
    matrix[matrix.sum(axis=1) == 0.0, CLASSES.index("blank")] = 1.0
    return matrix


def frames_of(tensors: Mapping[str, Tensor], clips: list[NDArray[np.int16]]) -> Tensor:
    """What the head sees of clips, [frames, 144]."""
    weights = {name: torch.from_numpy(np.ascontiguousarray(t)) for name, t in tensors.items()}
    mels = (np.pad(log_mel(padded(clip), tensors["filters"]), ((1, 1), (0, 0))) for clip in clips)
    seen = (network.frames_of(weights, torch.from_numpy(mel[None])) for mel in mels)
    return np.concatenate([frames[0].numpy() for frames in seen])


def main() -> None:
    """Write the weight file."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("speech", type=Path, help="what collect.py writes")
    parser.add_argument("file", type=Path)
    args = parser.parse_args()
    with np.load(args.speech) as stored:
        clips = np.split(stored["clips"], stored["ends"][:-1])
    chosen = np.random.default_rng(0).permutation(len(clips))[:FITTED]
    raw = raw_tensors()
    tensors = renamed(raw)
    tensors["head.matrix"], tensors["head.bias"] = head_of(
        raw, frames_of(tensors, [clips[number] for number in chosen])
    )
    network.write(tensors, args.file)


if __name__ == "__main__":
    main()
