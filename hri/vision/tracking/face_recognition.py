"""Recognizes faces with any face-embedding network, for robots whose owner wants that.

An embedding turns the picture of a face into numbers that are alike for pictures of one person.
A model is not included. Nothing is learned unless someone says a name, nothing leaves the
machine, nothing is written to a file unless one is named, and every name can be forgotten.
"""

from __future__ import annotations

import json
import math
from collections import deque
from pathlib import Path
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import AuthoringError, HriError, NotAvailable, Place
from hri.core.ownership import require_of_user
from hri.core.paths import exists
from hri.core.privacy import folder_for
from hri.core.reading import parse_json, read_bytes
from hri.core.signals import Image, Landmarks
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE, write_text
from hri.vision.blendshapes import MOUTH, PUPILS

Vector = NDArray[np.float32]

SIDE = 112
"""Pixels of the crop, as ArcFace and its successors want it."""
TEMPLATE = np.array([(38.3, 51.7), (73.5, 51.5), (56.0, 87.0)], np.float32)
"""Where the crop has the pupils and the middle of the mouth (Deng et al., "ArcFace", 2019)."""
ALIKE = 0.4
"""Cosine of the angle between two vectors above which they show the same person."""
MOST_SAMPLES = 20
"""Vectors that are kept of a name; the oldest go."""
LONGEST_VECTOR = 10_000
"""Numbers; networks give 128 to 4096."""
MOST_NAMES = 1000
LARGEST_FILE = 50_000_000
"""Bytes of a file of faces."""


class FaceEmbedder(Protocol):
    """A third party's model."""

    def embed(self, crop: Image) -> Vector:
        """The vector of a face: an upright crop of [112, 112, 3], RGB; of any length."""
        ...


class Acquaintances:
    """The names that were learned, and how their faces look."""

    def __init__(self, alike: float = ALIKE) -> None:
        self._alike = alike
        self._samples: dict[str, deque[Vector]] = {}

    @property
    def names(self) -> list[str]:
        return sorted(self._samples)

    def learn(self, name: str, vector: Vector) -> None:
        """Take a face for one of that name. Raises HriError for an invalid name or vector."""
        if not name.strip():
            raise HriError("a face needs a name - say whose it is")
        if name not in self._samples and len(self._samples) >= MOST_NAMES:
            raise HriError(f"{MOST_NAMES} names are known - forget one first")
        unit = _normalized(vector)
        known = next((samples[0] for samples in self._samples.values()), unit)
        if len(known) != len(unit):
            what = f"{len(unit)} numbers, the others have {len(known)}"
            raise HriError(f"a face of {what} - forget them all, or use the model they are of")
        self._samples.setdefault(name, deque(maxlen=MOST_SAMPLES)).append(unit)

    def forget(self, name: str) -> bool:
        """Forget everything about a name; whether it was known."""
        return self._samples.pop(name, None) is not None

    def forget_all(self) -> None:
        self._samples.clear()

    def name_of(self, vector: Vector) -> str:
        """The name for a face; empty when it is unknown."""
        vector = _normalized(vector)
        best, name = self._alike, ""
        for candidate in self.names:
            samples = [v for v in self._samples[candidate] if len(v) == len(vector)]
            alike = max((float(sample @ vector) for sample in samples), default=-1.0)
            if alike > best:
                best, name = alike, candidate
        return name

    def save(self, path: Path) -> None:
        """Write names and vectors to a file that only its owner can read, and note where it is.

        Raises HriError.
        """
        text = json.dumps({n: [v.tolist() for v in s] for n, s in self._samples.items()})
        folder_for(path)
        write_text(path, text + "\n", PRIVATE)
        note("faces", path)

    @classmethod
    def load(cls, path: Path, alike: float = ALIKE) -> Acquaintances:
        """Those of a file; none without a file.

        Raises AuthoringError for another file, HriError for one that cannot be read.
        """
        known = cls(alike)
        if not exists(path):
            return known
        require_of_user(path, "file of faces")
        text = read_bytes(path, "file of faces", LARGEST_FILE)
        try:
            for name, vectors in parse_json(text).items():
                for vector in _vectors(vectors):
                    with np.errstate(over="ignore"):
                        known.learn(name, np.array(vector, np.float32))
        except (ValueError, AttributeError, TypeError, OverflowError, HriError) as error:
            remedy = "delete it and let the robot learn the names again"
            raise AuthoringError(Place(path), f"not a file of faces: {error}", remedy) from error
        return known


