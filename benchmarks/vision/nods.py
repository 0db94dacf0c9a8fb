"""Films of repeated nods, and of what must not be taken for one; no question is open.

Before the first of the nods the head turns by 20 degrees; the pictures are blurred and noisy.
"""

from __future__ import annotations

import math
import random
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from benchmarks.progress import progress
from hri.bench.table import Row, amount, at_least, at_most
from hri.bench.threads import one_thread
from hri.bench.vision.seeing import seen
from hri.bench.workers import worker_pool
from hri.core.signals import HeadGesture
from hri.simulation.people.actors import ACTORS, Optics
from hri.simulation.people.body_motion import Posture, eased, nod_angles
from hri.simulation.people.lens import Lens
from hri.simulation.people.scripted_film import Film, Role
from hri.vision.face_models import find_face_models
from hri.vision.gestures.gesture_behaviors import PeopleGestures
from hri.vision.gestures.gesture_patterns import NOD, SHAKE, answer_patterns

RATES = (30.0, 15.0)
SEEDS = 5
DURATION = 30.0
"""Seconds of a film."""
NODS, FOUND = 20, 18
"""In a film, and how many of them must be recognized."""
TURN_AT, TURN_S, TURN = 0.4, 0.5, math.radians(20)
"""When the head turns before the first nod, how long that takes, and how far it goes."""
FIRST, EVERY = 1.2, 1.42
"""Seconds, when the first nod begins, and from each to the next."""
SLACK = 0.4
"""Seconds after its end in which a nod may still be recognized."""
HERTZ, DEGREES, CYCLES = (1.7, 2.4), (6.0, 12.0), 2.0
"""Of the nods."""
PICTURE_S = (0.25, 0.6)
"""Seconds that each of the switched pictures is shown."""

Motion = Callable[[float], Posture]


@dataclass(frozen=True, slots=True)
class Nods:
    """When someone nods, and how."""

    starts: tuple[float, ...]
    hertz: tuple[float, ...]
    amplitudes: tuple[float, ...]
    """Radians."""
    stays_turned: bool
    """Whether the head goes on looking aside; else it comes back before the first nod."""

    def __call__(self, time: float) -> Posture:
        turned = eased((time - TURN_AT) / TURN_S)
        if not self.stays_turned:
            turned *= 1.0 - eased((time - TURN_AT) / TURN_S - 0.5)
        held = Posture(yaw=TURN * turned)
        for start, hertz, amplitude in zip(self.starts, self.hertz, self.amplitudes, strict=True):
            if start <= time:
                angles = nod_angles(
                    time - start, amplitude=amplitude, frequency=hertz, cycles=CYCLES
                )
                held += Posture(*angles)
        return held

    def spans(self) -> list[tuple[float, float]]:
        """Beginning of each nod, and until when it may be recognized."""
        ends = [
            start + CYCLES / hertz for start, hertz in zip(self.starts, self.hertz, strict=True)
        ]
        return [(start, end + SLACK) for start, end in zip(self.starts, ends, strict=True)]


def nods(seed: int) -> Nods:
    """Twenty of them."""
    dice = random.Random(f"nods {seed}")
    return Nods(
        tuple(FIRST + EVERY * number for number in range(NODS)),
        tuple(dice.uniform(*HERTZ) for _ in range(NODS)),
        tuple(math.radians(dice.uniform(*DEGREES)) for _ in range(NODS)),
        stays_turned=seed % 2 == 0,
    )


def rest(seed: int) -> Motion:
    """Someone who only sways."""
    return lambda time: Posture()


def turns(seed: int) -> Motion:
    """Someone who turns the head aside and back, again and again."""
    dice = random.Random(f"turns {seed}")
    ways = [math.radians(dice.choice((-1, 1)) * dice.uniform(15, 40)) for _ in range(NODS)]
    speeds = [dice.uniform(0.35, 0.6) for _ in range(NODS)]

    def motion(time: float) -> Posture:
        number, elapsed = divmod(max(0.0, time - FIRST), EVERY)
        if number >= NODS:
            return Posture()
        way, turn_s = ways[int(number)], speeds[int(number)]
        return Posture(yaw=way * (eased(elapsed / turn_s) - eased((elapsed - 0.75) / turn_s)))

    return motion


