"""Gestures in films of synthetic people: how many are seen, and what else is taken for one."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import partial

import numpy as np

from benchmarks.progress import progress
from benchmarks.vision.script import Gesture, Script, scripts
from hri.bench.table import Limit, Row, amount, at_least, at_most, share
from hri.bench.threads import one_thread
from hri.bench.vision.seeing import seen
from hri.bench.workers import worker_pool
from hri.core.signals import HeadGesture, HeadPose, Person
from hri.vision.detectors.detector_choice import AUTO, HAAR
from hri.vision.face_models import find_face_models
from hri.vision.gestures.gesture_fusion import GestureFusion
from hri.vision.gestures.gesture_patterns import answer_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer

GESTURES, QUICK_GESTURES = 200, 20
RATES = (30.0, 15.0)
SLACK = 0.7
"""Seconds after its end in which a gesture may still be recognized."""
PRECISION, RECALL, ALARMS_A_MINUTE = 0.97, 0.90, 0.25
LATENCY_S, SLOWEST_S = 0.45, 0.9
"""Median and 90th percentile."""
PEER_FILMS = 8
"""Films that the chain without networks is shown."""

AGREEING, PROMPTED, POSE, FLOW = "mesh and flow agree", "prompted", "mesh alone", "flow alone"


@dataclass
class Judgment:
    """What a recognizer made of films."""

    hits: int = 0
    of: int = 0
    """Gestures that there were."""
    alarms: list[str] = field(default_factory=list)
    """False alarms: the reported gesture, and what was done instead."""
    latencies: list[float] = field(default_factory=list)
    """Seconds from the first movement, of the hits."""
    minutes: float = 0.0

    def __add__(self, other: Judgment) -> Judgment:
        return Judgment(
            self.hits + other.hits,
            self.of + other.of,
            self.alarms + other.alarms,
            self.latencies + other.latencies,
            self.minutes + other.minutes,
        )


def rows(quick: bool, workers: int) -> Iterator[Row]:
    """All films at all rates, in a number of processes."""
    find_face_models()
    films = scripts(QUICK_GESTURES if quick else GESTURES)
    for rate in RATES:
        found = _judged(films, rate, AUTO, workers)
        yield from _rows(found[AGREEING], rate)
        for peer in (POSE, FLOW):
            yield _told(f"peer: {peer}, {rate:g} a second", found[peer])
        yield from _latency(found[PROMPTED], rate)
    few = films[: 2 if quick else PEER_FILMS]
    found = _judged(few, RATES[0], HAAR, workers)
    yield _told(f"peer: Haar's cascade and flow, {RATES[0]:g} a second", found[AGREEING])


def _judged(
    films: Sequence[Script], rate: float, setting: str, workers: int
) -> dict[str, Judgment]:
    total: dict[str, Judgment] = {}
    with worker_pool(workers) as pool:
        each = pool.map(partial(judge, rate=rate, setting=setting), films)
        what = f"films, {rate:g} a second" + ("" if setting == AUTO else f", {setting}")
        for judgments in progress(each, len(films), what):
            for name, judgment in judgments.items():
                total[name] = total.get(name, Judgment()) + judgment
    return total


def judge(script: Script, rate: float, setting: str = AUTO) -> dict[str, Judgment]:
    """What each recognizer makes of one film, by its name."""
    film, recognizers = script.film(rate), _Recognizers()
    with one_thread():
        for people, _ in seen(film.frames(), film.optics, setting):
            for person in people.persons:
                if person.is_visible:
                    recognizers.update(person)
    return {name: score(script, found) for name, found in recognizers.found.items()}


class _Recognizers:
    """Several recognizers of the same person, and what each has found."""

    def __init__(self) -> None:
        patterns = answer_patterns()
        self._agreeing, self._prompted = GestureFusion(patterns), GestureFusion(patterns)
        self._pose, self._flow = GestureRecognizer(patterns), GestureRecognizer(patterns)
        self.found: dict[str, list[HeadGesture]] = {
            name: [] for name in (AGREEING, PROMPTED, POSE, FLOW)
        }

    def update(self, person: Person) -> None:
        motion: HeadPose = person.motion or person.pose
        told = {
            AGREEING: self._agreeing.update(person),
            PROMPTED: self._prompted.update(person, True),
            POSE: self._pose.update(person.pose),
            FLOW: self._flow.update(motion),
        }
        for name, gesture in told.items():
            if gesture is not None:
                self.found[name].append(gesture)


def score(script: Script, found: Sequence[HeadGesture]) -> Judgment:
    """Each gesture of the script may be found once, from its start to a moment after its end."""
    judgment = Judgment(of=len(script.gestures), minutes=script.duration / 60)
    left = list(script.gestures)
    for told in found:
        made = next((gesture for gesture in left if _is_of(told, gesture)), None)
        if made is None:
            judgment.alarms.append(f"{told.kind} for {_done(script, told.time)}")
            continue
        left.remove(made)
        judgment.hits += 1
        judgment.latencies.append(told.time - made.start)
    return judgment


def _is_of(told: HeadGesture, made: Gesture) -> bool:
    return told.kind == made.kind and made.start <= told.time <= made.end + SLACK


def _done(script: Script, time: float) -> str:
    """What the person began last."""
    begun = [(gesture.start, gesture.kind) for gesture in script.gestures]
    begun += [(distraction.start, distraction.name) for distraction in script.distractions]
    return max([what for what in begun if what[0] <= time], default=(0.0, "nothing"))[1]


def _rows(judgment: Judgment, rate: float) -> Iterator[Row]:
    told = judgment.hits + len(judgment.alarms)
    films = f"films of held-out faces, {rate:g} a second"
    yield share(f"{films}, precision", judgment.hits, max(told, 1), at_least(PRECISION))
    yield share(f"{films}, recall", judgment.hits, judgment.of, at_least(RECALL))
    yield amount(
        f"{films}, false alarms",
        len(judgment.alarms) / judgment.minutes,
        "1/min",
        at_most(ALARMS_A_MINUTE),
        minutes=round(judgment.minutes, 1),
        alarms=dict(Counter(judgment.alarms)),
    )


def _told(what: str, judgment: Judgment) -> Row:
    """A row of a peer, which nothing is asked of."""
    told = judgment.hits + len(judgment.alarms)
    return {
        "what": what,
        "precision": round(judgment.hits / max(told, 1), 3),
        "recall": round(judgment.hits / judgment.of, 3),
        "false_alarms_a_minute": round(len(judgment.alarms) / judgment.minutes, 2),
    }


def _latency(judgment: Judgment, rate: float) -> Iterator[Row]:
    """Of the recognizer from which an answer is expected."""
    limits: dict[float, Limit] = {50: at_most(LATENCY_S), 90: at_most(SLOWEST_S)}
    for percentile, limit in limits.items():
        name = "median" if percentile == 50 else "p90"
        what = f"latency from movement onset when prompted, {rate:g} a second, {name}"
        latencies = judgment.latencies or [float("inf")]
        yield amount(what, float(np.percentile(latencies, percentile)), "s", limit)
