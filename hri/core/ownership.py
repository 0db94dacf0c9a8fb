"""Whether what lies on the disk is the user's own, and nobody else can have written to it.

Code that is loaded from a cache is run: whoever may write to the cache could run theirs.
"""

from __future__ import annotations

import os
import shutil
import stat
from contextlib import suppress
from pathlib import Path

from hri.core.errors import HriError
from hri.core.privacy import PRIVATE_FOLDER

_ROOT = 0
"""Users who may write everything anyway."""


def is_of_user(path: Path) -> bool:
    """Whether a file or folder belongs to this user (or the system) and nobody else may write it.

    False when it is not there. Systems without owners of files have only one user.
    """
    try:
        status = path.stat()
    except OSError:
        return False
    return _is_owned(status) and not _is_open(status)


def require_of_user(path: Path, what: str) -> None:
    """Raise HriError for a file or folder that someone else may have written."""
    if not is_of_user(path):
        reason = f"someone else may have written this {what}, so it is not used"
        raise HriError(f"{path}: {reason} - look at it, then chown or chmod go-w it")


def is_all_of_user(path: Path) -> bool:
    """Whether `is_of_user` holds for a folder and for all that is in it."""
    return is_of_user(path) and all(map(is_of_user, path.rglob("*")))


def own_cache(path: Path) -> Path | None:
    """A folder for what can be made again, for this user alone; None when there can be none.

    It is made if it is not there. One of the user's that others could write to is emptied first;
    someone else's is not used.
    """
    with suppress(OSError):
        path.mkdir(mode=PRIVATE_FOLDER, parents=True, exist_ok=True)
        if not is_all_of_user(path) and _is_owned(path.stat()):
            shutil.rmtree(path)
            path.mkdir(mode=PRIVATE_FOLDER)
        return path if is_all_of_user(path) else None
    return None


def _is_owned(status: os.stat_result) -> bool:
    return not hasattr(os, "getuid") or status.st_uid in (os.getuid(), _ROOT)


def _is_open(status: os.stat_result) -> bool:
    """Whether someone else may write it."""
    if not hasattr(os, "getuid"):
        return False
    by_group = status.st_mode & stat.S_IWGRP and not _is_own_group(status.st_gid)
    return bool(status.st_mode & stat.S_IWOTH or by_group)


def _is_own_group(group: int) -> bool:
    """Whether it is the group that many systems make for each user, with nobody else in it."""
    try:
        import grp
        import pwd
    except ImportError:  # a system without groups
        return False
    try:
        user, members = pwd.getpwuid(os.getuid()), grp.getgrgid(group)
    except KeyError:
        return False
    return members.gr_name == user.pw_name and set(members.gr_mem) <= {user.pw_name}
