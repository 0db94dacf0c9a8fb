"""How long a frame takes, and the blend in it."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import cycle, islice

import numpy as np

from hri.bench.table import Row, amount, at_most
from hri.core.signals import Expression, Gaze, Phoneme, Speech
from hri.face.animator import Animator
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel
from hri.face.renderers.renderer import Renderer

RATE = 30.0
SOUNDS = "h @ l oU aI a m h a p I t @ s i: j u: f O: b r eI v f I S dZ V m p oU v @ D @ m a t"
SOUND_S = 0.085
"""Seconds of each sound."""
MOODS = ("neutral", "happy", "surprised", "sad", "excited")
MOOD_S = 4.0
LOOKS = (Gaze(0.0, 0.0), Gaze(0.12, -0.05), Gaze(0.0, 0.0), Gaze(-0.1, 0.06))
"""Where it looks meanwhile: at someone in front of it who moves a little."""
TARGETS = 50
SMALL, SMALL_MS = (320, 240), 5.0
BLEND_MS, FRAME_MS, SLOWEST_MS = 0.03, 6.0, 9.0


def talking(model: FaceModel, count: int) -> list[Vector]:
    """Weights of a number of frames of a face that talks without pause, with emotion."""
    animator = Animator(model, seed=1)
    speech = endless_speech(count / RATE)
    animator.speak(speech)
    vectors = []
    for number in range(count):
        now = number / RATE
        if now % MOOD_S < 1 / RATE:
            turn = round(now / MOOD_S)
            animator.express(Expression(MOODS[turn % len(MOODS)], 0.7))
            animator.look(LOOKS[turn % len(LOOKS)])
        vectors.append(animator.vector(now, 1 / RATE, now))
    return vectors


def endless_speech(seconds: float) -> Speech:
    """Sounds of English sentences, over and over, without a voice."""
    count = int(seconds / SOUND_S) + 1
    names = islice(cycle(SOUNDS.split()), count)
    phonemes = tuple(Phoneme(name, n * SOUND_S, SOUND_S) for n, name in enumerate(names))
    return Speech("", np.zeros(int(seconds * 16000) + 16000, np.int16), 16000, phonemes)


def rows(model: FaceModel, vectors: Sequence[Vector], size: tuple[int, int]) -> Iterator[Row]:
    """Milliseconds of a frame, of its slowest twentieth, and of the blend alone."""
    renderer = Renderer(model, size)
    for vector in vectors[:10]:
        renderer.render(vector)
    taken = np.array([1e3 * seconds(partial(renderer.render, vector)) for vector in vectors])
    what = f"frame, {size[0]}x{size[1]}, {model.name}, talking and moving"
    shapes = {"shapes": len(model.display.items), "frames": len(vectors)}
    yield amount(f"{what}, median", float(np.median(taken)), "ms", at_most(FRAME_MS), **shapes)
    yield amount(f"{what}, p95", float(np.percentile(taken, 95)), "ms", at_most(SLOWEST_MS))
    yield batch(model, vectors)
    yield blend(model)


def batch(model: FaceModel, vectors: Sequence[Vector]) -> Row:
    """A small frame, drawn into an array that is used again, as for a data set."""
    renderer, (width, height) = Renderer(model, SMALL), SMALL
    out = np.empty((height, width, 3), np.uint8)
    taken = [1e3 * seconds(partial(renderer.render, vector, out)) for vector in vectors]
    what = f"frame in a batch, {width}x{height}, {model.name}, median"
    return amount(what, float(np.median(taken)), "ms", at_most(SMALL_MS), frames=len(vectors))


def blend(model: FaceModel) -> Row:
    """The morph blend alone, with as many targets weighted as the figure is for."""
    vector = np.zeros(len(model.channels), np.float32)
    vector[:TARGETS] = 0.5
    taken = [1e3 * seconds(lambda: model.blend(vector)) for _ in range(500)]
    channels = len(model.display.channels)
    what = f"morph blend alone, {TARGETS} targets"
    return amount(what, float(np.median(taken)), "ms", at_most(BLEND_MS), channels=channels)


def seconds(work: Callable[[], object]) -> float:
    """Of the thread."""
    begun = time.thread_time()
    work()
    return time.thread_time() - begun
