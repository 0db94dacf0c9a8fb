"""`hri face show`: a window with a moving face, which updates while you draw it."""

from __future__ import annotations

import argparse

from hri.cli.face.options import FACE, pixels
from hri.core import paths
from hri.core.clock import RealClock
from hri.face import load_face
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.screen import Screen


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("face", nargs="?", default="robot", metavar="NAME", help=f"{FACE} (%(default)s)")
    add("--watch", action="store_true", help="reload its drawings whenever they are saved")
    add("--size", type=pixels, default=(800, 600), metavar="WxH", help="of the window, in pixels")
    add("--seed", type=int, default=0, metavar="N", help="seed of its idle motion")


def run(options: argparse.Namespace) -> int:
    from hri.cli.face.face_window import LEGEND, FaceWindow

    folder = paths.find("faces", options.face)
    load_face(folder)
    width, height = options.size
    shape = {"width": str(width), "height": str(height), "title": f"hri - {folder.name}"}
    with ResourceManager([Description("screen", "Hri.Screen", shape)], RealClock()) as resources:
        resources.check()
        screen = resources.obtain("screen", Screen)
        print(LEGEND)
        window = FaceWindow(folder, screen, resources.clock, options.watch, options.seed)
        while window.is_open:
            window.frame()
    return 0
