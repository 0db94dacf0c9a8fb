"""Seeing people: gestures of real heads and in films, what it costs, poses, and who is who."""

from __future__ import annotations

import os
from typing import Any

from hri.bench.table import Parts, measured
from hri.bench.vision import cross_validation, crossing, nods, pose, recordings, speed, videos

WORKERS = max(1, os.cpu_count() or 1)
"""Processes in which films are judged."""
PARTS: Parts = {
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
    return measured("vision", PARTS, quick, only)
