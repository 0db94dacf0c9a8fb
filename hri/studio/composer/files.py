"""Networks as files: where they are, which may be written, and drafts of what is not saved.

The file on the disk is the only truth. It is replaced whole or not at all, and only while it is
still what the page believes it to be. A draft lies beside its file, or in the user's folder where
nothing may be written there.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import private_folder
from hri.core.reading import parse_json, read_bytes
from hri.core.writing import PRIVATE, NotWritten, delete, make_folder, write_bytes
from hri.robot.app import load_app

LARGEST = 1_000_000
"""Bytes of a network."""
MOST_LISTED = 1000
SUFFIX = ".draft"
_FOLDERS = {"config/networks": "network", "networks": "network", "config/primitive": "primitive"}
_ROOT = b"<BehaviorNetwork"
_LONGEST_HEAD = 4096
"""Bytes before which a network begins."""

Json = dict[str, Any]


class NoFile(HriError):
    """There is no such network."""


class Changed(HriError):
    """The file is not what the page believes it to be."""

    def __init__(self, message: str, text: str, mark: str | None) -> None:
        super().__init__(message)
        self.text, self.mark = text, mark


@dataclass(frozen=True)
class Library:
    """The networks that can be opened."""

    now: Callable[[], float]
    """Seconds since 1970."""
    start: Path = field(default_factory=Path.cwd)
    """The folder in which the studio was started: new networks go there."""
    running: Sequence[Path] = ()
    """Those of the app that runs, wherever they are."""

    @property
    def home(self) -> Path:
        """Where new networks go."""
        is_ours = os.access(self.start, os.W_OK) and not _is_installed(self.start)
        return self.start if is_ours else paths.data_folder() / "networks"

    def listed(self) -> Json:
        """All that are known, apps first, each once."""
        found: dict[str, Json] = {}
        for path, kind, app in (*self._of_apps(), *self._of_folders(), *self._drafted()):
            if len(found) < MOST_LISTED:
                found.setdefault(str(path), self._row(path, kind, app))
        return {"networks": list(found.values()), "home": str(self.home)}

    def _row(self, path: Path, kind: str, app: str | None) -> Json:
        return {
            "path": str(path),
            "name": path.stem,
            "folder": str(path.parent),
            "app": app,
            "kind": kind,
            "is_writable": not why_not(path),
            "has_draft": _draft_of(path).is_file(),
        }

    def _of_apps(self) -> Iterator[tuple[Path, str, str | None]]:
        for folder in dict.fromkeys(self._app_folders()):
            with suppress(HriError):
                app = load_app(str(folder))
                for path in app.networks:
                    yield path.resolve(), "app", app.name

    def _app_folders(self) -> Iterator[Path]:
        for root in (self.start, *paths.search_folders()):
            for base in (root, root / "apps"):
                for mark in sorted(base.glob("*/app.toml")):
                    yield mark.parent.resolve()
        for path in self.running:
            if (path.parent / "app.toml").is_file():
                yield path.parent.resolve()

    def app(self, name: str) -> Json:
        """The networks of an app, in its order. Raises HriError."""
        return {"name": name, "networks": [str(path) for path in load_app(name).networks]}

    def _of_folders(self) -> Iterator[tuple[Path, str, str | None]]:
        for path in self.running:
            yield path.resolve(), "network", None
        for folder in dict.fromkeys((self.start, self.home)):
            yield from ((path, "network", None) for path in _networks_in(folder, "*.xml"))
        for root in paths.search_folders():
            for below, kind in _FOLDERS.items():
                yield from ((path, kind, None) for path in _networks_in(root / below, "**/*.xml"))

    def _drafted(self) -> Iterator[tuple[Path, str, str | None]]:
        """Networks that were never saved."""
        for folder in (self.home, _drafts()):
            for file in sorted(folder.glob(f".*{SUFFIX}")):
                with suppress(HriError, KeyError, TypeError):
                    path = Path(_read_draft(file)["path"])
                    if self.may_see(path):
                        yield path, "network", None

    def may_see(self, path: Path) -> bool:
        """Whether it is in a folder whose networks the page shows."""
        if path.suffix != ".xml" or not path.is_absolute():
            return False
        real = Path(os.path.realpath(path))
        roots = [self.start, self.home, *paths.search_folders()]
        roots += [one.parent for one in self.running]
        return any(real.is_relative_to(Path(os.path.realpath(root))) for root in roots)

    def path_of(self, text: str) -> Path:
        """The path that the page names. Raises HriError for one that is not its business."""
        try:
            path = Path(os.path.normpath(text))
            is_seen = bool(text) and "\0" not in text and self.may_see(path)
        except (OSError, ValueError):
            is_seen = False
        if not is_seen:
            what = f'"{text[:200]}" is not in a folder of networks'
            raise HriError(f"{what} - name an .xml file in {self.home}, or set HRI_PATH")
        return path

    def open(self, text: str) -> Json:
        """A network and its draft, if there is one. Raises HriError, NoFile."""
        path = self.path_of(text)
        draft = _draft_of(path)
        kept = _read_draft(draft) if paths.is_file(draft) else None
        if not paths.is_file(path) and kept is None:
            raise NoFile(f"{path}: there is no such network - it may have been moved")
        content, mark = _content(path)
        return {
            "path": str(path),
            "text": content,
            "mark": mark,
            "is_writable": not why_not(path),
            "why": why_not(path),
            "draft": kept and {key: kept.get(key) for key in ("text", "mark", "time")},
        }

    def save(self, text: str, content: str, mark: str | None) -> Json:
        """Replace a file that is as `mark` says, and forget its draft. Raises HriError, Changed."""
        path = self.path_of(text)
        if why := why_not(path):
            raise HriError(f"{path}: {why} - save it as another file")
        here, now = _content(path)
        if now != mark:
            what = f"{path}: changed since it was opened" if now else f"{path}: was removed"
            raise Changed(f"{what} - choose which text to keep", here, now)
        data = _encoded(content)
        make_folder(path.parent)
        write_bytes(path, data)
        delete(_draft_of(path))
        return {"mark": _mark(data)}

    def keep_draft(self, text: str, content: str, mark: str | None) -> Json:
        """Keep what is not saved. Raises HriError."""
        path = self.path_of(text)
        _encoded(content)
        draft = _draft_of(path)
        kept = {"path": str(path), "text": content, "mark": mark, "time": self.now()}
        if draft.parent == _drafts():
            private_folder(draft.parent)
        else:
            make_folder(draft.parent)
        write_bytes(draft, json.dumps(kept, ensure_ascii=False).encode("utf-8"), PRIVATE)
        return {}

    def drop_draft(self, text: str) -> Json:
        """Forget a draft, if there is one."""
        delete(_draft_of(self.path_of(text)))
        return {}

    def watch(self, text: str, mark: str) -> Json:
        """Whether the file is still as `mark` says; its text where it is not."""
        content, now = _content(self.path_of(text))
        return {"mark": now} if (now or "") == mark else {"mark": now, "text": content}


def why_not(path: Path) -> str:
    """Why a file cannot be written; empty when it can."""
    if _is_installed(path):
        return "it belongs to the installation"
    folder = path.parent
    while not paths.exists(folder) and folder != folder.parent:
        folder = folder.parent
    is_open = os.access(path, os.W_OK) if paths.exists(path) else True
    return "" if is_open and os.access(folder, os.W_OK) else "its folder or file is write-protected"


def _is_installed(path: Path) -> bool:
    """Whether it came with the package; the files of a checkout are its owner's."""
    house = paths.house()
    is_checkout = (house / "pyproject.toml").is_file()
    return not is_checkout and Path(os.path.realpath(path)).is_relative_to(house)


