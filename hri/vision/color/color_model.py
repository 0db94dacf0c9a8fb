"""A learned color, and its file `NAME.color`.

The file is JSON with the keys `format` (2), `learned` (a day), `name` where it is not that of the
file, `brightness` (levels of standard light), and `color` and `background`: the mixtures of their
chroma in standard light, each with `weights`, `means` and `covariances`. It has numbers alone, no
pictures. In format 1 the chroma was that of the picture, and there is no brightness.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.privacy import folder_for
from hri.core.reading import parse_json, read_text
from hri.core.signals import Image
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE, write_text
from hri.vision.color.color_constancy import SOFTENED, chromaticity
from hri.vision.color.color_mixture import ColorMixture, Samples, fit

KIND = "config/colors"
SUFFIX = ".color"
OLD_FORMAT, FORMAT = 1, 2
TAKEN_FOR, UNSURE = 200.0, 0.15
"""Levels that the brightest channel of a color of format 1 is taken to have had, or that of what
was behind it, and the part by which that may be wrong."""
COMPONENTS, BEHIND = 2, 4
"""Gaussians of a color, and of what is behind it."""
AROUND = 1.0
"""Of a box's size: what is nearer to it may have the color, too, and is not background."""
SPREAD = 25.0
"""Variance of chroma, squared levels, by which another light and another shade may differ."""
MOST_COMPONENTS = 16
LEAST_WEIGHT = 1e-5
LEAST_VARIANCE, LARGEST_VARIANCE = 1.0, 1e5
FARTHEST = 1e3
"""Levels; no mean is there."""
LONGEST_NAME = 60
REMEDY = "learn it again: hri color learn"

OPAQUE = 128
"""Of 255; what is less opaque shows no color."""

Box = tuple[int, int, int, int]
"""Left, top, width and height in pixels."""
Taught = tuple[Image, Sequence[Box]] | tuple[Image, Sequence[Box], NDArray[np.uint8] | None]
"""A picture (uint8, [height, width, 3], RGB), the boxes that show a color, and how opaque it is."""


@dataclass(frozen=True, slots=True)
class ColorModel:
    """How a color looks to a camera, and what was behind it."""

    name: str
    color: ColorMixture
    background: ColorMixture
    learned: str = ""
    """The day."""
    brightness: float = TAKEN_FOR
    """Its brightest channel, levels of standard light."""


def learn_color(name: str, pictures: Iterable[Taught], day: str = "") -> ColorModel:
    """Learn from pictures and the boxes that show the color.

    Pixels well outside of the boxes are background, transparent ones neither color nor background.
    Raises HriError when a box is outside of its picture, or there is too little of either.
    """
    inside: list[Samples] = []
    outside: list[Samples] = []
    bright: list[NDArray[np.uint8]] = []
    for image, boxes, *opacity in pictures:
        has_color, is_behind = np.zeros(image.shape[:2], bool), np.ones(image.shape[:2], bool)
        for box in boxes:
            has_color[within(box, image)] = True
            is_behind[_around(box)] = False
        if opacity and opacity[0] is not None:
            has_color &= opacity[0] >= OPAQUE
            is_behind &= opacity[0] >= OPAQUE
        seen = chromaticity(image)
        pixels, has_light = seen.chroma.astype(float), seen.brightness > 0
        inside.append(pixels[has_color & has_light])
        outside.append(pixels[is_behind & has_light])
        bright.append(seen.brightness[has_color & has_light])
    if not inside:
        raise HriError(f"no picture to learn {name} from - give one")
    color = fit(np.concatenate(inside), COMPONENTS)
    spread = replace(color, covariances=color.covariances + SPREAD * np.eye(2))
    brightness = float(np.median(np.concatenate(bright)))
    return ColorModel(name, spread, fit(np.concatenate(outside), BEHIND), day, brightness)


def within(box: Box, image: Image) -> tuple[slice, slice]:
    """The rows and columns of a box. Raises HriError when it is outside of the picture."""
    left, top, width, height = box
    is_inside = 0 <= left < image.shape[1] and 0 <= top < image.shape[0]
    if not (is_inside and width > 0 and height > 0):
        size = f"{image.shape[1]} x {image.shape[0]}"
        what = f"the box {left},{top},{width},{height} is outside of a picture of {size}"
        raise HriError(f"{what} - give left, top, width and height in pixels")
    return slice(top, top + height), slice(left, left + width)


def _around(box: Box) -> tuple[slice, slice]:
    left, top, width, height = box
    beside, over = int(AROUND * width), int(AROUND * height)
    rows = slice(max(0, top - over), top + height + over)
    return rows, slice(max(0, left - beside), left + width + beside)


def own_colors() -> Path:
    """The folder of the colors that the user has taught. Raises HriError."""
    return paths.data_folder() / "colors"


def own_color_files() -> list[Path]:
    """The files of the colors that the user has taught, sorted. Raises HriError."""
    return sorted(own_colors().glob(f"*{SUFFIX}"))


def color_names() -> list[str]:
    """All that can be found by name, sorted."""
    own = (file.name for file in own_color_files())
    found = (name for name in (*own, *paths.names(KIND)) if name.endswith(SUFFIX))
    return sorted({name.removesuffix(SUFFIX) for name in found})


