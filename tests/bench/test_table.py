from hri.bench.table import amount, at_most, attempted, report


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
    assert failed == {"what": "some", "failed": "IndexError: no page", "passed": False}
    assert "IndexError" in capsys.readouterr().err
