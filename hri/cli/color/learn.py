"""`hri color learn`: learns a color from parts of pictures."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from datetime import date
from pathlib import Path

from hri.cli.vision.taught import LeftOut, stills_of
from hri.cli.vision.watching import add_view, frames_of, opened_camera
from hri.core.clock import FakeClock, RealClock
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.signals import Image
from hri.vision.color.color_model import (
    LONGEST_NAME,
    SUFFIX,
    Box,
    Taught,
    is_name,
    learn_color,
    own_colors,
    save_color,
    within,
)

EPILOG = """\
Without a box the middle of the picture is taken: hold the color there. What is farther from the
boxes than their own size is background, so it must not show the color. Several pictures, in the
light of the day and of the evening, make a color that is found in both."""
MIDDLE = 0.2
"""Of the picture, in each direction, that is taken without a box."""
CLICK = 12
"""Pixels, width and height of the box around a click."""
SECONDS, EVERY = 3.0, 0.3
"""How long a camera looks, and seconds between two of its pictures."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    add = parser.add_argument
    add("name", metavar="NAME", help="what to call it: ball")
    source = parser.add_mutually_exclusive_group(required=True)
    about = "pictures, or folders of them"
    source.add_argument("--images", nargs="+", type=Path, metavar="FILE", help=about)
    source.add_argument("--video", type=Path, metavar="FILE", help="a video")
    about = "the configured camera, or one of this machine: 0, 1 ... or its path"
    source.add_argument("--camera", nargs="?", const="", metavar="N", help=about)
    source.add_argument("--simulated", action="store_true", help="the camera of the simulated room")
    add_view(parser)
    about = "left, top, width, height in pixels of what has the color; may be repeated"
    add("--box", action="append", type=_numbers(4), default=[], metavar="X,Y,W,H", help=about)
    about = "a pixel of what has the color; may be repeated"
    add("--click", action="append", type=_numbers(2), default=[], metavar="X,Y", help=about)
    add("--out", type=Path, metavar="F.color", help="the file (your own colors)")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture was left out, 2 when nothing was learned."""
    if not is_name(options.name):
        remedy = f"use 1 to {LONGEST_NAME} letters, digits, spaces, - and _"
        raise HriError(f'"{options.name}" is not a valid name for a color - {remedy}')
    left_out = LeftOut()
    pictures = list(_from_files(options, left_out) if options.images else _from_camera(options))
    model = learn_color(options.name, pictures, date.today().isoformat())
    path = options.out or own_colors() / f"{options.name}{SUFFIX}"
    replaced = ", which replaces the earlier one" if path.exists() else ""
    save_color(path, model)
    count = len(pictures)
    report(f'learned "{options.name}" from {count} picture{"s" * (count != 1)}: {path}{replaced}')
    return left_out.status


def _from_files(options: argparse.Namespace, left_out: LeftOut) -> Iterator[Taught]:
    for file, still in stills_of(options.images, left_out):
        try:
            yield still.image, _boxes(options, still.image), still.alpha
        except HriError as error:
            left_out.add(f"{file}: {error}")


def _boxes(options: argparse.Namespace, image: Image) -> list[Box]:
    """What has the color. Raises HriError when a box or a click is outside of the picture."""
    boxes = [*options.box, *(_around(click, image) for click in options.click)]
    for box in boxes:
        within(box, image)
    return boxes or [_middle(image)]


def _around(click: tuple[int, int], image: Image) -> Box:
    """The box around a pixel, as far as it is in the picture."""
    (x, y), (height, width) = click, image.shape[:2]
    if not (0 <= x < width and 0 <= y < height):
        what = f"the click {x},{y} is outside of a picture of {width} x {height}"
        raise HriError(f"{what} - give a column and a row in pixels")
    left, top = max(0, x - CLICK // 2), max(0, y - CLICK // 2)
    right, bottom = min(width, x + CLICK // 2), min(height, y + CLICK // 2)
    return left, top, right - left, bottom - top


def _from_camera(options: argparse.Namespace) -> Iterator[Taught]:
    is_live = options.video is None and not options.simulated
    options.seconds = min(options.seconds, SECONDS)
    with opened_camera(options, RealClock() if is_live else FakeClock()) as camera:
        due = 0.0
        for frame in frames_of(camera, options.seconds):
            if frame.time >= due:
                due = frame.time + EVERY
                yield frame.image, _boxes(options, frame.image), None


def _middle(image: Image) -> Box:
    height, width = image.shape[:2]
    size = max(1, round(width * MIDDLE)), max(1, round(height * MIDDLE))
    return (width - size[0]) // 2, (height - size[1]) // 2, *size


def _numbers(count: int) -> type:
    """A type for argparse: whole numbers with commas between."""

    class Numbers(tuple[int, ...]):
        def __new__(cls, text: str) -> Numbers:
            parts = tuple(int(part) for part in text.split(","))
            if len(parts) != count:
                raise ValueError(f"not {count} numbers")
            return super().__new__(cls, parts)

    Numbers.__name__ = f"{count} whole numbers with commas between"
    return Numbers
