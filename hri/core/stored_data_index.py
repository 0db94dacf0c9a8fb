"""Notes where data about people is stored outside the robot's own folders.

A recording, a film of the camera, a sound of the microphone, a draft of a network, an export of the
memory, or a file of people, faces, objects, colors, or feelings, lies where someone wanted it. So
that all of it can be found and forgotten, its place is noted in the state folder, a JSON object a
line:
`{"kind": "recording", "place": "/home/ann/out"}`.
"""

from __future__ import annotations

import json
import logging
import os
from contextlib import suppress
from pathlib import Path
from typing import Literal

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import private_file, private_folder
from hri.core.reading import parse_json, read_text
from hri.core.writing import PRIVATE, append_line, write_text

Kind = Literal[
    "recording",
    "faces",
    "feelings",
    "pictures",
    "objects",
    "colors",
    "sounds",
    "drafts",
    "people",
    "exports",
]

MOST_BYTES = 50_000_000

log = logging.getLogger("hri.whereabouts")


def whereabouts_file() -> Path:
    """Where the places are noted."""
    return paths.state_folder() / "whereabouts.jsonl"


def note(kind: Kind, place: Path) -> None:
    """Note that something of that kind lies there. Where it cannot be noted, that is logged."""
    place = place.resolve()
    try:
        file = whereabouts_file()
        if (kind, place) in _noted(file):
            return
        private_folder(file.parent)
        private_file(file)
        append_line(file, _line(kind, place))
    except (HriError, OSError) as error:
        log.warning("%s: `hri forget` will not find it: %s", place, error)


def noted(kind: Kind) -> list[Path]:
    """The noted places that still exist, in the order in which they were noted. Raises HriError
    when the notes cannot be read.
    """
    places = [place for of, place in _noted(whereabouts_file()) if of == kind]
    return [place for place in places if os.path.lexists(place)]


def tidy() -> None:
    """Take the places of what is gone out of the notes. Raises HriError."""
    file = whereabouts_file()
    before = _noted(file)
    lines = [_line(kind, place) for kind, place in before if os.path.lexists(place)]
    if lines:
        write_text(file, "\n".join([*lines, ""]), PRIVATE)
    elif before or file.exists():
        file.unlink(missing_ok=True)


def _line(kind: str, place: Path) -> str:
    return json.dumps({"kind": kind, "place": os.fspath(place)})


def _noted(file: Path) -> dict[tuple[str, Path], None]:
    """Kinds and places; lines that make no sense are left out."""
    if not file.exists():
        return {}
    found: dict[tuple[str, Path], None] = {}
    for line in read_text(file, "list of places", MOST_BYTES).splitlines():
        with suppress(ValueError, TypeError, KeyError):
            entry = parse_json(line)
            found[entry["kind"], Path(entry["place"])] = None
    return found
