"""How soon what was said is known, and how much of a core that takes."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path

import numpy as np

from hri.bench.speech import samples
from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import Hearing, Listen
from hri.bench.speech.samples import ORDERS, ROBOT, Clip, Recordings
from hri.bench.speech.scoring import Outcome
from hri.bench.table import Row, amount, at_most, attempted, skipped
from hri.core.errors import NotAvailable

Progress = Callable[[str], object]
NAMES = 10_000
CALLED = 20
"""Names that are said."""
SHORTEST = Clip("silence", np.zeros(RATE // 10, np.int16))
"""What is heard to find out how long the program takes to start."""


@dataclass(frozen=True, slots=True)
class Latency:
    """How soon the result must be there for recordings of a length."""

    of: str
    clips_s: tuple[float, float]
    limit_s: float


@dataclass(frozen=True, slots=True)
class Work:
    """Sentences to hear with one grammar, and how long that may take."""

    name: str
    grammar: Path
    said: Callable[[], Sequence[Clip]]
    limit: float
    """Real-time factor: seconds of one core for each second of sound."""
    latency: Latency | None = None

    @property
    def row(self) -> str:
        return f"real-time factor, {self.name}"


def rows(
    recordings: Recordings | None, listen: Listen, step: int = 1, progress: Progress = print
) -> Iterator[Row]:
    """Latency and real-time factor by grammar."""
    with names_grammar() as (names, called):
        for work in (*works(recordings, step), Work(f"{NAMES} names", names, called, 0.05)):
            progress(work.row)
            yield from attempted(work.row, partial(_of, work, listen))


def works(recordings: Recordings | None, step: int) -> Iterator[Work]:
    """Commands that flite says and orders that people gave; every `step`th of either."""

    def commands() -> Sequence[Clip]:
        return samples.spoken(samples.commands()[::step])

    def orders() -> Sequence[Clip]:
        if recordings is None:
            raise NotAvailable("no recordings of people - name their folder with --recordings")
        return recordings.orders[::step]

    short = Latency("commands of 2 to 4 s", (2.0, 4.0), 0.040)
    yield Work("robot grammar", ROBOT, commands, 0.02, short)
    long = Latency("orders of 7 to 11 s", (7.0, 11.0), 0.060)
    yield Work("order grammar", ORDERS, orders, 0.02, long)


def _of(work: Work, listen: Listen) -> Iterator[Row]:
    said = work.said()
    factor, hearing = real_time_factor(work.grammar, said, listen)
    right = count_right(said, hearing)
    yield amount(work.row, factor, "s/s", at_most(work.limit), right=right, of=len(said))
    if work.latency is not None:
        yield latency(work.latency, said, hearing)


def real_time_factor(grammar: Path, said: Sequence[Clip], listen: Listen) -> tuple[float, Hearing]:
    """Processor seconds for each second of sound, without the start of the program."""
    start = listen(grammar, [SHORTEST]).cpu_s
    hearing = listen(grammar, said)
    if not hearing.cpu_s:
        raise NotAvailable("this system does not tell the processor time of a program")
    return (hearing.cpu_s - start) / sum(clip.seconds for clip in said), hearing


def count_right(said: Sequence[Clip], hearing: Hearing) -> int:
    """Clips of which what was said was understood, and nothing else."""
    pairs = zip(said, hearing.heard, strict=True)
    return sum(Outcome(clip, heard).is_right for clip, heard in pairs)


def latency(asked: Latency, said: Sequence[Clip], hearing: Hearing) -> Row:
    """From the end of the pause that ends a piece of speech to its result."""
    shortest, longest = asked.clips_s
    found = [
        piece.latency_s
        for clip, pieces in zip(said, hearing.heard, strict=True)
        for piece in pieces
        if shortest <= clip.seconds <= longest
    ]
    what = f"end of speech to event without the pause, p95, {asked.of}"
    if not found:
        return skipped(what, "no recording is so long")
    p95 = float(np.percentile(found, 95))
    median = round(float(np.median(found)), 5)
    return amount(what, p95, "s", at_most(asked.limit_s), median=median, pieces=len(found))


@contextmanager
def names_grammar() -> Iterator[tuple[Path, Callable[[], list[Clip]]]]:
    """A grammar of a long list, and some sentences of it."""
    names = samples.names(NAMES)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "names.jsgf"
        rules = 'import "names.txt" as <name>;\npublic <call> = call <name>;\n'
        path.write_text(f"#JSGF V1.0;\ngrammar names;\n{rules}")
        path.with_suffix(".txt").write_text("\n".join(names) + "\n")
        sentences = [f"call {name}" for name in names[:: NAMES // CALLED]]
        yield path, partial(samples.spoken, sentences, ("slt", "rms"))
