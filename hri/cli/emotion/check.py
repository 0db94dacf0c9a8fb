"""`hri emotion check`: loads all emotion files, runs their self-tests, reports triggers that never
fire.
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path

import hri
from hri.cli.emotion.list import personality_names
from hri.core import paths
from hri.core.errors import HriError
from hri.core.quoting import message_line, report
from hri.emotion import personality, stimulus
from hri.emotion.display import load_display
from hri.emotion.reachability import (
    felt_by_name,
    unmet_expectations,
    unreachable_emotions,
    unreachable_stimuli,
)
from hri.emotion.stimulus import StimulusSpec

_MENTION = re.compile(rb"""["']([A-Za-z_][\w-]*(?:\.[\w-]+)*)["']""")
"""A name in quotes: of an event, of a stimulus."""
_BEHAVIOR = re.compile(rb"""<Behavior\s[^>]*?\bid=["']([\w-]+)["']""")
"""A behavior of a network."""
_SUFFIXES = (".py", ".toml", ".xml")
_LARGEST = 1_000_000
"""Bytes; larger files are not programs."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """No options."""


def run(options: argparse.Namespace) -> int:
    """Exit status 2 when a file is wrong, 1 when an expectation is not met."""
    loaders = _loaders()
    problems = [error for load in loaders.values() if (error := _error_of(load))]
    for error in problems:
        print(error)
    if problems:
        return 2
    stimuli = stimulus.load_stimuli()
    unmet = list(unmet_expectations(stimuli))
    for failure in unmet:
        print(message_line(str(failure)))
    for warning in _warnings(stimuli):
        print(message_line(str(warning)))
    count = sum(len(spec.expects) for spec in stimuli.values())
    told = f"{len(unmet)} of {count} expectations not met" if unmet else "fine"
    report(f"{', '.join(loaders)}: {told}")
    return 1 if unmet else 0


def _loaders() -> dict[str, Callable[[], object]]:
    """The loaders, separate so that one error does not hide the next."""
    loaders: dict[str, Callable[[], object]] = {
        stimulus.FOLDER: stimulus.load_stimuli,
        "emotions/display.toml": load_display,
    }
    for name in personality_names():
        loaders[f"{personality.FOLDER}/{name}"] = partial(personality.load_personality, name)
    return loaders


def _error_of(load: Callable[[], object]) -> HriError | None:
    try:
        load()
    except HriError as error:
        return error
    return None


def _warnings(stimuli: Mapping[str, StimulusSpec]) -> Iterator[str]:
    """Warnings and notes."""
    sources = list(_sources())
    mentioned = _found(_MENTION, sources)
    for emotion in unreachable_emotions(stimuli):
        yield f"warning: nothing causes {emotion} - add it to a stimulus in {stimulus.FOLDER}"
    for problem in unreachable_stimuli(stimuli, mentioned, _found(_BEHAVIOR, sources)):
        yield f"warning: {problem}"
    if named := felt_by_name(stimuli, mentioned):
        yield f"note: felt only when a program raises stimulus.felt with it: {', '.join(named)}"


def _sources() -> Iterator[bytes]:
    """The built-in programs and networks, and those of all apps."""
    house = [Path(hri.__file__).parent, paths.house() / "config"]
    for folder in (*house, *(below / "apps" for below in paths.search_folders())):
        for file in folder.rglob("*"):
            if file.suffix in _SUFFIXES and file.is_file() and file.stat().st_size <= _LARGEST:
                yield file.read_bytes()


def _found(pattern: re.Pattern[bytes], sources: Sequence[bytes]) -> set[str]:
    return {name.decode("ascii") for source in sources for name in pattern.findall(source)}
