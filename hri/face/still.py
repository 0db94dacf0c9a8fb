"""One picture of a face, drawn offscreen."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Gaze, Image
from hri.face import idle
from hri.face.baking import Vector
from hri.face.mixer import Layers, Mixer
from hri.face.model import FaceModel, load_face


def render_face(
    face: str | Path | FaceModel = "robot",
    expression: str = "neutral",
    intensity: float = 1.0,
    viseme: str | Mapping[str, float] | None = None,
    weights: Mapping[str, float] | None = None,
    gaze: tuple[float, float] = (0.0, 0.0),
    time: float | None = None,
    seed: int = 0,
    size: tuple[int, int] = (640, 480),
) -> Image:
    """A picture of a face: RGB, uint8, [height, width, 3]. The same arguments give the same bytes.

    `expression` is shown at its apex times `intensity` (0 to 1). `viseme` is an Oculus name or
    weights by name; it takes the mouth over as speech does. `weights` are added by target. `gaze`
    is -1 to 1: x to the viewer's right, y up. `time` in seconds adds idle life (blinks, breathing,
    small eye movements), drawn from `seed`. `size` is width and height in pixels.

    Raises HriError for an unknown name, a weight that is not finite, a face that cannot be read.
    """
    from hri.face.renderers.opencv import OpenCvRenderer

    model = face if isinstance(face, FaceModel) else load_face(face)
    vector = still_vector(model, expression, intensity, viseme, weights, gaze, time, seed)
    return OpenCvRenderer(model, size).render(vector)


def still_vector(
    model: FaceModel,
    expression: str = "neutral",
    intensity: float = 1.0,
    viseme: str | Mapping[str, float] | None = None,
    weights: Mapping[str, float] | None = None,
    gaze: tuple[float, float] = (0.0, 0.0),
    time: float | None = None,
    seed: int = 0,
) -> Vector:
    """Weights of all channels for such a picture; see `render_face`."""
    x, y = gaze
    for name, value in (("intensity", intensity), ("gaze", x), ("gaze", y), ("time", time or 0.0)):
        if not np.isfinite(value):
            raise HriError(f"{name} is {value} - give a finite number")
    if not 0 <= intensity <= 1:
        raise HriError(f"an intensity of {intensity:g} - give a number from 0 to 1")
    shown = {viseme: 1.0} if isinstance(viseme, str) else dict(viseme or {})
    shape = np.zeros(len(model.channels), np.float32)
    for name, weight in shown.items():
        shape += np.float32(weight) * model.vector(model.viseme(name))
    drift = Gaze() if time is None else idle.wandering(model.settings.idle, seed, time)
    blink = 0.0 if time is None else idle.blink_closure(model.settings.blink, seed, time)
    layers = Layers(
        expression=np.float32(intensity) * model.vector(model.expression(expression)),
        viseme=shape,
        talking=float(bool(shown)),
        blink=blink,
        gaze=Gaze(min(max(x + drift.x, -1.0), 1.0), min(max(y + drift.y, -1.0), 1.0)),
        idle={} if time is None else idle.sway(model.settings.idle, seed, time),
    )
    return Mixer(model).mix(layers) + model.vector(weights or {})