def _networks_in(folder: Path, pattern: str) -> Iterator[Path]:
    for path in sorted(folder.glob(pattern)):
        with suppress(OSError):
            if not path.name.startswith(".") and path.is_file():
                with path.open("rb") as file:
                    if _ROOT in file.read(_LONGEST_HEAD):
                        yield path


def _drafts() -> Path:
    return paths.data_folder() / "drafts"


def _draft_of(path: Path) -> Path:
    beside = path.parent / f".{path.name}{SUFFIX}"
    if not _is_installed(path) and path.parent.is_dir() and os.access(path.parent, os.W_OK):
        return beside
    return _drafts() / f".{_mark(str(path).encode('utf-8', 'surrogateescape'))[:32]}{SUFFIX}"


def _read_draft(file: Path) -> Json:
    """Raises HriError for one that is damaged."""
    try:
        kept = parse_json(read_bytes(file, "draft", 4 * LARGEST))
    except ValueError as error:
        raise HriError(f"{file}: the draft is damaged - delete it") from error
    if not isinstance(kept, dict) or not isinstance(kept.get("text"), str):
        raise HriError(f"{file}: the draft is damaged - delete it")
    return kept


def _content(path: Path) -> tuple[str, str | None]:
    """Text and mark of a file; empty and None where there is none. Raises HriError."""
    if not paths.exists(path):
        return "", None
    data = read_bytes(path, "network", LARGEST)
    try:
        return data.decode("utf-8"), _mark(data)
    except UnicodeDecodeError as error:
        raise HriError(f"{path}: not UTF-8 text - save it as UTF-8") from error


def _encoded(content: str) -> bytes:
    try:
        data = content.encode("utf-8")
    except UnicodeEncodeError as error:
        raise HriError("the text has half a character in it - remove it") from error
    if len(data) > LARGEST:
        raise NotWritten(f"a network of {len(data)} bytes - at most {LARGEST} are kept")
    return data


def _mark(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
