"""Cards to print: a marker or a code with its white margin, and what it is written below."""

from __future__ import annotations

import io
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from PIL import Image as Pillow, ImageDraw, ImageFont

from hri.core.errors import HriError
from hri.core.geometry import Matrix
from hri.core.signals import Image
from hri.core.writing import write_bytes
from hri.vision.markers.families import FAMILIES, QR, check_families
from hri.vision.markers.qr_codes import LONGEST, plain

PER_INCH = 300
"""Dots."""
MM = PER_INCH / 25.4
"""Dots of a millimeter."""
LETTERS = 4.0
"""Millimeters of the line below."""
KINDS = (".pdf", ".png")
MARGIN = {QR: 4}
"""White cells around the black square; a code needs more of them than the others, which get two."""


@dataclass(frozen=True, eq=False, slots=True)
class Card:
    """A card, ready to print."""

    picture: Image
    """[height, width], gray, `PER_INCH`."""
    caption: str

    @property
    def size_mm(self) -> tuple[int, int]:
        """Width and height."""
        height, width = self.picture.shape
        return round(width / MM), round(height / MM)


def marker_card(family: str, id: int, side_mm: float) -> Card:
    """The card of a marker whose black square has that side. Raises HriError."""
    check_families([family])
    if family == QR:
        raise HriError("a QR code has a text, not an id - give --text")
    cells = FAMILIES[family].cells(id)[1:-1, 1:-1]
    return _card(cells, family, f"{family}  {id}", side_mm)


def code_card(text: str, side_mm: float) -> Card:
    """The card of a QR code of that width. Raises HriError for a text that is not read as it is."""
    if not text or plain(text) != text:
        raise HriError(
            f"a text of {len(text)} characters cannot be a code"
            f" - write 1 to {LONGEST} printable ones, without spaces at its ends"
        )
    drawn = np.asarray(cv2.QRCodeEncoder.create().encode(text)) > 0
    inked = np.flatnonzero(~drawn.all(axis=0))
    inside = slice(inked[0], inked[-1] + 1)
    return _card(drawn[inside, inside].astype(np.float64), QR, f"qr  {text}", side_mm)


def write_card(path: Path, card: Card) -> None:
    """Write it as a PDF or PNG that knows its size. Raises HriError."""
    suffix = path.suffix.lower()
    if suffix not in KINDS:
        raise HriError(f'{path}: no cards of the kind "{suffix}" - write .pdf or .png')
    page = Pillow.fromarray(card.picture)
    data = io.BytesIO()
    if suffix == ".pdf":
        page.save(data, "PDF", resolution=float(PER_INCH), title=card.caption)
    else:
        page.save(data, "PNG", dpi=(PER_INCH, PER_INCH))
    write_bytes(path, data.getvalue())


def _card(cells: Matrix, family: str, name: str, side_mm: float) -> Card:
    side = round(side_mm * MM)
    margin = round(side * MARGIN.get(family, 2) / len(cells))
    # A cell is whole dots or a dot more, so that its edges stay sharp.
    ends = np.linspace(0, len(cells), side, endpoint=False).astype(int)
    square = (cells[np.ix_(ends, ends)] * 255).astype(np.uint8)
    caption = f"{name}  {side_mm:g} mm"
    line = _letters(caption, side + 2 * margin)
    page = np.full((side + 2 * margin + line.shape[0], side + 2 * margin), 255, np.uint8)
    page[margin : margin + side, margin : margin + side] = square
    page[-line.shape[0] :] = line
    page[[0, -1], :] = 190  # where to cut
    page[:, [0, -1]] = 190
    return Card(page, caption)


def _letters(caption: str, width: int) -> Image:
    """A line of text, as far as it fits."""
    height = round(2 * LETTERS * MM)
    line = Pillow.new("L", (width, height), 255)
    font = ImageFont.load_default(round(min(LETTERS * MM, width / 16)))
    ImageDraw.Draw(line).text((width / 2, height / 4), caption, 90, font=font, anchor="mt")
    return np.asarray(line, np.uint8)
