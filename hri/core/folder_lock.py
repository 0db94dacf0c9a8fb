"""One writer at a time in a folder, also of several programs."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from hri.core.open_files import BINARY


@contextmanager
def locked_folder(folder: Path) -> Iterator[None]:
    """Keep other programs from changing a file of a folder meanwhile, where folders have locks.

    Whoever has the lock gives it back within the time of a write.
    """
    try:
        import fcntl
    except ImportError:  # Windows, where no robot runs
        yield
        return
    try:
        handle = os.open(folder, os.O_RDONLY | BINARY)
    except OSError:  # there is none
        yield
        return
    try:
        with suppress(OSError):  # a file system without locks
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)
