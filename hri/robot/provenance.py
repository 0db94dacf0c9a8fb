"""What a recorded run is, so that it can be repeated and laid beside other recordings of it.

`Setup` is the same for equal runs, and stands in the first event of a recording. All that differs
between them stands in `recording.json`: the command, when it ran, on what, and how it ended.
"""

from __future__ import annotations

import json
import logging
import os
import platform
import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import asdict, dataclass
from datetime import UTC, datetime
from importlib import metadata
from pathlib import Path
from typing import Any

from hri.core import paths
from hri.core.clock import Clock, RealClock
from hri.core.errors import HriError
from hri.core.models import models_folder
from hri.core.reading import parse_json, read_text
from hri.core.recorded import ABOUT, EVENTS
from hri.core.writing import PRIVATE, write_text
from hri.robot.sources import digests, of_every_run

OTHER_VARIABLES = ("EVOLUTION_CONFIG_PATH", "XDG_CONFIG_HOME", "XDG_DATA_HOME")
"""Environment variables that decide a run, besides our own."""
LARGEST = 20_000_000
"""Bytes of a `recording.json` that is read."""
SECRET = re.compile(r"token|secret|passw|code|credential|auth|api.?key", re.IGNORECASE)
"""What is in the name of an option, or of a part of an address, with a secret behind it."""
_HIDDEN = "***"

log = logging.getLogger("hri.recording")


@dataclass(frozen=True, slots=True)
class Setup:
    """What decides a run, as it was asked for."""

    version: str
    """Of hri."""
    seed: int
    app: str
    personality: str | None
    """None for a robot without feelings."""
    config: str


class RunRecord:
    """Writes the `recording.json` of a run."""

    def __init__(
        self,
        setup: Setup,
        clock: Clock,
        command: Sequence[str],
        sources: Iterable[Path] = (),
        feelings: Path | None = None,
    ) -> None:
        """`command` is the command line; `sources` are files and folders that decide the run,
        besides those of the search folders; `feelings` is the file with which it begins.
        """
        now, began = clock.now(), utc_now()
        self._clock = clock
        self._told: dict[str, Any] = {
            **asdict(setup),
            "command": without_secrets(command),
            "cwd": os.getcwd(),
            "folder": "",
            "clock": "fake" if clock.is_fake else "real",
            "began": _text_of(began),
            "began_at": round(now, 4),
            "zero": _text_of(datetime.fromtimestamp(began.timestamp() - now, UTC)),
            "python": platform.python_version(),
            "platform": platform.platform(),
            "packages": _packages(),
            "environment": environment(),
            "sources": digests((*of_every_run(), *sources)),
            "models": sorted(path.name for path in _models()),
            "feelings": _feelings(feelings),
        }
        self._path: Path | None = None

    def text(self, folder: Path) -> str:
        """What it says when the recording begins in a folder."""
        self._told["folder"] = str(folder.resolve())
        self._path = folder / ABOUT
        return _written(self._told)

    def complete(self, why: str) -> None:
        """Write when and why the run ended; a disk that is full is logged in one line."""
        if self._path is None:
            return
        path, self._path = self._path, None
        ended = {"ended": _text_of(utc_now()), "ended_at": round(self._clock.now(), 4), "why": why}
        try:
            write_text(path, _written({**self._told, **ended}), PRIVATE)
        except HriError as error:
            log.error("%s", error)


def utc_now() -> datetime:
    """The time on the wall, also when that of the robot is simulated."""
    return RealClock().wall().astimezone(UTC)


def read_record(folder: Path) -> dict[str, Any]:
    """What `recording.json` says. Raises HriError where there is none that can be read."""
    path = folder / ABOUT
    if not paths.exists(path) and paths.exists(folder / EVENTS):
        what = f"{folder}: recorded by an earlier version, without a {ABOUT}"
        raise HriError(f"{what} - start it with the command that you used then")
    try:
        told = parse_json(read_text(path, "record of a run", LARGEST))
    except ValueError as error:
        raise HriError(f"{path}: not JSON: {error} - name another recording") from error
    if not isinstance(told, dict):
        raise HriError(f"{path}: not a record of a run - name another recording")
    return told


def environment() -> dict[str, str]:
    """The environment variables that decide a run; a token is not among them."""
    return {
        name: value
        for name, value in sorted(os.environ.items())
        if (name.startswith("HRI_") or name in OTHER_VARIABLES) and not SECRET.search(name)
    }


def without_secrets(command: Sequence[str]) -> list[str]:
    """A command line in which what looks like a secret is hidden."""
    told, is_next = [], False
    for word in command:
        option, equals, value = word.partition("=")
        is_option = option.startswith("-") and SECRET.search(option) is not None
        if is_next and not word.startswith("-"):
            told.append(_HIDDEN)
        elif is_option and value:
            told.append(f"{option}{equals}{_HIDDEN}")
        else:
            told.append(_address_without(word))
        is_next = is_option and not equals
    return told


def _address_without(word: str) -> str:
    """The same without the password and the secret parts of an address."""
    word = re.sub(r"(://[^/@:]*:)[^/@]*@", rf"\1{_HIDDEN}@", word)
    hidden = rf"([?&#][^=&#]*(?:{SECRET.pattern})[^=&#]*=)[^&#]*"
    return re.sub(hidden, rf"\1{_HIDDEN}", word, flags=re.IGNORECASE)


def _models() -> list[Path]:
    """The models that were fetched."""
    with suppress(OSError):
        return [*models_folder().iterdir()]
    return []


def _packages() -> dict[str, str]:
    """Versions of what hri is made of, as far as it is installed."""
    found = {}
    for line in _requirements():
        if "dev" in line.partition(";")[2]:
            continue
        name = re.split(r"[^\w.-]", line, maxsplit=1)[0]
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return dict(sorted(found.items()))


def _requirements() -> list[str]:
    try:
        return metadata.requires("hri") or []
    except metadata.PackageNotFoundError:
        return []


def _feelings(file: Path | None) -> Any:
    """The feelings with which a run begins; None without, or where they cannot be read."""
    if file is None or not paths.exists(file):
        return None
    try:
        return parse_json(read_text(file, "memory of feelings"))
    except (HriError, ValueError):
        return None


def _text_of(time: datetime) -> str:
    return time.isoformat(timespec="microseconds").replace("+00:00", "Z")


def _written(told: Mapping[str, Any]) -> str:
    text = json.dumps(told, indent=1, ensure_ascii=False)
    return text.encode("utf-8", "backslashreplace").decode() + "\n"
