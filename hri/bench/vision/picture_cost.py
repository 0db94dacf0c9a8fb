"""What a picture of 640x480 costs, on one core."""

from __future__ import annotations

import time
from collections.abc import Iterator

import numpy as np

from hri.bench.table import Row, amount, at_most
from hri.bench.threads import one_thread
from hri.bench.vision.seeing import seen
from hri.simulation.people.actors import ACTORS, Optics
from hri.simulation.people.body_motion import MOTIONS, Posture
from hri.simulation.people.lens import Lens
from hri.simulation.people.scripted_film import Film, Role

OPTICS = Optics(640, 480, 1.05)
SECONDS, QUICK_SECONDS = 10.0, 3.0
SETTLING = 15
"""Pictures at the start that do not count."""
LIMITS_MS = {1: 14.0, 4: 30.0}
"""By how many people there are."""
DRAWN_MS = {(320, 240): 8.0, (640, 480): 20.0}
PLACES = ((-0.62, 1.6), (-0.2, 1.5), (0.22, 1.6), (0.64, 1.5))
"""Meters to the right and ahead of up to four people."""


def rows(quick: bool) -> Iterator[Row]:
    """The chain with one and with four people, and the drawing of the pictures themselves."""
    with one_thread():
        for count, limit in LIMITS_MS.items():
            yield _chain(count, limit, QUICK_SECONDS if quick else SECONDS)
        for size, limit in DRAWN_MS.items():
            yield _drawing(size, limit)


def _chain(count: int, limit: float, seconds: float) -> Row:
    film = Film(_roles(count), seconds, 30.0, OPTICS, Lens(4.0))
    took = list(seen(film.frames(), OPTICS))[SETTLING:]
    times = [milliseconds for _, milliseconds in took]
    visible = [sum(person.is_visible for person in people.persons) for people, _ in took]
    return amount(
        f"whole chain at 640x480, {count} in the picture",
        float(np.mean(times)),
        "ms",
        at_most(limit),
        p95=round(float(np.percentile(times, 95)), 2),
        people_seen=round(float(np.mean(visible)), 2),
    )


def _roles(count: int) -> list[Role]:
    def talk(now: float) -> Posture:
        return MOTIONS["talk"].at(now % MOTIONS["talk"].duration)

    places = PLACES if count > 1 else ((0.0, 1.0),)
    return [
        Role(talk, actor, distance, right, seed)
        for seed, (actor, (right, distance)) in enumerate(
            zip(list(ACTORS)[:count], places[:count], strict=True)
        )
    ]


def _drawing(size: tuple[int, int], limit: float) -> Row:
    optics = Optics(*size, 0.6)
    film = Film(_roles(1), 2.0, 30.0, optics, Lens(4.0))
    frames, times = film.frames(), []
    for _ in range(60):
        begun = time.thread_time()
        next(frames)
        times.append((time.thread_time() - begun) * 1e3)
    what = f"drawing a picture of {size[0]}x{size[1]}"
    return amount(what, float(np.median(times)), "ms", at_most(limit))
