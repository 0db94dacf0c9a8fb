"""Gestures of hands in films that nothing was tuned on, and what seeing them costs, as JSON.

    python -m benchmarks.vision.hands --hand left.glb [--films 40] [--first 0] [--tuning]

People are drawn, before photographs (`../shared/vision/stills`, beside the project); their hands
are rendered, see `rendered_hand`. The thresholds were chosen with `--tuning`, whose films have
other people, rooms, and lots.
"""

from __future__ import annotations

import argparse
import json
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import cv2
import numpy as np

from benchmarks.vision.hand_films import GESTURES, NOTHINGS, SIZE, HandFilm, frames, made_film
from benchmarks.vision.rendered_hand import HandMesh
from hri.core import paths
from hri.core.signals import HandGesture, Image
from hri.simulation.people.actors import ACTORS
from hri.vision.camera_view import CameraView
from hri.vision.detectors.detector_choice import load_detectors
from hri.vision.hands.hand_gestures import PeopleHands
from hri.vision.hands.hand_patterns import load_hand_patterns
from hri.vision.hands.hand_tracker import load_hand_tracker
from hri.vision.tracking.people import PeopleTracker

TUNING, FIGURES = 10_000, 880_000
"""Seeds."""
TUNING_ROOMS, ROOMS = ("coffee", "chelsea"), ("rocket", "brick", "coins")
TUNING_ACTORS = 3
"""How many of the drawn people are for choosing; the others are judged."""
LATE = 1.2
"""Seconds after a gesture has ended within which it is still told."""


@dataclass
class Judged:
    """How many gestures were made, told, and told where there were none; seconds of film."""

    made: Counter[str] = field(default_factory=Counter)
    hit: Counter[str] = field(default_factory=Counter)
    false: Counter[str] = field(default_factory=Counter)
    missed: list[str] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)
    delays: list[float] = field(default_factory=list)
    costs: list[float] = field(default_factory=list)
    of_faces: list[float] = field(default_factory=list)
    """Milliseconds of a picture, of all and of what is not for hands."""
    seconds: float = 0.0

    def add(self, film: HandFilm, told: Sequence[HandGesture]) -> None:
        self.seconds += film.duration
        matched = set()
        for deed in film.deeds:
            if deed.kind not in GESTURES:
                continue
            self.made[deed.kind] += 1
            hits = [
                index
                for index, gesture in enumerate(told)
                if gesture.kind == deed.kind and deed.start <= gesture.time <= deed.end + LATE
            ]
            matched.update(hits)
            if hits:
                self.hit[deed.kind] += 1
                self.delays.append(told[hits[0]].time - deed.start)
            else:
                self.missed.append(f"{film.seed}: {deed.kind} at {deed.start:.1f}")
        for index, gesture in enumerate(told):
            if index not in matched and gesture.kind in GESTURES:
                self.false[gesture.kind] += 1
                now = [d.kind for d in film.deeds if d.start <= gesture.time <= d.end + LATE]
                self.wrong.append(f"{film.seed}: {gesture.kind} at {gesture.time:.1f} in {now}")

    def figures(self) -> dict[str, object]:
        found: dict[str, object] = {}
        for kind in GESTURES:
            told = self.hit[kind] + self.false[kind]
            found[kind] = {
                "made": self.made[kind],
                "recall": round(self.hit[kind] / max(1, self.made[kind]), 3),
                "precision": round(self.hit[kind] / max(1, told), 3),
            }
        hits, false = sum(self.hit.values()), sum(self.false.values())
        found["all"] = {
            "recall": round(hits / max(1, sum(self.made.values())), 3),
            "precision": round(hits / max(1, hits + false), 3),
            "false_a_minute": round(60 * false / max(1.0, self.seconds), 3),
            "minutes": round(self.seconds / 60, 1),
            "delay_p50_s": round(float(np.median(self.delays or [np.nan])), 2),
            "delay_p90_s": round(float(np.quantile(self.delays or [np.nan], 0.9)), 2),
        }
        found["cpu_ms"], found["of_faces_ms"] = _spread(self.costs), _spread(self.of_faces)
        found["missed"], found["wrong"] = self.missed, self.wrong
        return found


def _spread(costs: Sequence[float]) -> dict[str, float]:
    return {
        "mean": round(float(np.mean(costs)), 1),
        "p50": round(float(np.median(costs)), 1),
        "p95": round(float(np.quantile(costs, 0.95)), 1),
    }


def watch(film: HandFilm, mesh: HandMesh, rooms: Sequence[Image], judged: Judged) -> None:
    """See a film as the robot does, in one thread."""
    view = CameraView()
    tracker, hands = PeopleTracker(load_detectors(), view), load_hand_tracker(view)
    assert hands is not None, "hri models fetch face"
    recognizer, told = PeopleHands(load_hand_patterns().values()), []
    for frame in frames(film, mesh, rooms):
        begun = time.thread_time()
        people = tracker.see(frame)
        judged.of_faces.append((time.thread_time() - begun) * 1e3)
        people = hands.see(frame, people, is_late=tracker.is_searching)
        told += recognizer.update(people)
        judged.costs.append((time.thread_time() - begun) * 1e3)
    judged.add(film, told)


def rooms_named(names: Sequence[str]) -> list[Image]:
    """The photographs of these names."""
    folder = paths.house().parent / "shared" / "vision" / "stills"
    found = []
    for name in names:
        file = next(folder.glob(f"{name}.*"))
        image = cv2.imread(str(file), cv2.IMREAD_COLOR)
        assert image is not None, file
        found.append(np.ascontiguousarray(image[..., ::-1]).astype(np.uint8))
    return found


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--hand", type=Path, required=True, help="generic-hand/left.glb")
    parser.add_argument("--films", type=int, default=40)
    parser.add_argument("--first", type=int, default=0, help="number of the first film")
    parser.add_argument("--tuning", action="store_true", help="the films to choose by")
    options = parser.parse_args()
    cv2.setNumThreads(1)
    mesh, judged = HandMesh(options.hand), Judged()
    rooms = rooms_named(TUNING_ROOMS if options.tuning else ROOMS)
    actors = list(ACTORS)
    actors = actors[:TUNING_ACTORS] if options.tuning else actors[TUNING_ACTORS:]
    first = TUNING if options.tuning else FIGURES
    for number in range(options.first, options.first + options.films):
        kinds = [
            GESTURES[number % len(GESTURES)],
            NOTHINGS[number % len(NOTHINGS)],
            GESTURES[(number + 2) % len(GESTURES)],
        ]
        watch(made_film(first + number, kinds, actors, len(rooms)), mesh, rooms, judged)
    print(json.dumps({"size": SIZE, **judged.figures()}, indent=1))


if __name__ == "__main__":
    main()
