"""A sheet with all that a face can show."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image as Picture, ImageDraw, ImageFont

from hri.core.signals import Image
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector
from hri.face.vocabulary import EXPRESSIONS, STATES, VISEMES

WIDTH = 2240
"""Pixels of the sheet."""
MARGIN, GAP = 40, 14
"""Pixels around the sheet, and between pictures."""
ASPECT = 0.86
"""Height of a picture, of its width."""
LABEL, HEADING, TITLE = 24, 34, 54
"""Heights of letters in pixels."""
PAPER, INK, FAINT = (250, 248, 244), (40, 44, 52), (120, 124, 132)


@dataclass(frozen=True, slots=True)
class Section:
    """Pictures of one kind, under a heading."""

    heading: str
    columns: int
    pictures: Sequence[tuple[str, Vector]]
    """Names and weights."""


def draw_sheet(model: FaceModel) -> Image:
    """All expressions and states, then all visemes, each above its name."""
    labels = [label for label in (*EXPRESSIONS, *STATES) if label in model.expressions]
    shown = [(label, still_vector(model, label)) for label in labels]
    spoken = [(name, still_vector(model, viseme=name)) for name in VISEMES]
    sections = (Section("Expressions and states", 7, shown), Section("Visemes", 8, spoken))
    top = MARGIN + TITLE + GAP + HEADING
    height = top + sum(_height(section) for section in sections) + MARGIN
    page = Picture.new("RGB", (WIDTH, height), PAPER)
    draw = ImageDraw.Draw(page)
    draw.text((MARGIN, MARGIN), model.name, INK, _font(TITLE))
    draw.text((MARGIN, MARGIN + TITLE + GAP), model.settings.about, FAINT, _font(LABEL))
    for section in sections:
        _draw_section(page, section, model, top)
        top += _height(section)
    return np.array(page)


def _draw_section(page: Picture.Image, section: Section, model: FaceModel, top: int) -> None:
    width, height = _cell(section)
    draw = ImageDraw.Draw(page)
    draw.text((MARGIN, top + GAP), section.heading, INK, _font(HEADING))
    renderer = Renderer(model, (width, height))
    for number, (name, vector) in enumerate(section.pictures):
        row, column = divmod(number, section.columns)
        x = MARGIN + column * (width + GAP)
        y = top + 2 * GAP + round(1.3 * HEADING) + row * _step(section)
        page.paste(Picture.fromarray(renderer.render(vector)), (x, y), _rounded(width, height))
        middle = x + width / 2, y + height + 4
        draw.text(middle, name, INK, _font(LABEL), anchor="ma")


def _height(section: Section) -> int:
    rows = -(-len(section.pictures) // section.columns)
    return 2 * GAP + round(1.3 * HEADING) + rows * _step(section)


def _step(section: Section) -> int:
    """From one row to the next."""
    return _cell(section)[1] + round(1.4 * LABEL) + GAP


def _cell(section: Section) -> tuple[int, int]:
    """Width and height of each picture."""
    width = (WIDTH - 2 * MARGIN - (section.columns - 1) * GAP) // section.columns
    return width, round(width * ASPECT)


def _rounded(width: int, height: int) -> Picture.Image:
    """A mask with round corners, drawn larger and shrunk so that they are smooth."""
    large = Picture.new("L", (4 * width, 4 * height))
    box = (0, 0, 4 * width - 1, 4 * height - 1)
    ImageDraw.Draw(large).rounded_rectangle(box, radius=4 * GAP, fill=255)
    return large.resize((width, height), Picture.Resampling.BOX)


def _font(size: int) -> ImageFont.FreeTypeFont | ImageFont.ImageFont:
    return ImageFont.load_default(size)
