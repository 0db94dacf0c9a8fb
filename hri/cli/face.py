"""`hri face`: render, survey, check and list faces."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.face import load_face, render_face
from hri.face.model import FaceModel
from hri.face.vocabulary import ARKIT, PAIRED, SINGLE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    commands = parser.add_subparsers(dest="face_command", metavar="COMMAND", required=True)
    render = commands.add_parser("render", help="draw one picture")
    render.set_defaults(face_run=_render)
    _add_render_arguments(render)
    sheet = commands.add_parser("sheet", help="draw all expressions and visemes, with labels")
    sheet.set_defaults(face_run=_sheet)
    sheet.add_argument("--face", default="robot", metavar="NAME")
    sheet.add_argument("--out", required=True, type=Path, metavar="FILE.png")
    check = commands.add_parser("check", help="load a face and report what is wrong")
    check.set_defaults(face_run=_check)
    check.add_argument("face", metavar="DIR|NAME")
    listing = commands.add_parser("list", help="show the faces there are")
    listing.set_defaults(face_run=_list)


def _add_render_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("--face", default="robot", metavar="NAME", help="from faces/, or a folder")
    share = "with =x for a share from 0 to 1"
    add("--expression", default="neutral", metavar="LABEL[=x]", help=share)
    add("--viseme", metavar="V[=x]", help=f"one of Oculus' 15, {share}")
    add("--weights", metavar="NAME=x,...", help="morph targets to add")
    look = "-1 to 1: to the viewer's right, and up (write --gaze=-0.5,0)"
    add("--gaze", type=_pair, default=(0.0, 0.0), metavar="X,Y", help=look)
    add("--time", type=float, metavar="T", help="add idle life as it is after T seconds")
    add("--seed", type=int, default=0, metavar="N", help="of the idle life")
    add("--size", type=_size, default=(640, 480), metavar="WxH", help="in pixels")
    add("--out", required=True, type=Path, metavar="FILE.png")


def run(options: argparse.Namespace) -> int:
    status: int = options.face_run(options)
    return status


def _render(options: argparse.Namespace) -> int:
    from hri.face.renderers.sheet import write_png

    label, intensity = _share(options.expression)
    picture = render_face(
        options.face,
        label,
        intensity,
        viseme=dict([_share(options.viseme)]) if options.viseme else None,
        weights=dict(_share(part) for part in (options.weights or "").split(",") if part),
        gaze=options.gaze,
        time=options.time,
        seed=options.seed,
        size=options.size,
    )
    write_png(options.out, picture)
    return 0


def _sheet(options: argparse.Namespace) -> int:
    from hri.face.renderers.sheet import draw_sheet, write_png

    write_png(options.out, draw_sheet(load_face(options.face)))
    return 0


def _check(options: argparse.Namespace) -> int:
    folder = Path(options.face)
    model = load_face(folder if folder.is_dir() else options.face)
    for warning in _warnings(model):
        print(f"warning: {warning}")
    print(
        f"{model.name}: fine, {len(model.targets)} targets, {len(model.expressions)} expressions,"
        f" {len(model.visemes)} visemes"
    )
    return 0


def _warnings(model: FaceModel) -> Iterator[str]:
    """What loads, but is likely a slip."""
    settings = model.settings
    used = {name for weights in model.expressions.values() for name in weights}
    used |= {name for weights in model.visemes.values() for name in weights}
    gaze = settings.gaze
    for ways in (
        gaze.left,
        gaze.right,
        gaze.up,
        gaze.down,
        settings.blink.weights,
        settings.pupils,
    ):
        used |= set(ways)
    for target in model.targets:
        if not any(name == target or name[: len(target)] == target for name in used):
            near = did_you_mean(target, (*ARKIT, *PAIRED, *SINGLE), "name it in face.toml")
            yield f"nothing uses targets/{target}.svg - {near}"


def _list(options: argparse.Namespace) -> int:
    for name in paths.names("faces"):
        try:
            about = load_face(name).settings.about
        except HriError as error:
            about = f"broken: {error}"
        print(f"{name:12} {about}")
    return 0


def _share(text: str) -> tuple[str, float]:
    """`happy=0.5` as a name and a number, 1 when there is none."""
    name, equals, number = text.partition("=")
    try:
        return name.strip(), float(number) if equals else 1.0
    except ValueError:
        raise HriError(f'"{text}": "{number}" is no number - write {name}=0.5') from None


def _pair(text: str) -> tuple[float, float]:
    try:
        x, y = (float(part) for part in text.split(","))
    except ValueError:
        raise argparse.ArgumentTypeError(
            f'"{text}" - write two numbers, such as 0.5,-0.2'
        ) from None
    return x, y


def _size(text: str) -> tuple[int, int]:
    try:
        width, height = (int(part) for part in text.lower().split("x"))
    except ValueError:
        raise argparse.ArgumentTypeError(f'"{text}" - write pixels, such as 640x480') from None
    return width, height
