"""Balls of learned colors in photographs, which are not part of the project, in other lights."""

import pytest

from benchmarks.vision import color_scenes, colors
from hri.core.errors import NotAvailable
from hri.core.signals import ColorBlob
from hri.vision.color.color_model import find_color
from hri.vision.color.segmentation import ColorSegmenter, tables_of

ROOMS = ["2007_007763", "2008_002079", "2009_004587"]


@pytest.fixture(scope="module")
def taught():
    try:
        return {"balls": colors.segmenter(("coffee", "rocket"), 41)}
    except NotAvailable as why:
        pytest.skip(str(why))


@pytest.mark.proves("R10")
@pytest.mark.parametrize(
    ("light", "least"), [("half", 11), ("0.3", 11), ("strong warm", 11), ("gamma 1.8", 8)]
)
def test_a_color_is_found_in_another_light_and_little_else(taught, light, least):
    count = colors.measured(taught, ROOMS, color_scenes.LIGHTS[light], 5)
    assert count.balls == 12
    assert count.found >= least
    assert count.wrong == 0
    assert count.elsewhere <= len(ROOMS)


def test_photographs_without_a_red_ball_show_none(taught):
    segmenter = ColorSegmenter(tables_of([find_color("red_ball")]))
    for room in color_scenes.rooms().values():
        assert all(blob.confidence < 0.6 for blob in segmenter.segment(room))


def test_what_was_found_is_counted_right():
    balls = (color_scenes.Ball("red", 50, 50, 20), color_scenes.Ball("blue", 150, 50, 20))
    made = color_scenes.ColorScene(None, balls)

    def blob(name, x, confidence=1.0):
        return ColorBlob(name, x, 50.0, 40.0, 40.0, 1000.0, (), confidence=confidence)

    found = [blob("red", 50, 0.2), blob("red", 150), blob("blue", 300), blob("blue", 310, 0.2)]
    assert colors.counted(made, found) == colors.Count(2, 1, 1, 1)
