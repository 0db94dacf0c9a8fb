"""Films of people who wave, point, and show an open hand or a thumb: drawn people, rendered hands.

Each film is one person before a photograph, who makes gestures with rests between, and movements of
the hands that mean nothing. What they do is known to the picture. Hands, arms, people, light, noise
and speed are drawn by lot.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from benchmarks.vision.rendered_hand import Bent, HandMesh, Placed, shown, turned
from hri.core.signals import Frame, Image
from hri.simulation.people.actors import ACTORS, Appearance

SIZE = (640, 480)
RATE = 15.0
LEAD = 2.0
"""Seconds before anything happens, in which the person is found."""
RISE = 0.45
"""Seconds in which a hand is raised or lowered."""
GESTURES = ("wave", "stop", "thumb_up", "thumb_down", "point")
NOTHINGS = ("talk", "lift", "fist", "scratch", "carry")
THUMB = {"thumb_up": 65.0, "thumb_down": -115.0}
"""Degrees by which a hand is turned so that its thumb points there in the picture: up to 30 aside,
by how it is yawed."""
LENGTH = 0.83
"""Of a hand, from the wrist to the tip, in heights of the head: 19 cm of 23."""


@dataclass(frozen=True)
class Deed:
    """What a hand does from a time on."""

    kind: str
    start: float
    """Seconds, when the hand begins to rise."""
    held: float
    """Seconds from when it is up to when it is lowered."""
    is_left: bool
    place: tuple[float, float]
    """Where it is held, in heights of the head from the middle of the face; to the outside."""
    hertz: float
    swing: float
    """Degrees to each side of a wave."""
    roll: float
    yaw: float
    pitch: float
    shape: Bent

    @property
    def end(self) -> float:
        return self.start + 2 * RISE + self.held


@dataclass(frozen=True)
class HandFilm:
    """One person, and what they do."""

    seed: int
    actor: str
    head: float
    """Pixels, height of the head."""
    center: tuple[float, float]
    room: int
    noise: float
    light: float
    deeds: tuple[Deed, ...]

    @property
    def duration(self) -> float:
        return self.deeds[-1].end + 1.2 if self.deeds else 10.0


def made_film(seed: int, kinds: Sequence[str], actors: Sequence[str], rooms: int) -> HandFilm:
    """A film by lot, in which these are done one after the other."""
    random = np.random.default_rng(seed)
    time, deeds = LEAD, []
    for kind in kinds:
        deeds.append(_deed(kind, time, random))
        time = deeds[-1].end + float(random.uniform(0.8, 1.6))
    head = float(random.uniform(75, 115))
    return HandFilm(
        seed,
        actors[int(random.integers(len(actors)))],
        head,
        (float(random.uniform(260, 380)), float(random.uniform(0.9, 1.3)) * head),
        int(random.integers(rooms)),
        float(random.uniform(1, 4)),
        float(random.uniform(0.6, 1.1)),
        tuple(deeds),
    )


def _deed(kind: str, start: float, random: np.random.Generator) -> Deed:
    uniform = random.uniform
    side = (float(uniform(0.95, 1.5)), float(uniform(0.2, 0.9)))
    shape, roll, yaw, pitch = Bent(), random.normal(0, 8), random.normal(0, 12), random.normal(0, 8)
    held = float(uniform(1.4, 2.4))
    match kind:
        case "wave":
            held = float(uniform(2.0, 3.2))
        case "thumb_up" | "thumb_down":
            shape = shown(0)
            up = 1 if kind == "thumb_up" else -1
            roll, yaw = THUMB[kind] + random.normal(0, 12), up * uniform(-10, 60)
            side = (float(uniform(0.5, 1.3)), float(uniform(0.8, 1.5)))
        case "point":
            shape = shown(1)
            roll = -uniform(40, 115)
            side = (float(uniform(1.0, 1.5)), float(uniform(0.4, 1.1)))
        case "talk":
            half = float(uniform(25, 45))
            shape = Bent(((15.0, 15.0, 10.0), *(((half, half, 0.6 * half),) * 4)))
            roll, yaw = -uniform(20, 70), uniform(-50, 50)
            side = (float(uniform(0.5, 1.0)), float(uniform(1.2, 1.8)))
        case "fist":
            shape = shown()
        case "scratch":
            half = float(uniform(20, 40))
            shape = Bent(((10.0, 10.0, 10.0), *(((half, half, half),) * 4)))
            yaw, roll = 180 + uniform(-30, 30), 30 + random.normal(0, 15)
            side = (0.55, float(uniform(-0.3, 0.3)))
        case "lift":
            held = 0.0
        case "carry":
            shape = Bent((STIFF, *((STIFF,) * 4)))
            roll, pitch = -uniform(60, 100), uniform(20, 60)
            side = (float(uniform(0.6, 1.2)), float(uniform(1.2, 1.7)))
    return Deed(
        kind,
        start,
        held,
        bool(random.random() < 0.5),
        side,
        float(uniform(1.0, 2.2)),
        float(uniform(15, 30)),
        float(roll),
        float(yaw),
        float(pitch),
        shape.shaken(random),
    )


STIFF = (45.0, 20.0, 15.0)
"""A hand that holds a box, say."""


def frames(film: HandFilm, mesh: HandMesh, rooms: Sequence[Image]) -> Iterator[Frame]:
    """The pictures of a film."""
    random = np.random.default_rng(film.seed + 1)
    room = cv2.resize(rooms[film.room % len(rooms)], SIZE, interpolation=cv2.INTER_AREA)
    red, green, blue = random.integers(30, 200, 3).tolist()
    sleeve = red, green, blue
    light = (float(random.uniform(-0.8, 0.8)), -0.6, -0.8)
    before: Image = np.ascontiguousarray(room, np.uint8).copy()
    yaw, pitch = random.normal(0, 0.1, 2).tolist()
    Appearance(film.actor, pitch, yaw, 0.0, film.center, film.head).paint(before)
    for number in range(round(film.duration * RATE)):
        time = number / RATE
        image = before.copy()
        for deed in film.deeds:
            if deed.start <= time <= deed.end:
                placed = _placed(film, deed, time, sleeve, light)
                mesh.draw(image, deed.shape, placed)
        lit = cv2.GaussianBlur(image, (0, 0), 0.7).astype(np.float32) * film.light
        noisy = lit + random.normal(0, film.noise, image.shape)
        yield Frame(np.clip(noisy, 0, 255).astype(np.uint8), time, number)


def _placed(
    film: HandFilm,
    deed: Deed,
    time: float,
    sleeve: tuple[int, int, int],
    light: tuple[float, float, float],
) -> Placed:
    """Where the hand is: up from the lap, held, and down again."""
    outside = 1 if deed.is_left else -1
    gone = time - deed.start
    raised = _eased(min(gone, deed.end - time) / RISE)
    phase = math.sin(math.tau * deed.hertz * (gone - RISE))
    x, y = deed.place
    roll = deed.roll
    if deed.kind == "wave":
        roll += deed.swing * phase
        x += 0.012 * deed.swing * phase
    elif deed.kind in ("talk", "carry"):
        x += 0.25 * phase
        y += 0.15 * math.sin(5.1 * time)
        roll += 12 * math.sin(3.3 * time)
    else:
        x += 0.02 * math.sin(4 * time)
    lap = film.head * 3.6
    length = LENGTH * film.head * 1.1
    place_x = film.center[0] + outside * x * film.head
    place_y = film.center[1] + y * film.head + (1 - raised) * lap
    elbow = film.center[0] + outside * 1.25 * film.head, film.center[1] + 2.6 * film.head
    if deed.kind == "point":
        elbow = film.center[0] + outside * 0.7 * film.head, film.center[1] + 2.0 * film.head
    # The roll is written as of a left hand; that of a right one is mirrored.
    turn = turned(outside * _sense(deed) * roll, outside * deed.yaw, deed.pitch)
    return Placed(
        place_x, place_y, length, turn, deed.is_left, ACTORS[film.actor].skin, sleeve, elbow, light
    )


def _sense(deed: Deed) -> float:
    """A thumb is turned up inward, a finger points outward."""
    return -1.0 if deed.kind in ("point", "talk", "carry") else 1.0


def _eased(part: float) -> float:
    part = min(1.0, max(0.0, part))
    return part * part * (3 - 2 * part)


def rooms_of(folder: Path) -> list[Image]:
    """The photographs of a folder that can be read, in the order of their names."""
    found = []
    for file in sorted(folder.iterdir()):
        image = cv2.imread(str(file)) if file.suffix in (".jpg", ".png") else None
        if image is not None:
            found.append(np.ascontiguousarray(image[..., ::-1]).astype(np.uint8))
    return found
