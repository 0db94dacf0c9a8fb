from cProfile import Profile
from pstats import Stats

import pytest

from hri.bench.broken_links import LINKS, combinations, words
from hri.bench.drive import measure, simulated_world
from hri.core.errors import HriError


def test_the_speed_of_the_world_is_measured() -> None:
    (row,) = simulated_world.rows(quick=True)
    assert row["unit"] == "times real time"
    assert row["value"] > 1
    assert row["passed"] is (row["value"] >= simulated_world.LEAST)


def test_a_second_of_the_world_takes_no_more_calls_than_it_did() -> None:
    """Calls are counted, since they are the same on any machine."""
    simulated_world.spent(0.1)  # what is imported and read at first use does not count
    seconds, profile = 2.0, Profile()
    profile.runcall(simulated_world.spent, seconds)
    assert Stats(profile).total_calls / seconds < 75_000  # type: ignore[attr-defined]


def test_each_combination_of_dead_links_leaves_one_alive_and_is_measured_once() -> None:
    found = combinations()
    assert len({words(done) for done in found}) == 3**3 - 2**3 - 1
    assert all(0 < len(done) < len(LINKS) for done in found)


def test_one_part_can_be_measured_alone_and_a_misspelt_one_is_refused() -> None:
    assert len(measure(only="odometry")["rows"]) == 1
    with pytest.raises(HriError, match='did you mean "chain"'):
        measure(only="chian")
