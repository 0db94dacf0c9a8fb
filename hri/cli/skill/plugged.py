"""The skills of an app, by name or path, for the commands of `hri skill`."""

from __future__ import annotations

import argparse
import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from hri.core import paths
from hri.core.errors import HriError, did_you_mean
from hri.robot.app import App, load_app
from hri.robot.skills import OffSkill, turned_off

APP = "companion"


def add_app(parser: argparse.ArgumentParser) -> None:
    """`--app`."""
    parser.add_argument("--app", default=APP, metavar="APP", help=f"name or path ({APP})")


def add_names(parser: argparse.ArgumentParser) -> None:
    """Names of skills, and `--app`."""
    parser.add_argument(
        "names", nargs="*", metavar="NAME", help="names of skills, or paths to their folders (all)"
    )
    add_app(parser)


def skills_of(app: App) -> dict[str, App | OffSkill]:
    """All skills of an app by name, those that are off as well."""
    found: tuple[App | OffSkill, ...] = (*app.all_skills(), *app.off)
    return {one.name: one for one in found}


def plugged_in(app: str) -> App:
    """An app with its skills. Raises HriError."""
    return load_app(app, turned_off())


def chosen(app: App, names: Sequence[str]) -> list[str]:
    """The names of skills that are meant; all without any. Raises HriError for an unknown one."""
    known = skills_of(app)
    meant = [Path(name).resolve().name if is_path(name) else name for name in names]
    for name in meant:
        if name not in known:
            raise HriError(f'{app.name} has no skill "{name}" - {did_you_mean(name, known)}')
    return meant or list(known)


def is_path(name: str) -> bool:
    """Whether a skill is named by its folder."""
    return "/" in name or name in (".", "..")


@contextmanager
def with_named(app: str, names: Sequence[str]) -> Iterator[str]:
    """An app that has these skills plugged in, which may lie anywhere; it is there for the body."""
    folders = [paths.expanded(name).resolve() for name in names if is_path(name)]
    if not folders:
        yield app
        return
    with TemporaryDirectory() as place:
        folder = Path(place) / "with_skills"
        folder.mkdir()
        base = app if not is_path(app) else str(paths.expanded(app).resolve())
        listed = ", ".join(json.dumps(str(one)) for one in folders)
        text = f"extends = {json.dumps(base)}\nskills = [{listed}]\n"
        (folder / "app.toml").write_text(text, "utf-8")
        yield str(folder)
