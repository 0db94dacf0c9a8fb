"""`hri face new`: a copy of a face to start a new one from."""

from __future__ import annotations

import argparse
import re
import shutil
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.core.writing import make_folder, new_folder
from hri.face import load_face
from hri.face.model import stamps_of
from hri.face.motion.gesture_tracks import FILE as GESTURES

NAME = re.compile(r"[a-z][a-z0-9_]{0,39}")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    add = parser.add_argument
    add("name", metavar="NAME", help="small letters, digits and _: my_robot")
    add("--from", dest="source", default="robot", metavar="FACE", help="what to copy (%(default)s)")
    add("--dir", type=Path, default=Path(), metavar="DIR", help="where to put its folder (here)")


def run(options: argparse.Namespace) -> int:
    if not NAME.fullmatch(options.name):
        what = f'"{options.name}" is not a valid name for a face'
        raise HriError(f"{what} - write small letters, digits and _: my_robot")
    folder: Path = options.dir / options.name
    if folder.exists() or folder.is_symlink():
        raise HriError(f"{folder}: already exists - choose another name, or --dir another folder")
    source = paths.find("faces", options.source)
    load_face(source)
    make_folder(folder.parent)
    with new_folder(folder) as new:
        _copy(source, new)
    spelled = folder if folder.is_absolute() else f"./{folder}"
    report(f"{folder}: a copy of {source.name}. Next:")
    print()
    report(f"  draw in {folder / 'neutral.svg'} and {folder / 'targets'}/ with an SVG editor")
    report(f"  hri face show {spelled} --watch     # shows each change when you save")
    report(f"  hri face check {spelled}            # reports mistakes")
    report(f"  hri companion --face {spelled}      # runs with it")
    return 0


def _copy(source: Path, folder: Path) -> None:
    """Copy only the files of a face from its folder."""
    own_gestures = [source / GESTURES] if (source / GESTURES).is_file() else []
    for file in (*(file for file, *_ in stamps_of(source)), *own_gestures):
        target = folder / file.relative_to(source)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(file, target)
