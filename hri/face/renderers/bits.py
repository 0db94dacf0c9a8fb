"""One bit a pixel from the layers of a face, not from a threshold over its colors.

Parts of the body and of the face are one tone, with a contour in the other that separates them
from each other and from a ground of either tone; ink is the other tone, and as thick as it takes
to be seen. What is in no layer is not drawn, nor is the background.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from hri.core.signals import Image
from hri.face.drawing.baking import Item, Opening, Shape, Vector
from hri.face.drawing.paint import Solid
from hri.face.model import FaceModel
from hri.face.renderers.painter import Painter, Pen
from hri.face.renderers.renderer import Renderer
from hri.face.renderers.small_screens import Bits, black_and_white, one_bit

CONTOURS = {"body": 2.0, "face": 1.5}
"""Pixels around a part, by layer: within the body there is less room."""
THINNEST = 2.0
"""Pixels of a line of ink."""
SPREAD = 1.0
"""Pixels that a filled part of ink is wider than drawn: half of it on each side."""
TONES = {True: Solid((255, 255, 255)), False: Solid((0, 0, 0))}


def face_bits(
    model: FaceModel, vector: Vector, size: tuple[int, int] = (128, 64), *, ground: bool = False
) -> Bits:
    """Lit pixels, [height, width], of a face for weights of all channels of its model.

    `size` is width and height in pixels, 16 to 4096; `ground` says whether what is behind the face
    is lit. A face without [layers] is drawn in its colors, of which those lighter than half are
    lit. Raises HriError for a size out of range or weights that are not finite.
    """
    return BitRenderer(model, size, ground=ground).render(vector)


class BitRenderer:
    """Draws one face at one size in one bit, one picture at a time."""

    def __init__(self, model: FaceModel, size: tuple[int, int], *, ground: bool = False) -> None:
        """`size` is width and height in pixels, `ground` whether what is behind the face is lit.

        Raises HriError for a size out of range.
        """
        self.model = model
        self._colors = Renderer(model, size) if not model.settings.layers.patterns else None
        inking = _Inking(model)
        self._painter = Painter(model, tuple(inking.items(model.display.items)), size, inking.pens)
        self._canvas = np.empty((size[1], size[0]), np.uint32)
        self._ground = 0xFFFFFFFF if ground else 0xFF000000

    def render(self, vector: Vector) -> Bits:
        """Lit pixels, [height, width]. Raises HriError for weights that are not finite."""
        if self._colors is not None:
            return one_bit(self._colors.render(vector))
        self._canvas.fill(self._ground)
        self._painter.paint(vector, self._canvas)
        return np.asarray(self._canvas & 0xFF >= 128)

    def picture(self, vector: Vector) -> Image:
        """The same in black and white, [height, width, 3]."""
        return black_and_white(self.render(vector))


class _Inking:
    """Items of a display list in two tones, with the pens that draw their contours."""

    def __init__(self, model: FaceModel) -> None:
        self.pens: list[Pen] = []
        self._layers = model.settings.layers
        self._first = len(model.display.neutral) - 2 * model.display.points

    def items(self, items: Iterable[Item]) -> Iterator[Item]:
        """Those of the layers, each behind its contour."""
        for item in items:
            if isinstance(item, Opening):
                yield Opening(item.clip, tuple(self.items(item.content)))
            elif (layer := self._layers.of(item.id)) is not None:
                is_lit = layer in self._layers.lit
                contour = CONTOURS.get(layer)
                if contour is None:
                    yield from self._ink(item, is_lit)
                else:
                    yield self._line(item, not is_lit, added=2 * contour)
                    yield replace(item, paint=TONES[is_lit])

    def _ink(self, shape: Shape, is_lit: bool) -> Iterator[Shape]:
        if shape.is_stroke:
            yield self._line(shape, is_lit, least=THINNEST)
        else:
            yield replace(shape, paint=TONES[is_lit])
            yield self._line(shape, is_lit, added=SPREAD)

    def _line(self, shape: Shape, is_lit: bool, added: float = 0.0, least: float = 0.0) -> Shape:
        scalar = self._first + 2 * len(self.pens)
        self.pens.append(Pen(shape.opacity, added, least))
        return replace(shape, paint=TONES[is_lit], opacity=scalar, is_stroke=True)
