"""What a face looks like, offscreen: the frames of a sentence, and all of its expressions."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from hri.core.signals import Image, Speech
from hri.face.frames import said, speaking_frames
from hri.face.model import FaceModel, load_face
from hri.face.renderers.renderer import Renderer
from hri.face.still import still_vector

__all__ = ["SIZE", "expressions_of", "said", "spoken_frames"]

SIZE = (320, 240)
"""Width and height in pixels: enough to distinguish two faces, and drawn in a millisecond."""


def spoken_frames(
    text: str | Speech,
    face: str | FaceModel = "robot",
    expression: str = "neutral",
    *,
    rate: float = 25.0,
    size: tuple[int, int] = SIZE,
    seed: int = 0,
) -> Iterator[Image]:
    """The pictures of a face that says a sentence: RGB, uint8, [height, width, 3].

    A text is spoken by espeak-ng; a `Speech` brings its own sound and phonemes. `rate` is in
    pictures a second; the last second is the silence after it. The same arguments give the same
    bytes. Raises HriError for an unknown face or expression.
    """
    for picture, _ in speaking_frames(text, face, expression, size=size, rate=rate, seed=seed):
        yield picture


def expressions_of(
    face: str | FaceModel = "robot", size: tuple[int, int] = SIZE
) -> Mapping[str, Image]:
    """A picture of each expression of a face by name, at its apex. Raises HriError."""
    model = load_face(face) if isinstance(face, str) else face
    renderer = Renderer(model, size)
    return {name: renderer.render(still_vector(model, name)) for name in model.expressions}
