"""Recordings on the disk: which there are, what one consists of, and its events, part by part.

Anyone may have written what lies in a folder: only regular files by the names of a recording are
opened, links are not followed, and lines that are not events are left out.
"""

from __future__ import annotations

import json
import os
import stat
import struct
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from hri.core.errors import HriError
from hri.core.growing_files import is_growing
from hri.core.open_files import AT_ONCE, BINARY, NO_LINK
from hri.core.paths import expanded
from hri.core.reading import parse_json
from hri.core.recorded import EVENTS, FILES, RECORDINGS, SOUND, STARTED
from hri.core.stored_data_index import noted
from hri.emotion.display import load_display

MOST_LISTED = 500
"""Recordings that are listed, the newest."""
LONGEST = 30 * 24 * 3600.0
"""Seconds; an event of a later time is left out."""
PART = 1_000_000
"""Bytes of a log that are read at once; a longer line is left out."""
TAIL = 65_536
"""Bytes at the end of a log in which its last event is looked for."""
_WAV = struct.Struct("<4sI4s4sIHHIIHH4sI")
"""The head of a sound as `hri.hal.drivers.wav_file` writes it."""


@dataclass(frozen=True, slots=True)
class Sound:
    """What the head of `robot.wav` says."""

    length: float
    """Seconds."""
    size: int
    """Bytes of the file."""


@dataclass(frozen=True, slots=True)
class Times:
    """When the log, the film and the sound of a recording begin, and the log ends, in seconds of
    its clock.
    """

    log: float = 0.0
    face: float = 0.0
    sound: float = 0.0
    end: float = 0.0


def folder_of(place: str) -> Path:
    """The folder of a recording as someone names it. Raises HriError unless it has a log."""
    try:
        folder = expanded(place).resolve() if place else None
    except (OSError, ValueError, RuntimeError):
        folder = None
    if folder is None or not _is_shown(str(folder)):
        raise HriError(f"{place!r:.200}: not the name of a folder - check the path")
    if not _is_regular(folder / EVENTS):
        remedy = "name the folder that was given to --record"
        raise HriError(f"{folder!s:.200}: not a recording, it has no {EVENTS} - {remedy}")
    return folder


def opened(folder: Path, name: str) -> BinaryIO:
    """A file of a recording, to read. Raises HriError unless it is a regular file, and no link."""
    path = folder / name
    flags = os.O_RDONLY | NO_LINK | AT_ONCE | BINARY
    try:
        descriptor = os.open(path, flags)
    except OSError as error:
        raise HriError(f"{path}: cannot be read: {error.strerror} - check the file") from error
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise HriError(f"{path}: not a regular file - replace it")
    return open(descriptor, "rb")


def listed() -> list[dict[str, Any]]:
    """The recordings that were noted, and those below `recordings/`; the newest first."""
    found = {}
    for folder in _candidates():
        with suppress(HriError, OSError):
            folder = folder_of(str(folder))
            found[folder] = (folder / EVENTS).lstat().st_mtime
    newest = sorted(found, key=lambda folder: found[folder], reverse=True)[:MOST_LISTED]
    told = []
    for folder in newest:
        with suppress(HriError, OSError):
            told.append(summary(folder))
    return told


def _candidates() -> Iterator[Path]:
    with suppress(HriError):  # notes that cannot be read
        yield from noted("recording")
    with suppress(OSError), os.scandir(RECORDINGS) as entries:
        yield from (Path(entry.path) for entry in entries)


def summary(folder: Path) -> dict[str, Any]:
    """What a list shows of a recording. Raises HriError."""
    times, sound = times_of(folder), None
    there = [status for name in FILES if (status := _status(folder / name))]
    if not there:
        raise HriError(f"{folder}: deleted just now - choose another recording")
    with suppress(HriError):
        sound = sound_of(folder)
    return {
        "folder": str(folder),
        "name": folder.name,
        "written": there[0].st_mtime,
        "bytes": sum(status.st_size for status in there),
        "length": _length(times, sound),
        "is_growing": is_growing(folder / EVENTS),
    }


def _length(times: Times, sound: Sound | None) -> float:
    end = max(times.end, times.sound + sound.length if sound is not None else 0.0)
    return max(0.0, round(end - times.log, 3))


