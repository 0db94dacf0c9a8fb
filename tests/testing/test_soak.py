from hri.cli.main import main
from hri.core.events import EventBus
from hri.testing.soak import Soak


def test_two_simulated_minutes_pass(capsys):
    assert main(["soak", "--hours", "0.033", "--behaviors", "50"]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[-1] == "passed"


def test_two_runs_are_equal():
    first, second = (Soak(0.02, 10, lambda line: None).run() for _ in range(2))
    assert (first.events, first.tasks, first.injected) == (
        second.events,
        second.tasks,
        second.injected,
    )


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
