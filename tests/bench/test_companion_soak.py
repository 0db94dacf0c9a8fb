from collections import Counter

import pytest

from hri.bench.companion_soak import CompanionSoak

GOOD = Counter(
    {
        "visitor say": 13,
        "speech.heard": 12,
        "speech.rejected": 1,
        "speech.said": 18,
        "speech.finished": 18,
    }
)


@pytest.fixture(scope="module")
def soak():
    return CompanionSoak(0.05, lambda line: None)


@pytest.mark.parametrize(
    ("differs", "fault"),
    [
        ({"speech.heard": 11}, "visit 1: 1 of 13 lines were lost"),
        ({"speech.finished": 17}, "visit 1: 18 sentences began, 17 ended"),
        ({"behavior.failed": 1}, "visit 1: behavior.failed"),
    ],
)
def test_what_a_visit_lost_is_a_fault(soak, differs, fault):
    soak.verdict.faults.clear()
    soak._judge(0, GOOD)
    assert soak.verdict.faults == []
    soak._judge(0, Counter(GOOD | differs))
    assert soak.verdict.faults == [fault]
