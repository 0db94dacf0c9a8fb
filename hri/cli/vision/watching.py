"""Picture sources and films of the commands that use a camera."""

from __future__ import annotations

import argparse
import math
import signal
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from pathlib import Path

from hri.cli.terminal.messages import Within
from hri.core import paths
from hri.core.clock import Clock
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import report
from hri.core.signals import Frame, Image
from hri.hal.camera import Camera
from hri.hal.choices import apply_choices, load_choices
from hri.hal.configuration import load_configuration
from hri.hal.drivers.video_file import check_video
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.world import SimulatedWorld

LOOK = 0.002
"""Seconds between checks for the next picture."""
SIZE = {"width": "640", "height": "480"}
"""Requested frame size; the robot itself uses less."""
VIEWS = 12.0, 140.0
"""Smallest and largest view in degrees; a wider one is a fisheye, which distorts the picture."""
SHOW = (("nod", 2.0), ("look_aside", 5.0), ("shake", 8.0))
"""Actions of the simulated person, and their times in seconds."""
HANDS = (("wave", 11.0), ("thumb_up", 15.0))
"""What they show with a hand then."""
FILM_RATE = 30.0
"""Frames per second of a written film."""
MOST_REPEATS = 300
"""Most repeats of one picture in a film; longer breaks are cut."""


def add_source(parser: argparse.ArgumentParser) -> None:
    """Add the options that choose a camera; the default is the configured one."""
    add = parser.add_mutually_exclusive_group().add_argument
    add("--video", type=Path, metavar="FILE", help="a video or an image")
    add("--images", type=Path, metavar="FOLDER", help="a folder of pictures, in order")
    add("--camera", metavar="N", help="a camera of this machine: 0, 1 ... or its path")
    add(
        "--simulated",
        action="store_true",
        help="a simulated person who nods, shakes the head, waves, and holds a thumb up",
    )
    add_view(parser)


def add_view(parser: argparse.ArgumentParser) -> None:
    """Add the options that say how a camera looks, and for how long."""
    add = parser.add_argument
    add("--config", default="resource-config", metavar="FILE", help="the devices (%(default)s)")
    add("--mirror", action="store_true", help="correct a mirrored view")
    add("--rotate", choices=("0", "90", "180", "270"), default="0", help="degrees clockwise")
    add(
        "--view",
        type=Within(float, *VIEWS),
        metavar="DEGREES",
        help="horizontal field of view",
    )
    add("--seconds", type=Within(float, 0.001), default=math.inf, metavar="S", help="how long")


@contextmanager
def opened_camera(options: argparse.Namespace, clock: Clock) -> Iterator[Camera]:
    """The camera that the options choose; on a fake clock files are read as fast as possible.
    Raises HriError for a bad file, NotAvailable when there is no camera: no stand-in is used that
    the options do not ask for.
    """
    pace = "fast" if clock.is_fake else "real"
    # Standard output is for results, perhaps as JSON.
    notice = partial(report, file=sys.stderr)
    with ResourceManager(_devices(options, pace), clock, notice) as resources:
        resources.check()
        try:
            camera = resources.obtain("camera", Camera)
        except NotAvailable as error:
            raise NotAvailable(f"{error}; --simulated shows a simulated room") from error
        if options.simulated:
            person = resources.obtain("world", SimulatedWorld).person
            for name, at in SHOW:
                person.move(name, at)
            for name, at in HANDS:
                person.show(name, at)
        yield camera


def _devices(options: argparse.Namespace, pace: str) -> list[Description]:
    view = {"mirror": "true"} if options.mirror else {}
    if options.rotate != "0":
        view["rotate"] = options.rotate
    if options.view is not None:
        view["field_of_view"] = f"{math.radians(options.view):.6f}"
    if options.video is not None:
        if options.video.is_dir():
            raise HriError(f"{options.video}: a folder - give it to --images")
        check_video(options.video)
        file = {"file": str(options.video), "pace": pace}
        return [Description("camera", "Hri.VideoFileCamera", file | view)]
    if options.images is not None:
        folder = {"folder": str(options.images), "pace": pace}
        return [Description("camera", "Hri.ImageFolderCamera", folder | view)]
    if options.camera:
        device = {"device": options.camera}
        return [Description("camera", "Hri.Webcam", device | SIZE | view)]
    if options.simulated:
        world = Description("world", "Hri.SimulatedWorld")
        return [world, Description("camera", "Hri.SimulatedCamera", SIZE | view, bus="world")]
    configuration = load_configuration(paths.find("config", options.config))
    devices = list(apply_choices(configuration.devices, load_choices()))
    if all(device.id != "camera" for device in devices):
        raise HriError(f'{options.config}: no device "camera" - add one, or give --video FILE')
    own = {**view, "stand_in": ""}
    return [
        replace(device, parameters={**device.parameters, **own})
        if device.id == "camera"
        else device
        for device in devices
    ]


@contextmanager
def interruption() -> Iterator[Callable[[], bool]]:
    """Whether Ctrl-C was pressed, so that a film is finished first; pressed again, it ends the
    program.
    """
    is_pressed = False

    def press(*_: object) -> None:
        nonlocal is_pressed
        is_pressed = True
        signal.signal(signal.SIGINT, before)

    before = signal.signal(signal.SIGINT, press)
    try:
        yield lambda: is_pressed
    finally:
        signal.signal(signal.SIGINT, before)


def frames_of(
    camera: Camera, seconds: float = math.inf, is_over: Callable[[], bool] = lambda: False
) -> Iterator[Frame]:
    """The newest picture of a camera each time, until the camera, Ctrl-C or the time limit ends
    it.
    """
    clock = camera.manager.clock
    begun, first = clock.now(), math.nan
    while not is_over():
        frame = camera.read(clock.now())
        if frame is None:
            if camera.has_ended or clock.now() - begun > seconds:
                return
            clock.advance(LOOK)
            continue
        first = frame.time if math.isnan(first) else first
        if frame.time - first > seconds:
            return
        yield frame


def paced(pictures: Iterable[tuple[float, Image]], rate: float = FILM_RATE) -> Iterator[Image]:
    """Pictures with their times in seconds, repeated or dropped to match a frame rate."""
    count, begin, last = 0, math.nan, None
    for time, picture in pictures:
        begin = time if math.isnan(begin) else begin
        due = round((time - begin) * rate)
        if last is not None:
            for _ in range(min(due - count, MOST_REPEATS)):
                yield last
            count = max(count, due)
        last = picture
    if last is not None:
        yield last
