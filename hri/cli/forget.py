"""`hri forget`: erases data kept about people, or about one person."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Collection
from pathlib import Path

from hri.cli.terminal.progress_line import waiting
from hri.conversation import personal_data
from hri.conversation.personal_data import LookedUpWords, Trace
from hri.conversation.remains import remains
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report

EPILOG = """\
A running robot forgets it too, within about a second. Files made on purpose are deleted only after
a yes: recordings, and without a name also pictures and films of the camera, your lexicon, and your
choice of devices. Without a terminal to ask, they stay, and are listed.
Then it searches every file that the program wrote for the name and for what the person told;
where something is left, that is said, and the exit status is 1."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.epilog = EPILOG
    about = "forget only this person: what they told, the robot's opinion of them, their face"
    parser.add_argument("person", nargs="?", metavar="NAME", help=about)
    parser.add_argument("--yes", action="store_true", help="delete without asking")


def run(options: argparse.Namespace) -> int:
    """Erase place by place; a failure at one place does not stop the others. Then search."""
    person = options.person
    with waiting("looking for saved data"):
        found = personal_data.traces(person)
        known = set() if found else personal_data.people()
        forgotten = [person] if person else sorted(personal_data.people())
        told = sorted({word for name in forgotten for word in personal_data.told_by(name)})
    if not found:
        if person and known:
            raise HriError(f'unknown person "{person}" - {did_you_mean(person, known)}')
        print("there is nothing to forget")
    status, spared = 0, []
    for trace in found:
        try:
            if not _is_erased(trace, options.yes):
                spared.append(trace.place)
        except HriError as error:
            print(error, file=sys.stderr)
            status, spared = 2, [*spared, trace.place]
    with waiting("searching what the program wrote"):
        left = _left(forgotten, told, spared) if found else []
    for line in left:
        report(line, sys.stderr)
    return status or bool(left)


def _left(names: Collection[str], told: Collection[str], spared: Collection[Path]) -> list[str]:
    """Search for everyone by name, and for what they told; a line for each file."""
    for word in told:  # how it is said
        for place in LookedUpWords().places():
            LookedUpWords().forget(place, word)
    remedy = "look at it, and delete it if it is about them"
    left = remains(names, told, spared)
    return [f'{file}: it still has "{word}" - {remedy}' for file, word in left]


def _is_erased(trace: Trace, has_yes: bool) -> bool:
    """Erase it, if allowed, and say so; whether it was."""
    what = trace.kept.about if trace.person is None else f"{trace.kept.about}: {trace.person}"
    if trace.needs_yes and not has_yes and not _is_allowed(f"{trace.place}: {what} - delete it?"):
        report(f"{trace.place}: {what} - it stays; --yes deletes it")
        return False
    trace.erase()
    report(f"{trace.place}: {what} - forgotten")
    return True


def _is_allowed(question: str) -> bool:
    """The answer at the terminal; no if there is no terminal."""
    if not sys.stdin.isatty():
        return False
    try:
        return input(f"{question} [y/N] ").strip().lower() in ("y", "yes")
    except EOFError:
        return False
