"""Seeing people: gestures of real heads and in films, what it costs, poses, and who is who."""

from __future__ import annotations

import os
from collections.abc import Iterator
from typing import Any

from hri.bench.table import Row, attempted, report
from hri.bench.vision import cross_validation, crossing, pose, recordings, speed, videos


def measure(quick: bool = False) -> dict[str, Any]:
    """All rows; what is being done is told on standard error. `quick` takes a tenth of the time."""
    told = list(rows(quick, max(1, os.cpu_count() or 1)))
    return report("vision", told, quick)


def rows(quick: bool, workers: int) -> Iterator[Row]:
    """All rows in the order of the table; films are judged in so many processes."""
    yield from attempted("recordings of real heads", recordings.rows)
    yield from attempted("cross-validation on them", cross_validation.rows)
    yield from attempted("the chain on one core", lambda: speed.rows(quick))
    yield from attempted("pose", lambda: pose.rows(quick))
    yield from attempted("crossing", lambda: crossing.rows(quick, workers))
    yield from attempted("films", lambda: videos.rows(quick, workers))
