"""How much is understood, and how little is made up."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Literal

from benchmarks.speech import manners
from benchmarks.speech.conditions import heard_in, padded
from benchmarks.speech.texts import lines
from benchmarks.speech.voices import spoken
from hri.bench.speech import samples
from hri.bench.speech.latency import Progress
from hri.bench.speech.listening import Listen
from hri.bench.speech.samples import ORDERS, ROBOT, Clip, Recordings
from hri.bench.speech.scoring import Outcome
from hri.bench.table import Limit, Row, at_least, at_most, attempted, share
from hri.core.errors import NotAvailable
from hri.speech.grammar import load_grammar

TOLD = 20
"""Clips that a row names."""
BATCH = 40
"""Clips for one process."""

MANNERS_COST = 0.08
"""How much less than of plain speech may be understood of whispers, shouts and the like."""
DRAWS = 10
"""Times that the noise under people's orders is drawn: there are few of them."""

Kind = Literal["commands", "outside", "orders", "foreign"]
GRAMMARS: dict[Kind, Path] = {
    "commands": ROBOT,
    "outside": ROBOT,
    "orders": ORDERS,
    "foreign": ROBOT,
}


@dataclass(frozen=True, slots=True)
class Measure:
    """One row: which clips, what is counted in them, and how many there may be."""

    what: str
    kind: Kind
    condition: str
    counted: Literal["right", "mistaken"]
    limit: Limit

    @property
    def name(self) -> str:
        return f"{self.what}, {self.condition}"


UNDERSTOOD = "commands understood word for word"
_CONFUSED = "another sentence accepted for a command"
_MADE_UP = "sentences outside of the grammar accepted"
ORDERED = "people's orders, all slots right"
_MISTAKEN = "another order accepted"
_SPOKEN = "commands understood word for word, spoken"
_LIMITS: Mapping[tuple[str, Kind, Literal["right", "mistaken"]], Mapping[str, float]] = {
    (UNDERSTOOD, "commands", "right"): {"clean": 0.98, "12 dB": 0.92, "6 dB": 0.75},
    (_CONFUSED, "commands", "mistaken"): {"clean": 0.005, "12 dB": 0.02, "6 dB": 0.04},
    (_MADE_UP, "outside", "mistaken"): {"clean": 0.005, "12 dB": 0.015, "6 dB": 0.03},
    (ORDERED, "orders", "right"): {
        "clean": 0.98, "12 dB": 0.90, "6 dB": 0.72,
        "12 dB in a kitchen": 0.92, "6 dB in a kitchen": 0.78,
    },
    (_MISTAKEN, "orders", "mistaken"): {
        "clean": 0.015, "12 dB": 0.05, "6 dB": 0.10,
        "12 dB in a kitchen": 0.05, "6 dB in a kitchen": 0.10,
    },
    ("people's foreign speech accepted", "foreign", "mistaken"): {"clean": 0.01},
}  # fmt: skip
"""What is counted, in which clips, and by condition how many there must or may be."""
MEASURES = tuple(
    Measure(what, kind, condition, counted, (at_least if counted == "right" else at_most)(limit))
    for (what, kind, counted), limits in _LIMITS.items()
    for condition, limit in limits.items()
)


def rows(
    recordings: Recordings | None,
    listen: Listen,
    step: int = 1,
    progress: Progress = print,
    draw: int = 0,
) -> Iterator[Row]:
    """The rows of recognition; every `step`th sentence and recording is taken.

    `draw` chooses other noise, which shows how much of a figure is chance.
    """

    @cache
    def outcomes(kind: Kind, condition: str) -> list[Outcome]:
        is_drawn_often = kind == "orders" and condition != "clean"
        draws = range(DRAWS * draw + 1, DRAWS * draw + 1 + (DRAWS if is_drawn_often else 1))
        said = [clip for d in draws for clip in sounds(recordings, kind, condition, step, d)]
        progress(f"{kind}, {condition}: {len(said)} clips")
        return hear(GRAMMARS[kind], said, listen)

    def counted(measure: Measure) -> Iterator[Row]:
        yield _row(measure, outcomes(measure.kind, measure.condition))

    for measure in MEASURES:
        yield from attempted(measure.name, partial(counted, measure))
    progress(_SPOKEN)
    yield from attempted(_SPOKEN, partial(_manner_rows, listen, step))


def _manner_rows(listen: Listen, step: int) -> Iterator[Row]:
    """Commands understood in each manner of speaking, against plain speech."""
    limit = None
    for manner in manners.MANNERS:
        said = list(manners.spoken(manner, samples.commands()[::step]))
        right = sum(outcome.is_right for outcome in hear(ROBOT, said, listen))
        yield share(f"{_SPOKEN}, {manner}", right, len(said), limit)
        limit = limit or at_least(round(right / len(said) - MANNERS_COST, 4))


def outside() -> list[str]:
    """The sentences of `outside.txt`."""
    return lines("outside.txt")


def sounds(
    recordings: Recordings | None, kind: Kind, condition: str, step: int = 1, draw: int = 0
) -> list[Clip]:
    """The clips of one kind. Raises NotAvailable when flite or the recordings are missing."""
    if recordings is None and (kind in ("orders", "foreign") or condition != "clean"):
        raise NotAvailable("no recordings of people - name their folder with --recordings")
    if recordings is None:
        recordings = Recordings((), ())
    people = [*recordings.orders, *recordings.read]
    if kind == "foreign":
        return people[::step]
    if kind == "orders":
        orders = recordings.orders[::step]
        said = list(orders) if condition == "clean" else [padded(clip) for clip in orders]
        return list(heard_in(condition, said, recordings.orders, draw))
    sentences = samples.commands() if kind == "commands" else outside()
    return list(heard_in(condition, list(spoken(sentences[::step])), people, draw))


def hear(grammar: Path, said: Sequence[Clip], listen: Listen) -> list[Outcome]:
    """Hear clips in as many processes as there are cores."""
    batches = [said[start : start + BATCH] for start in range(0, len(said), BATCH)]
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        hearings = pool.map(partial(listen, grammar), batches)
        heard = [pieces for hearing in hearings for pieces in hearing.heard]
    return [Outcome(clip, pieces) for clip, pieces in zip(said, heard, strict=True)]


def _row(measure: Measure, outcomes: Sequence[Outcome]) -> Row:
    def counts(outcome: Outcome) -> bool:
        return outcome.is_right if measure.counted == "right" else outcome.is_mistaken

    hits = [outcome for outcome in outcomes if counts(outcome)]
    odd = hits if measure.counted == "mistaken" else [o for o in outcomes if not o.is_right]
    row = share(measure.name, len(hits), len(outcomes), measure.limit)
    voices = Counter(outcome.clip.voice for outcome in hits)
    if voices.keys() - {""}:
        row["by_voice"] = dict(sorted(voices.items()))
    if measure.kind == "commands":
        grammar = load_grammar(ROBOT)
        row["meaning_right"] = sum(outcome.means_the_same(grammar) for outcome in outcomes)
    return row | {"clips": [outcome.told() for outcome in odd[:TOLD]]}
