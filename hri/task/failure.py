"""Where a task failed: the line that its author can fix."""

from __future__ import annotations

import os
import traceback
from collections.abc import Callable
from pathlib import Path
from types import CodeType

_OWN = Path(__file__).parents[1]
"""The package `hri`."""
_LIBRARY = Path(os.__file__).parent
"""That of Python."""
_INSTALLED = ("site-packages", "dist-packages")
"""Names of the folders of installed packages."""


def place_of(error: BaseException, job: Callable[..., object] | None = None) -> str:
    """`file:line` of the innermost call in a file that is neither ours nor installed.

    Where there is none, of the first line of `job`, else of the innermost call; empty for an error
    that was never raised. Of a group, that of its first error.
    """
    while isinstance(error, BaseExceptionGroup):
        error = error.exceptions[0]
    frames = traceback.extract_tb(error.__traceback__)
    authored = [frame for frame in frames if _is_authored(Path(frame.filename))]
    code = _code_of(job)
    if not authored and code is not None:
        return f"{code.co_filename}:{code.co_firstlineno}"
    for frame in (authored or frames)[-1:]:
        return f"{frame.filename}:{frame.lineno}"
    return ""


def _code_of(job: object) -> CodeType | None:
    """The function within what wraps it: a partial, a TaskType, a bound method."""
    while (inner := getattr(job, "func", None) or getattr(job, "function", None)) is not None:
        job = inner
    code = getattr(job, "__code__", None)
    return code if isinstance(code, CodeType) else None


def _is_authored(file: Path) -> bool:
    if file.name.startswith("<") or any(name in file.parts for name in _INSTALLED):
        return False
    return not (file.is_relative_to(_OWN) or file.is_relative_to(_LIBRARY))


def with_place(error: Exception, job: Callable[..., object] | None = None) -> str:
    """An error of a job in words, behind its place."""
    place, words = place_of(error, job), str(error) or type(error).__name__
    return f"{place}: {words}" if place and place not in words else words
