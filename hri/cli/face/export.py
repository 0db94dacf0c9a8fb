"""`hri face export`: writes a baked face as JSON, for other programs that draw it."""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from pathlib import Path

from hri.core.quoting import report
from hri.core.writing import write_text
from hri.face import FaceModel, load_face
from hri.face.drawing.serialization import Plain, exported
from hri.face.vocabulary import MOTIONS


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("face", metavar="DIR|NAME", help="a folder, or a name in faces/")
    parser.add_argument("--out", required=True, type=Path, metavar="FILE.json")


def run(options: argparse.Namespace) -> int:
    folder = Path(options.face)
    model = load_face(folder if folder.is_dir() else options.face)
    text = json.dumps(exported_face(model), separators=(",", ":"), sort_keys=True)
    write_text(options.out, text + "\n")
    report(f"{options.out}: {len(text) / 1000:.0f} kB")
    return 0


def exported_face(model: FaceModel) -> Plain:
    """The data needed to draw a face from the weights of its channels, and to name them."""
    settings = model.settings
    return {
        "name": model.name,
        "about": settings.about,
        "background": [list(color) for color in settings.background],
        "motions": {"names": list(MOTIONS), **asdict(settings.motion)},
        "expressions": {label: dict(weights) for label, weights in model.expressions.items()},
        "visemes": {name: dict(weights) for name, weights in model.visemes.items()},
        "display": exported(model.display),
    }
