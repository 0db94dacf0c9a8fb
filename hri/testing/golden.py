"""Pictures that were approved: a test compares what is drawn now with what a person looked at.

def test_my_robot_smiles(golden):
    golden.check("happy", render_face("mine", expression="happy"))

`pytest --update-goldens` writes the pictures into `golden/` beside the test; look at each of them
before you commit it.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from hri.core.native_path import native_path
from hri.core.picture_writer import write_picture
from hri.core.signals import Image

TILE = 32
"""Pixels: the side of the squares that are compared. A change of an eyebrow fills one."""
SLIGHT = 1.0
"""Mean difference of a tile in steps of 255 that counts as rounding."""
GLARING = 24.0
"""Difference in steps of 255 that no more than one pixel of a thousand may have."""


def difference(seen: Image, approved: Image) -> str:
    """How a picture differs from the approved one, in words; "" when only rounding does.

    Both RGB or gray, uint8, of any size.
    """
    if seen.shape != approved.shape:
        return f"its shape is {seen.shape}, and the approved one is {approved.shape}"
    apart = np.abs(seen.astype(np.float32) - approved)
    tiles = {
        (x, y): float(apart[y : y + TILE, x : x + TILE].mean())
        for y in range(0, len(apart), TILE)
        for x in range(0, apart.shape[1], TILE)
    }
    (x, y), most = max(tiles.items(), key=lambda tile: tile[1])
    if most < SLIGHT and np.quantile(apart, 0.999) < GLARING:
        return ""
    changed = sum(mean >= SLIGHT for mean in tiles.values())
    where = f"the most at x {x} to {x + TILE}, y {y} to {y + TILE}"
    return f"{changed} of {len(tiles)} tiles changed, {where} (by {most:.1f} of 255 on average)"


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
        """Compare a picture (RGB, uint8, [height, width, 3]) with the approved one of that name.

        Raises AssertionError that says where they differ and where to look.
        """
        path = self.folder / f"{name.replace(' ', '-')}.png"
        if self.is_updating:
            self.folder.mkdir(parents=True, exist_ok=True)
            write_picture(path, seen)
            return
        with native_path(path) as file:
            read = cv2.imread(file)
        assert read is not None, f"no picture {path} - run pytest --update-goldens, look at it"
        approved = np.asarray(cv2.cvtColor(read, cv2.COLOR_BGR2RGB), np.uint8)
        what = difference(seen, approved)
        if what:
            shown = self.scratch / path.name
            pictures = [approved, seen] if seen.shape == approved.shape else [seen]
            write_picture(shown, np.hstack(pictures))
            raise AssertionError(
                f"{name}: {what} - {shown} shows the approved picture and this one;"
                " if the change is meant, run pytest --update-goldens"
            )