def words() -> dict[str, str]:
    """What the robot is, after "I am", by the label of a feeling; empty where no one says."""
    try:
        return {label: look.words for label, look in load_display().looks.items()}
    except HriError:
        return {}


def times_of(folder: Path) -> Times:
    """When the parts of a recording begin, and its log ends. Raises HriError."""
    with opened(folder, EVENTS) as file:
        first = _event(file.readline(TAIL)) or {}
        file.seek(max(0, os.fstat(file.fileno()).st_size - TAIL))
        lines = file.read(TAIL).splitlines(keepends=True)
    last: dict[str, Any] = next((e for line in reversed(lines) if (e := _event(line))), {})
    if first.get("event") != STARTED:
        return Times(end=last.get("t", 0.0))
    log, end = first["t"], last.get("t", 0.0)
    return Times(log, _time(first.get("face"), log), _time(first.get("sound"), log), end)


def sound_of(folder: Path) -> Sound:
    """The sound of a recording. Raises HriError where there is none that we have written."""
    with opened(folder, SOUND) as file:
        head, size = file.read(_WAV.size), os.fstat(file.fileno()).st_size
    if len(head) == _WAV.size:
        riff, _, wave, fmt, _, kind, _, _, rate, _, _, data, told = _WAV.unpack(head)
        length = min(told, size - _WAV.size) / max(rate, 1)
        is_ours = (riff, wave, fmt, kind, data) == (b"RIFF", b"WAVE", b"fmt ", 1, b"data")
        if is_ours and length <= LONGEST:
            return Sound(length, size)
    raise HriError(f"{folder / SOUND}: not a sound of a recording - it is damaged")


def events_of(folder: Path, begin: int = 0) -> str:
    """The events of a part of a log that begins at a byte, as JSON.

    `next` is where the next part begins, `is_all` whether there is none now, and `skipped` how many
    lines were left out. Raises HriError, also where the log is shorter.
    """
    with opened(folder, EVENTS) as file:
        size = os.fstat(file.fileno()).st_size
        if not 0 <= begin <= size:
            raise HriError(f"{folder / EVENTS}: shorter than {begin} bytes - begin again at 0")
        file.seek(max(0, begin - 1))
        # The byte before says whether a line begins here, or the end of one is to be left out.
        is_inside = begin > 0 and file.read(1) != b"\n"
        data = file.read(PART)
    end = data.rfind(b"\n") + 1
    if not end and len(data) == PART:
        end = PART  # of a line that is too long
    lines = data[:end].splitlines(keepends=True)[is_inside:]
    found = [told for line in lines if (told := _told(line))]
    blank = sum(not line.strip() for line in lines)
    rest = {
        "next": begin + end,
        "is_all": begin + len(data) >= size,
        "skipped": len(lines) - len(found) - blank,
    }
    return f'{{"events": [{", ".join(found)}], {json.dumps(rest)[1:]}'


def _told(line: bytes) -> str:
    """An event as JSON that every browser reads; empty for what is not one."""
    with suppress(ValueError, RecursionError):
        event = _event(line)
        return json.dumps(event, allow_nan=False) if event else ""
    return ""


def _event(line: bytes) -> dict[str, Any] | None:
    """What a whole line says; None unless it is an event."""
    if not line.endswith(b"\n"):
        return None
    try:
        found = parse_json(line.decode())
    except ValueError:
        return None
    is_event = isinstance(found, dict) and isinstance(found.get("event"), str)
    return found if is_event and _time(found.get("t"), -1.0) >= 0 else None


def _time(value: object, otherwise: float) -> float:
    """A time in seconds, or something else for what cannot be one."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return otherwise
    return value if 0 <= value <= LONGEST else otherwise


def _is_regular(path: Path) -> bool:
    status = _status(path)
    return status is not None and stat.S_ISREG(status.st_mode)


def _is_shown(name: str) -> bool:
    """Whether a name has only letters that a page can show."""
    with suppress(UnicodeEncodeError):
        return bool(name.encode())
    return False


def _status(path: Path) -> os.stat_result | None:
    with suppress(OSError, ValueError):
        return path.lstat()
    return None
