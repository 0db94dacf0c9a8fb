"""`hri gesture`: reports nods and shakes in a video, from a camera, or in series of head poses."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

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
from hri.core.signals import Frame, HeadGesture, Image
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE
from hri.hal.camera import Camera
from hri.vision.gestures.gesture_file import chosen
from hri.vision.gestures.gesture_patterns import ANSWERS, FILE, Pattern, load_patterns
from hri.vision.gestures.gesture_recognizer import GestureRecognizer
from hri.vision.pose_file import Remarks, read_poses

SHOWN = 1.5
"""Seconds that a gesture stays in the picture."""

Teller = Callable[[HeadGesture, str], None]
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
    known = load_patterns(path)
    if options.list or options.check:
        if options.list:
            _show(known.values())
        count = f"{len(known)} gesture{'s' * (len(known) != 1)}"
        report(f"{path or paths.find('config', FILE)}: {count}, fine")
        return 0
    patterns = list(known.values()) if options.patterns is not None else chosen(known, ANSWERS)
    tell = _tell_json if options.json else _tell
    if options.pose:
        if options.overlay or options.video or options.images or options.camera:
            raise HriError("--pose takes no pictures - leave out the other source and --overlay")
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
    from hri.vision.tracking.people import PeopleTracker

    detectors = load_detectors(options.detector)
    for problem in detectors.problems:
        print(problem, file=sys.stderr)
    tracker = PeopleTracker(detectors, CameraView.of(camera))
    recognizer = PeopleGestures(patterns)
    recent: list[HeadGesture] = []
    begun: float | None = None
    for frame in frames:
        begun = frame.time if begun is None else begun
        people = tracker.see(frame)
        for gesture in recognizer.update(people, options.prompted):
            recent.append(gesture)
            tell(_since(begun, gesture), "")
        if options.overlay is None:
            yield frame.time, frame.image
            continue
        recent = [gesture for gesture in recent if 0 <= frame.time - gesture.time <= SHOWN]
        yield frame.time, draw(frame.image, people, recent)


def _since(begin: float, gesture: HeadGesture) -> HeadGesture:
    """A gesture with its time from the first picture."""
    return replace(gesture, time=gesture.time - begin)


def _tell(gesture: HeadGesture, file: str) -> None:
    about = f"confidence {gesture.confidence:.2f}, {gesture.latency:.2f} s after it began"
    words = [file, f"{gesture.time:8.2f} s", gesture.person, f"{gesture.kind:<8}", about]
    report("  ".join(word for word in words if word), flush=True)


def _tell_json(gesture: HeadGesture, file: str) -> None:
    told: dict[str, str | float] = {"file": file} if file else {}
    told |= {
        "t": round(gesture.time, 3),
        "gesture": gesture.kind,
        "person": gesture.person,
        "confidence": round(gesture.confidence, 3),
        "latency_s": round(gesture.latency, 3),
    }
    print(json.dumps(told), flush=True)


def _show(patterns: Iterable[Pattern]) -> None:
    for pattern in patterns:
        report(f"{pattern.gesture:<10} {pattern.event:<18} {pattern.about}")
        for row in pattern.rows:
            report(f"{'':<10} {row.words(pattern.axis)}")
