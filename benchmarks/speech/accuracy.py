"""How much is understood, and how little is made up."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import cache, partial
from pathlib import Path
from typing import Literal

from benchmarks.speech.babble import in_babble, padded
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

Kind = Literal["commands", "outside", "orders", "foreign"]
Condition = Literal["clean", "12 dB", "6 dB"]
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
    condition: Condition
    counted: Literal["right", "mistaken"]
    limit: Limit

    @property
    def name(self) -> str:
        return f"{self.what}, {self.condition}"


_UNDERSTOOD = "commands understood word for word"
_CONFUSED = "another sentence accepted for a command"
_MADE_UP = "sentences outside of the grammar accepted"
_ORDERED = "people's orders, all slots right"
MEASURES = (
    Measure(_UNDERSTOOD, "commands", "clean", "right", at_least(0.97)),
    Measure(_UNDERSTOOD, "commands", "12 dB", "right", at_least(0.88)),
    Measure(_UNDERSTOOD, "commands", "6 dB", "right", at_least(0.72)),
    Measure(_CONFUSED, "commands", "clean", "mistaken", at_most(0.01)),
    Measure(_CONFUSED, "commands", "12 dB", "mistaken", at_most(0.04)),
    Measure(_MADE_UP, "outside", "clean", "mistaken", at_most(0.005)),
    Measure(_MADE_UP, "outside", "12 dB", "mistaken", at_most(0.02)),
    Measure(_ORDERED, "orders", "clean", "right", at_least(0.98)),
    Measure(_ORDERED, "orders", "12 dB", "right", at_least(0.90)),
    Measure(_ORDERED, "orders", "6 dB", "right", at_least(0.72)),
    Measure("people's foreign speech accepted", "foreign", "clean", "mistaken", at_most(0.01)),
)


def rows(
    recordings: Recordings | None,
    listen: Listen,
    step: int = 1,
    progress: Progress = print,
    draw: int = 0,
) -> Iterator[Row]:
    """The rows of recognition; every `step`th sentence and recording is taken.

    `draw` is the seed of the babble; another one shows how much of a figure is chance.
    """

    @cache
    def outcomes(kind: Kind, condition: Condition) -> list[Outcome]:
        said = sounds(recordings, kind, condition, step, draw)
        progress(f"{kind}, {condition}: {len(said)} clips")
        return hear(GRAMMARS[kind], said, listen)

    def counted(measure: Measure) -> Iterator[Row]:
        yield _row(measure, outcomes(measure.kind, measure.condition))

    for measure in MEASURES:
        yield from attempted(measure.name, partial(counted, measure))


def outside() -> list[str]:
    """The sentences of `outside.txt`."""
    lines = Path(__file__).with_name("outside.txt").read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line and not line.startswith("#")]


def sounds(
    recordings: Recordings | None, kind: Kind, condition: Condition, step: int = 1, draw: int = 0
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
        return list(in_babble(said, recordings.orders, condition, draw))
    sentences = samples.commands() if kind == "commands" else outside()
    return list(in_babble(samples.spoken(sentences[::step]), people, condition, draw))


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
