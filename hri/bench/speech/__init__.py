"""Speech: how soon it is understood, how soon the voice begins, and at what cost.

Every row of recognition is what `hri grammar listen --wav` says with its default engine and
strictness. The commands are spoken by flite, the orders come from recordings of people.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

from hri.bench.checkout import research
from hri.bench.speech.latency import rows as speed_rows
from hri.bench.speech.listening import Listen, listen
from hri.bench.speech.samples import Clip, Recordings, read_recordings
from hri.bench.speech.start import rows as start_rows
from hri.bench.speech.text import rows as text_rows
from hri.bench.speech.voice_start import rows as speaking_rows
from hri.bench.table import Row, attempted, report
from hri.core import paths

QUICK_STEP = 6
"""A quick run takes every sixth sentence and recording."""


def measure(quick: bool = False, recordings: Path | None = None, draw: int = 0) -> dict[str, Any]:
    """All rows; what is being done is told on standard error.

    `draw` is the number of the babble: published figures use 0; other seeds show how much is
    chance.

    `recordings` is a folder with a `manifest.tsv` (see `clips.read_recordings`); without one,
    `../shared/speech/real` beside a checkout is taken when it is there.
    Raises HriError when recordings cannot be read or a program fails.
    """
    folder = recordings or recordings_beside()
    people = read_recordings(folder) if folder else None
    told = list(rows(people, listen, QUICK_STEP if quick else 1, draw))
    return report("speech", told, quick) | {"draw": draw}


def rows(people: Recordings | None, hear: Listen, step: int = 1, draw: int = 0) -> Iterator[Row]:
    """All rows in the order of the table; every `step`th sentence and recording is taken."""
    tell = partial(print, file=sys.stderr, flush=True)
    yield from attempted("speed", lambda: speed_rows(people, hear, step, tell))
    tell("start, text, voice")
    yield from attempted("start and memory of the engine", lambda: start_rows(_longest(people)))
    yield from attempted("parsing and checking", text_rows)
    yield from attempted("speaking", speaking_rows)
    if (compared := research("speech")) is not None:
        of_peers = partial(compared.rows, people, hear, step, tell, draw)
        yield from attempted("accuracy and peers", of_peers)


def _longest(people: Recordings | None) -> list[Clip]:
    return sorted(people.orders, key=lambda clip: clip.seconds)[-1:] if people else []


def recordings_beside() -> Path | None:
    """The folder of recordings beside a checkout; None where there is none."""
    folder = paths.house().parent / "shared" / "speech" / "real"
    return folder if (folder / "manifest.tsv").is_file() else None