class FaceRecognizer:
    """Names faces by an embedding and those who are known."""

    def __init__(self, embedder: FaceEmbedder, known: Acquaintances) -> None:
        self.known = known
        self._embedder = embedder

    def name(self, image: Image, landmarks: Landmarks) -> str:
        """The name for the face in a picture; empty when it is unknown.

        Raises HriError when the model fails.
        """
        return self.known.name_of(self._vector(image, landmarks))

    def learn(self, name: str, image: Image, landmarks: Landmarks) -> None:
        """Take a face for one of that name. Raises HriError as `Acquaintances.learn` does."""
        self.known.learn(name, self._vector(image, landmarks))

    def _vector(self, image: Image, landmarks: Landmarks) -> Vector:
        try:
            return self._embedder.embed(aligned(image, landmarks))
        except Exception as error:  # a third party's: whatever it is, only names are lost
            what = f"the model of faces failed: {type(error).__name__}: {error}"
            raise NotAvailable(f"{what} - see that it is the right one") from error


def aligned(image: Image, landmarks: Landmarks) -> Image:
    """The crop of a face, turned upright and scaled to where the template has eyes and mouth."""
    middles = [landmarks[list(points), :2].mean(axis=0) for points in (*PUPILS, MOUTH)]
    scale, turn, shift = _similarity(TEMPLATE, np.array(middles, np.float32))
    y, x = np.mgrid[0:SIDE, 0:SIDE]
    places = np.stack([x, y], axis=-1).astype(np.float32) @ (scale * turn).T + shift
    return _sampled(image, places)


def _similarity(source: Vector, target: Vector) -> tuple[float, Vector, Vector]:
    """Scale, rotation and shift that lead from points to others, with the least squares.

    Umeyama, "Least-squares estimation of transformation parameters" (1991), in two dimensions.
    """
    middle, goal = source.mean(axis=0), target.mean(axis=0)
    one, other = source - middle, target - goal
    along = float((one * other).sum())
    across = float((one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum())
    scale = math.hypot(along, across) / max(float((one**2).sum()), 1e-9)
    angle = math.atan2(across, along)
    cosine, sine = math.cos(angle), math.sin(angle)
    turn = np.array([[cosine, -sine], [sine, cosine]], np.float32)
    return scale, turn, goal - scale * turn @ middle


def _sampled(image: Image, places: Vector) -> Image:
    """The colors at places [rows, columns, 2], between pixels; black outside of the picture."""
    height, width = image.shape[:2]
    corner = np.floor(places).astype(np.int64)
    right_part, down_part = np.moveaxis(places - corner, -1, 0)
    total = np.zeros((*places.shape[:2], 3), np.float32)
    for right in (0, 1):
        for down in (0, 1):
            x, y = corner[..., 0] + right, corner[..., 1] + down
            inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
            colors = np.where(
                inside[..., None], image[np.where(inside, y, 0), np.where(inside, x, 0)], 0
            )
            weight = (right_part if right else 1 - right_part) * (
                down_part if down else 1 - down_part
            )
            total += colors * weight[..., None]
    sampled: Image = np.rint(total).astype(np.uint8)
    return sampled


def _vectors(stored: object) -> list[list[object]]:
    """The vectors of a name. Raises ValueError for anything else, and for more than are kept."""
    if not isinstance(stored, list) or len(stored) > MOST_SAMPLES:
        raise ValueError(f"a name has more than {MOST_SAMPLES} vectors, or none")
    if not all(isinstance(one, list) and len(one) <= LONGEST_VECTOR for one in stored):
        raise ValueError(f"a vector is not a list of at most {LONGEST_VECTOR} numbers")
    return stored


def _normalized(vector: Vector) -> Vector:
    """Of length 1. Raises HriError for what is not finite, or 0."""
    with np.errstate(over="ignore"):  # what overflows is not finite, and refused
        flat = np.asarray(vector, np.float32).ravel()
        length = float(np.linalg.norm(flat))
    if not math.isfinite(length) or length == 0:
        raise HriError("the model gave no vector for this face - see that it is the right one")
    unit: Vector = flat / length
    return unit
