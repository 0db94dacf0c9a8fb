"""The authored files that an assistant may read, by name: no path of its choice is ever opened.

A name is the path below a search folder, `grammars/companion.jsgf`, or below an app or a skill that
runs, `apps/companion/replies.toml`. Only names that are listed here count.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import quoted
from hri.core.reading import read_text
from hri.robot.app import App

LARGEST = 400_000
"""Bytes of a file that is read."""
MOST_FILES = 2000
DEEPEST = 3
"""Folders below the one of a kind."""
KINDS = ("grammar", "replies", "face", "network", "emotion")
_SEARCHED = {
    "grammars": ("grammar", (".jsgf", ".gram")),
    "faces": ("face", (".toml", ".svg")),
    "emotions": ("emotion", (".toml",)),
    "config/networks": ("network", (".xml",)),
}
"""Folders in a search folder: the kind of the files in it, and their suffixes."""
_NOT_REPLIES = frozenset(("app.toml", "skill.toml", "demo.toml", "forms.toml", "memory.toml"))
_SUFFIXES = {".jsgf": "grammar", ".gram": "grammar", ".xml": "network"}
_REPLY = re.compile(r"^\[reply\b", re.MULTILINE)


@dataclass(frozen=True, slots=True)
class Authored:
    """A file that may be read."""

    name: str
    kind: str
    path: Path

    def read(self) -> str:
        """Its text. Raises HriError."""
        return read_text(self.path, self.kind, LARGEST)


def listed(app: App) -> dict[str, Authored]:
    """All such files by name, sorted; of files with one name the first that counts."""
    found: dict[str, Authored] = {}
    for one in (*_of_apps(app), *_of_folders()):
        found.setdefault(one.name, one)
        if len(found) == MOST_FILES:
            break
    return dict(sorted(found.items()))


def named(app: App, name: str) -> Authored:
    """The file of that name. Raises HriError."""
    known = listed(app)
    if name not in known:
        near = did_you_mean(name, known, "list_authored names them")
        raise HriError(f'no authored file "{quoted(name)}" - {near}')
    return known[name]


def _of_folders() -> Iterator[Authored]:
    for root in paths.search_folders():
        for below, (kind, suffixes) in _SEARCHED.items():
            for path in _files(root / below, DEEPEST):
                if path.suffix in suffixes:
                    yield Authored(f"{below}/{_below(root / below, path)}", kind, path)


def _of_apps(app: App) -> Iterator[Authored]:
    if app.is_network:
        yield Authored(f"apps/{app.folder.name}", "network", app.folder)
        return
    for one in app.line():
        place = f"{'skills' if one.is_skill else 'apps'}/{one.name}"
        for path in _files(one.folder, 1):
            if kind := _kind_in_app(path):
                yield Authored(f"{place}/{_below(one.folder, path)}", kind, path)


def _kind_in_app(path: Path) -> str:
    """Of a file of an app; empty for any other, such as a program."""
    if path.suffix != ".toml" or path.name in _NOT_REPLIES:
        return _SUFFIXES.get(path.suffix, "")
    try:
        return "replies" if _REPLY.search(read_text(path, "replies", LARGEST)) else ""
    except HriError:
        return ""


def _files(folder: Path, depth: int) -> Iterator[Path]:
    """Regular files in a folder and below it, sorted; none that leads out of it."""
    try:
        entries = sorted(folder.iterdir())
        real = folder.resolve()
        for path in entries:
            if path.name.startswith((".", "_")) or not path.resolve().is_relative_to(real):
                continue
            if path.is_dir() and depth and path.name != "skills":
                yield from _files(path, depth - 1)
            elif paths.is_file(path):
                yield path
    except OSError:
        return


def _below(folder: Path, path: Path) -> str:
    return path.relative_to(folder).as_posix()
