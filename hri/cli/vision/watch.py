"""`hri watch`: draws people live: box, id, pose, gaze and gestures."""

from __future__ import annotations

import argparse
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from hri.cli.vision import stills
from hri.cli.vision.watching import (
    FILM_RATE,
    LOOK,
    add_source,
    frames_of,
    interruption,
    opened_camera,
    paced,
)
from hri.core.clock import FakeClock, RealClock
from hri.core.errors import NotAvailable
from hri.core.quoting import report
from hri.core.signals import (
    ColorBlob,
    FoundObject,
    Frame,
    HandGesture,
    HeadGesture,
    Image,
    Motion,
    People,
)
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE
from hri.hal.camera import Camera
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen

if TYPE_CHECKING:
    from hri.vision.camera_view import CameraView

SHOWN = 1.5
"""Seconds that a gesture stays in the picture."""
IDLE = 0.1
"""Seconds between checks of the keys while there is no new picture."""
KEYS = "escape: end; space: hold; l: landmarks; c: camera off and on"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add_source(parser)
    stills.add_arguments(parser)
    add = parser.add_argument
    add("--out", type=Path, metavar="FILM.mp4", help="write a film instead of opening a window")
    add(
        "--detector", default="auto", metavar="NAME", help="auto, haar, or the path of a YuNet file"
    )
    add("--prompted", action="store_true", help="an answer is expected: a single nod is enough")
    add("--patterns", action="store_true", help="all gestures of gestures.toml, not nod and shake")
    add("--hands", action="store_true", help="show hands and their gestures, too")
    add("--objects", metavar="SET.mdl", help="recognize the objects of a set, too")
    about = "find colors, too: their names with commas between, or all"
    add("--colors", nargs="?", const="", metavar="NAMES", help=about)
    add("--motion", action="store_true", help="show what moves, too")
    add("--no-landmarks", action="store_true", help="hide the points of faces and hands")


def run(options: argparse.Namespace) -> int:
    """Run until the source has ended, the window is closed, or Ctrl-C."""
    if options.stills is not None:
        stills.check(options)
        return stills.run(options)
    is_live = options.out is None or _is_device(options)
    clock = RealClock() if is_live else FakeClock()
    with opened_camera(options, clock) as camera:
        watcher = Watcher.of(camera, options)
        if options.out is not None:
            with interruption() as is_over:
                write(options.out, watcher, frames_of(camera, options.seconds, is_over))
            return 0
        try:
            with opened_window(camera) as screen:
                print(KEYS)
                show(watcher, camera, screen, options.seconds)
        except KeyboardInterrupt:
            print()
    return 0


def _is_device(options: argparse.Namespace) -> bool:
    return options.video is None and options.images is None and not options.simulated


@dataclass
class Watcher:
    """Analyzes frames, prints their gestures, and draws the results."""

    see: Callable[[Frame], People]
    recognize: Callable[[People], Iterable[HeadGesture | HandGesture]]
    has_landmarks: bool = True
    find: Callable[[Image], Sequence[FoundObject]] = lambda image: ()
    """Recognizes objects."""
    find_colors: Callable[[Image], Sequence[ColorBlob]] = lambda image: ()
    find_motion: Callable[[Frame], Motion | None] = lambda frame: None
    _recent: list[HeadGesture | HandGesture] = field(default_factory=list)

    @classmethod
    def of(cls, camera: Camera, options: argparse.Namespace) -> Watcher:
        """As the options say; reports what does not work without models."""
        from hri.vision.camera_view import CameraView
        from hri.vision.detectors.detector_choice import load_detectors
        from hri.vision.gestures.gesture_behaviors import PeopleGestures
        from hri.vision.gestures.gesture_file import chosen
        from hri.vision.gestures.gesture_patterns import ANSWERS, load_patterns
        from hri.vision.hands.hand_gestures import PeopleHands
        from hri.vision.hands.hand_patterns import load_hand_patterns
        from hri.vision.hands.hand_tracker import load_hand_tracker
        from hri.vision.tracking.people import PeopleTracker, seen_with

        detectors = load_detectors(options.detector)
        for problem in detectors.problems:
            print(problem, file=sys.stderr)
        view = CameraView.of(camera)
        tracker = PeopleTracker(detectors, view)
        hands = load_hand_tracker(view) if options.hands else None
        hand_gestures = PeopleHands(load_hand_patterns().values())
        known = load_patterns()
        gestures = PeopleGestures(chosen(known, known if options.patterns else ANSWERS))

        def recognize(people: People) -> Iterable[HeadGesture | HandGesture]:
            return [*gestures.update(people, options.prompted), *hand_gestures.update(people)]

        watcher = cls(seen_with(hands, tracker), recognize, not options.no_landmarks)
        if options.objects is not None:
            from hri.vision.objects.model_file import find_models, load_models
            from hri.vision.objects.recognizer import ObjectRecognizer

            models = load_models(find_models(options.objects))
            watcher.find = ObjectRecognizer(models, view).recognize
        if options.colors is not None:
            from hri.vision.color.segmentation import ColorSegmenter

            watcher.find_colors = ColorSegmenter(stills.color_tables(options.colors)).segment
        if options.motion:
            watcher.find_motion = _motion_finder(view)
        return watcher

    def look(self, frame: Frame) -> Image:
        """The frame with the results drawn in; gestures are printed."""
        from hri.vision.detectors.overlay import draw, draw_blobs, draw_motion, draw_objects

        people = self.see(frame)
        for gesture in self.recognize(people):
            self._recent.append(gesture)
            who = gesture.person or "somebody"
            report(f"{frame.time:7.2f} s  {who}  {gesture.kind}  {_how(gesture)}", flush=True)
        self._recent = [g for g in self._recent if 0 <= frame.time - g.time <= SHOWN]
        seen = draw(frame.image, people, self._recent, self.has_landmarks)
        seen = draw_blobs(seen, self.find_colors(frame.image))
        if (motion := self.find_motion(frame)) is not None:
            seen = draw_motion(seen, motion)
        return draw_objects(seen, self.find(frame.image))


