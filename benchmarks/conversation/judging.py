"""What readers make of a transcript: one verdict a turn, and how far two readers agree."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from benchmarks.conversation.transcript import LARGEST, Line
from hri.core.errors import HriError, did_you_mean
from hri.core.reading import parse_json, read_text
from hri.core.toml import load_toml

SOMETHING_ELSE = "as if something else was meant"
VERDICTS = ("sensible", SOMETHING_ELSE, "silent", "beside the point")

Verdicts = Mapping[str, str]
"""By the id of a turn."""


def read_verdicts(file: Path, lines: Sequence[Line]) -> Verdicts:
    """The verdicts of a reader on all turns of a transcript; those on others are left out.

    A TOML file is the filled-in form; one of JSON lines has an `id` and a `verdict` in each.
    Raises AuthoringError or HriError for a file that is wrong, or lacks a turn.
    """
    found = _from_toml(file) if file.suffix == ".toml" else _from_json(file)
    missing = [line.id for line in lines if line.id not in found]
    if missing:
        raise HriError(f"{file} lacks {len(missing)} turns, such as {missing[0]} - judge them, too")
    return {line.id: found[line.id] for line in lines}


def _from_toml(file: Path) -> Verdicts:
    root = load_toml(file, "file of verdicts")
    return {id: root.table(id).string("verdict", among=VERDICTS) for id in root.data}


def _from_json(file: Path) -> Verdicts:
    found = {}
    for number, text in enumerate(read_text(file, "file of verdicts", LARGEST).splitlines(), 1):
        if not text.strip():
            continue
        try:
            told = parse_json(text)
            id, verdict = str(told["id"]), str(told["verdict"])
        except (ValueError, TypeError, KeyError) as error:
            where = f"{file}:{number}:1"
            raise HriError(f'{where}: no verdict - write {{"id": ..., "verdict": ...}}') from error
        if verdict not in VERDICTS:
            remedy = did_you_mean(verdict, VERDICTS)
            raise HriError(f'{file}:{number}:1: the verdict is "{verdict}" - {remedy}')
        found[id] = verdict
    return found


def agreement(one: Verdicts, other: Verdicts) -> float:
    """The share of turns on which two readers agree, of 1."""
    return sum(verdict == other[id] for id, verdict in one.items()) / len(one)


def kappa(one: Verdicts, other: Verdicts) -> float:
    """Cohen's kappa: agreement beyond chance, 1 at most (Cohen 1960).

    1 when both give one and the same verdict throughout, where the formula has no value.
    """
    first, second = Counter(one.values()), Counter(other.values())
    chance = sum(first[verdict] * second[verdict] for verdict in first) / len(one) ** 2
    return 1.0 if chance == 1.0 else (agreement(one, other) - chance) / (1.0 - chance)


def report(lines: Sequence[Line], readers: Sequence[Verdicts]) -> Iterator[str]:
    """The shares of each reader's verdicts; of two readers also how they agree, and on what."""
    for verdict in VERDICTS:
        counts = [sum(told == verdict for told in reader.values()) for reader in readers]
        cells = (f"{count} ({100 * count / len(lines):.1f} %)" for count in counts)
        yield f"{verdict:34}" + "".join(f"{cell:>16}" for cell in cells)
    if len(readers) == 2:
        one, other = readers
        yield f"{'agreement':34}{100 * agreement(one, other):14.1f} %"
        yield f"{'Cohens kappa':34}{kappa(one, other):16.2f}"
    alike = [line for line in lines if all(it[line.id] == SOMETHING_ELSE for it in readers)]
    who = "both readers" if len(readers) == 2 else "the reader"
    yield f'\n{len(alike)} turns of which {who} said "{SOMETHING_ELSE}":'
    yield from (f'  {line.id}: "{line.say}" - {line.answered()}' for line in alike)
