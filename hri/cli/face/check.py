"""`hri face check`: loads a face and reports errors and likely mistakes."""

from __future__ import annotations

import argparse
import sys

from hri.core import paths
from hri.core.quoting import message_line, report
from hri.face import load_face
from hri.face.motion.gesture_tracks import load_gestures
from hri.face.vocabulary import CORRECTIVE


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("face", metavar="DIR|NAME", help="a folder, or a name in faces/")


def run(options: argparse.Namespace) -> int:
    """Exit status 1 when there are warnings, 2 when the face cannot be loaded."""
    from hri.face.lint import findings
    from hri.face.mistakes import mistakes

    folder = paths.find("faces", options.face)
    if wrong := mistakes(folder):
        for error in wrong:
            print(error, file=sys.stderr)
        return 2
    model = load_face(folder)
    load_gestures(model)
    found = findings(model, folder)
    for finding in found:
        print(message_line(str(finding)))
    warnings = sum(finding.is_slip for finding in found)
    drawn = sum(CORRECTIVE not in target for target in model.targets)
    report(
        f"{folder}: {drawn} targets, {len(model.targets) - drawn} correctives,"
        f" {len(model.expressions)} expressions, {len(model.visemes)} visemes,"
        f" {model.display.points} points: {_counted(warnings)}"
    )
    return 1 if warnings else 0


def _counted(warnings: int) -> str:
    return {0: "ok", 1: "1 warning"}.get(warnings, f"{warnings} warnings")
