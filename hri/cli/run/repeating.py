"""`--repeat FOLDER`: runs again what was recorded there, as its `recording.json` says."""

from __future__ import annotations

import argparse
import json
import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from hri import __version__
from hri.cli.terminal.messages import OptionParser
from hri.core.errors import HriError
from hri.core.recorded import ABOUT
from hri.core.writing import PRIVATE, write_text
from hri.robot.provenance import environment, read_record
from hri.robot.sources import changed

OWN = frozenset((
    "allow_remote", "app", "command", "headless", "open", "port", "record", "repeat", "studio",
    "trusted",
))  # fmt: skip
"""What a repetition may have otherwise than the run; all else comes from the record."""

Options = argparse.Namespace


@contextmanager
def repeated(
    options: Options,
    add_options: Callable[[argparse.ArgumentParser], object],
    tell: Callable[[str], object],
) -> Iterator[Options]:
    """The options of the run that was recorded, in its folder, with its environment and feelings.

    `tell` gets a line for each thing that is no longer as it was. Raises HriError for a recording
    that no command of ours made, and for options that the record has.
    """
    folder = Path(os.path.abspath(options.repeat))
    told = read_record(folder)
    words = _words(folder, told)
    parser = OptionParser(prog="hri run")
    _add_app(parser)
    add_options(parser)
    _refuse_more(options, parser.parse_args([]))
    recorded = parser.parse_args(words)
    recorded.command, recorded.repeat = told["command"], None
    recorded.record = None if options.record is None else Path(os.path.abspath(options.record))
    recorded.headless |= options.headless
    for name in ("studio", "open", "port", "allow_remote", "trusted"):
        setattr(recorded, name, getattr(options, name))
    for line in _differences(told):
        tell(f"{line} - the run may differ from the recorded one")
    with _as_recorded(told), _feelings(told) as memory:
        recorded.memory = memory
        yield recorded


def _words(folder: Path, told: dict[str, Any]) -> list[str]:
    """The arguments of `hri run`."""
    match told.get("command"):
        case ["hri", "run", *words]:
            return list(map(str, words))
        case ["hri", "companion", *words]:
            return ["companion", *map(str, words)]
        case ["hri", "studio", *words]:
            return [*map(str, words), "--headless"]
    remedy = "start it again with the command in there"
    raise HriError(f"{folder / ABOUT}: not a run of `hri run` - {remedy}")


def _add_app(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("app", nargs="?", default="companion")


def _refuse_more(options: Options, defaults: Options) -> None:
    for name, default in vars(defaults).items():
        if name not in OWN and getattr(options, name, default) != default:
            option = name.replace("_", "-")
            raise HriError(f"--repeat takes --{option} from the recording - leave it out")


def _differences(told: dict[str, Any]) -> Iterator[str]:
    """A line for each thing that decides a run and is no longer as it was."""
    if told.get("clock") != "fake":
        yield "it ran in real time"
    if (then := told.get("version")) != __version__:
        yield f"it was recorded with hri {then}, and this is {__version__}"
    sources = told.get("sources")
    for path in changed(sources) if isinstance(sources, dict) else ():
        yield f"{path} has changed"


@contextmanager
def _as_recorded(told: dict[str, Any]) -> Iterator[None]:
    """The folder and the environment of the run."""
    there, cwd = told.get("environment"), told.get("cwd")
    if not isinstance(there, dict) or not isinstance(cwd, str):
        raise HriError("the record lacks its folder or environment - name another recording")
    here, now = os.getcwd(), environment()
    _replace(now, there)
    try:
        os.chdir(cwd)
        yield
    except FileNotFoundError as error:
        if error.filename != cwd:
            raise
        raise HriError(f"{cwd}: it ran in this folder, which is gone - create it") from error
    finally:
        os.chdir(here)
        _replace(there, now)


def _replace(before: dict[str, str], after: dict[str, str]) -> None:
    for name in before.keys() - after.keys():
        os.environ.pop(name, None)
    os.environ.update({name: str(value) for name, value in after.items()})


@contextmanager
def _feelings(told: dict[str, Any]) -> Iterator[str]:
    """A file with the feelings that the run began with, if it did with any. Those of the user are
    not touched.
    """
    with tempfile.TemporaryDirectory(prefix="hri-") as folder:
        file = Path(folder) / "feelings.json"
        if told.get("feelings"):
            write_text(file, json.dumps(told["feelings"]), PRIVATE)
        yield str(file)
