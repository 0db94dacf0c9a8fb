"""Unpacking an archive that nobody has looked into, into a folder that is whole or not there."""

from __future__ import annotations

import hashlib
import os
import shutil
import stat
import zipfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from hri.core.errors import HriError
from hri.core.writing import new_folder
from hri.core.zip_archive import opened_archive

MOST_FILES = 1_000
LARGEST_UNPACKED = 8_000_000_000
"""Bytes; no model is larger."""
LARGEST_GROWTH = 50
"""Times that unpacking may swell an archive: models of numbers hardly pack at all."""
LONGEST_NAME = 255
"""Bytes of the name of a file or folder, as file systems have it."""
LONGEST_DIRECTORY = MOST_FILES * 1000
"""Bytes of the directory of an archive."""
_BLOCK = 1 << 18
_REMEDY = "take the one that `hri models list` names"


@dataclass(frozen=True, slots=True)
class Part:
    """A file of an archive that is wanted."""

    path: str
    """In the archive."""
    sha256: str

    @property
    def name(self) -> str:
        """Of the file, without the folders of the archive."""
        return PurePosixPath(self.path).name


def unpack(archive: Path, target: Path, parts: Sequence[Part] = ()) -> None:
    """Unpack a ZIP archive into a new folder: all of it, or the named parts side by side.

    An archive with a single folder at its top stands for that folder. Raises HriError when it is
    broken, leads out of its folder, would fill the disk, or is not what its parts should be.
    """
    try:
        with (
            archive.open("rb") as raw,
            opened_archive(raw, LONGEST_DIRECTORY) as opened,
            new_folder(target) as folder,
        ):
            members = [member for member in opened.infolist() if not member.is_dir()]
            chosen = _chosen(archive, members, parts)
            _check(archive, [member for member, _ in chosen])
            for member, path in chosen:
                place = folder.joinpath(path)
                place.parent.mkdir(parents=True, exist_ok=True)
                with opened.open(member) as packed, place.open("xb") as file:
                    shutil.copyfileobj(packed, file, _BLOCK)
            check_parts(folder, parts)
    except ValueError as error:
        raise HriError(f"{archive}: cannot be unpacked: {error} - fetch it again") from error


def check_parts(folder: Path, parts: Iterable[Part]) -> None:
    """Raises HriError when a part is not in the folder, or not what it should be."""
    for part in parts:
        file = folder / part.name
        if not file.is_file():
            raise HriError(f"{file}: is missing - {_REMEDY}")
        with file.open("rb") as opened:
            if hashlib.file_digest(opened, "sha256").hexdigest() != part.sha256:
                raise HriError(f"{file}: damaged, or of another version - fetch it again")


def _chosen(
    archive: Path, members: list[zipfile.ZipInfo], parts: Sequence[Part]
) -> list[tuple[zipfile.ZipInfo, PurePosixPath]]:
    """What is to be unpacked, and to where in the folder."""
    paths = {member.filename: member for member in members}
    for part in parts:
        if part.path not in paths:
            raise HriError(f"{archive}: has no {part.path} - {_REMEDY}")
    if parts:
        return [(paths[part.path], PurePosixPath(part.name)) for part in parts]
    tops = {PurePosixPath(path).parts[:1] for path in paths}
    skipped = len(tops) == 1 and all("/" in path for path in paths)
    return [
        (member, PurePosixPath(*PurePosixPath(path).parts[skipped:]))
        for path, member in paths.items()
    ]


def _check(archive: Path, members: list[zipfile.ZipInfo]) -> None:
    """Refuse what would leave the folder, or fill the disk."""
    remedy = "take it from its maker"
    if not members or len(members) > MOST_FILES:
        raise HriError(f"{archive}: {len(members)} files are not a model - {remedy}")
    for member in members:
        path = PurePosixPath(member.filename)
        if not path.parts or max(len(os.fsencode(part)) for part in path.parts) > LONGEST_NAME:
            raise HriError(
                f'{archive}: "{member.filename}" cannot be the name of a file - {remedy}'
            )
        is_link = stat.S_ISLNK(member.external_attr >> 16)
        if path.is_absolute() or ".." in path.parts or "\\" in member.filename or is_link:
            raise HriError(f'{archive}: "{member.filename[:60]}" leads elsewhere - {remedy}')
    size = sum(member.file_size for member in members)
    room = min(LARGEST_UNPACKED, LARGEST_GROWTH * archive.stat().st_size)
    if size > room:
        raise HriError(f"{archive}: swells to {size} bytes - {remedy}")
    if size > shutil.disk_usage(archive.parent).free:
        raise HriError(f"{archive}: needs {size} bytes that the disk has not - make room")
