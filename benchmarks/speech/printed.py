"""Prints the rows of one bench as a table: figure, limit, and what failed."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path

from hri.bench.speech import recordings_beside
from hri.bench.speech.samples import Recordings, read_recordings
from hri.bench.table import Row

WIDTH = 62
"""Letters of what was measured."""


def main(about: str | None, rows: Callable[[Recordings | None, int], Iterator[Row]]) -> None:
    """Measure and print; exit status 1 when a limit is missed.

    `rows` is called with the recordings of people and with the step in which sentences are taken.
    Raises SystemExit.
    """
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--recordings", type=Path, default=recordings_beside(), metavar="DIR")
    help_ = "take every N-th sentence only"
    parser.add_argument("--step", type=int, default=1, metavar="N", help=help_)
    options = parser.parse_args()
    people = read_recordings(options.recordings) if options.recordings else None
    status = 0
    for row in rows(people, options.step):
        print(line(row), *(f"      {clip}" for clip in row.get("clips", ())), sep="\n", flush=True)
        status |= not row.get("passed", True)
    raise SystemExit(status)


def line(row: Row) -> str:
    """A row of the table."""
    mark = ("ok" if row["passed"] else "MISSED") if "passed" in row else ""
    return f"{mark:6}  {row['what']:{WIDTH}} {_figure(row):>24}  {_limit(row)}".rstrip()


def _figure(row: Row) -> str:
    if "rate" in row:
        return f"{row['count']} of {row['of']} ({100 * row['rate']:.1f} %)"
    if "value" in row:
        return f"{row['value']:g} {row['unit']}"
    return str(row.get("skipped") or row.get("failed"))


def _limit(row: Row) -> str:
    if "limit" not in row:
        return ""
    limit = f"{100 * row['limit']:g} %" if "rate" in row else f"{row['limit']:g} {row['unit']}"
    return f"{row['side']} {limit}"
