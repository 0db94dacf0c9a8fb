"""`hri memory list`: everyone who is remembered, a line each."""

from __future__ import annotations

import argparse

from hri.cli.memory.output import as_json, minute, remembered, times
from hri.core.quoting import report


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    people = remembered()
    if options.json:
        keys = ("id", "name", "since", "seen", "meetings")
        found = [
            {key: getattr(person, key) for key in keys} | {"facts": len(person.facts)}
            for person in people
        ]
        print(as_json(found))
        return 0
    if not people:
        print("nobody is remembered")
    width = max((len(person.name) for person in people), default=0)
    for person in people:
        count = len(person.facts)
        facts = "1 fact" if count == 1 else f"{count} facts"
        met = f"met {times(person.meetings)} since {person.since:%Y-%m-%d}"
        report(f"{person.name:{width}}  {met}, last {minute(person.seen)}; {facts}")
    return 0
