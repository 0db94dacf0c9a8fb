"""Finds the folder `benchmarks`: a checkout has it beside the package `hri`, a wheel does not."""

from __future__ import annotations

import importlib
import sys
from types import ModuleType

from hri.core import paths
from hri.core.errors import HriError


def has_research() -> bool:
    """Whether the folder is there."""
    return (paths.house() / "benchmarks").is_dir()


def research(name: str) -> ModuleType | None:
    """A module of the folder; None where `hri` was installed without it."""
    if not has_research():
        return None
    if (checkout := str(paths.house())) not in sys.path:
        sys.path.insert(0, checkout)
    return importlib.import_module(f"benchmarks.{name}")


def missing(words: str) -> HriError:
    """The error for a bench, or for a part of it, that is not here."""
    remedy = f'run it in a checkout of hri: make bench OPTIONS="{words}"'
    return HriError(f"bench {words} does not come with an installed hri - {remedy}")
