"""Rows of the table of figures: what was measured, its confidence interval, and its limit."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any, Literal

from hri.bench.checkout import has_research, missing, research
from hri.bench.figures import machine
from hri.core.errors import HriError, NotAvailable, did_you_mean
from hri.core.statistics import wilson

Row = dict[str, Any]
Parts = Mapping[str, Callable[[bool], Iterator[Row]]]
"""The parts of a bench by name, in the order of the table; each is told whether to be quick."""


@dataclass(frozen=True, slots=True)
class Limit:
    """What a figure must reach."""

    value: float
    side: Literal["at least", "at most"]

    def holds(self, figure: float) -> bool:
        return figure >= self.value if self.side == "at least" else figure <= self.value

    def told(self, figure: float) -> dict[str, Any]:
        return {"limit": self.value, "side": self.side, "passed": self.holds(figure)}


def at_least(value: float) -> Limit:
    """A figure that is better the larger it is."""
    return Limit(value, "at least")


def at_most(value: float) -> Limit:
    """A figure that is better the smaller it is."""
    return Limit(value, "at most")


def share(what: str, count: int, total: int, limit: Limit | None) -> Row:
    """A row that counts: `count` of `total`, and the interval of the true share."""
    rate = count / total
    interval = [round(bound, 4) for bound in wilson(count, total)]
    told = {"count": count, "of": total, "rate": round(rate, 4), "interval_95": interval}
    return {"what": what} | told | (limit.told(rate) if limit else {})


def amount(what: str, value: float, unit: str, limit: Limit | None, **more: Any) -> Row:
    """A row that measures one figure."""
    verdict = limit.told(value) if limit else {}
    return {"what": what, "value": round(value, 5), "unit": unit} | verdict | more


def compared(what: str, own: float, other: float, unit: str) -> Row:
    """A row whose own figure must lie below the other's, of the same run."""
    return amount(
        what, own, unit, at_most(other), other=round(other, 5), times=round(other / own, 1)
    )


def skipped(what: str, why: str) -> Row:
    """A row that could not be measured here."""
    return {"what": what, "skipped": why}


def attempted(what: str, measure: Callable[[], Iterator[Row]]) -> Iterator[Row]:
    """The rows of one measurement; where it cannot be done or fails, a row that says why."""
    try:
        yield from measure()
    except NotAvailable as why:
        yield skipped(what, str(why))
    except (KeyboardInterrupt, GeneratorExit):
        raise
    except BaseException as why:  # also the groups and exits of a robot that runs beside it
        yield {"what": what, **failure(why), "passed": False}


def attempt(measure: Callable[[], Any]) -> Any:
    """A part of a bench without rows: its figures, or its `error` where it fails."""
    try:
        return measure()
    except (KeyboardInterrupt, GeneratorExit):
        raise
    except BaseException as why:
        return failure(why)


def failure(why: BaseException) -> dict[str, str]:
    """What is reported of a part that failed: it must not lose the figures of the others."""
    if not isinstance(why, HriError):
        traceback.print_exception(why)
    told = str(why) if isinstance(why, HriError) else f"{type(why).__name__}: {why}"
    return {"error": told, "failed": told}


def report(bench: str, rows: Sequence[Row], quick: bool) -> dict[str, Any]:
    """What a bench of rows prints: the rows, on what machine, and which missed or were skipped."""
    if not has_research():
        print("left out: what `make bench` measures in a checkout of hri", file=sys.stderr)
    missed = [row["what"] for row in rows if not row.get("passed", True)]
    if missed:
        sample = " (small sample: repeat without --quick)" if quick else ""
        print(f"limits missed{sample}: {'; '.join(missed)}", file=sys.stderr)
    return {
        "bench": bench,
        "machine": machine(),
        "load": [round(value, 2) for value in os.getloadavg()],
        "quick": quick,
        "rows": rows,
        "missed": missed,
        "skipped": [row["what"] for row in rows if "skipped" in row],
    }


def measured(bench: str, parts: Parts, quick: bool, only: str | None) -> dict[str, Any]:
    """The report of all parts of a bench, with those of `benchmarks` in a checkout, or of one.

    Raises HriError for an unknown part.
    """
    more = research(bench)
    parts = {**parts, **(more.PARTS if more else {})}
    if only is not None and only not in parts:
        if more is None:
            raise missing(f"{bench} --only '{only}'")
        raise HriError(f'bench {bench} has no part "{only}" - {did_you_mean(only, parts)}')
    chosen = parts if only is None else {only: parts[only]}
    rows = [row for name, part in chosen.items() for row in attempted(name, partial(part, quick))]
    return report(bench, rows, quick)
