"""The files that decide a run, and whether they are as they were."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from hri.core import paths
from hri.core.recorded import FILES
from hri.robot.skills import own_folder as own_skills
from hri.speech.pronunciation.lexicon import user_lexicon
from hri.vision.color.color_model import own_colors
from hri.vision.objects.model_file import own_models

CODE = Path(__file__).parents[1]
"""The folder of hri itself: between two versions, it changes as well."""
KINDS = ("apps", "config", "emotions", "faces", "grammars", "skills")
"""What is looked for in the search folders."""
AUTHORED = frozenset((".color", ".gram", ".jsgf", ".mdl", ".py", ".svg", ".toml", ".txt", ".xml"))
"""Suffixes of the files that count in a folder."""
PASSED_OVER = ("node_modules", "recordings")
"""Folders that do not, besides those whose names begin with a point or a line."""


def of_every_run() -> Iterator[Path]:
    """The code, what the search folders hold, and the user's lexicon, colors, models and skills."""
    yield CODE
    yield user_lexicon()
    yield own_colors()
    yield own_models()
    yield own_skills()
    for folder in paths.search_folders():
        yield from (folder / kind for kind in KINDS)


def digests(sources: Iterable[Path]) -> dict[str, str | None]:
    """SHA-256 of files, and of the authored files of folders, by their absolute paths; None for
    what is not there, or cannot be read.
    """
    return {str(source): _digest(source) for source in dict.fromkeys(map(Path.resolve, sources))}


def changed(sources: Mapping[str, str | None]) -> list[str]:
    """The paths of what is no longer as it was, sorted."""
    now = digests([Path(path) for path in sources])
    return sorted(path for path in sources if now.get(path) != sources[path])


def authored(folder: Path) -> list[Path]:
    """The authored files right in a folder, sorted; none in one that cannot be read."""
    try:
        return sorted(path for path in folder.iterdir() if _counts(path))
    except OSError:
        return []


def _counts(path: Path) -> bool:
    return path.suffix in AUTHORED and path.name not in FILES and path.is_file()


def _digest(source: Path) -> str | None:
    try:
        if source.is_file():
            return _sha256(source)
        if not source.is_dir():
            return None
        files = sorted(path for path in _below(source) if _counts(path))
        lines = [f"{path.relative_to(source)} {_sha256(path)}\n" for path in files]
    except OSError:
        return None
    return hashlib.sha256(os.fsencode("".join(lines))).hexdigest()


def _below(folder: Path) -> Iterator[Path]:
    """The files of a folder and of those in it, except for what is fetched or made."""
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name[0] not in "._" and name not in PASSED_OVER]
        yield from (Path(root, name) for name in names)


def _sha256(file: Path) -> str:
    with file.open("rb") as opened:
        return hashlib.file_digest(opened, "sha256").hexdigest()
