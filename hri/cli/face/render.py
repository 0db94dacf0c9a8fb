"""`hri face render`: one picture of a face."""

from __future__ import annotations

import argparse
from pathlib import Path

from hri.cli.face.options import FACE, pair, pixels, share
from hri.core.errors import HriError
from hri.core.picture_writer import EXACT
from hri.core.signals import Image
from hri.face import FaceModel, load_face
from hri.face.drawing.baking import Vector
from hri.face.layers import LAYERS
from hri.face.still import still_vector
from hri.hal.drivers.image_size import write_picture

HELP = """\
A named expression or viseme is shown at its apex; --time moves idle life only.

  hri face render --expression happy --out happy.png
  hri face render --expression sad=0.5 --viseme aa --gaze=-0.5,0.2 --yaw 15 --out talking.png
  hri face render --valence 0.6 --arousal -0.4 --time 12.5 --seed 3 --out calm.png
  hri face render --expression sad --transparent --layer ink --out features.png"""

LAYER = "draw only what [layers] in its face.toml lists; several times for more than one"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.formatter_class = argparse.RawDescriptionHelpFormatter
    parser.epilog = HELP
    add = parser.add_argument
    add("--face", default="robot", metavar="NAME", help=FACE)
    part = "with =x for a share from 0 to 1"
    add("--expression", default="neutral", metavar="LABEL[=x]", help=part)
    add("--viseme", metavar="V[=x]", help=f"one of Oculus' 15 or Rhubarb's, {part}")
    add(
        "--weights",
        default="",
        metavar="NAME=x,...",
        help="morph targets to add, -1.5 to 1.5; 1 without a number",
    )
    add("--valence", type=float, metavar="V", help="-1 to 1: a mood, below the expression")
    add("--arousal", type=float, metavar="A", help="-1 to 1, likewise")
    look = "-1 to 1: to the viewer's right, and up (write --gaze=-0.5,0)"
    add("--gaze", type=pair, default=(0.0, 0.0), metavar="X,Y", help=look)
    add(
        "--yaw",
        type=float,
        default=0.0,
        metavar="DEG",
        help="turn to the viewer's right; most faces -25 to 25",
    )
    add("--pitch", type=float, default=0.0, metavar="DEG", help="turn up; most faces -15 to 15")
    add("--time", type=float, metavar="T", help="add idle motion as it is after T seconds")
    add("--seed", type=int, default=0, metavar="N", help="seed of the idle motion")
    add("--size", type=pixels, default=(640, 480), metavar="WxH", help="in pixels")
    add("--layer", action="append", default=[], choices=LAYERS, help=LAYER)
    kind = parser.add_mutually_exclusive_group()
    kind.add_argument("--bits", action="store_true", help="one bit per pixel, as on a small OLED")
    kind.add_argument(
        "--transparent", action="store_true", help="leave the background out: .png or .webp"
    )
    add("--out", required=True, type=Path, metavar="FILE.png", help="or .jpg, .webp")


def run(options: argparse.Namespace) -> int:
    if options.transparent and options.out.suffix.lower() not in EXACT:
        raise HriError(f"{options.out} cannot be transparent - write .png or .webp")
    if options.bits and options.layer:
        raise HriError("one bit is drawn from all layers - leave out --bits or --layer")
    label, intensity = share(options.expression)
    model = load_face(options.face)
    vector = still_vector(
        model,
        label,
        intensity,
        viseme=dict([share(options.viseme)]) if options.viseme else None,
        weights=dict(share(part) for part in options.weights.split(",") if part),
        gaze=options.gaze,
        time=options.time,
        seed=options.seed,
        valence=options.valence,
        arousal=options.arousal,
        yaw=options.yaw,
        pitch=options.pitch,
    )
    write_picture(options.out, _drawn(model, vector, options))
    return 0


def _drawn(model: FaceModel, vector: Vector, options: argparse.Namespace) -> Image:
    from hri.face.renderers.bits import BitRenderer
    from hri.face.renderers.renderer import Renderer

    if options.bits:
        return BitRenderer(model, options.size).picture(vector)
    kind = {"transparent": options.transparent, "layers": options.layer}
    return Renderer(model, options.size, **kind).render(vector)
