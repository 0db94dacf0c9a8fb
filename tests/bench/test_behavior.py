import numpy as np
import pytest

from hri.bench.behavior import chain, cost
from hri.bench.ticks import INTERVAL, Stopwatch, figures
from hri.bench.workers import busy_processes
from hri.core import paths


def test_the_chain_really_passes_a_number_on():
    runner = chain(100)
    runner.start()
    runner.tick(5.0)
    assert runner.network["99"].output.value == 5.0
    assert runner.statistics.behaviors["99"].count == 1


@pytest.mark.slow
def test_the_cost_is_told_for_a_behavior_and_compared_where_a_peer_is():
    figures = cost(count=20, repeats=50)
    assert figures["hri_us"]["median"] > 0
    if figures["py_trees"] != "not installed":
        assert figures["times_faster_than_py_trees_sequence"] > 1


def test_without_a_checkout_the_peer_is_not_called_missing(tmp_path, monkeypatch):
    monkeypatch.setattr(paths, "house", lambda: tmp_path)
    figures = cost(count=2, repeats=10)
    assert figures["py_trees"] == "compared only in a checkout of hri"


def test_lateness_and_period_are_told_against_the_deadlines():
    stopwatch = Stopwatch("s")
    stopwatch.lateness = [0.001] * 99 + [0.004]
    slots = [*range(50), *range(51, 101)]
    late = np.array(stopwatch.lateness)
    stopwatch.times = list(np.array(slots) * INTERVAL + late)
    told = figures(stopwatch)
    assert told["ticks"] == 100
    assert told["skipped"] == 1
    assert told["lateness_ms"]["p50"] == pytest.approx(1.0)
    assert told["lateness_max_ms"] == pytest.approx(4.0)
    assert told["period_error_percent"] == pytest.approx(0.3)


def test_busy_processes_end():
    with busy_processes(2) as processes:
        assert [process.poll() for process in processes] == [None, None]
    assert all(process.poll() is not None for process in processes)
