"""`test_camera`: write some pictures of each camera to files."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from hri.cli import diagnostics
from hri.cli.terminal.messages import Within
from hri.core.errors import HriError, NotAvailable
from hri.core.quoting import report
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE
from hri.hal.camera import Camera
from hri.hal.drivers.image_size import write_picture

HELP = """\
Usage: test_camera [OPTIONS] [<camera1_id> [..<cameraN_id>]]

Writes pictures of the named cameras, or of all of them, to <camera_id>_<number>.jpg.

OPTIONS:
  --frames <count>         Frames to output (default = 5).
  --quality <quality>      Quality from [0-1] (default = 0.8).
  --pause-time <duration>  Duration to pause between readings, in seconds
                           (default = 0.1 = 100ms).
  --out <folder>           Folder for the files (default = the current folder).
  --config <file>          The devices (default = resource-config).
  --fast                   Fake time: stand-ins replace real cameras.

Exit status: 0, or 1 when a camera failed, or 2 when an option or a file is wrong.
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Take the pictures. Exit status 0, 1 when a camera failed, 2 when an option or file is."""
    parser = diagnostics.parser("test_camera", HELP)
    parser.add_argument("ids", nargs="*")
    parser.add_argument("--frames", type=Within(int, 1, 999), default=5)
    parser.add_argument("--quality", type=Within(float, 0, 1), default=0.8)
    parser.add_argument("--pause-time", type=Within(float, 0, 3600), default=0.1)
    parser.add_argument("--out", type=Path, default=Path())
    return diagnostics.run(parser, HELP, _test, arguments)


def _test(options: argparse.Namespace) -> int:
    with diagnostics.resources_of(options) as resources:
        ids = options.ids or resources.ids(Camera)
        if not ids:
            raise HriError(f"{options.config}: no camera in it - add one, or name another")
        _make_folder(options.out)
        cameras, failures = diagnostics.obtained(resources, ids, Camera)
        print("*** test_camera ***")
        report(f"Obtained cameras: {', '.join(camera.id for camera in cameras)}")
        if not cameras:
            print("none of them is available - see the lines above", file=sys.stderr)
            return 1
        report(
            f"Frame count: {options.frames}. Pause time: {options.pause_time:g} sec.", flush=True
        )
        for number in range(1, options.frames + 1):
            if number > 1:
                resources.clock.advance(options.pause_time)
            for camera in list(cameras):
                try:
                    _take_picture(camera, number, options)
                except NotAvailable as error:
                    print(error, file=sys.stderr)
                    cameras.remove(camera)
                    failures += 1
    return 1 if failures else 0


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise HriError(f"{folder}: cannot be made: {error.strerror} - check the path") from error


def _take_picture(camera: Camera, number: int, options: argparse.Namespace) -> None:
    frame = camera.take()
    path = options.out / f"{camera.id}_{number:03d}.jpg"
    report(f"Writing file {path}", flush=True)
    write_picture(path, frame.image, options.quality, PRIVATE)
    note("pictures", path)


if __name__ == "__main__":
    sys.exit(main())
