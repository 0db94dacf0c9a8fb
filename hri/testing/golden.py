"""Approved pictures: a test compares the current drawing with the one that a person looked at.

def test_my_robot_smiles(golden):
    golden.check("happy", render_face("mine", expression="happy"))

`pytest --update-goldens` writes the pictures into `golden/` beside the test; look at each of them
before you commit it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hri.core.picture_writer import over_white, write_picture
from hri.core.signals import Image
from hri.hal.drivers.still_image import read_still

TILE = 32
"""Pixels: the side of the squares that are compared. A change of an eyebrow fills one."""
SLIGHT = 1.0
"""Mean difference of a tile in steps of 255 that counts as rounding."""
GLARING = 24.0
"""Difference in steps of 255 that no more than one pixel of a thousand may have."""


_NAMES: dict[Path, str] = {}
"""By file, the name that a test of this run gave its picture."""


def difference(seen: Image, approved: Image) -> str:
    """How a picture differs from the approved one, in words; "" when only rounding does.

    Both of one bit, gray, RGB or RGBA, as `Golden.check` takes them. One of one bit has no
    rounding. Raises AssertionError for another kind of array.
    """
    return _compared(_in_colors(seen), _in_colors(approved), _is_one_bit(seen))


def _compared(seen: Image, approved: Image, is_exact: bool) -> str:
    seen, approved = _alike(seen, approved)
    if seen.shape != approved.shape:
        return f"its shape is {seen.shape}, and the approved one is {approved.shape}"
    apart = np.abs(seen.astype(np.float32) - approved)
    tiles = {
        (x, y): float(apart[y : y + TILE, x : x + TILE].mean())
        for y in range(0, len(apart), TILE)
        for x in range(0, apart.shape[1], TILE)
    }
    (x, y), most = max(tiles.items(), key=lambda tile: tile[1])
    slight, glaring = (0.0, 0.0) if is_exact else (SLIGHT, GLARING)
    if most <= slight and np.quantile(apart, 0.999) <= glaring:
        return ""
    changed = sum(mean > slight for mean in tiles.values())
    where = f"the most at x {x} to {x + TILE}, y {y} to {y + TILE}"
    return f"{changed} of {len(tiles)} tiles changed, {where} (by {most:.1f} of 255 on average)"


def _is_one_bit(picture: NDArray[Any]) -> bool:
    return picture.dtype == bool or (picture.ndim == 2 and picture.size > 0 and picture.max() <= 1)


def _in_bytes(picture: NDArray[Any]) -> NDArray[np.uint8]:
    """A picture of any kind, with white as 255. Raises AssertionError when it is not one."""
    kind = f"{picture.dtype}, {list(picture.shape)}"
    is_picture = picture.ndim in (2, 3) and picture.size and picture.dtype in (bool, np.uint8)
    channels = picture.shape[2] if picture.ndim == 3 else 1
    if not is_picture or channels not in (1, 3, 4):
        remedy = "give uint8 or bool, [height, width] and 3 colors, 4 with opacity, or none"
        raise AssertionError(f"an array of {kind} - {remedy}")
    return np.where(picture, 255, 0).astype(np.uint8) if _is_one_bit(picture) else picture


def _in_colors(picture: NDArray[Any]) -> Image:
    """A picture of any kind with three channels; with four where it has opacity, over white."""
    told = _in_bytes(picture)
    if told.ndim == 2 or told.shape[2] == 1:
        return np.dstack([told.reshape(told.shape[:2])] * 3)
    if told.shape[2] == 3:
        return told
    return np.dstack([over_white(told[..., :3], told[..., 3]), told[..., 3]])


def _alike(one: Image, other: Image) -> tuple[Image, Image]:
    """Both with opacity where one has it."""
    most = max(one.shape[2], other.shape[2])
    first, second = (
        np.dstack([each, np.full(each.shape[:2], 255, np.uint8)]) if each.shape[2] < most else each
        for each in (one, other)
    )
    return first, second


@dataclass(frozen=True)
class Golden:
    """The approved pictures of one test file."""

    folder: Path
    """Where they are kept."""
    scratch: Path
    """Where a test that fails leaves what it saw."""
    is_updating: bool = False
    """Whether to approve what is seen."""

    def check(self, name: str, seen: Image) -> None:
        """Compare a picture with the approved one of a name, which may be in a folder: eyes/left.

        It is uint8, RGB ([height, width, 3]), RGBA, or gray ([height, width]), or bool for one bit.
        Raises AssertionError that says where they differ and where to look, and for a name that
        another picture has.
        """
        file = self._file(name)
        path = self.folder / file
        if self.is_updating:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_picture(path, _in_bytes(seen))
            return
        assert path.exists(), f"no picture {path} - run pytest --update-goldens, look at it"
        approved, colors = _read(path), _in_colors(seen)
        what = _compared(colors, approved, _is_one_bit(seen))
        if what:
            shown = self.scratch / file
            shown.parent.mkdir(parents=True, exist_ok=True)
            pictures = _alike(approved, colors)
            is_same_size = pictures[0].shape == pictures[1].shape
            write_picture(shown, np.hstack(pictures) if is_same_size else pictures[1])
            raise AssertionError(
                f"{name}: {what} - {shown} shows the approved picture and this one;"
                " if the change is meant, run pytest --update-goldens"
            )

    def _file(self, name: str) -> PurePosixPath:
        """The file of a name, in the folder. Raises AssertionError when it cannot be one."""
        file = PurePosixPath(f"{name.replace(' ', '-')}.png")
        is_inside = not file.is_absolute() and ".." not in file.parts
        if not name.strip(" ./") or not is_inside or "\0" in name:
            remedy = 'take letters, as in "happy", or a folder and letters, as in "eyes/left"'
            raise AssertionError(f'"{name}" cannot be the name of a picture - {remedy}')
        path = (self.folder / file).absolute()
        if (other := _NAMES.setdefault(path, name)) != name:
            what = f'"{other}" and "{name}" are one file, {path}'
            raise AssertionError(f"{what} - rename one of them")
        return file


def _read(path: Path) -> Image:
    """An approved picture, with its opacity. Raises HriError."""
    still = read_still(path)
    return still.image if still.alpha is None else np.dstack([still.image, still.alpha])
