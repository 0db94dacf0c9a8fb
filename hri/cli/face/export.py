"""`hri face export`: a baked face as JSON, for whoever draws the same shapes elsewhere."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from hri.core.writing import write_text
from hri.face import load_face
from hri.face.exchange import exported_face


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("face", metavar="DIR|NAME", help="a folder, or a name in faces/")
    parser.add_argument("--out", required=True, type=Path, metavar="FILE.json")


def run(options: argparse.Namespace) -> int:
    folder = Path(options.face)
    model = load_face(folder if folder.is_dir() else options.face)
    text = json.dumps(exported_face(model), separators=(",", ":"), sort_keys=True)
    write_text(options.out, text + "\n")
    print(f"{options.out}: {len(text) / 1000:.0f} kB")
    return 0
