"""`hri gesture`: reports nods, shakes, gestures of hands and facial expressions in a video or from
a camera, and nods and shakes in series of head poses."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path
from typing import TypeVar

from hri.cli.terminal.progress_line import waiting
from hri.cli.vision.watching import (
    FILM_RATE,
    add_source,
    frames_of,
    interruption,
    opened_camera,
    paced,
)
from hri.core import paths
from hri.core.clock import FakeClock, RealClock
from hri.core.errors import HriError
from hri.core.quoting import message_line, report
from hri.core.signals import Frame, HandGesture, HeadGesture, Image
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE
from hri.hal.camera import Camera
from hri.vision.expressions.expression_patterns import (
    FILE as EXPRESSIONS,
    ExpressionPattern,
    load_expression_patterns,
)
from hri.vision.expressions.expression_recognizer import FacialExpression, PeopleExpressions
from hri.vision.gestures.gesture_file import chosen
from hri.vision.gestures.gesture_patterns import ANSWERS, FILE, Pattern, load_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer
from hri.vision.hands.hand_patterns import FILE as HANDS, HandPattern, load_hand_patterns
from hri.vision.pose_file import Remarks, read_poses

T = TypeVar("T")

SHOWN = 1.5
"""Seconds that a gesture stays in the picture."""

Gesture = HeadGesture | HandGesture | FacialExpression
Teller = Callable[[Gesture, str], None]
"""Prints a gesture, with its file if there are several."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_source(parser)
    add = parser.add_argument
    add(
        "--pose", type=Path, nargs="+", action="extend", metavar="FILE.csv",
        help="series of poses, one head each: columns t_s,pitch_deg,yaw_deg,roll_deg",
    )  # fmt: skip
    add("--prompted", action="store_true", help="an answer is expected: a single nod is enough")
    add(
        "--patterns", nargs="?", type=Path, const=True, metavar="FILE",
        help=f"all gestures of a file, of config/{FILE} without one; else only nod and shake",
    )  # fmt: skip
    add(
        "--hands", action="store_true",
        help=f"report gestures of hands, too; with --check and --list, of config/{HANDS}",
    )  # fmt: skip
    add(
        "--expressions", action="store_true",
        help=f"report facial expressions, too; with --check and --list, of config/{EXPRESSIONS}",
    )  # fmt: skip
    add("--json", action="store_true", help="print one line of JSON per gesture")
    add("--overlay", type=Path, metavar="FILM.mp4", help="write a film with the results drawn in")
    add(
        "--detector", default="auto", metavar="NAME", help="auto, haar, or the path of a YuNet file"
    )
    add("--list", action="store_true", help="show the gestures of the file of patterns")
    add("--check", action="store_true", help="check the file of patterns")


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when a file is wrong; the others are still processed."""
    path = None if options.patterns is True else options.patterns
    if options.hands and (options.list or options.check):
        hands = load_hand_patterns(path)
        _examined(options, path or paths.find("config", HANDS), hands, _hand_lines)
        return 0
    if options.expressions and (options.list or options.check):
        faces, file = load_expression_patterns(path), path or paths.find("config", EXPRESSIONS)
        _examined(options, file, faces, _face_lines, "expression")
        return 0
    known = load_patterns(path)
    if options.list or options.check:
        _examined(options, path or paths.find("config", FILE), known, _head_lines)
        return 0
    patterns = list(known.values()) if options.patterns is not None else chosen(known, ANSWERS)
    tell = _tell_json if options.json else _tell
    if options.pose:
        others = (options.overlay, options.video, options.images, options.camera)
        if any(others) or options.hands or options.expressions:
            words = "leave out the other source, --overlay, --hands and --expressions"
            raise HriError(f"--pose takes no pictures - {words}")
        with waiting("looking at the poses"):
            return _run_poses(options.pose, patterns, options.prompted, tell)
    is_live = not (options.video or options.images or options.simulated)
    with nullcontext() if is_live else waiting("looking at the pictures"):
        _run_pictures(options, patterns, tell)
    return 0


def _run_poses(
    files: Sequence[Path], patterns: Sequence[Pattern], prompted: bool, tell: Teller
) -> int:
    status = 0
    for path in files:
        remarks = Remarks(path)
        recognizer = GestureRecognizer(patterns)
        try:
            for pose in read_poses(path, remarks):
                if (gesture := recognizer.update(pose, prompted)) is not None:
                    tell(gesture, str(path))
        except HriError as error:
            print(error, file=sys.stderr)
            status = 2
        for remark in remarks:
            print(message_line(str(remark)), file=sys.stderr)
    return status


def _run_pictures(options: argparse.Namespace, patterns: Sequence[Pattern], tell: Teller) -> None:
    is_device = options.video is None and options.images is None and not options.simulated
    clock = RealClock() if is_device else FakeClock()
    with opened_camera(options, clock) as camera, interruption() as is_over:
        frames = frames_of(camera, options.seconds, is_over)
        pictures = _seen(camera, frames, options, patterns, tell)
        if options.overlay is None:
            for _ in pictures:
                pass
            return
        from hri.face.renderers.movie import check_movie, write_movie

        check_movie(options.overlay, FILM_RATE)
        write_movie(options.overlay, paced(pictures), FILM_RATE, PRIVATE)
        note("pictures", options.overlay)


def _seen(
    camera: Camera,
    frames: Iterable[Frame],
    options: argparse.Namespace,
    patterns: Sequence[Pattern],
    tell: Teller,
) -> Iterator[tuple[float, Image]]:
    """The pictures with their times, with the results drawn in on request."""
    from hri.vision.camera_view import CameraView
    from hri.vision.detectors.detector_choice import load_detectors
    from hri.vision.detectors.overlay import draw
    from hri.vision.gestures.gesture_behaviors import PeopleGestures
    from hri.vision.hands.hand_gestures import PeopleHands
    from hri.vision.hands.hand_tracker import load_hand_tracker
    from hri.vision.tracking.people import PeopleTracker, seen_with

    detectors = load_detectors(options.detector)
    for problem in detectors.problems:
        print(problem, file=sys.stderr)
    view = CameraView.of(camera)
    hands = load_hand_tracker(view) if options.hands else None
    see = seen_with(hands, PeopleTracker(detectors, view))
    recognizer, of_hands = PeopleGestures(patterns), PeopleHands(load_hand_patterns().values())
    of_faces = PeopleExpressions(load_expression_patterns().values() if options.expressions else ())
    recent: list[Gesture] = []
    begun: float | None = None
    for frame in frames:
        begun = frame.time if begun is None else begun
        people = see(frame)
        made: list[Gesture] = [*recognizer.update(people, options.prompted)]
        for gesture in made + of_hands.update(people) + of_faces.update(people):
            recent.append(gesture)
            tell(_since(begun, gesture), "")
        if options.overlay is None:
            yield frame.time, frame.image
            continue
        recent = [gesture for gesture in recent if 0 <= frame.time - gesture.time <= SHOWN]
        yield frame.time, draw(frame.image, people, recent)


def _since(begin: float, gesture: Gesture) -> Gesture:
    """A gesture with its time from the first picture."""
    return replace(gesture, time=gesture.time - begin)


def _tell(gesture: Gesture, file: str) -> None:
    if isinstance(gesture, HandGesture):
        about = f"{gesture.hand.side} hand, {gesture.latency:.2f} s after it began"
    elif isinstance(gesture, FacialExpression):
        about = f"{'over' if gesture.is_over else 'shown'}, {gesture.seconds:.2f} s after it began"
    else:
        how = f"confidence {gesture.confidence:.2f}"
        about = f"{how}, {gesture.latency:.2f} s after it began"
    words = [file, f"{gesture.time:8.2f} s", gesture.person, f"{gesture.kind:<8}", about]
    report("  ".join(word for word in words if word), flush=True)


def _tell_json(gesture: Gesture, file: str) -> None:
    told = {"file": file} if file else {}
    print(json.dumps(told | {"t": round(gesture.time, 3), **_fields(gesture)}), flush=True)


def _fields(gesture: Gesture) -> dict[str, str | float]:
    who = {"person": gesture.person}
    if isinstance(gesture, FacialExpression):
        seconds = round(gesture.seconds, 3)
        return {"expression": gesture.kind, **who, "is_over": gesture.is_over, "seconds": seconds}
    latency = {"latency_s": round(gesture.latency, 3)}
    if isinstance(gesture, HandGesture):
        return {"gesture": gesture.kind, **who, "hand": gesture.hand.side, **latency}
    confidence = round(gesture.confidence, 3)
    return {"gesture": gesture.kind, **who, "confidence": confidence, **latency}


def _examined(
    options: argparse.Namespace,
    path: Path,
    known: Mapping[str, T],
    lines: Callable[[T], Iterable[str]],
    noun: str = "gesture",
) -> None:
    """Report that a file of gestures is right, and on request what is in it."""
    if options.list:
        for pattern in known.values():
            for line in lines(pattern):
                report(line)
    count = f"{len(known)} {noun}{'s' * (len(known) != 1)}"
    report(f"{path}: {count}, fine")


def _head_lines(pattern: Pattern) -> Iterator[str]:
    yield f"{pattern.gesture:<10} {pattern.event:<18} {pattern.about}"
    for row in pattern.rows:
        yield f"{'':<10} {row.words(pattern.axis)}"


def _hand_lines(pattern: HandPattern) -> Iterator[str]:
    yield f"{pattern.gesture:<10} {pattern.event:<18} {pattern.about}"
    yield f"{'':<10} {pattern.words()}"


def _face_lines(pattern: ExpressionPattern) -> Iterator[str]:
    yield f"{pattern.name:<14} {pattern.about}"
    yield f"{'':<14} {pattern.words()}"
