"""`hri fleet list`: the robots, a line each."""

from __future__ import annotations

import argparse
import json
from collections.abc import Mapping
from typing import Any

from hri.cli.fleet_options import add_looking_options, settings_of
from hri.conversation.alarms import length_words
from hri.core.errors import HriError
from hri.core.quoting import report
from hri.net.zenoh.fleet import Fleet, fleet

COLUMNS = ("robot", "app", "up for", "feels", "battery", "base", "runs", "answers in")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument("--json", action="store_true", help="print JSON")
    add_looking_options(parser)


def run(options: argparse.Namespace) -> int:
    with fleet(settings_of(options)) as found:
        robots = {name: _state(found, name) for name in found.names()}
    if options.json:
        print(json.dumps(robots, indent=2))
        return 0
    if not robots:
        report("no robot is in the fleet - hri run APP --fleet NAME lets one join")
        return 0
    rows = [COLUMNS, *(_row(name, state) for name, state in robots.items())]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        report(
            "  ".join(f"{text:{width}}" for text, width in zip(row, widths, strict=True)).rstrip()
        )
    return 0


def _state(found: Fleet, name: str) -> dict[str, Any]:
    try:
        _, seconds = found.meet(name)
        return {**found.ask(name, "state", {}), "answers_in": seconds}
    except HriError as error:
        return {"error": str(error)}


def _row(name: str, state: Mapping[str, Any]) -> tuple[str, ...]:
    if "error" in state:
        return (name, str(state["error"]), *[""] * (len(COLUMNS) - 2))
    battery = state["battery"]
    return (
        name,
        str(state["app"]),
        length_words(state["seconds"]),
        str(state["feels"] or "-"),
        f"{battery:.0%}" if battery is not None else "-",
        str(state["base"] or "-"),
        ", ".join(state["tasks"]) or "-",
        f"{1000 * state['answers_in']:.1f} ms",
    )
