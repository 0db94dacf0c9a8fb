"""`hri color check`: colors that are damaged, or hard to tell apart."""

from __future__ import annotations

import argparse
from itertools import combinations

import numpy as np

from hri.core.errors import HriError
from hri.core.quoting import report
from hri.vision.color.color_mixture import ratio_table
from hri.vision.color.color_model import ColorModel, color_names, find_color, load_color
from hri.vision.color.segmentation import LIKELY

WIDE = 0.25
"""Of all chroma; a color that takes more is found everywhere."""
SHARED = 0.5
"""Of the smaller color's chroma; two that share more are taken for each other."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("names", nargs="*", metavar="NAME", help="colors, or paths (all)")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when there is something to do."""
    names = options.names or color_names()
    problems, masks = [], {}
    for name in names:
        try:
            model = load_color(find_color(name))
        except HriError as error:
            problems.append(str(error))
            continue
        masks[model.name] = mask = _chroma_of(model)
        if mask.mean() > WIDE:
            problems.append(f"{name}: {mask.mean():.0%} of all chroma has it - learn it again")
        if not mask.any():
            problems.append(f"{name}: it is like its background - learn it before another one")
    for (one, first), (other, second) in combinations(masks.items(), 2):
        smaller = min(first.sum(), second.sum())
        if smaller and (first & second).sum() > SHARED * smaller:
            problems.append(f'{one}: "{other}" is nearly the same color - remove one of them')
    for line in problems or [f"{len(names)} colors, all told apart"]:
        report(line)
    return 1 if problems else 0


def _chroma_of(model: ColorModel) -> np.ndarray[tuple[int, int], np.dtype[np.bool_]]:
    return np.asarray(ratio_table(model.color, model.background).ratios >= LIKELY)
