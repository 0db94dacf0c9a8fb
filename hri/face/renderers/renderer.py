"""Draws a face model: weights in, an RGB picture out, or RGBA without its background."""

from __future__ import annotations

from collections.abc import Collection

import cv2
import numpy as np

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Image
from hri.face.drawing.baking import Vector
from hri.face.layers import LAYERS
from hri.face.model import FaceModel
from hri.face.renderers.instructions import Picture
from hri.face.renderers.painter import Painter, of_layers
from hri.face.renderers.program import packed


class Renderer:
    """Draws one face at one size, one picture at a time; the same weights give the same bytes, on
    another kind of processor up to one step of a few pixels (docs/testing.md).

    The first pictures of a process are drawn without compiled loops, a tenth of a second each; in a
    new installation the ninth takes some seconds more, in which the loops are compiled.
    """

    def __init__(
        self,
        model: FaceModel,
        size: tuple[int, int] = (640, 480),
        *,
        transparent: bool = False,
        layers: Collection[str] = (),
    ) -> None:
        """`size` is width and height in pixels. `transparent` leaves the background out; with
        `layers` only the parts in these layers of its face.toml are drawn.

        Raises HriError for a size out of range, a layer that the face does not have, or a face
        with too deep clip paths.
        """
        items = model.display.items
        if layers:
            _check_layers(model, layers)
            items = tuple(of_layers(items, model.settings.layers, layers))
        self._painter = Painter(model, items, size)
        self.model = model
        self.width, self.height = size
        shape = (self.height, self.width)
        self._channels = 4 if transparent else 3
        self._conversion = cv2.COLOR_mRGBA2RGBA if transparent else cv2.COLOR_RGBA2RGB
        self._ground = np.zeros(shape, np.uint32) if transparent else _background(model, *size)
        self._canvas = np.empty(shape, np.uint32)

    @property
    def background(self) -> Image:
        """What is behind the drawing."""
        out = np.empty((self.height, self.width, self._channels), np.uint8)
        return self._convert(self._ground, out)

    def render(self, vector: Vector, out: Image | None = None) -> Image:
        """The picture, [height, width, 3] RGB, for weights of all channels of the model.

        A transparent one is [height, width, 4]: RGB, not multiplied with the opacity, and that;
        a pixel that is half covered is half opaque. It is written into `out`, an array of this
        shape and uint8 without gaps, or into a new one. Raises HriError for weights that are not
        finite, ValueError for an `out` that does not fit.
        """
        shape = (self.height, self.width, self._channels)
        if out is None:
            out = np.empty(shape, np.uint8)
        elif out.shape != shape or out.dtype != np.uint8 or not out.flags.c_contiguous:
            raise ValueError(f"out is {out.dtype}, {out.shape} - give uint8, {shape}, contiguous")
        np.copyto(self._canvas, self._ground)
        self._painter.paint(vector, self._canvas)
        return self._convert(self._canvas, out)

    def _convert(self, canvas: Picture, out: Image) -> Image:
        channels = canvas.view(np.uint8).reshape(self.height, self.width, 4)
        cv2.cvtColor(channels, self._conversion, dst=out)
        return out


def _check_layers(model: FaceModel, layers: Collection[str]) -> None:
    """Raises HriError for one that there is not, or that the face has no parts in."""
    for layer in layers:
        if layer not in LAYERS:
            raise HriError(f'no layer "{layer}" - {did_you_mean(layer, LAYERS)}')
        if layer not in model.settings.layers.patterns.values():
            what = f'the face {model.name} has no layer "{layer}"'
            raise HriError(f'{what} - add {layer} = ["eye*"] or the like to [layers], face.toml')


def _background(model: FaceModel, width: int, height: int) -> Picture:
    """From the middle color to that of the corners, round."""
    middle, corners = (np.array(color, np.float32) for color in model.settings.background)
    x, y = (
        np.linspace(-1, 1, side, dtype=np.float32) * np.float32(1 - 1 / side)
        for side in (width, height)
    )
    away = np.sqrt(np.add.outer(y * y, x * x)) / np.float32(np.sqrt(2))
    share = np.clip(away, 0, 1)[..., None]
    share = share * share * (3 - 2 * share)
    return packed(middle + (corners - middle) * share)
