"""Reports saved files of an app that need a restart."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from hri.robot import App
from hri.task.context import TaskContext

LOOK_EVERY = 1.0
"""Seconds between checks of the files."""

Marks = dict[Path, tuple[int, int]]
"""What identifies a version of a file: its time of writing (nanoseconds) and its size in bytes."""


async def announce_changes(
    app: App, tell: Callable[[str], object], has_studio: bool, context: TaskContext
) -> None:
    """Report each saved file that needs a restart, in one line, once per file.

    These are `app.toml`, `skill.toml`, Python files and networks; grammars, replies and emotions
    are reloaded. A network that is the whole app is started again by the studio's page, too.
    """
    load = "press Start again on the page" if has_studio and app.is_network else "restart the robot"
    before, told = marks(app), set[Path]()
    while True:
        await context.clock.sleep(LOOK_EVERY)
        changed = {path for path, mark in marks(app).items() if before.get(path) != mark}
        for path in sorted(changed - told):
            tell(f"{path} was saved - {load} to load it")
        told |= changed


def marks(app: App) -> Marks:
    """The files of an app, and of those it extends, that are read when it starts."""
    folders = [one.folder for one in app.line()]
    files = {*app.networks, *(one.file for one in app.line())}
    found: Marks = {}
    with suppress(OSError):  # a folder that is gone
        files.update(path for folder in folders for path in folder.glob("*.py"))
    for path in files:
        with suppress(OSError):  # one that is being written
            status = path.stat()
            found[path] = status.st_mtime_ns, status.st_size
    return found
