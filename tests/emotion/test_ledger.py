import pytest

from hri.emotion.ledger import (
    FAINT,
    MOST,
    MOST_OPEN,
    OLD_S,
    OTHER,
    REST,
    STILL,
    LedgerRow,
    Origin,
    pruned,
    total_mood,
)


def row(charge: float, time: float = 0.0) -> LedgerRow:
    return LedgerRow({"joy": charge}, (charge, 0.0, -charge), time)


def test_what_counts_least_goes_to_the_rest() -> None:
    ledger = {Origin(f"cause {n}"): row(1.0 + n) for n in range(MOST + 3)}
    left = pruned(ledger, 0.0)
    assert set(ledger) - set(left) == {Origin(f"cause {n}") for n in range(3)}
    assert left[REST].charges["joy"] == pytest.approx(1.0 + 2.0 + 3.0)
    assert total_mood(left.values()) == pytest.approx(total_mood(ledger.values()))


def test_the_rest_takes_no_place_of_a_cause() -> None:
    ledger = {Origin(f"cause {n}"): row(1.0) for n in range(MOST)}
    assert pruned({**ledger, REST: row(0.1)}, 0.0).keys() == {*ledger, REST}


def test_what_explains_nothing_any_more_goes_to_the_rest() -> None:
    faint = row(FAINT / 4)
    ledger = {Origin("old"): faint, Origin("strong"): row(1.0)}
    assert pruned(ledger, OLD_S) is ledger
    left = pruned(ledger, OLD_S + 1.0)
    assert left == {Origin("strong"): row(1.0), Origin(OTHER): faint}


def test_goals_that_are_hoped_for_or_feared_are_kept_apart_whatever_else_counts() -> None:
    strong = {Origin(f"cause {n}"): row(5.0) for n in range(MOST)}
    hopes = {Origin(f"goal.{n}"): LedgerRow({"hope": 0.1}, STILL, 0.0) for n in range(3)}
    ledger = {**strong, **hopes}
    assert pruned(ledger, 0.0) == ledger
    left = pruned({**ledger, Origin("weak"): row(1.0)}, 0.0)
    assert left == {**ledger, REST: row(1.0)}
    many = {
        Origin(f"goal.{n}"): LedgerRow({"fear": 0.1 + n}, STILL, 0.0) for n in range(2 * MOST_OPEN)
    }
    left = pruned(many, 0.0)
    assert len(left) == MOST_OPEN + 1
    assert left[REST].charges["fear"] == pytest.approx(sum(0.1 + n for n in range(MOST_OPEN)))


def test_the_rest_stays_the_rest() -> None:
    ledger = {REST: LedgerRow({}, STILL, 0.0)}
    assert pruned(ledger, 1e9) == ledger
