"""The frames of a face that says a sentence, drawn offscreen.

for picture, time in speaking_frames("Hello.", "person", "happy", size=(320, 240)):
    ...                                     # RGB, uint8, [240, 320, 3]; seconds
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from hri.core.clock import FakeClock
from hri.core.signals import Expression, Image, Speech
from hri.face.model import FaceModel, load_face
from hri.face.scene import scene_of
from hri.face.still import still_vector
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import Synthesizer


class Frame(NamedTuple):
    """One picture of a moving face."""

    picture: Image
    """RGB, uint8, [height, width, 3]."""
    time: float
    """Seconds from the start of the sound."""


def speaking_frames(
    text: str | Speech,
    face: str | Path | FaceModel = "robot",
    expression: str = "neutral",
    *,
    size: tuple[int, int] = (640, 480),
    rate: float = 25.0,
    seed: int = 0,
) -> Iterator[Frame]:
    """Pictures of a face that says a sentence, one after the other, as they are asked for.

    A text is spoken by espeak-ng; a `Speech` brings its sound and phonemes. `size` is width and
    height in pixels, `rate` is in pictures a second, and `seed` is that of its idle life. The last
    second is the silence after it. The same arguments give the same bytes. Raises HriError for an
    unknown face or expression, a size out of range, or where espeak-ng is not installed.
    """
    from hri.face.renderers.renderer import Renderer

    model = face if isinstance(face, FaceModel) else load_face(face)
    still_vector(model, expression)  # raises for one that the face does not know
    renderer = Renderer(model, size)
    speech = said(text) if isinstance(text, str) else text
    for moment in scene_of(speech, Expression(expression)).moments(model, rate, seed):
        yield Frame(renderer.render(moment.vector), moment.time)


def said(text: str) -> Speech:
    """A sentence by espeak-ng, with the times of its phonemes. Raises HriError without it."""
    with ResourceManager([Description("voice", "Hri.EspeakVoice")], FakeClock()) as resources:
        return resources.obtain("voice", Synthesizer).synthesize(text)
