"""Files that cannot be used: set aside under another name, never overwritten."""

from __future__ import annotations

import errno
import glob
import os
from pathlib import Path

from hri.core.privacy import close_to_others


def put_aside(path: Path) -> Path:
    """Give a file that cannot be used another name; that name.

    Raises OSError, also if it is not a file: a folder named by mistake stays in place.
    """
    if not path.is_file() and path.exists():
        raise FileNotFoundError(errno.ENOENT, "it is not a file", str(path))
    number = 1
    while os.path.lexists(aside := path.with_name(f"{path.stem}.unusable-{number}{path.suffix}")):
        number += 1
    path.rename(aside)
    if not aside.is_symlink():
        close_to_others(aside)
    return aside


def set_aside(path: Path) -> list[Path]:
    """The files that were put aside in favor of this one, sorted."""
    return sorted(path.parent.glob(f"{glob.escape(path.stem)}.unusable-*{path.suffix}"))
