"""`hri face list`: all faces, and what they can show."""

from __future__ import annotations

import argparse

from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.face import load_face
from hri.face.motion.gesture_tracks import load_gestures
from hri.face.vocabulary import LABELS


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """No options."""


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when one of them does not load."""
    status = 0
    for name in paths.names("faces"):
        if not paths.find("faces", name).is_dir():
            continue
        try:
            model = load_face(name)
            about = f"{model.settings.about} ({len(model.channels)} channels)"
        except HriError as error:
            about, status = f"broken: {error}", 1
        report(f"{name:12} {about}")
    print(f"\nExpressions: {', '.join(LABELS)}")
    report(f"Gestures: {', '.join(sorted(load_gestures(load_face())))}")
    return status
