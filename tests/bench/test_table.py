from hri.bench.table import amount, at_most, report


def test_missed_limits_are_listed_in_the_report_and_on_standard_error(capsys):
    rows = [amount("slow", 2.0, "s", at_most(1)), amount("fast", 0.5, "s", at_most(1))]
    assert report("some", rows, quick=True)["missed"] == ["slow"]
    assert "missed (small sample: repeat without --quick): slow\n" in capsys.readouterr().err
    report("some", rows, quick=False)
    assert "limits missed: slow\n" in capsys.readouterr().err
