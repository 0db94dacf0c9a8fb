"""Seeing people: gestures of real heads and in films, poses, and who is who."""

from __future__ import annotations

import os

from benchmarks.vision import (
    colors,
    contact,
    cross_validation,
    crossing,
    expressions,
    far_faces,
    following,
    half_hidden,
    markers,
    nods,
    objects,
    pose,
    recordings,
    returning,
    shown_things,
    videos,
)
from hri.bench.table import Parts

WORKERS = max(1, os.cpu_count() or 1)
"""Processes in which films are judged."""
PARTS: Parts = {
    "recordings of real heads": lambda quick: recordings.rows(),
    "cross-validation on them": lambda quick: cross_validation.rows(),
    "pose": pose.rows,
    "crossing": lambda quick: crossing.rows(quick, WORKERS),
    "far faces": far_faces.rows,
    "who comes back": returning.rows,
    "follow from behind": following.rows,
    "expressions": expressions.rows,
    "nods": lambda quick: nods.rows(quick, WORKERS),
    "objects": objects.rows,
    "half-hidden things": half_hidden.rows,
    "things that are shown": shown_things.rows,
    "colors": colors.rows,
    "markers": markers.rows,
    "time to contact": contact.rows,
    "films": lambda quick: videos.rows(quick, WORKERS),
}
"""What `hri bench vision` measures in a checkout beside its own, in the order of the table."""
