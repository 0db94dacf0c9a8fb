"""Child processes of Python, started so that nothing in the current folder is run by mistake.

Python looks for modules in the folder that a program was started in before it looks at its own: a
`random.py` that happens to lie there would be run by every child that imports `random`. A child
here finds modules where this program finds them, except in the current folder.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

_OWN = Path(__file__).resolve().parents[2]
"""The folder that has the package `hri`."""


def command(*words: str | Path) -> list[str]:
    """The command line that runs Python with these arguments; start it with `environment()`."""
    return [sys.executable, "-P", *map(str, words)]


def environment(**variables: str) -> dict[str, str]:
    """The environment for a child, with variables of your own; it protects its children, too."""
    safe = {"PYTHONSAFEPATH": "1", "PYTHONPATH": os.pathsep.join(folders())}
    return {**os.environ, **safe, **variables}


def folders() -> list[str]:
    """Where a child looks for modules.

    The current folder is among them only if the user named it by its whole path in PYTHONPATH, or
    if `hri` itself lies there.
    """
    named = os.environ.get("PYTHONPATH", "").split(os.pathsep)
    known = [folder for folder in sys.path if Path(folder).is_absolute()]
    return [folder for folder in known if folder in named or not _is_current(folder)]


def _is_current(folder: str) -> bool:
    try:
        return os.path.samefile(folder, os.curdir) and not os.path.samefile(folder, _OWN)
    except OSError:  # one of them is not there, and so has no modules
        return False
