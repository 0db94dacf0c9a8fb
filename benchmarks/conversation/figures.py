"""Figures of a transcript: how much was understood, answered, and said again."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import groupby

from benchmarks.conversation.transcript import Line

AGAIN_WITHIN = 300.0
"""Seconds within which the same reply is heard as a repetition."""
COLUMNS: dict[str, Callable[[Line], bool]] = {
    "understood": lambda line: bool(line.rule),
    "answered": lambda line: line.is_answered,
    "silent, spoken to": lambda line: line.is_for_it and not line.is_answered,
    "answered, not spoken to": lambda line: not line.is_for_it and line.is_answered,
}
FIRST, OTHERS = 38, 24
"""Letters of the columns."""


def table(lines: Sequence[Line], intents: bool = False) -> Iterator[str]:
    """The table of a transcript: all turns, by writer and by kind; or by intent of a toy robot."""
    yield f"{'':{FIRST}}{'turns':>6}" + "".join(f"{name:>{OTHERS}}" for name in COLUMNS)
    yield _row("all", lines)
    parts: tuple[Callable[[Line], str], ...] = (lambda line: line.writer, lambda line: line.kind)
    for part in parts[intents:]:
        for name, those in groupby(sorted(lines, key=part), part):
            yield _row(name, list(those))


def _row(name: str, lines: Sequence[Line]) -> str:
    counts = [sum(map(is_so, lines)) for is_so in COLUMNS.values()]
    cells = "".join(f"{_share(count, len(lines)):>{OTHERS}}" for count in counts)
    return f"{name:{FIRST}}{len(lines):6}{cells}"


def _share(count: int, total: int) -> str:
    return f"{count} ({100 * count / total:.0f} %)" if total else "-"


def intents_understood(lines: Sequence[Line]) -> tuple[int, int, int]:
    """Of how many intents all sentences are understood, of how many at least one, and of all."""
    by_intent = [
        [bool(line.rule) for line in those] for _, those in groupby(sorted(lines, key=_kind), _kind)
    ]
    return sum(map(all, by_intent)), sum(map(any, by_intent)), len(by_intent)


def _kind(line: Line) -> str:
    return line.kind


def repeated(lines: Sequence[Line]) -> tuple[list[str], int]:
    """The texts that it said again within five minutes of one life, and how many it said."""
    again: list[str] = []
    total = 0
    for _, talk in groupby(lines, lambda line: line.talk):
        last: dict[str, float] = {}
        for time, text in _said(talk):
            total += 1
            if time - last.get(text, -AGAIN_WITHIN) < AGAIN_WITHIN:
                again.append(text)
            last[text] = time
    return again, total


def _said(lines: Iterator[Line]) -> Iterator[tuple[float, str]]:
    for line in lines:
        yield from ((line.time + words.at, words.text) for words in line.said)


def told_again(lines: Sequence[Line]) -> str:
    """A line about replies that were said again."""
    again, total = repeated(lines)
    return f"replies said again within five minutes: {_share(len(again), total)} of {total}"
