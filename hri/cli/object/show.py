"""`hri object show`: a picture of what is known of an object."""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

from hri.cli.object.attribute import attribute_lines
from hri.cli.object.options import add_set, loaded, object_of
from hri.core.picture_writer import write_picture
from hri.core.quoting import escaped, report
from hri.core.signals import Image
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE
from hri.vision.objects.object_model import View

SIDE = 300
"""Pixels, of a view in the picture."""
COLUMNS = 4
FEATURE, OUTLINE = (255, 210, 60), (80, 220, 120)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_set(parser)
    parser.add_argument("name", metavar="NAME", help="the object")
    parser.add_argument(
        "--out", type=Path, default=Path("object.png"), metavar="F.png", help="(%(default)s)"
    )


def run(options: argparse.Namespace) -> int:
    model = object_of(loaded(options), options.name)
    tiles = [_drawn(view) for view in model.views]
    blank = np.full_like(tiles[0], 40)
    tiles += [blank] * (-len(tiles) % min(COLUMNS, len(tiles)))
    width = min(COLUMNS, len(tiles))
    rows = [np.hstack(tiles[i : i + width]) for i in range(0, len(tiles), width)]
    write_picture(options.out, np.vstack(rows), mode=PRIVATE)
    note("pictures", options.out)
    for number, view in enumerate(model.views, 1):
        size = f", {100 * view.scale * np.ptp(view.outline[:, 0]):.1f} cm wide" * (view.scale > 0)
        report(f"view {number}: {len(view.features)} features{size}, from {escaped(view.source)}")
    for line in attribute_lines(model.attributes):
        report(line)
    report(f"wrote {options.out}")
    return 0


def _drawn(view: View) -> Image:
    """The view within a square, with its outline and its features."""
    tile = np.full((SIDE, SIDE, 3), 40, np.uint8)
    scale = SIDE / max(view.picture.shape[:2])
    picture = cv2.resize(view.picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_LINEAR)
    tile[: picture.shape[0], : picture.shape[1]] = picture[:SIDE, :SIDE]
    corners = np.rint(view.outline * scale).astype(np.int32)
    cv2.polylines(tile, [corners], True, OUTLINE, 1, cv2.LINE_AA)
    for x, y in np.rint(view.features.points * scale).astype(int).tolist():
        cv2.circle(tile, (x, y), 2, FEATURE, -1, cv2.LINE_AA)
    return tile
