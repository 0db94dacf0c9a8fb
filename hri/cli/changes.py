"""Says which files of an app were saved that it takes only when it starts."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from hri.robot import App
from hri.task.context import TaskContext

LOOK_EVERY = 1.0
"""Seconds between looks at the files."""

Marks = dict[Path, tuple[int, int]]
"""By which a file is known to be another: when it was written (nanoseconds), and its bytes."""


async def announce_changes(app: App, tell: Callable[[str], object], context: TaskContext) -> None:
    """Tell one line for each file that is saved and not taken, once a file.

    These are `app.toml`, Python files and networks; grammars, replies and emotions are read again.
    """
    before, told = marks(app), set[Path]()
    while True:
        await context.clock.sleep(LOOK_EVERY)
        changed = {path for path, mark in marks(app).items() if before.get(path) != mark}
        for path in sorted(changed - told):
            tell(f"{path} was saved - start the robot again to take it")
        told |= changed


def marks(app: App) -> Marks:
    """The files of an app, and of those it extends, that are read when it starts."""
    folders = [one.folder for one in app.line()]
    files = {*app.networks, *(folder / "app.toml" for folder in folders)}
    found: Marks = {}
    with suppress(OSError):  # a folder that is gone
        files.update(path for folder in folders for path in folder.glob("*.py"))
    for path in files:
        with suppress(OSError):  # one that is being written
            status = path.stat()
            found[path] = status.st_mtime_ns, status.st_size
    return found
