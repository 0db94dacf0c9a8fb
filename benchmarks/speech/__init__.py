"""Speech: what is understood and what is made up, and the same work by others.

Every row of recognition is what `hri grammar listen --wav` says with its default engine and
strictness. The commands and the sentences outside of their grammar are spoken by flite; orders,
foreign speech and the babble come from recordings of people.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from benchmarks.speech import (
    accuracy,
    alignment,
    barge_in,
    feelings,
    heard_back,
    melody,
    peers,
    phrases,
    told_apart,
)
from hri.bench.speech.latency import Progress
from hri.bench.speech.listening import Listen
from hri.bench.speech.samples import Recordings
from hri.bench.table import Row, attempted


def rows(
    people: Recordings | None, hear: Listen, step: int, progress: Progress, draw: int
) -> Iterator[Row]:
    """What `hri bench speech` measures in a checkout beside its own."""
    of_people = partial(accuracy.rows, people, hear, step, progress, draw)
    yield from attempted("accuracy", of_people)
    yield from attempted(phrases.WHAT, partial(phrases.rows, people, hear, step, progress))
    yield from attempted("peers", lambda: peers.rows(people, hear, step, progress))
    progress("feelings in the voice")
    yield from attempted(feelings.WHAT, feelings.rows)
    progress(told_apart.WHAT)
    yield from attempted(told_apart.WHAT, told_apart.rows)
    progress(melody.WHAT)
    yield from attempted(melody.WHAT, melody.rows)
    progress(alignment.WHAT)
    yield from attempted(alignment.WHAT, alignment.rows)
    progress(heard_back.WHAT)
    yield from attempted(heard_back.WHAT, heard_back.rows)
    progress(barge_in.WHAT)
    yield from attempted(barge_in.WHAT, barge_in.rows)
