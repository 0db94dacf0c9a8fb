import pytest

import hri.bench.network_soak as soak_module
from hri.bench.network_soak import Soak
from hri.cli.main import main
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus


@pytest.mark.slow
def test_two_simulated_minutes_pass(capsys):
    assert main(["soak", "--hours", "0.033", "--behaviors", "50"]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[-1] == "passed"


@pytest.mark.slow
def test_two_runs_are_equal():
    first, second = (Soak(0.02, 10, lambda line: None).run() for _ in range(2))
    assert (first.events, first.tasks, first.injected) == (
        second.events,
        second.tasks,
        second.injected,
    )


@pytest.mark.slow
def test_a_lost_event_and_a_leak_are_found():
    class Lossy(EventBus):
        """Loses one event, and never forgets any."""

        kept = []

        def raise_event(self, name, /, **properties):
            self.kept.append(bytearray(10_000))
            if properties.get("number") == 3 and properties["crier"] == "crier1":
                return None
            return super().raise_event(name, **properties)

    soak = Soak(0.02, 10, lambda line: None)
    soak.events.__class__ = Lossy
    faults = " ".join(soak.run().faults)
    assert "crier1: event 4 came out of turn" in faults
    assert "1 of" in faults
    assert "memory grew" in faults


@pytest.mark.slow
def test_bases_drive_and_numbers_cross_bridges_meanwhile():
    verdict = Soak(0.03, 10, lambda line: None).run()
    assert verdict.faults == []
    assert verdict.drives >= 2
    assert verdict.crossings >= 2


@pytest.mark.slow
def test_timers_that_are_kept_until_they_would_be_due_are_found():
    class Hoarder(FakeClock):
        """Forgets no timer of the far future, though it was cancelled."""

        kept = []

        def call_at(self, when, callback):
            timer = super().call_at(when, callback)
            if when - self.now() > 1000:
                self.kept.append((timer, bytearray(5000)))  # as what it would call back may hold
            return timer

    soak = Soak(0.04, 10, lambda line: None)
    soak.clock.__class__ = Hoarder
    assert [fault.split(" by ")[0] for fault in soak.run().faults] == ["memory grew"]


@pytest.mark.slow
def test_a_bridge_that_is_down_is_found(monkeypatch):
    monkeypatch.setattr(soak_module, "CROSSING_PATIENCE", 0.0)
    verdict = Soak(0.01, 10, lambda line: None).run()
    assert verdict.crossings == 0
    assert "a number did not cross the bridge" in verdict.faults
