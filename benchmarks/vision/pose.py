"""How far a head seems to turn against how far it turns, and how quiet it is at rest."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from benchmarks.progress import progress
from hri.bench.table import Row, amount, at_least, at_most
from hri.bench.vision.seeing import seen
from hri.simulation.people.actors import ACTORS, Optics
from hri.simulation.people.body_motion import Posture
from hri.simulation.people.lens import Lens
from hri.simulation.people.scripted_film import Film, Role

RANGE = math.radians(15)
"""Of a nod, up and down."""
SWEEP = 4.0
"""Seconds from one end to the other and back."""
SETTLING = 0.5
"""Seconds at the start that do not count."""
RATE = 15.0
OPTICS = Optics(640, 480, 1.05)
DISTANCE = 1.0
"""Meters: a head of 132 pixels."""
NOISE = 4.0
"""Of the picture, standard deviation of 255."""
GAIN, QUIET = (0.9, 1.1), 0.3
"""What is asked for; degrees."""
AXES = ("pitch", "yaw")


def rows(quick: bool) -> Iterator[Row]:
    """Gain of each axis over all faces, and the noise."""
    names = list(ACTORS)[::3] if quick else list(ACTORS)
    gains: dict[str, list[float]] = {axis: [] for axis in AXES}
    noises: dict[str, list[float]] = {axis: [] for axis in AXES}
    cases = [(name, axis) for name in names for axis in AXES]
    for name, axis in progress(cases, len(cases), "pose"):
        truth, found = _swept(name, axis)
        gains[axis].append(float(np.polyfit(truth, found, 1)[0]))
        noises[axis].append(_noise(found))
    for axis in AXES:
        told = {name: round(gain, 3) for name, gain in zip(names, gains[axis], strict=True)}
        what = f"{axis} against the scripted angle, +-15 degrees, gain"
        yield amount(f"{what}, smallest", min(gains[axis]), "1", at_least(GAIN[0]), faces=told)
        yield amount(f"{what}, largest", max(gains[axis]), "1", at_most(GAIN[1]), faces=told)
    for axis in AXES:
        what = f"noise of {axis}, mean of all faces"
        yield amount(what, float(np.mean(noises[axis])), "degrees", at_most(QUIET))


def _swept(actor: str, axis: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The scripted angles and those that are seen, degrees."""

    def turn(time: float) -> Posture:
        angle = RANGE * math.sin(2 * math.pi * time / SWEEP)
        return Posture(pitch=angle) if axis == "pitch" else Posture(yaw=angle)

    role = Role(turn, actor, DISTANCE, seed=5)
    film = Film([role], SETTLING + SWEEP, RATE, OPTICS, Lens(NOISE, seed=5))
    pairs = []
    for people, _ in seen(film.frames(), OPTICS):
        held = role.posture(people.time)
        if people.time >= SETTLING and people.persons and held is not None:
            pairs.append([getattr(held, axis), getattr(people.persons[0].pose, axis)])
    truth, found = np.degrees(np.array(pairs)).T
    return truth, found


def _noise(angles: NDArray[np.float64]) -> float:
    """Standard deviation of what changes from picture to picture.

    From third differences, which a smooth movement leaves at nothing: those of white noise have a
    variance of 1 + 9 + 9 + 1 times its own.
    """
    return float(np.std(np.diff(angles, 3)) / math.sqrt(20))