def pictures(seed: int) -> Motion:
    """Still pictures of someone, one switched for another."""
    dice = random.Random(f"pictures {seed}")
    poses = [(dice.uniform(-12, 12), dice.uniform(-20, 20)) for _ in range(4)]
    until, shown, moments = 0.0, 0, []
    while until < DURATION:
        until += dice.uniform(*PICTURE_S)
        shown = (shown + dice.randrange(1, len(poses))) % len(poses)
        moments.append((until, shown))

    def motion(time: float) -> Posture:
        number = next((shown for until, shown in moments if time < until), 0)
        pitch, yaw = poses[number]
        return Posture(pitch=math.radians(pitch), yaw=math.radians(yaw))

    return motion


NODDING, TURNING = "nods after a turn", "turning the head"
FILMS: Mapping[str, Callable[[int], Motion]] = {
    NODDING: nods,
    "at rest": rest,
    TURNING: turns,
    "switched pictures": pictures,
}


def film(motion: Motion, seed: int, rate: float, duration: float = DURATION) -> Film:
    """Someone who makes these moves, blurred and noisy, at a frame rate."""
    dice = random.Random(f"lens {seed}")
    lens = Lens(noise=dice.uniform(3, 7), blur=dice.uniform(0.6, 1.0), seed=seed)
    actors = [name for name, looks in ACTORS.items() if looks.is_for_tests]
    role = Role(
        motion, actor=actors[seed % len(actors)], distance=dice.uniform(0.8, 1.3), seed=seed
    )
    return Film([role], duration, rate, Optics(), lens, scene=seed)


def told(seed: int, kind: str, rate: float) -> list[HeadGesture]:
    """All gestures reported in a film, without an open question."""
    made = film(FILMS[kind](seed), seed, rate)
    watching = PeopleGestures(answer_patterns())
    with one_thread():
        return [
            gesture
            for people, _ in seen(made.frames(), made.optics)
            for gesture in watching.update(people)
        ]


def hits(nods: Nods, gestures: Sequence[HeadGesture]) -> int:
    """How many of the nods are recognized; each counts once."""
    left = [gesture.time for gesture in gestures if gesture.kind == NOD]
    found = 0
    for begun, ended in nods.spans():
        time = next((time for time in left if begun <= time <= ended), None)
        if time is not None:
            left.remove(time)
            found += 1
    return found


def rows(quick: bool, workers: int) -> Iterator[Row]:
    """All films at all rates, in a number of processes; `quick` takes one of each."""
    find_face_models()
    seeds = range(1 if quick else SEEDS)
    for rate in RATES:
        for kind in FILMS:
            with worker_pool(workers) as pool:
                each = pool.map(partial(told, kind=kind, rate=rate), seeds)
                what = f"{kind}, {rate:g} a second"
                found = list(progress(each, len(seeds), what))
            yield from _judged(kind, what, found)


def _judged(kind: str, what: str, found: Sequence[list[HeadGesture]]) -> Iterator[Row]:
    counts = Counter(gesture.kind for gestures in found for gesture in gestures)
    if kind == NODDING:
        each = [hits(nods(seed), gestures) for seed, gestures in enumerate(found)]
        least = f"{what}: nods told of {NODS}, the least of {len(found)} films"
        yield amount(least, min(each), "nods", at_least(FOUND), films=each, told=counts[NOD])
        yield amount(f"{what}: shakes told", counts[SHAKE], "shakes", at_most(0))
        return
    yield amount(f"{what}: nods told", counts[NOD], "nods", at_most(0))
    if kind != TURNING:
        yield amount(f"{what}: shakes told", counts[SHAKE], "shakes", at_most(0))
