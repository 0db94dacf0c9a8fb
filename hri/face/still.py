"""One picture of a face, drawn offscreen."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np

from hri.core.errors import HriError
from hri.core.signals import Gaze, Image
from hri.face.drawing.baking import Vector
from hri.face.model import FaceModel, load_face
from hri.face.motion import idle
from hri.face.motion.affect_map import AffectMap
from hri.face.motion.blinking import blink_closure
from hri.face.motion.mixer import Layers, Mixer
from hri.face.vocabulary import TURNS


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
    valence: float | None = None,
    arousal: float | None = None,
    yaw: float = 0.0,
    pitch: float = 0.0,
    *,
    transparent: bool = False,
    layers: Collection[str] = (),
) -> Image:
    """A picture of a face: RGB, uint8, [height, width, 3]. The same arguments give the same bytes.

    `expression` is shown at its apex times `intensity` (0 to 1). `valence` and `arousal`, -1 to 1,
    are the mood below it, and arousal widens the pupils; one alone takes 0 for the other. `viseme`
    is an Oculus name or weights by name; it takes the mouth over as speech does. `weights` are
    added by target. `gaze` is -1 to 1: x to the viewer's right, y up. `yaw` and `pitch` turn the
    head to the viewer's right and up, in degrees, as far as the face allows. `time` in seconds adds
    idle life and nothing else (blinks, breathing, small eye movements), drawn from `seed`. `size`
    is width and height in pixels. A `transparent` picture is RGBA, [height, width, 4], without the
    background; its colors are not multiplied with the opacity. `layers` are those of its face.toml
    to draw, such as ("ink",).

    Raises HriError for an unknown name, a number that is not finite or out of range, a face that
    cannot be read.
    """
    from hri.face.renderers.renderer import Renderer

    model = face if isinstance(face, FaceModel) else load_face(face)
    vector = still_vector(
        model,
        expression,
        intensity,
        viseme,
        weights,
        gaze,
        time,
        seed,
        valence,
        arousal,
        yaw,
        pitch,
    )
    renderer = Renderer(model, size, transparent=transparent, layers=layers)
    return renderer.render(vector)


def still_vector(
    model: FaceModel,
    expression: str = "neutral",
    intensity: float = 1.0,
    viseme: str | Mapping[str, float] | None = None,
    weights: Mapping[str, float] | None = None,
    gaze: tuple[float, float] = (0.0, 0.0),
    time: float | None = None,
    seed: int = 0,
    valence: float | None = None,
    arousal: float | None = None,
    yaw: float = 0.0,
    pitch: float = 0.0,
) -> Vector:
    """Weights of all channels for such a picture; see `render_face`."""
    _check_range("intensity", intensity, 0, 1)
    for way, value in zip(("x", "y"), gaze, strict=True):
        _check_range(f"gaze {way}", value, -1, 1)
    shown = {viseme: 1.0} if isinstance(viseme, str) else dict(viseme or {})
    layers = Layers(
        expression=_feeling(model, expression, intensity, valence, arousal),
        viseme=_shape(model, shown),
        talking=float(bool(shown)),
        gaze=Gaze(*gaze),
    )
    if time is not None:
        layers = _alive(layers, model, time, seed, expression)
    moved = model.vector(_turn(model, yaw, pitch)) + model.vector(weights or {})
    return Mixer(model).mix(layers) + moved


def _feeling(
    model: FaceModel,
    expression: str,
    intensity: float,
    valence: float | None,
    arousal: float | None,
) -> Vector:
    """The expression, over the mood if there is one."""
    asked = np.float32(intensity) * model.vector(model.expression(expression))
    if valence is None and arousal is None:
        return asked
    for name, value in (("valence", valence), ("arousal", arousal)):
        _check_range(name, value or 0.0, -1, 1)
    mood = AffectMap(model).weights(valence or 0.0, arousal or 0.0)
    mood = mood + np.float32(arousal or 0.0) * model.vector(model.settings.pupils)
    if expression == "neutral":
        return mood
    return np.float32(1 - intensity) * mood + asked


def _shape(model: FaceModel, visemes: Mapping[str, float]) -> Vector:
    shape = np.zeros(len(model.channels), np.float32)
    for name, weight in visemes.items():
        _check_range(f"the viseme {name}", weight, 0, 1.5)
        shape += np.float32(weight) * model.vector(model.viseme(name))
    return shape


def _turn(model: FaceModel, yaw: float, pitch: float) -> dict[str, float]:
    """Weights of the turns of the head, for degrees."""
    head = model.settings.head
    if head is None:
        if yaw or pitch:
            what = f"the head of the face {model.name} does not turn"
            raise HriError(f"{what} - leave yaw and pitch at 0, or add [head] to its face.toml")
        return {}
    turns = {}
    asked = zip(TURNS, ("yaw", "pitch"), (yaw, pitch), (head.yaw, head.pitch), strict=True)
    for channel, name, degrees, limit in asked:
        _check_range(name, degrees, -limit, limit)
        turns[channel] = degrees / limit if limit else 0.0
    return turns


def _alive(layers: Layers, model: FaceModel, time: float, seed: int, expression: str) -> Layers:
    """With the idle life of a moment; who is asleep does not blink."""
    if not math.isfinite(time):
        raise HriError(f"time is {time} - give a number of seconds")
    state = expression if expression in idle.STATES else "resting"
    life, settings = idle.STATES[state], model.settings
    drift = idle.wandering(settings.idle, seed, time, state)
    moves = idle.sway(settings.idle, seed, time, state)
    if settings.head is not None:
        moves |= dict(zip(TURNS, idle.turning(settings.idle, seed, time, state), strict=True))
    return replace(
        layers,
        blink=blink_closure(settings.blink, seed, time, settings.blink.rate * life.blinks),
        gaze=Gaze(_within(layers.gaze.x + drift.x), _within(layers.gaze.y + drift.y)),
        idle=moves,
    )


def _within(value: float) -> float:
    return min(max(value, -1.0), 1.0)


def _check_range(name: str, value: float, least: float, most: float) -> None:
    """Raises HriError for a value that is out of range or not finite."""
    if not least <= value <= most:
        raise HriError(f"{name} is {value:g} - give a number from {least:g} to {most:g}")
