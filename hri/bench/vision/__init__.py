"""Seeing people: gestures of real heads and in films, what it costs, poses, and who is who."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from hri.bench.table import Row, attempted, report
from hri.bench.vision import cross_validation, crossing, nods, pose, recordings, speed, videos
from hri.core.errors import HriError, did_you_mean

WORKERS = max(1, os.cpu_count() or 1)
"""Processes in which films are judged."""
PARTS: Mapping[str, Callable[[bool], Iterator[Row]]] = {
    "recordings of real heads": lambda quick: recordings.rows(),
    "cross-validation on them": lambda quick: cross_validation.rows(),
    "the chain on one core": speed.rows,
    "pose": pose.rows,
    "crossing": lambda quick: crossing.rows(quick, WORKERS),
    "nods": lambda quick: nods.rows(quick, WORKERS),
    "films": lambda quick: videos.rows(quick, WORKERS),
}
"""The parts of the bench in the order of the table."""


def measure(quick: bool = False, only: str | None = None) -> dict[str, Any]:
    """The rows of all parts, or of one of PARTS; progress is written to standard error.

    `quick` takes a tenth of the time. Raises HriError for an unknown part.
    """
    if only is not None and only not in PARTS:
        raise HriError(f'bench vision has no part "{only}" - {did_you_mean(only, PARTS)}')
    chosen = PARTS if only is None else {only: PARTS[only]}
    told = [row for name, rows in chosen.items() for row in attempted(name, _begun(rows, quick))]
    return report("vision", told, quick)


def _begun(rows: Callable[[bool], Iterator[Row]], quick: bool) -> Callable[[], Iterator[Row]]:
    return lambda: rows(quick)