def _how(gesture: HeadGesture | HandGesture) -> str:
    """What follows its name: how surely it is one, or which hand made it."""
    if isinstance(gesture, HandGesture):
        return f"{gesture.hand.side} hand"
    return f"{gesture.confidence:.2f}"


def _motion_finder(view: CameraView) -> Callable[[Frame], Motion | None]:
    """What moves before a camera that stands still."""
    from hri.vision.motion.motion_finder import CameraMove, MotionFinder

    finder = MotionFinder(view)

    def find(frame: Frame) -> Motion | None:
        found = finder.look(frame.image, frame.time, CameraMove(), 0.0)
        return None if found is None else found.motion

    return find


def write(path: Path, watcher: Watcher, frames: Iterator[Frame]) -> None:
    """Write the film. Raises HriError."""
    from hri.face.renderers.movie import check_movie, write_movie

    check_movie(path, FILM_RATE)
    pictures = ((frame.time, watcher.look(frame)) for frame in frames)
    write_movie(path, paced(pictures), FILM_RATE, PRIVATE)
    note("pictures", path)
    report(f"wrote {path}")


def show(watcher: Watcher, camera: Camera, screen: Screen, seconds: float = math.inf) -> None:
    """Show it on a screen until the window is closed, or Escape is pressed."""
    clock = camera.manager.clock
    window = _Window(watcher, camera, screen)
    end, shown = clock.now() + seconds, -IDLE
    while window.is_open and clock.now() < end:
        frame = None if window.is_held else camera.read(clock.now())
        if frame is None and clock.now() - shown < IDLE:
            clock.advance(LOOK)
            continue
        shown = clock.now()
        window.show(frame)


@contextmanager
def opened_window(camera: Camera) -> Iterator[Screen]:
    """A window for the pictures of a camera. Raises NotAvailable without a display."""
    shape = {"width": str(max(320, camera.width)), "height": str(max(240, camera.height))}
    device = Description("window", "Hri.Screen", shape | {"title": f"hri watch - {camera.id}"})
    with ResourceManager([device], camera.manager.clock) as resources:
        try:
            yield resources.obtain("window", Screen)
        except NotAvailable as error:
            raise NotAvailable(f"{error}, or write a film with --out film.mp4") from error


@dataclass
class _Window:
    """The window and its keys."""

    watcher: Watcher
    camera: Camera
    screen: Screen
    is_held: bool = False
    is_open: bool = True
    _picture: Image | None = None

    def show(self, frame: Frame | None) -> None:
        """A new frame, or else the last one again."""
        from hri.vision.detectors.overlay import draw_words

        clock = self.camera.manager.clock
        if frame is not None:
            begun = clock.now()
            picture = self.watcher.look(frame)
            footage, took = self.camera.footage(), clock.now() - begun
            words = (
                f"{footage.rate:.0f} pictures a second, {footage.lost} lost, {1000 * took:.0f} ms"
            )
            self._picture = draw_words(picture, words)
        if self._picture is not None:
            if not self.camera.is_on:
                self._picture = draw_words(np.zeros_like(self._picture), "the camera is off")
            self.screen.show(self._picture, clock.now())
        for key in self.screen.pressed_keys():
            self._press(key)
        self.is_open = self.is_open and not self.screen.is_closed

    def _press(self, key: str) -> None:
        if key == "escape":
            self.is_open = False
        elif key == "space":
            self.is_held = not self.is_held
        elif key == "l":
            self.watcher.has_landmarks = not self.watcher.has_landmarks
        elif key == "c":
            self._switch()

    def _switch(self) -> None:
        try:
            self.camera.switch(not self.camera.is_on)
        except NotAvailable as error:
            print(error, file=sys.stderr)
