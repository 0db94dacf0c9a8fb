"""Facial expressions of drawn people: how many are recognized, and what else is taken for one.

Drawn people smile and raise and lower their brows, between nods, looks aside and other movements.
Whoever talks here raises the brows now and then, and who laughs smiles: neither counts, nor do the
eyes, which laughing narrows. That real faces are recognized as well, this does not prove.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from operator import add

from hri.bench.table import Row, amount, at_least, at_most, share, skipped
from hri.bench.threads import one_thread
from hri.simulation.people.actors import ACTORS, Optics
from hri.simulation.people.body_motion import DISTRACTORS, GESTURES, MOTIONS, Posture
from hri.simulation.people.lens import Lens
from hri.simulation.people.scripted_film import Film, Role
from hri.vision.detectors.detector_choice import Detectors, load_detectors
from hri.vision.expressions.expression_patterns import load_expression_patterns
from hri.vision.expressions.expression_recognizer import PeopleExpressions
from hri.vision.tracking.people import PeopleTracker

SEED = 672_000
FILMS, QUICK_FILMS = 24, 2
RATE = 15.0
LEAD, REST, LATE = 3.0, 1.2, 0.6
"""Seconds before anything happens, between two movements, and after one in which it may be told."""
SHOWN = {"smile": "smile", "raise_brows": "brows_raised", "lower_brows": "brows_lowered"}
"""The expression of each motion."""
SHOWING_MORE = ("talk", "laugh")
LEAST, FALSE = 0.9, 0.25
"""Share that must be recognized, and others a minute at most."""


@dataclass(frozen=True, slots=True)
class Deed:
    """A movement in a film."""

    name: str
    start: float
    seed: int

    @property
    def end(self) -> float:
        return self.start + MOTIONS[self.name].duration + LATE


def rows(quick: bool) -> Iterator[Row]:
    """The figures."""
    detectors = load_detectors()
    if detectors.mesh is None:
        yield skipped("expressions", "; ".join(detectors.problems))
        return
    made: Counter[str] = Counter()
    found: Counter[str] = Counter()
    wrong, seconds = 0, 0.0
    with one_thread():
        for number in range(QUICK_FILMS if quick else FILMS):
            script = _script(number)
            told = _told(_film(number, script), detectors)
            for deed in script:
                shown = [kind for time, kind in told if deed.start <= time < deed.end]
                if (kind := SHOWN.get(deed.name)) is not None:
                    made[kind] += 1
                    found[kind] += kind in shown
                if deed.name not in SHOWING_MORE:
                    wrong += sum(other != kind for other in shown)
                    seconds += deed.end - deed.start
    for kind in SHOWN.values():
        yield share(f"{kind}, drawn faces: recognized", found[kind], made[kind], at_least(LEAST))
    yield amount("other expressions a minute", 60 * wrong / seconds, "1/min", at_most(FALSE))


def _script(number: int) -> list[Deed]:
    dice = random.Random(SEED + number)
    names = [*SHOWN, *SHOWN, *dice.sample((*GESTURES, *DISTRACTORS), 6)]
    dice.shuffle(names)
    script, time = [], LEAD
    for name in names:
        script.append(Deed(name, time, dice.randrange(1 << 30)))
        time += MOTIONS[name].duration + REST
    return script


def _film(number: int, script: list[Deed]) -> Film:
    dice = random.Random(SEED - 1 - number)

    def motion(time: float) -> Posture:
        parts = (MOTIONS[deed.name].at(time - deed.start, deed.seed) for deed in script)
        return reduce(add, parts, Posture())

    role = Role(motion, dice.choice(list(ACTORS)), dice.uniform(0.8, 1.6), seed=number)
    optics = Optics(640, 480, 1.05)
    return Film([role], script[-1].end, RATE, optics, Lens(noise=dice.uniform(0, 6)), number)


def _told(film: Film, detectors: Detectors) -> list[tuple[float, str]]:
    """When which expression began, or was over, of a brief one."""
    patterns = load_expression_patterns()
    tracker, recognizer = PeopleTracker(detectors), PeopleExpressions(patterns.values())
    return [
        (one.time, one.kind)
        for frame in film.frames()
        for one in recognizer.update(tracker.see(frame))
        if not one.is_over or patterns[one.kind].is_brief
    ]
