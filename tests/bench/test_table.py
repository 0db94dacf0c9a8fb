import pytest

from hri.bench import table
from hri.bench.table import amount, at_most, attempt, attempted, measured, report
from hri.core.errors import HriError


def test_missed_limits_are_listed_in_the_report_and_on_standard_error(capsys):
    rows = [amount("slow", 2.0, "s", at_most(1)), amount("fast", 0.5, "s", at_most(1))]
    assert report("some", rows, quick=True)["missed"] == ["slow"]
    assert "missed (small sample: repeat without --quick): slow\n" in capsys.readouterr().err
    report("some", rows, quick=False)
    assert "limits missed: slow\n" in capsys.readouterr().err


def test_a_part_that_fails_is_a_row_beside_its_others(capsys):
    def part():
        yield amount("fast", 0.5, "s", at_most(1))
        raise IndexError("no page")

    fast, failed = attempted("some", part)
    assert fast["passed"]
    error = "IndexError: no page"
    assert failed == {"what": "some", "error": error, "failed": error, "passed": False}
    assert "IndexError" in capsys.readouterr().err


FAILURES = [
    ValueError("no process 0"),
    HriError("no figures - repeat it"),
    SystemExit(3),
    BaseExceptionGroup("", [SystemExit()]),
]


@pytest.mark.parametrize("why", FAILURES, ids=repr)
def test_whatever_ends_a_part_the_figures_of_the_others_are_told(why, capsys, monkeypatch):
    def fails(quick):
        yield amount("begun", 1.0, "s", None)
        raise why

    def works(quick):
        yield amount("fast", 0.5, "s", at_most(1))

    monkeypatch.setattr(table, "research", lambda name: None)
    told = measured("some", {"first": works, "broken": fails, "last": works}, False, None)
    assert [row["what"] for row in told["rows"]] == ["fast", "begun", "broken", "fast"]
    assert str(why) in told["rows"][2]["error"]
    assert told["missed"] == ["broken"]


def test_a_part_without_rows_that_fails_is_an_error_in_its_place(capsys):
    assert attempt(lambda: {"rate": 3}) == {"rate": 3}
    assert attempt(lambda: 1 // 0)["error"].startswith("ZeroDivisionError: ")
    assert "Traceback" in capsys.readouterr().err


def test_ctrl_c_ends_a_bench():
    def pressed():
        yield amount("begun", 1.0, "s", None)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        list(attempted("some", pressed))
    with pytest.raises(KeyboardInterrupt):
        attempt(lambda: list(attempted("some", pressed)))
