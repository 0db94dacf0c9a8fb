"""The whole chain below the program, on an emulated Create 2 in memory and in fake time."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from benchmarks.faults import FAULTS, GO, Chain, survived
from hri.core.signals import Twist
from hri.drive.bases.create2 import CLIFFS
from hri.drive.bases.protocol import Note
from hri.drive.supervisor.cause import POWER_UP, Cause
from hri.drive.supervisor.link import Ask, Dock, Heartbeat, Nearest, Release, Song, Trip
from hri.hal.motion import REST
from hri.hal.rank import Rank
from hri.simulation.bases.emulated_create2 import PASSIVE
from hri.simulation.bases.emulated_line import Faults


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_of_the_bench_is_survived_at_rest_with_its_cause_named(name) -> None:
    assert survived(FAULTS[name])


def test_a_base_is_greeted_and_stands_until_it_is_released() -> None:
    chain = Chain()
    chain.run(1.0, GO)
    assert chain.controller.state(chain.now).report is not None
    assert chain.speed == 0.0
    chain.release()
    chain.run(1.2, GO)
    assert chain.speed == pytest.approx(0.3, abs=0.001)


def test_a_release_that_lay_in_a_queue_is_not_heard() -> None:
    chain = Chain()
    chain.run(2.0)
    chain.turn(Release(chain.now - 1.5, POWER_UP))
    assert chain.controller.state(chain.now).is_latched


def test_an_order_that_lay_in_a_queue_is_not_heard() -> None:
    chain = Chain()
    chain.run(1.0)
    chain.release()
    for _ in range(50):
        chain.turn(Ask(Rank.TASKS, GO, 0.5))
    assert chain.speed == 0.0


def test_an_order_from_the_future_is_not_heard_then_either() -> None:
    chain = Chain()
    chain.run(1.0)
    chain.release()
    chain.turn(Ask(Rank.TASKS, GO, chain.now + 0.5))
    for _ in range(100):
        chain.turn()
        assert not chain.base.is_rolling


def test_a_release_opens_no_latch_that_closed_meanwhile() -> None:
    chain = Chain().start()
    seen = chain.controller.state(chain.now)
    chain.turn(Trip(Cause("e-stop", "you said stop")), Release(seen.time, seen.reason))
    assert chain.controller.state(chain.now).is_latched


def test_half_a_command_moves_nothing_that_is_latched() -> None:
    chain = Chain().start()
    chain.turn(Trip(Cause("e-stop", "you said stop")))
    chain.run(0.1)
    chain.port.line.faults.halved = 0.5
    for _ in range(500):
        chain.turn()
        assert not chain.base.is_rolling


def test_a_base_on_its_way_to_the_dock_stops_when_it_is_told_to() -> None:
    chain = Chain().start()
    chain.turn(Dock(chain.now))
    chain.run(0.5, GO)
    assert chain.base.is_rolling
    assert chain.controller.state(chain.now).reason.name == "docking"
    chain.turn(Trip(Cause("e-stop", "you said stop")))
    chain.turn()
    assert not chain.base.is_rolling
    chain.release()
    chain.run(1.2, GO)
    assert chain.speed == pytest.approx(0.3, abs=0.001)


@pytest.mark.parametrize("button", ["clean", "dock"])
def test_a_base_that_a_button_sends_off_by_itself_is_stopped(button) -> None:
    chain = Chain().start()
    chain.base.body.hanging.add("left")
    chain.run(0.1)
    chain.base.body.hanging.clear()
    assert chain.base.mode == PASSIVE
    chain.base.body.held.add(button)
    while not chain.base.is_rolling:
        chain.turn()
    chain.run(0.03)
    assert not chain.base.is_rolling
    assert f"my {button} button" in chain.controller.state(chain.now).reason.words


def test_a_latched_base_does_not_go_to_its_dock() -> None:
    chain = Chain()
    chain.run(1.0)
    chain.turn(Dock(chain.now))
    chain.run(0.5)
    assert not chain.base.is_rolling
    assert chain.causes == ["refused"]


def test_a_song_that_cannot_be_sung_is_refused_and_the_base_drives_on() -> None:
    chain = Chain().start()
    for duration in (math.nan, math.inf, -1.0, 1e9):
        chain.turn(Song((Note(60, duration),)))
    chain.run(0.1, GO)
    assert chain.causes == ["refused"] * 4
    assert chain.speed == pytest.approx(0.3, abs=0.001)


def test_a_program_that_only_looks_does_not_keep_the_base_going() -> None:
    chain = Chain().start()
    for _ in range(22):
        chain.turn(Heartbeat(chain.now))
    assert not chain.base.is_rolling
    assert chain.causes == ["timeout"]


def test_a_hazard_is_answered_in_the_turn_in_which_it_is_heard() -> None:
    chain = Chain().start()
    chain.base.body.pressed.add("left")
    while not any((chain.controller.state(chain.now).report.bumps or {}).values()):
        assert chain.base.is_rolling
        chain.turn(Ask(Rank.TASKS, GO, chain.now))
    assert not chain.base.is_rolling


def test_at_an_edge_the_base_is_woken_from_its_own_guard_and_backs_off() -> None:
    chain = Chain().start()
    chain.base.body.over_edge.update(CLIFFS)
    chain.run(0.08, GO)
    assert not chain.base.is_rolling
    where = chain.base.body.base.pose.x
    chain.run(1.5, GO)
    assert chain.base.body.base.pose.x < where - 0.05
    chain.run(3.0, GO)
    assert chain.speed <= 0.0  # it still sees the edge


def test_a_lost_port_latches_and_the_base_that_is_back_stands_until_it_is_released() -> None:
    chain = Chain().start()
    chain.port.is_plugged = False
    chain.turn(Ask(Rank.TASKS, GO, chain.now))
    assert chain.causes == ["lost port"]
    chain.run(1.0, GO)
    chain.port.is_plugged = True
    rolled = chain.controller.state(chain.now).report.rolled.linear
    chain.run(2.0, GO)
    state = chain.controller.state(chain.now)
    assert state.is_open
    assert state.is_latched
    assert chain.speed == 0.0
    # It goes on counting, without what the base rolled while nobody could hear it.
    assert state.report.rolled.linear == pytest.approx(rolled, abs=0.05)
    chain.release()
    chain.run(1.2, GO)
    assert chain.speed == pytest.approx(0.3, abs=0.001)


def test_a_line_that_takes_no_more_latches_and_hears_the_stop_first_when_it_does_again() -> None:
    chain = Chain().start()
    chain.port.is_full = True
    chain.run(0.5, GO)
    assert chain.causes == ["jammed"]
    chain.port.is_full = False
    chain.run(0.05, GO)
    assert not chain.base.is_rolling
    chain.run(1.0, GO)
    assert chain.speed == 0.0


def test_a_base_that_sleeps_is_woken_and_stands_until_it_is_released() -> None:
    chain = Chain()
    chain.base.is_asleep = True
    chain.run(1.5, GO)
    assert chain.controller.state(chain.now).report is None
    chain.run(3.0, GO)
    assert chain.controller.state(chain.now).report.obeys
    assert not chain.base.is_rolling
    chain.release()
    chain.run(1.2, GO)
    assert chain.speed == pytest.approx(0.3, abs=0.001)


def test_no_pulse_that_wakes_a_base_is_one_that_changes_its_baud_rate() -> None:
    changes = []
    chain = Chain()
    chain.port.set_rts = lambda is_on: changes.append((chain.now, is_on))
    chain.port.line.feed = lambda data, now: b""
    chain.run(20.0)
    times = [time for time, _ in changes]
    assert len(times) >= 8
    assert [is_on for _, is_on in changes] == [False, True] * (len(changes) // 2)
    assert all(after - before > 0.6 for before, after in pairwise(times))


def test_a_base_that_is_switched_off_and_on_is_greeted_anew() -> None:
    chain = Chain().start()
    chain.base.feed(b"\x07", chain.now)
    chain.run(0.3, GO)
    assert not chain.base.is_rolling
    chain.run(5.0)
    assert chain.controller.state(chain.now).is_latched
    assert chain.controller.state(chain.now).report.obeys
    chain.release()
    chain.run(1.2, GO)
    assert chain.speed == pytest.approx(0.3, abs=0.001)


@pytest.mark.parametrize(
    "faults",
    [Faults(lost=0.002), Faults(damaged=0.002), Faults(halved=0.02), Faults(delay=0.02)],
    ids=["lost", "damaged", "half a packet", "late"],
)
def test_on_a_bad_line_it_drives_and_still_stops(faults) -> None:
    chain = Chain(faults)
    chain.run(0.5)
    for _ in range(8):
        chain.release()
        chain.run(1.0, GO)
    assert chain.base.body.base.travelled > 0.3
    chain.turn(Trip(Cause("e-stop", "you said stop")))
    chain.run(0.8, GO)
    assert chain.speed == 0.0


@pytest.mark.parametrize(
    ("faults", "cause"),
    [
        (Faults(damaged=0.01), "garbled"),
        (Faults(lost=0.01), "garbled"),
        (Faults(report_delay=0.3), "late"),
        (Faults(report_delay=0.8), "late"),
        (Faults(delay=0.15), "late"),
    ],
)
def test_on_a_worse_line_it_latches_says_why_and_does_not_drive_in_between(faults, cause) -> None:
    chain = Chain(faults)
    chain.run(1.5)
    chain.release()
    chain.run(2.0, GO)
    assert cause in chain.causes
    assert chain.base.body.base.travelled < 0.35
    for _ in range(500):
        chain.turn(*chain.asked(GO))
        assert chain.controller.state(chain.now).velocity == REST
    assert chain.controller.state(chain.now).reason.name == cause


def test_with_nobody_near_it_may_go_faster() -> None:
    chain = Chain().start()
    for _ in range(150):
        chain.turn(Nearest(5.0, chain.now), Ask(Rank.TASKS, Twist(0.5), chain.now))
    assert chain.speed == pytest.approx(0.5, abs=0.001)


def test_closing_stops_the_base() -> None:
    chain = Chain().start()
    chain.controller.close(chain.now)
    chain.controller.close(chain.now)
    assert not chain.base.is_rolling
    assert not chain.port.is_open
