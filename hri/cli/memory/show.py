"""`hri memory show NAME`: all that is remembered of a person."""

from __future__ import annotations

import argparse
from collections.abc import Iterator

from hri.cli.memory.output import as_json, entries, minute, remembered, times
from hri.conversation.people import KnownPerson
from hri.core.errors import HriError, did_you_mean
from hri.core.quoting import report


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("name", metavar="NAME", help="who; everyone of that name is shown")
    parser.add_argument("--json", action="store_true", help="print JSON")


def run(options: argparse.Namespace) -> int:
    everyone = remembered()
    found = [person for person in everyone if person.is_called(options.name)]
    if not found:
        remedy = did_you_mean(options.name, [person.name for person in everyone])
        raise HriError(f'nobody called "{options.name}" is remembered - {remedy}')
    if options.json:
        print(as_json(entries(found)))
        return 0
    for person in found:
        report(person.name)
        for key, text in _lines(person):
            report(f"  {key:12} {text}")
    return 0


def _lines(person: KnownPerson) -> Iterator[tuple[str, str]]:
    """Keys, and what belongs to them, for people."""
    if person.consent is not None:
        yield "allowed", f"{minute(person.consent.when)}, by {person.consent.how}"
    yield "met", f"{times(person.meetings)} since {minute(person.since)}"
    yield "last seen", minute(person.seen)
    if person.heard:
        yield "heard as", " ".join(person.heard)
    if person.said:
        yield "said as", " ".join(person.said)
    for fact in person.facts:
        values = "".join(f", {name} {value}" for name, value in fact.values.items())
        yield fact.relation, f"{fact.value}{values} ({minute(fact.since)})"
    for felt in person.felt:
        yield "felt", f"{felt.feeling}, because of {felt.because} ({minute(felt.when)})"
    for asked in person.asked:
        yield "asked", f"{asked.question or asked.relation} (meeting {asked.meeting})"
