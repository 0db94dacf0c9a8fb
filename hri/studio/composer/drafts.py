"""Drafts: what was not saved, one file for each page that edits a network.

A draft lies beside its network, or in the user's folder where nothing may be written there. No page
replaces or deletes the draft of another, but for one that a person has seen and discards.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import private_folder
from hri.core.reading import parse_json, read_bytes
from hri.core.stored_data_index import note
from hri.core.writing import PRIVATE, NotWritten, delete, make_folder, write_bytes

SUFFIX = ".draft"
MOST = 20
"""Drafts of a network; a further page is told to discard one."""
LARGEST = 4_000_000
"""Bytes."""
_PAGE = re.compile(r"[a-z0-9]{0,32}")
LONGEST_NAME = 255
"""Bytes of a file name."""

Names = Callable[[Path], list[str]]


@dataclass(frozen=True)
class Draft:
    """What a page has not saved."""

    path: str
    page: str
    """Empty for one that an older version has kept."""
    text: str
    mark: str | None
    """Of the file that it began from; None where there was none."""
    time: float
    """Seconds since 1970."""
    count: int = 0
    """Rises with each text of its page."""

    @property
    def seen(self) -> str:
        """By which a person discards this text, and no later one."""
        return mark_of(self.text.encode("utf-8", "surrogatepass"))


def mark_of(data: bytes) -> str:
    """By which content is known again: its SHA-256."""
    return hashlib.sha256(data).hexdigest()


def user_folder() -> Path:
    """Where drafts lie that cannot lie beside their networks."""
    return paths.data_folder() / "drafts"


def check_page(page: str) -> None:
    """Raises HriError for what cannot name a page."""
    if not _PAGE.fullmatch(page):
        raise HriError(f'"{page[:50]}" names no page - take up to 32 small letters and digits')


def file_of(path: Path, page: str, is_beside: bool) -> Path:
    """The draft of a page. Raises HriError for what cannot name a page."""
    check_page(page)
    tail = f".{page}{SUFFIX}" if page else SUFFIX
    beside = path.parent / f".{path.name}{tail}"
    is_short = len(os.fsencode(beside.name)) <= LONGEST_NAME
    return beside if is_beside and is_short else user_folder() / f".{_key(path)}{tail}"


def names_in(folder: Path) -> list[str]:
    """The names of all drafts in a folder."""
    with suppress(OSError):
        return [name for name in os.listdir(folder) if name.endswith(SUFFIX)]
    return []


def files_of(path: Path, names: Names = names_in) -> Iterator[Path]:
    """All drafts of a network, beside it and in the user's folder."""
    for folder, stem in ((path.parent, path.name), (user_folder(), _key(path))):
        for name in names(folder):
            page = name.removeprefix(f".{stem}").removesuffix(SUFFIX).removeprefix(".")
            if name in (f".{stem}{SUFFIX}", f".{stem}.{page}{SUFFIX}") and _PAGE.fullmatch(page):
                yield folder / name


def drafts_of(path: Path) -> tuple[list[Draft], list[str]]:
    """Those of a network, newest first; and what is wrong with those that cannot be read."""
    found: dict[str, Draft] = {}
    damaged = []
    for file in files_of(path):
        try:
            draft = read(file)
        except HriError as error:
            damaged.append(str(error))
            continue
        if draft.path == str(path):
            known = found.setdefault(draft.page, draft)
            found[draft.page] = max(known, draft, key=lambda one: (one.time, one.count))
    return sorted(found.values(), key=lambda one: -one.time), damaged


def keep(draft: Draft, content: str, is_beside: bool) -> None:
    """Write a draft, unless a later text of its page is there; `content` is what the file has.

    Raises HriError when it cannot be written, or when there are too many.
    """
    path = Path(draft.path)
    file = file_of(path, draft.page, is_beside)
    others, damaged = drafts_of(path)
    known = next((one for one in others if one.page == draft.page), None)
    if known is not None and known.count > draft.count:
        return
    if known is None and len(others) + len(damaged) >= MOST:
        _make_room(path, others, {content, draft.text})
    if file.parent == user_folder():
        private_folder(file.parent)
    else:
        make_folder(file.parent)
    write_bytes(file, json.dumps(vars(draft), ensure_ascii=False).encode("utf-8"), PRIVATE)
    note("drafts", file.parent)


def _make_room(path: Path, drafts: list[Draft], elsewhere: set[str]) -> None:
    """Drop drafts whose text is elsewhere, too. Raises NotWritten when there are none."""
    repeated = []
    for one in drafts:
        if one.text in elsewhere:
            repeated.append(one)
        elsewhere.add(one.text)
    if not repeated:
        what = f"{path}: there are {len(drafts)} drafts of it, the most that are kept"
        raise NotWritten(f"{what} - open it in another tab and discard one")
    for one in repeated:
        drop(path, one.page)


def drop(path: Path, page: str, count: int | None = None, seen: str = "") -> None:
    """Delete the draft of a page: no text later than `count`, and only the one that was `seen`.

    One that is damaged stays when either is given. Raises HriError.
    """
    for file in {file_of(path, page, True), file_of(path, page, False)}:
        if (count is None and not seen) or _may_go(file, count, seen):
            delete(file)


def _may_go(file: Path, count: int | None, seen: str) -> bool:
    with suppress(HriError):
        draft = read(file)
        return (count is None or draft.count <= count) and seen in ("", draft.seen)
    return False


def read(file: Path) -> Draft:
    """Raises HriError for one that is damaged."""
    try:
        kept: Any = parse_json(read_bytes(file, "draft", LARGEST))
        mark, time, count = kept["mark"], float(kept["time"]), int(kept.get("count", 0))
        named = {name: kept.get(name, "") for name in ("path", "page", "text")}
        if not all(isinstance(one, str) for one in (*named.values(), mark or "")):
            raise TypeError
        return Draft(**named, mark=mark, time=time, count=count)
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError) as error:
        raise HriError(f"{file}: the draft is damaged - delete it") from error


def _key(path: Path) -> str:
    return mark_of(str(path).encode("utf-8", "surrogateescape"))[:32]
