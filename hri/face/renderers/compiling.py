"""Turns loops over pixels into machine code, by numba, and keeps that for the next run."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, ParamSpec, TypeVar, cast

import numba

from hri.core import paths
from hri.core.ownership import is_all_of_user, own_cache

P = ParamSpec("P")
R = TypeVar("R")

_OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
"""Other threads of Python run meanwhile; a division by zero gives infinity, as in numpy."""


def compiled(function: Callable[P, R]) -> Callable[P, R]:
    """The function as machine code, made at its first call.

    What is kept on disk is only a shortcut: when it is damaged, or cannot be read or written, the
    code is made again.
    """
    return cast("Callable[P, R]", _Compiled(function))


def inlined(function: Callable[P, R]) -> Callable[P, R]:
    """A function that compiled ones call; it becomes part of them."""
    return cast("Callable[P, R]", numba.njit(**_OPTIONS)(function))


class _Compiled:
    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self._code = _kept(function)
        self.__doc__ = function.__doc__

    def __call__(self, *arguments: Any) -> Any:
        try:
            return self._code(*arguments)
        except Exception:
            # Nothing is raised by loops over pixels: what was kept is damaged, or the disk is full.
            with suppress(OSError):
                self._code.recompile()  # empties what is kept
            self._code = numba.njit(**_OPTIONS)(self._function)
            return self._code(*arguments)


def folder() -> Path | None:
    """Where code is kept: our folder, unless the user chose another (NUMBA_CACHE_DIR).

    None when someone else may have written there: what is kept is run.
    """
    chosen: str = cast("Any", numba.config).CACHE_DIR
    if not chosen:
        return own_cache(paths.cache_folder() / "compiled")
    named = Path(chosen)
    return named if is_all_of_user(named) or not named.exists() else None


def _kept(function: Callable[..., Any]) -> Any:
    """The function with its code kept on disk, where there is a place for it."""
    config: Any = numba.config
    chosen, below = config.CACHE_DIR, folder()
    if below is None:
        return numba.njit(**_OPTIONS)(function)
    config.CACHE_DIR = str(below)
    try:
        return numba.njit(cache=True, **_OPTIONS)(function)
    except RuntimeError:  # no folder can be written
        return numba.njit(**_OPTIONS)(function)
    finally:
        config.CACHE_DIR = chosen
