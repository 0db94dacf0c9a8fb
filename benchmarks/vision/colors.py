"""Learned colors in other rooms and lights: how many balls are found, and what else is."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from benchmarks.progress import progress
from benchmarks.vision.color_scenes import (
    COLORS,
    LIGHTS,
    ColorScene,
    Light,
    learned,
    rooms,
    scenes,
)
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.core.signals import ColorBlob
from hri.vision.color.color_mixture import ratio_table
from hri.vision.color.color_model import find_color
from hri.vision.color.segmentation import ColorSegmenter, tables_of

TAUGHT_IN = ("coffee", "rocket"), ("chelsea", "biden"), ("brick", "obama")
"""Pairs of rooms that the colors are learned in, one set after the other."""
PEOPLE = "20"
"""What the names of the rooms begin with in which they are looked for."""
SURE = 0.5
FOUND, FALSE, RED = 0.9, 1.0, 0.05
SEED = 41


@dataclass(frozen=True, slots=True)
class Count:
    """What was found in pictures with a ball of each color."""

    balls: int = 0
    found: int = 0
    wrong: int = 0
    """Balls that were given the name of another color, with confidence."""
    elsewhere: int = 0
    """Blobs beside the balls, with confidence."""

    def __add__(self, other: Count) -> Count:
        return Count(
            self.balls + other.balls,
            self.found + other.found,
            self.wrong + other.wrong,
            self.elsewhere + other.elsewhere,
        )


def counted(made: ColorScene, blobs: Iterable[ColorBlob]) -> Count:
    """What is right and wrong about the blobs of a picture."""
    found, wrong, elsewhere = set(), 0, 0
    for blob in blobs:
        there = next((ball for ball in made.balls if ball.shows(blob.x, blob.y)), None)
        if there is not None and there.color == blob.name:
            found.add(blob.name)
        elif blob.confidence > SURE:
            wrong += there is not None
            elsewhere += there is None
    return Count(len(made.balls), len(found), wrong, elsewhere)


def measured(
    segmenter_of: dict[str, ColorSegmenter], names: list[str], light: Light, seed: int
) -> Count:
    """In a light, over rooms; each picture by itself."""
    total = Count()
    for segmenter in segmenter_of.values():
        for made in scenes(names, light, seed):
            total += counted(made, segmenter.segment(made.image))
    return total


def segmenter(pair: tuple[str, str], seed: int) -> ColorSegmenter:
    """That finds the colors of the balls as two rooms have taught them."""
    models = learned(pair, seed).values()
    return ColorSegmenter(
        {one.name: ratio_table(one.color, one.background, one.brightness) for one in models}
    )


def rows(quick: bool) -> Iterator[Row]:
    """By the light; then the pictures of the rooms themselves."""
    names = [name for name in rooms() if name.startswith(PEOPLE)]
    pairs = TAUGHT_IN[:1] if quick else TAUGHT_IN
    taught = {pair[0]: segmenter(pair, SEED + n) for n, pair in enumerate(pairs)}
    total = Count()
    for number, (light, made) in enumerate(progress(LIGHTS.items(), len(LIGHTS), "lights")):
        count = measured(taught, names, made, 100 * number)
        total += count
        row = share(f"balls found, light: {light}", count.found, count.balls, at_least(FOUND))
        yield row | {"wrong_names": count.wrong, "elsewhere": count.elsewhere}
    pictures = total.balls // len(COLORS)
    yield share("balls with a wrong name", total.wrong, total.balls, at_most(0))
    what = "blobs beside the balls, with confidence"
    yield amount(what, total.elsewhere / pictures, "a picture", at_most(FALSE), of=pictures)
    red = ColorSegmenter(tables_of([find_color("red_ball")]))
    seen = sum(
        any(blob.confidence > SURE for blob in red.segment(room)) for room in rooms().values()
    )
    yield share("pictures without one that show red_ball", seen, len(rooms()), at_most(RED))
