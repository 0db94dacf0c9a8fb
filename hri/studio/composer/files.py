"""Networks as files: where they are, which may be written, and what is open with its drafts.

The file on the disk is the only truth. It is replaced whole or not at all, and only while it is
still what the page believes it to be.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import HriError
from hri.core.reading import read_bytes
from hri.core.writing import NotWritten, make_folder, write_bytes
from hri.robot.app import load_app
from hri.studio.composer import drafts
from hri.studio.composer.drafts import Draft, mark_of

LARGEST = 1_000_000
"""Bytes of a network."""
MOST_LISTED = 1000
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
        names = cache(drafts.names_in)
        known = (*self._of_apps(), *self._of_folders())
        folders = {self.home, drafts.user_folder(), *(path.parent for path, _, _ in known)}
        for path, kind, app in (*known, *self._drafted(sorted(folders), names)):
            if len(found) < MOST_LISTED:
                found.setdefault(str(path), self._row(path, kind, app, names))
        return {"networks": list(found.values()), "home": str(self.home)}

    def _row(self, path: Path, kind: str, app: str | None, names: drafts.Names) -> Json:
        return {
            "path": str(path),
            "name": path.stem,
            "folder": str(path.parent),
            "app": app,
            "kind": kind,
            "is_writable": not why_not(path),
            "has_draft": any(drafts.files_of(path, names)),
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

    def _drafted(
        self, folders: Sequence[Path], names: drafts.Names
    ) -> Iterator[tuple[Path, str, str | None]]:
        """Networks that were never saved."""
        for folder in folders:
            for name in sorted(names(folder)):
                with suppress(HriError):
                    path = Path(drafts.read(folder / name).path)
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
            is_short = len(os.fsencode(path.name)) <= drafts.LONGEST_NAME
            is_seen = bool(text) and "\0" not in text and is_short and self.may_see(path)
        except (OSError, ValueError):
            is_seen = False
        if not is_seen:
            what = f'"{text[:200]}" is not in a folder of networks'
            raise HriError(f"{what} - name an .xml file in {self.home}, or set HRI_PATH")
        return path

    def new(self, text: str) -> Json:
        """The path of a network that can begin there. Raises HriError."""
        if not Path(text).name.removesuffix(".xml") or text.endswith("/"):
            raise HriError(f'"{text[:200]}" has no name - add one, such as follow_me.xml')
        path = self.path_of(text)
        if path.name.startswith("."):
            raise HriError(f'"{path.name}" is a hidden file - begin the name with a letter')
        if "~" in path.parts:
            raise HriError(f'"{text[:200]}" has a folder "~" - write the path of your folder out')
        if paths.exists(path) or any(drafts.files_of(path)):
            raise HriError(f"{path}: already exists - open it, or take another name")
        if why := why_not(path):
            raise HriError(f"{path}: {why} - choose another folder, such as {self.home}")
        return {"path": str(path)}

    def open(self, text: str) -> Json:
        """A network and the drafts of it, newest first. Raises HriError, NoFile."""
        path = self.path_of(text)
        content, mark = _content(path)
        found, damaged = self._left(path, content if mark else None)
        if mark is None and not found:
            if damaged:
                raise HriError(damaged[0])
            raise NoFile(f"{path}: there is no such network - it may have been moved")
        rows = [
            {"page": one.page, "text": one.text, "mark": one.mark, "time": one.time}
            | {"seen": one.seen}
            for one in found
        ]
        return {
            "path": str(path),
            "text": content,
            "mark": mark,
            "is_writable": not why_not(path),
            "why": why_not(path),
            "draft": {key: rows[0][key] for key in ("text", "mark", "time")} if rows else None,
            "drafts": rows,
            "damaged": damaged,
        }

    def _left(self, path: Path, content: str | None) -> tuple[list[Draft], list[str]]:
        """The drafts of a network; those that the file has word by word are dropped."""
        found, damaged = drafts.drafts_of(path)
        for one in found:
            if one.text == content:
                drafts.drop(path, one.page, seen=one.seen)
        return [one for one in found if one.text != content], damaged

    def save(
        self, text: str, content: str, mark: str | None, page: str = "", count: str = ""
    ) -> Json:
        """Replace a file that is as `mark` says; the draft of this page goes, unless its text is
        later than `count`. Raises HriError, Changed.
        """
        path, until = self.path_of(text), _number(count)
        drafts.check_page(page)
        if why := why_not(path):
            raise HriError(f"{path}: {why} - save it as another file")
        here, now = _content(path)
        if now != mark:
            what = f"{path}: changed since it was opened" if now else f"{path}: was removed"
            raise Changed(f"{what} - choose which text to keep", here, now)
        data = _encoded(content)
        make_folder(path.parent)
        write_bytes(path, data)
        with suppress(HriError):  # it is saved, whatever becomes of the draft
            drafts.drop(path, page, until)
        return {"mark": mark_of(data)}

    def keep_draft(
        self, text: str, content: str, mark: str | None, page: str = "", count: str = ""
    ) -> Json:
        """Keep what a page has not saved. Raises HriError."""
        path = self.path_of(text)
        _encoded(content)
        draft = Draft(str(path), page, content, mark, self.now(), _number(count) or 0)
        drafts.keep(draft, _content(path)[0], _is_open(path))
        return {}

    def drop_draft(self, text: str, page: str = "", seen: str = "") -> Json:
        """Forget a draft, if there is one; with `seen` only if that is still its text."""
        drafts.drop(self.path_of(text), page, seen=seen)
        return {}

    def watch(self, text: str, mark: str, page: str = "") -> Json:
        """Whether the file is still as `mark` says; its text where it is not; with a page whether
        its draft is there.
        """
        path = self.path_of(text)
        content, now = _content(path)
        found: Json = {"mark": now} if (now or "") == mark else {"mark": now, "text": content}
        if page:
            files = (drafts.file_of(path, page, is_beside) for is_beside in (True, False))
            found["has_draft"] = any(paths.is_file(file) for file in files)
        return found


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


def _is_open(path: Path) -> bool:
    """Whether a draft can lie beside a network."""
    is_ours = not _is_installed(path) and path.parent.is_dir()
    return is_ours and os.access(path.parent, os.W_OK)


def _number(digits: str) -> int | None:
    if digits and not (digits.isascii() and digits.isdigit() and len(digits) < 16):
        raise HriError(f'"{digits[:50]}" is not a count - write digits')
    return int(digits) if digits else None


def _content(path: Path) -> tuple[str, str | None]:
    """Text and mark of a file; empty and None where there is none. Raises HriError."""
    if not paths.exists(path):
        return "", None
    data = read_bytes(path, "network", LARGEST)
    try:
        return data.decode("utf-8"), mark_of(data)
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
