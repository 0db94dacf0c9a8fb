"""Two people who cross, and one who leaves and returns: whether everyone keeps their id."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

from benchmarks.progress import progress
from hri.bench.table import Row, at_least, share
from hri.bench.threads import one_thread
from hri.bench.vision.seeing import seen
from hri.bench.workers import worker_pool
from hri.core.signals import FaceBox, People
from hri.simulation.people.actors import ACTORS, Optics
from hri.simulation.people.body_motion import Posture, eased, steps
from hri.simulation.people.lens import Lens
from hri.simulation.people.scripted_film import Film, Role
from hri.vision.face_models import find_face_models

CASES, QUICK_CASES = 100, 8
SECONDS = 5.6
RATE, SLOW_RATE = 30.0, 15.0
"""Pictures a second, as cameras have them by day, and in the dark."""
SLOW_CASES = 20
OPTICS = Optics(640, 480, 1.05)
SEED = 590_000
APART = 1.3
"""Heads between two faces from which on it is plain which box is whose."""
SETTLED = 0.5
"""Seconds after two faces were close, from when on everyone must have their own id again."""
LONGEST_AWAY = 2.6
"""Seconds; ids are kept for 3."""


@dataclass(frozen=True, slots=True)
class CrossingVerdict:
    """What became of the ids in a case."""

    is_swapped: bool
    """Someone kept the id of the other."""
    is_mixed_up: bool
    """Someone had the id of the other, if only for a moment after they were close."""
    is_lost: bool
    """Someone got a new id."""


def rows(quick: bool, workers: int) -> Iterator[Row]:
    """All cases, in a number of processes."""
    find_face_models()
    count = QUICK_CASES if quick else CASES
    verdicts = _judged(count, RATE, workers)
    kept = sum(not verdict.is_swapped for verdict in verdicts)
    what = "two people who cross, one who leaves and returns: no id swapped"
    mixed_up = sum(verdict.is_mixed_up for verdict in verdicts)
    lost = sum(verdict.is_lost for verdict in verdicts)
    told = {"mixed_up_for_a_moment": mixed_up, "with_a_new_id": lost}
    yield share(what, kept, count, at_least(1.0)) | told
    slow = _judged(min(count, SLOW_CASES), SLOW_RATE, workers)
    kept = sum(not verdict.is_swapped for verdict in slow)
    yield {"what": f"the same, {SLOW_RATE:g} a second", "count": kept, "of": len(slow)}


def _judged(count: int, rate: float, workers: int) -> list[CrossingVerdict]:
    with worker_pool(workers) as pool:
        verdicts = pool.map(partial(judge, rate=rate), range(count))
        return list(progress(verdicts, count, f"crossing, {rate:g} a second"))


def judge(number: int, rate: float = RATE) -> CrossingVerdict:
    """Case of a number: every other one has someone who leaves and returns."""
    roles = crossing_roles(number) if number % 2 == 0 else _returning(number)
    lens = Lens(noise=4.0, seed=SEED + number)
    film = Film(roles, SECONDS, rate, OPTICS, lens, scene=number)
    at_once: list[set[str]] = [set(), set()]
    settled: list[set[str]] = [set(), set()]
    close = -math.inf
    with one_thread():
        for people, _ in seen(film.frames(), OPTICS):
            ids = ids_at(people, roles)
            if ids is None:
                close = people.time
                continue
            for role, id in enumerate(ids):
                if id:
                    at_once[role].add(id)
                    if people.time - close >= SETTLED:
                        settled[role].add(id)
    return CrossingVerdict(
        is_swapped=bool(settled[0] & settled[1]),
        is_mixed_up=bool(at_once[0] & at_once[1]),
        is_lost=any(len(own) > 1 for own in settled),
    )


def ids_at(people: People, roles: list[Role]) -> list[str] | None:
    """The id at the face of each role, empty where there is none; None while they are close."""
    shown = []
    for role in roles:
        held = role.posture(people.time)
        shown.append(held and OPTICS.show(role.actor, held, role.right, role.distance))
    first, second = shown
    if first and second:
        gap = math.dist(first.center, second.center)
        if gap < APART * max(first.height, second.height):
            return None
    found = []
    for appearance in shown:
        near = [
            person.id
            for person in people.persons
            if appearance
            and person.is_visible
            and person.pose.box
            and math.dist(_middle(person.pose.box), appearance.center) < 0.5 * appearance.height
        ]
        found.append(near[0] if near else "")
    return found


def _middle(box: FaceBox) -> tuple[float, float]:
    return box.x + box.width / 2, box.y + box.height / 2


def crossing_roles(number: int) -> list[Role]:
    """Both walk to where the other one was, one of them nearer to the camera."""
    dice = random.Random(f"crossing {SEED + number}")
    near, far = dice.uniform(0.9, 1.3), dice.uniform(1.5, 2.1)
    start, time = dice.uniform(1.0, 1.5), dice.uniform(1.5, 3.0)
    side = dice.choice((-1, 1))
    reach = 0.32 * near
    one, other = dice.sample(list(ACTORS), 2)
    return [
        Role(_walk(side * reach, -2 * side * reach, start, time), one, near, seed=number),
        Role(
            _walk(-side * reach * far / near, 2 * side * reach * far / near, start, time),
            other,
            far,
            seed=number + 1,
        ),
    ]


def _returning(number: int) -> list[Role]:
    """One stays, the other is gone for a moment and comes back at another place."""
    dice = random.Random(f"crossing {SEED + number}")
    distance, side = dice.uniform(1.0, 1.5), dice.choice((-1, 1))
    one, other = dice.sample(list(ACTORS), 2)
    leaves = dice.uniform(1.0, 1.6)
    returns = leaves + dice.uniform(0.8, LONGEST_AWAY)
    shift = dice.uniform(-0.1, 0.1)

    def leaving(time: float) -> Posture | None:
        if leaves <= time < returns:
            return None
        return Posture(right=shift) if time >= returns else Posture()

    aside = 0.3 * distance
    return [
        Role(actor=one, distance=distance, right=-side * aside, seed=number),
        Role(leaving, other, distance, side * aside, seed=number + 1),
    ]


def _walk(origin: float, way: float, start: float, duration: float) -> Callable[[float], Posture]:
    def walk(time: float) -> Posture:
        part = (time - start) / duration
        gone = Posture(right=origin + way * eased(part))
        return gone + steps(time) if 0 < part < 1 else gone

    return walk
