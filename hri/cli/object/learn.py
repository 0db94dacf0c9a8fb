"""`hri object learn`: learns an object from what is shown."""

from __future__ import annotations

import argparse
import math
from collections.abc import Iterator
from datetime import date
from pathlib import Path

from hri.cli.object.options import add_set
from hri.cli.terminal.messages import Within
from hri.cli.vision.taught import LeftOut, stills_of
from hri.cli.vision.watching import add_view, frames_of, opened_camera
from hri.core.clock import FakeClock, RealClock
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.signals import Image
from hri.vision.camera_view import CameraView
from hri.vision.objects.cutout import opaque, whole
from hri.vision.objects.held_up import HeldUp, HeldUpFinder
from hri.vision.objects.learning import (
    ObjectLearner,
    Shown,
    scale_from_distance,
    scale_from_width,
)
from hri.vision.objects.local_features import METHODS, SIFT
from hri.vision.objects.model_file import (
    NAME_REMEDY,
    is_name,
    load_or_new,
    own_models,
    save_models,
)
from hri.vision.objects.object_model import Outline

EPILOG = """\
Turn the object slowly while the camera looks: a view is kept when it shows something new. With
--width or --distance its distance will be known later. Pictures with a transparent or an even
background are cut out; of others --whole takes all."""
SECONDS = 10.0
"""How long a camera looks, unless told otherwise."""
EVERY = 0.3
"""Seconds between two pictures of a video or camera that are looked at."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    add = parser.add_argument
    add("name", metavar="NAME", help="what to call it: cup")
    source = parser.add_mutually_exclusive_group(required=True)
    source.add_argument(
        "--images", nargs="+", type=Path, metavar="FILE", help="pictures, or folders of them"
    )
    source.add_argument("--video", type=Path, metavar="FILE", help="a video of the object")
    about = "the configured camera, or one of this machine: 0, 1 ... or its path"
    source.add_argument("--camera", nargs="?", const="", metavar="N", help=about)
    source.add_argument("--simulated", action="store_true", help="the camera of the simulated room")
    add_view(parser)
    add_set(parser)
    add("--width", type=Within(float, 0.1, 1000), metavar="CM", help="how wide the object is")
    add("--distance", type=Within(float, 1, 1000), metavar="CM", help="how far away it is shown")
    add("--whole", action="store_true", help="the object fills the pictures")
    add("--features", choices=tuple(METHODS), default=SIFT, help="of a new set (%(default)s)")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when a picture was left out, 2 when nothing was learned."""
    if not is_name(options.name):
        raise HriError(f'"{options.name}" is not a valid name for an object - {NAME_REMEDY}')
    path = own_models() if options.models is None else Path(options.models)
    models = load_or_new(path, options.features)
    learner, left_out = ObjectLearner(options.name, models), LeftOut()
    pictures = _from_files(options, left_out) if options.images else _from_camera(options)
    is_blind = True
    for image, held_up, source, focal_length in pictures:
        is_blind = False
        if (outline := held_up.outline) is None:
            learner.refuse(held_up.reason)
            report(f"{source}: not kept: {held_up.reason}", flush=True)
            continue
        scale = _scale(options, outline, focal_length)
        shown = learner.show(image, outline, scale, source, has_moved=held_up.has_moved)
        _print(learner, shown, source)
    if is_blind and left_out.count:
        raise HriError(f"no picture to learn {options.name} from - give one that can be read")
    model = learner.model(date.today().isoformat())
    save_models(path, models.with_object(model))
    count = len(model.views)
    report(f'learned "{options.name}" from {count} view{"s" * (count != 1)}: {path}')
    return left_out.status


Picture = tuple[Image, HeldUp, str, float]
"""An image, the object in it, where the image is from, and its focal length in pixels."""


def _from_files(options: argparse.Namespace, left_out: LeftOut) -> Iterator[Picture]:
    view = CameraView() if options.view is None else CameraView(math.radians(options.view))
    for file, still in stills_of(options.images, left_out):
        is_whole = options.whole and still.alpha is None
        outline = whole(still.image) if is_whole else opaque(still.image, still.alpha)
        if outline is None:
            left_out.add(f"{file}: it is transparent, and shows nothing - take another picture")
            continue
        size = still.image.shape[1], still.image.shape[0]
        yield still.image, HeldUp(outline), str(file), view.focal_length(size)


def _from_camera(options: argparse.Namespace) -> Iterator[Picture]:
    """Pictures of the camera or video, of which the object is in the middle."""
    is_live = options.video is None and not options.simulated
    if is_live and math.isinf(options.seconds):
        options.seconds = SECONDS
        report(f"show it to the camera and turn it slowly for {SECONDS:g} s", flush=True)
    finder = HeldUpFinder(is_whole=options.whole)
    with opened_camera(options, RealClock() if is_live else FakeClock()) as camera:
        view, due = CameraView.of(camera), -math.inf
        for frame in frames_of(camera, options.seconds):
            if frame.time >= due:
                due = frame.time + EVERY
                focal_length = view.focal_length((frame.width, frame.height))
                yield frame.image, finder.find(frame.image), camera.describe(), focal_length


def _scale(options: argparse.Namespace, outline: Outline, focal_length: float) -> float:
    """Meters to a pixel; 0 when nothing was said about the size."""
    if options.width is not None:
        return scale_from_width(outline, options.width / 100)
    if options.distance is not None:
        return scale_from_distance(options.distance / 100, focal_length)
    return 0.0


def _print(learner: ObjectLearner, shown: Shown, source: str) -> None:
    what = f"view {learner.count}" if shown.is_new else "not kept"
    warning = f'; looks like "{shown.mistaken}"' if shown.mistaken else ""
    report(f"{source}: {what}: {shown.reason}{warning}", flush=True)
