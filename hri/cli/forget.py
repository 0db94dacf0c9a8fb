"""`hri forget`: erases data kept about people, or about one person."""

from __future__ import annotations

import argparse
import sys

from hri.cli.terminal.progress_line import waiting
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report
from hri.robot import personal_data
from hri.robot.personal_data import Trace

EPILOG = """\
A running robot forgets it too, within about a second. Files made on purpose are deleted only after
a yes: recordings, and without a name also pictures and films of the camera, your lexicon, and your
choice of devices. Without a terminal to ask, they stay, and are listed."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    about = "forget only this person: the robot's opinion of them, their deeds, their face"
    parser.add_argument("person", nargs="?", metavar="NAME", help=about)
    parser.add_argument("--yes", action="store_true", help="delete without asking")


def run(options: argparse.Namespace) -> int:
    """Erase place by place; a failure at one place does not stop the others."""
    person = options.person
    with waiting("looking for saved data"):
        found = personal_data.traces(person)
        known = set() if found else personal_data.people()
    if not found:
        if person and known:
            raise HriError(f'unknown person "{person}" - {did_you_mean(person, known)}')
        print("there is nothing to forget")
    status = 0
    for trace in found:
        try:
            report(_forgotten(trace, options.yes))
        except HriError as error:
            print(error, file=sys.stderr)
            status = 2
    return status


def _forgotten(trace: Trace, has_yes: bool) -> str:
    """Erase it, if allowed; the result in a line."""
    what = trace.kept.about if trace.person is None else f"{trace.kept.about}: {trace.person}"
    if trace.needs_yes and not has_yes and not _is_allowed(f"{trace.place}: {what} - delete it?"):
        return f"{trace.place}: {what} - it stays; --yes deletes it"
    trace.erase()
    return f"{trace.place}: {what} - forgotten"


def _is_allowed(question: str) -> bool:
    """The answer at the terminal; no if there is no terminal."""
    if not sys.stdin.isatty():
        return False
    try:
        return input(f"{question} [y/N] ").strip().lower() in ("y", "yes")
    except EOFError:
        return False
