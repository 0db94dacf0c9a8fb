"""Phrases that are said among other words, and other sentences that hold none."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from benchmarks.speech.accuracy import TOLD, hear
from benchmarks.speech.conditions import heard_in
from benchmarks.speech.texts import blocks
from benchmarks.speech.voices import spoken
from hri.bench.speech.latency import Progress
from hri.bench.speech.listening import Listen
from hri.bench.speech.samples import Clip, Recordings
from hri.bench.speech.scoring import Outcome
from hri.bench.table import Limit, Row, at_least, at_most, share
from hri.core.errors import NotAvailable

WHAT = "phrases among other words"
GRAMMAR = Path(__file__).with_name("phrases.jsgf")
LEAST = {"clean": 0.95, "12 dB": 0.93, "6 dB": 0.85}
"""Phrases that must be heard, by condition."""
OTHERS = ("others", "near")
"""Sentences without a phrase, and of these such as sound alike."""
MOST_OTHER = 0.01
"""Phrases taken for another, and sentences without one that are taken."""


def rows(people: Recordings | None, listen: Listen, step: int, progress: Progress) -> Iterator[Row]:
    """Of each condition, by eight voices. Raises NotAvailable without flite or recordings."""
    if people is None:
        raise NotAvailable("no recordings of people - name their folder with --recordings")
    for condition, least in LEAST.items():
        progress(f"{WHAT}, {condition}")
        outcomes = {
            kind: hear(GRAMMAR, _clips(people, kind, condition, step), listen)
            for kind in ("phrases", *OTHERS)
        }
        said, others = outcomes["phrases"], outcomes["others"]
        right = [one for one in said if one.is_right]
        mistaken = [one for one in said if one.is_mistaken]
        yield _row(f"{WHAT}, {condition}", right, said, at_least(least)) | {
            "clips": [one.told() for one in said if not one.is_right][:TOLD]
        }
        yield _row(f"another phrase, {condition}", mistaken, said, at_most(MOST_OTHER))
        taken = [one for one in others if one.accepted]
        yield _row(f"other sentences taken, {condition}", taken, others, at_most(MOST_OTHER))
        near = [one for one in outcomes["near"] if one.accepted]
        yield _row(f"sentences that sound alike taken, {condition}", near, outcomes["near"], None)


@cache
def _spoken(kind: str, step: int) -> list[Clip]:
    """The sentences of one kind in eight voices; what is to be heard of them is their phrase."""
    chosen = {
        text: "" if heading in OTHERS else heading
        for heading, text in blocks("phrases.txt")
        if kind == (heading if heading in OTHERS else "phrases")
    }
    return [
        Clip(clip.name, clip.samples, chosen[clip.sentence], voice=clip.voice)
        for clip in spoken(list(chosen)[::step])
    ]


def _clips(people: Recordings, kind: str, condition: str, step: int) -> list[Clip]:
    return list(heard_in(condition, _spoken(kind, step), [*people.orders, *people.read]))


def _row(what: str, hits: list[Outcome], all_of: list[Outcome], limit: Limit | None) -> Row:
    return share(what, len(hits), len(all_of), limit)
