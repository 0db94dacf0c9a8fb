"""Skills: folders that plug into an app by being there.

    skill.toml     about = "...", and the lists of an app.toml: tasks, networks, events, [on]
    grammar.jsgf   its commands
    replies.toml   the replies to them
    tasks.py       its deeds
    README.md      its page, with dialogues that `hri skill test` plays

An app that has a folder `skills/` takes those in it, those of the user's own folder, those in
`skills/` of the folders of HRI_PATH, and the packages of the entry points `hri.skills`.
`skills = ["quiz"]` in `app.toml` adds one by its name or path, `without_skills` leaves some out. A
user turns one off with `hri skill off`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path
from typing import Generic, TypeVar

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.core.ownership import require_of_user
from hri.core.privacy import folder_for
from hri.core.toml import Table, load_toml
from hri.core.writing import PRIVATE, write_text

SKILLS = "skills"
"""Name of the folders with skills."""
MARK = paths.MARKS[SKILLS]
GROUP = "hri.skills"
"""Entry points whose values are packages; each is the folder of a skill."""
CHOICES = "skills.toml"
"""The user's file of skills that are off, in the folder of settings."""
TURNED_OFF = "you turned it off"
LONGEST_WHY = 400
"""Characters."""

T = TypeVar("T")


@dataclass(frozen=True)
class OffSkill:
    """A skill that is not plugged in."""

    name: str
    folder: Path
    why: str
    """A line: TURNED_OFF, or what is wrong with it."""

    @property
    def is_broken(self) -> bool:
        return self.why != TURNED_OFF


@dataclass(frozen=True)
class Skills(Generic[T]):
    """Skills as they were read."""

    on: tuple[T, ...]
    off: tuple[OffSkill, ...]


def read_skills(
    table: Table, folder: Path, off: Mapping[str, str], read: Callable[[Path], T]
) -> Skills[T]:
    """The skills of the app in a folder, whose `app.toml` is the table.

    Raises AuthoringError for a name in the table that no skill has.
    """
    found = _found(table, folder)
    without = table.strings("without_skills", [])
    for name in without:
        if name not in found:
            what = f'there is no skill "{name}" to leave out'
            raise table.error("without_skills", what, did_you_mean(name, found))
    on, left = [], []
    for name, place in found.items():
        if name in without:
            continue
        if name in off:
            left.append(OffSkill(name, place, off[name]))
            continue
        try:
            on.append(read(place))
        except HriError as error:
            left.append(OffSkill(name, place, why_off(error)))
    return Skills(tuple(on), tuple(left))


def why_off(error: HriError) -> str:
    """The mistake in a line."""
    line = str(error).partition("\n")[0]
    return line if len(line) <= LONGEST_WHY else f"{line[:LONGEST_WHY]}..."


def _found(table: Table, folder: Path) -> dict[str, Path]:
    """The folders of all skills of an app, by name; the first of a name counts."""
    found: dict[str, Path] = {}
    own = folder / SKILLS
    if own.is_dir():
        for place in (*_in(own), *_in(own_folder()), *_in_path(), *_installed()):
            found.setdefault(place.name, place)
    for name in table.strings(SKILLS, []):
        place = _named(table, folder, name)
        found.setdefault(place.name, place)
    return found


def own_folder() -> Path:
    """Where the user's own skills are plugged in by being there."""
    return paths.data_folder() / SKILLS


def _in(folder: Path) -> list[Path]:
    """The skills in a folder."""
    if not folder.is_dir():
        return []
    return sorted(place for place in folder.iterdir() if paths.is_file(place / MARK))


def _in_path() -> Iterator[Path]:
    for folder in paths.search_folders():
        yield from _in(folder / SKILLS)


def _installed() -> Iterator[Path]:
    """Those of installed packages, which are not imported for it."""
    for entry in sorted(entry_points(group=GROUP)):
        try:
            spec = find_spec(entry.value)
        except (ImportError, ValueError):
            continue
        for place in (spec.submodule_search_locations or ()) if spec else ():
            if paths.is_file(Path(place) / MARK):
                yield Path(place)


def _named(table: Table, folder: Path, name: str) -> Path:
    """A skill that an app names. Raises AuthoringError."""
    for place in (folder / name, folder / SKILLS / name):
        if paths.is_file(place / MARK):
            return place
    try:
        place = paths.find(SKILLS, name)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise table.error(SKILLS, what, remedy) from error
    if not paths.is_file(place / MARK):
        raise table.error(SKILLS, f"{place} has no {MARK}, which makes a folder a skill", "add one")
    return place


# --- the user's choice ---


def turned_off() -> dict[str, str]:
    """The skills that the user turned off, and that. Raises HriError for a file with a mistake."""
    path = paths.settings_folder() / CHOICES
    if not paths.exists(path):
        return {}
    require_of_user(path, "choice of skills")
    table = load_toml(path, "choice of skills")
    off = table.strings("off", [])
    table.finish()
    return dict.fromkeys(off, TURNED_OFF)


def turn(name: str, on: bool) -> None:
    """Turn a skill on or off from the next start on. Raises HriError where that cannot be kept."""
    off = [one for one in turned_off() if one != name] + ([] if on else [name])
    path = paths.settings_folder() / CHOICES
    names = ", ".join(map(json.dumps, sorted(off)))  # A JSON string is a TOML string as well.
    folder_for(path)
    write_text(path, f"# Written by `hri skill off`.\noff = [{names}]\n", PRIVATE)
