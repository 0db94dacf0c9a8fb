"""Files and folders that nobody but their owner can read."""

from __future__ import annotations

import os
import stat
from contextlib import suppress
from pathlib import Path

from hri.core.writing import PRIVATE, make_folder, not_written

PRIVATE_FOLDER = 0o700
"""Permissions of a folder that only its owner may enter."""
_OTHERS = stat.S_IRWXG | stat.S_IRWXO


def private_folder(folder: Path) -> None:
    """Make a folder that only its owner may enter; one that is there is closed to others.

    Raises NotWritten.
    """
    make_folder(folder, PRIVATE_FOLDER)
    close_to_others(folder)


def private_file(path: Path) -> None:
    """Make an empty file that only its owner may read; one that is there is closed to others.

    For what a library opens and writes itself. Raises NotWritten.
    """
    try:
        os.close(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_CLOEXEC | os.O_NONBLOCK, PRIVATE))
    except OSError as error:
        raise not_written(path, error) from error
    close_to_others(path)


def close_to_others(path: Path) -> None:
    """Take from the group and from all others what they may do with a file or a folder.

    What is missing, belongs to somebody else, or is neither, such as a device, is left alone.
    """
    with suppress(OSError):
        mode = path.stat().st_mode
        if (stat.S_ISREG(mode) or stat.S_ISDIR(mode)) and mode & _OTHERS:
            path.chmod(stat.S_IMODE(mode) & ~_OTHERS)
