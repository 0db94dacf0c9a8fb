"""`hri color show`: which chroma has a color, as a picture."""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

from hri.core.picture_writer import write_picture
from hri.core.quoting import report
from hri.core.writing import PRIVATE
from hri.vision.color.color_mixture import ratio_table
from hri.vision.color.color_model import find_color, load_color
from hri.vision.color.segmentation import LIKELY

LUMA = 140
FAINT = 0.25
"""How strongly the chroma is drawn that does not have the color."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="a color, or the path of its file")
    parser.add_argument(
        "--out", type=Path, default=Path("color.png"), metavar="F.png", help="(%(default)s)"
    )


def run(options: argparse.Namespace) -> int:
    model = load_color(find_color(options.name))
    has_color = ratio_table(model.color, model.background).ratios >= LIKELY
    red, blue = np.mgrid[:256, :256].astype(np.uint8)
    plane = np.dstack([np.full((256, 256), LUMA, np.uint8), red, blue])
    picture = cv2.cvtColor(plane, cv2.COLOR_YCrCb2RGB).astype(np.float32)
    picture[~has_color] = 255 - FAINT * (255 - picture[~has_color])
    write_picture(options.out, picture.round().astype(np.uint8), mode=PRIVATE)
    for weight, (cr, cb) in zip(model.color.weights, model.color.means, strict=True):
        report(f"{weight:4.0%} around Cr {cr:.0f}, Cb {cb:.0f}")
    report(f"{has_color.mean():.1%} of all chroma has it; wrote {options.out}")
    return 0
