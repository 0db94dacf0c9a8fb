"""Assigns rows to columns at the least cost."""

from __future__ import annotations

import math
from collections.abc import Sequence


def assigned(costs: Sequence[Sequence[float]]) -> list[int | None]:
    """For each row the column it gets, each column once; None for a row that gets none.

    Pairs of infinite cost are never made, and no more pairs could be. The cheapest pairs are taken
    first and then changed two by two as long as that lowers the sum: for two rows or columns that
    is the least there is, for a handful of people all but always.
    """
    chosen: list[int | None] = [None] * len(costs)
    pairs = sorted(
        (cost, row, column)
        for row, line in enumerate(costs)
        for column, cost in enumerate(line)
        if cost < math.inf
    )
    for _, row, column in pairs:
        if chosen[row] is None and column not in chosen:
            chosen[row] = column
    while _improve(costs, chosen):
        pass
    return chosen


def _improve(costs: Sequence[Sequence[float]], chosen: list[int | None]) -> bool:
    """Let two rows change their columns, or one take a free one, where that costs less."""
    for one in range(len(chosen)):
        for column in range(len(costs[one])):
            other = chosen.index(column) if column in chosen else None
            if other == one:
                continue
            before = [(_cost(costs, one, chosen[one])), _cost(costs, other, column)]
            after = [_cost(costs, one, column), _cost(costs, other, chosen[one])]
            # Fewer pairs without a partner go first, then the sum.
            if _rank(after) < _rank(before):
                if other is not None:
                    chosen[other] = chosen[one]
                chosen[one] = column
                return True
    return False


def _cost(costs: Sequence[Sequence[float]], row: int | None, column: int | None) -> float | None:
    """None for a row that is there and has no partner, 0 for no row."""
    if row is None:
        return 0.0
    return None if column is None else costs[row][column]


def _rank(values: list[float | None]) -> tuple[float, int, float]:
    known = [value for value in values if value is not None]
    forbidden = sum(value == math.inf for value in known)
    total = sum(value for value in known if value < math.inf)
    return forbidden, len(values) - len(known), round(total, 9)