def find_color(name: str) -> Path:
    """The file of a color: a path, or a name of the user's own or in `config/colors`.

    Raises HriError.
    """
    if paths.exists(own := own_colors() / f"{Path(name).name}{SUFFIX}") and is_name(name):
        return own
    if name.endswith(SUFFIX):
        return paths.find(KIND, name)
    if name not in color_names():
        raise HriError(f'no color "{name}" - {did_you_mean(name, color_names())}')
    return paths.find(KIND, f"{name}{SUFFIX}")


def is_name(name: str) -> bool:
    """Whether a color may be named so: it is the name of its file."""
    return 0 < len(name) <= LONGEST_NAME and all(c.isalnum() or c in "-_ " for c in name)


def load_color(path: Path) -> ColorModel:
    """Read a color. Raises HriError with what is wrong."""
    try:
        data = parse_json(read_text(path, "color"))
    except (ValueError, RecursionError) as error:
        raise _damaged(path, f"it is not JSON: {error}") from error
    if not isinstance(data, dict) or data.get("format") not in (OLD_FORMAT, FORMAT):
        raise _damaged(path, f'"format" is not {FORMAT}')
    learned = data.get("learned", "")
    if not isinstance(learned, str) or len(learned) > LONGEST_NAME:
        raise _damaged(path, '"learned" is not a day')
    name = data.get("name", path.stem)
    if not isinstance(name, str) or ("name" in data and not is_name(name)):
        raise _damaged(path, '"name" is not a name')
    color, background = _mixture(path, data, "color"), _mixture(path, data, "background")
    if data["format"] == OLD_FORMAT:
        return ColorModel(name, _in_standard_light(color), _in_standard_light(background), learned)
    brightness = float(_numbers(path, data, "brightness", 0))
    if not 0 < brightness <= 255:
        raise _damaged(path, '"brightness" is not a level above 0, up to 255')
    return ColorModel(name, color, background, learned, brightness)


def _in_standard_light(mixture: ColorMixture) -> ColorMixture:
    """What a mixture of format 1 is about, as if each pixel were as bright as can be."""
    apart = mixture.means - 128
    scale = 255 / (TAKEN_FOR + SOFTENED)
    unsure = (UNSURE * scale) ** 2 * apart[:, :, None] * apart[:, None, :]
    return ColorMixture(
        mixture.weights, 128 + scale * apart, scale**2 * mixture.covariances + unsure
    )


def save_color(path: Path, model: ColorModel) -> None:
    """Write a color that only its owner may read. Raises HriError."""
    data = {
        "format": FORMAT,
        "learned": model.learned,
        "brightness": round(model.brightness, 1),
        "color": _written(model.color),
        "background": _written(model.background),
    }
    if model.name != path.stem:
        data["name"] = model.name
    folder_for(path)
    write_text(path, json.dumps(data, indent=1) + "\n", PRIVATE)
    if path.parent.resolve() != own_colors().resolve():
        note("colors", path)


def _written(mixture: ColorMixture) -> dict[str, object]:
    return {
        "weights": np.maximum(mixture.weights, LEAST_WEIGHT).round(5).tolist(),
        "means": mixture.means.round(3).tolist(),
        "covariances": mixture.covariances.round(3).tolist(),
    }


def _mixture(path: Path, data: dict[str, Any], key: str) -> ColorMixture:
    part = data.get(key)
    if not isinstance(part, dict):
        raise _damaged(path, f'"{key}" is not a table')
    weights = _numbers(path, part, f"{key}.weights", 1)
    count = len(weights)
    means = _numbers(path, part, f"{key}.means", 2)
    covariances = _numbers(path, part, f"{key}.covariances", 3)
    fits = means.shape == (count, 2) and covariances.shape == (count, 2, 2)
    if not (0 < count <= MOST_COMPONENTS and fits):
        raise _damaged(path, f'the parts of "{key}" do not fit together')
    is_bounded = (
        ((weights >= LEAST_WEIGHT) & (weights <= 1)).all()
        and np.abs(means).max() < FARTHEST
        and np.abs(covariances).max() < LARGEST_VARIANCE
    )
    covariances = np.tril(covariances) + np.tril(covariances, -1).transpose(0, 2, 1)
    if not is_bounded or _least_variance(covariances) < LEAST_VARIANCE:
        raise _damaged(path, f'"{key}" has numbers that no color has')
    return ColorMixture(weights / weights.sum(), means, covariances)


def _least_variance(covariances: NDArray[np.float64]) -> float:
    """In any direction; negative where there is no such Gaussian."""
    return float(np.linalg.eigvalsh(covariances).min())


def _numbers(path: Path, part: dict[str, Any], key: str, axes: int) -> NDArray[np.float64]:
    try:
        numbers = np.array(part.get(key.rpartition(".")[2]), np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise _damaged(path, f'"{key}" is not made of numbers') from error
    if numbers.ndim != axes or not np.isfinite(numbers).all():
        raise _damaged(path, f'"{key}" is not made of numbers')
    return numbers


def _damaged(path: Path, what: str) -> HriError:
    return HriError(f"{path}: this color is damaged: {what} - {REMEDY}")
