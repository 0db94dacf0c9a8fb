"""Baked faces, kept on disk by content: a face that was loaded once is there at once.

A file is named by the drawings, the turning of the head and the program that baked them, so it is
never out of date. It holds a digest of the rest, a line of JSON and two arrays. It is only a
shortcut: when it is damaged, or cannot be read or written, nothing is lost.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

import numpy as np

from hri.core import paths
from hri.core.errors import HriError
from hri.core.ownership import own_cache
from hri.core.reading import read_bytes
from hri.core.writing import make_folder, write_bytes
from hri.face.drawing import serialization
from hri.face.drawing.baking import DisplayList, bake
from hri.face.drawing.svg import load_drawing
from hri.face.settings import HeadSettings

BAKERS = (
    "outline.py", "paint.py", "svg.py", "head_turn.py", "light.py", "baking.py", "serialization.py",
)  # fmt: skip
"""The modules that cached data depends on."""
MOST_FILES = 16
MOST_BYTES = 100_000_000
"""Of all files together; a face larger than a quarter of it is not kept."""
_DIGEST = 32
_NUMBER = np.dtype("<f4")


def folder() -> Path:
    """Where baked faces are kept."""
    return paths.cache_folder() / "faces"


def own_folder() -> Path | None:
    """The same, made for this user alone; None where it cannot be."""
    return own_cache(folder())


def baked(neutral: Path, targets: Sequence[Path], head: HeadSettings | None) -> DisplayList:
    """The display list of these drawings, from disk when it was baked before.

    Raises AuthoringError with the place of what is wrong, HriError when a file is unreadable.
    """
    below = own_folder()
    file = None if below is None else below / f"{_key([neutral, *targets], head)}.face"
    kept = None if file is None else _read(file)
    if kept is not None:
        return kept
    whole = load_drawing(neutral)
    display = bake(whole, {target.stem: load_drawing(target) for target in targets}, head)
    if file is not None:
        _write(file, display)
    return display


def _key(drawings: Sequence[Path], head: HeadSettings | None) -> str:
    found = hashlib.blake2b(digest_size=16)
    for module in BAKERS:
        source = Path(__file__).with_name(module)
        if source.is_file():
            found.update(source.read_bytes())
    found.update(repr(head).encode())
    for path in drawings:
        content = read_bytes(path, "drawing")
        found.update(f"\n{path.name}\n{len(content)}\n".encode(errors="replace"))
        found.update(content)
    return found.hexdigest()


def _read(file: Path) -> DisplayList | None:
    """The display list of a file; None when it is missing or damaged."""
    try:
        if not file.is_file() or file.stat().st_size > MOST_BYTES:
            return None
        raw = file.read_bytes()
        with suppress(OSError):
            os.utime(file)
        return _unpacked(raw)
    except (OSError, KeyError, TypeError, ValueError):
        return None


def _unpacked(raw: bytes) -> DisplayList:
    digest, rest = raw[:_DIGEST], raw[_DIGEST:]
    if hashlib.blake2b(rest, digest_size=_DIGEST).digest() != digest:
        raise ValueError("the file is damaged")
    line, _, numbers = rest.partition(b"\n")
    plain = json.loads(line)
    values = np.frombuffer(numbers, _NUMBER).reshape(-1, plain["length"]).astype(np.float32)
    return serialization.restored(plain, values[0], values[1:])


def _packed(display: DisplayList) -> bytes:
    plain = {**serialization.structure(display), "length": len(display.neutral)}
    numbers = np.concatenate([display.neutral[None], display.rows]).astype(_NUMBER).tobytes()
    rest = json.dumps(plain).encode() + b"\n" + numbers
    return hashlib.blake2b(rest, digest_size=_DIGEST).digest() + rest


def _write(file: Path, display: DisplayList) -> None:
    packed = _packed(display)
    if len(packed) > MOST_BYTES // 4:
        return
    with suppress(OSError, HriError):
        make_folder(file.parent)
        write_bytes(file, packed)
        _prune(file.parent)


def _prune(below: Path) -> None:
    """Delete what was not used for longest, until all is within the limits."""
    files = [(entry.stat().st_mtime_ns, entry.stat().st_size, entry) for entry in below.iterdir()]
    total = 0
    for number, (_, size, entry) in enumerate(sorted(files, reverse=True)):
        total += size
        if number >= MOST_FILES or total > MOST_BYTES:
            entry.unlink(missing_ok=True)
