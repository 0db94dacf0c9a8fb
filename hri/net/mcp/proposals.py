"""Drafts that an assistant proposes: checked, then kept apart until a person applies them.

They lie in the user's folder of drafts. Nothing there is ever used by the robot, and no file that
is used is written.
"""

from __future__ import annotations

from pathlib import Path

from hri.core import paths
from hri.core.errors import HriError
from hri.core.privacy import private_folder
from hri.core.stored_data_index import note
from hri.core.writing import write_new_text
from hri.net.mcp.authored import Authored

MOST = 50
"""Drafts that are kept; a further one is refused until a person has looked at them."""
LONGEST = 200_000
"""Letters of a draft."""
BEGINNING, SUFFIX = ".mcp-", ".draft"
"""Of their names, by which `hri forget` finds them."""


def folder() -> Path:
    """Where they are kept."""
    return paths.data_folder() / "drafts"


def drafts() -> list[Path]:
    """All that are kept, the oldest first."""
    try:
        return sorted(folder().glob(f"{BEGINNING}*{SUFFIX}"))
    except OSError:
        return []


def keep(file: Authored, text: str) -> Path:
    """Keep a text that would take the place of a file; where it lies. Blocks for the disk.

    Raises HriError when there are too many, or it cannot be written.
    """
    kept = drafts()
    if len(kept) >= MOST:
        what = f"there are {len(kept)} drafts in {folder()}, the most that are kept"
        raise HriError(f"{what} - a person has to apply or delete some")
    private_folder(folder())
    note("drafts", folder())
    number = 1 + max((_number(path) for path in kept), default=0)
    for taken in range(MOST):
        name = f"{BEGINNING}{number + taken:04}.{file.name.replace('/', '.')}{SUFFIX}"
        if write_new_text(folder() / name, text):
            return folder() / name
    raise HriError(f"{folder()}: no draft can be written there - try again")


def _number(path: Path) -> int:
    digits = path.name.removeprefix(BEGINNING).partition(".")[0]
    return int(digits) if digits.isdecimal() and len(digits) < 9 else 0
