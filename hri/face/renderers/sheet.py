"""A sheet with all that a face can show, and pictures as PNG files."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.face.model import FaceModel
from hri.face.renderers.captions import add_label
from hri.face.renderers.opencv import OpenCvRenderer
from hri.face.still import still_vector

COLUMNS = 6
SIZE = (320, 280)
"""Width and height of each picture."""


def draw_sheet(model: FaceModel) -> Image:
    """All expressions, then all visemes, each with its name."""
    renderer = OpenCvRenderer(model, SIZE)
    pictures = [
        add_label(renderer.render(still_vector(model, expression=label)), label)
        for label in model.expressions
    ]
    pictures += [
        add_label(renderer.render(still_vector(model, viseme=name)), name) for name in model.visemes
    ]
    blank = np.full_like(pictures[0], 255)
    pictures += [blank] * (-len(pictures) % COLUMNS)
    rows = [
        np.concatenate(pictures[first : first + COLUMNS], axis=1)
        for first in range(0, len(pictures), COLUMNS)
    ]
    return np.concatenate(rows)


def write_png(path: Path, image: Image) -> None:
    """Write a picture. Raises HriError when the file cannot be written."""
    if path.suffix.lower() != ".png":
        raise HriError(f"{path}: pictures are written as PNG - name it {path.stem}.png")
    _, data = cv2.imencode(".png", cv2.cvtColor(image, cv2.COLOR_RGB2BGR))
    try:
        path.write_bytes(data.tobytes())
    except OSError as error:
        reason = error.strerror or str(error)
        raise HriError(f"{path}: cannot write: {reason} - choose another place") from error
