"""Real processes over a pseudo-terminal: whatever is killed or stands still, the base rests.

The bounds are wide, since a machine that runs tests has other things to do; `hri bench drive`
measures.
"""

from __future__ import annotations

import itertools
import os
import signal
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace

import psutil
import pytest

from hri.bench.drive.leaving import ENDS, is_left_alone
from hri.bench.stops import SLOW, Bench, drive_to, ended, settings
from hri.core.clock import FakeClock
from hri.core.errors import NotAvailable
from hri.core.signals import Twist
from hri.drive.supervisor import remote
from hri.drive.supervisor.base_bus import BaseBus
from hri.drive.supervisor.base_devices import BaseOdometry
from hri.drive.supervisor.base_drive import BaseDrive
from hri.drive.supervisor.cause import Cause
from hri.drive.supervisor.link import Ask, Release, State, Trip
from hri.drive.supervisor.process import Settings
from hri.drive.supervisor.remote import Remote
from hri.drive.supervisor.supervisor_connection import BEAT
from hri.drive.supervisor.watchdog import ABANDONED
from hri.hal.drivers.serial_port import Backoff
from hri.hal.rank import Rank
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.bases.emulated_create2 import PASSIVE
from hri.simulation.bases.pseudo_terminal import PseudoTerminal

SOON = 3.0
"""Seconds; on a quiet machine the figures are below a tenth of it."""


class Driving:
    """A program (this one), its supervisor, and a base that goes."""

    def __init__(self, bench: Bench, port: PseudoTerminal) -> None:
        self.bench, self.port = bench, port
        self.connection = Remote(bench.clock, settings(port.path))
        drive_to(bench, self.connection)

    @property
    def supervisor(self) -> psutil.Process:
        return psutil.Process(self.connection.pid)

    def watchdog(self) -> psutil.Process:
        """Raises IndexError when there is none."""
        return self.supervisor.children()[0]

    def state(self) -> State:
        self.connection.look()
        return self.connection.state

    def ask(self) -> State:
        """Go on asking, as a program does that does not know what happened."""
        state = self.state()
        self.connection.say(Ask(Rank.TASKS, Twist(SLOW), state.time))
        return state

    def stays(self, seconds: float = 0.3) -> bool:
        """Whether the base stands, however much it is asked to go."""
        end = self.bench.clock.now() + seconds
        while self.bench.clock.now() < end:
            self.ask()
            self.bench.clock.advance(BEAT)
        return not self.bench.line.base.is_rolling


World = tuple[Bench, PseudoTerminal]


@pytest.fixture(scope="module")
def world() -> Iterator[World]:
    bench = Bench()
    with bench.port() as port:
        yield bench, port


@pytest.fixture(scope="module")
def started(world: World) -> Iterator[list[Driving]]:
    """The program that drives now, if any: to start a supervisor takes half a second."""
    started: list[Driving] = []
    yield started
    for driving in started:
        driving.connection.close()


@pytest.fixture
def driving(world: World, started: list[Driving]) -> Iterator[Driving]:
    if not started:
        started.append(Driving(*world))
    driving = started[0]
    drive_to(world[0], driving.connection)
    yield driving
    with suppress(ProcessLookupError):
        os.kill(driving.connection.pid, signal.SIGCONT)


@pytest.fixture
def alone(started: list[Driving]) -> None:
    """Nobody else has the port."""
    while started:
        started.pop().connection.close()


def test_a_loop_that_is_blocked_no_longer_moves_the_base(driving) -> None:
    bench = driving.bench
    assert bench.stop_after(bench.clock.now()) < SOON
    bench.wait(
        "the cause", lambda: [n for n in driving.state().news if n.cause.name == "timeout"] != []
    )


def test_for_a_supervisor_that_is_frozen_the_watchdog_stops_the_base(driving) -> None:
    bench = driving.bench
    time = bench.clock.now()
    os.kill(driving.connection.pid, signal.SIGSTOP)
    for _ in range(3000):
        driving.ask()  # a full line does not hold the program up
    assert bench.clock.now() - time < SOON
    assert bench.stop_after(time) < SOON
    bench.clock.advance(0.1)
    assert not bench.line.base.is_rolling
    os.kill(driving.connection.pid, signal.SIGCONT)
    bench.wait("an answer", lambda: driving.state().news[-1].cause.name == "frozen")


def test_a_watchdog_that_is_killed_stops_the_base_and_another_takes_its_place(driving) -> None:
    watchdog = driving.watchdog()
    time = driving.bench.clock.now()
    watchdog.kill()
    driving.bench.wait("a latch", lambda: driving.ask().is_latched)
    assert driving.bench.stop_after(time) < 2 * SOON
    assert driving.state().reason.name == "watchdog"
    driving.bench.wait("another", lambda: watchdog not in driving.supervisor.children())
    assert driving.watchdog() != watchdog
    drive_to(driving.bench, driving.connection)


def test_a_port_that_vanishes_latches_and_is_found_again(driving) -> None:
    driving.port.unplug()
    driving.bench.wait("a latch", lambda: driving.ask().is_latched)
    assert driving.state().reason.name == "lost port"
    driving.port.plug()
    driving.bench.wait("the port", lambda: driving.ask().is_open)
    assert driving.stays()
    drive_to(driving.bench, driving.connection)


def test_a_port_that_takes_no_bytes_is_cleared_for_the_stop(driving) -> None:
    bench, line = driving.bench, driving.bench.line
    with driving.port._lock:  # nobody reads at the other end
        for _ in range(5):  # the system makes room for some more after a moment
            _fill(driving.port.path)
            bench.clock.advance(0.01)
        bench.wait("a latch", lambda: driving.ask().is_latched)
    assert bench.stop_after(bench.clock.now() - SOON) is not None
    bench.wait("rest", lambda: not line.base.is_rolling)
    assert driving.stays()
    assert driving.state().reason.name == "jammed"


def test_a_base_that_comes_back_as_another_port_is_found_by_its_id() -> None:
    bench = Bench()
    with bench.port() as port:
        connection = Remote(bench.clock, replace(settings(port.path), by_id=port.by_id))
        try:
            port.unplug()
            port.plug("another")
            bench.wait("a latch", lambda: _looked(connection).reason.name == "lost port")
            bench.wait("the port", lambda: _looked(connection).is_open)
            drive_to(bench, connection)
            os.kill(connection.pid, signal.SIGKILL)
            bench.wait("the end", lambda: _looked(connection).reason.name == "supervisor")
            bench.wait("another", lambda: _looked(connection).is_open)
        finally:
            connection.close()


def _looked(connection: Remote) -> State:
    connection.look()
    return connection.state


def test_a_second_program_is_refused_while_the_first_drives_on(driving) -> None:
    with pytest.raises(NotAvailable, match="something else uses it"):
        Remote(driving.bench.clock, settings(driving.port.path))
    drive_to(driving.bench, driving.connection)
    assert not driving.state().is_latched


def test_a_button_of_the_base_latches_it_until_it_is_let_go_and_released(driving) -> None:
    line = driving.bench.line
    line.base.body.held.add("clean")
    driving.bench.wait("rest", lambda: not line.base.is_rolling)
    assert driving.stays()
    state = driving.state()
    assert state.reason.words == "I stopped because someone pressed my clean button"
    driving.connection.say(Release(state.time, state.reason))
    driving.bench.wait("a refusal", lambda: driving.ask().news[-1].cause.name == "refused")
    assert driving.state().is_latched
    line.base.body.held.clear()
    assert driving.stays()
    drive_to(driving.bench, driving.connection)


def test_an_emergency_stop_stays_whatever_is_asked(driving) -> None:
    driving.connection.say(Trip(Cause("e-stop", "you said stop")))
    driving.bench.wait("rest", lambda: not driving.bench.line.base.is_rolling)
    assert driving.stays()
    assert driving.state().reason.words == "I stopped because you said stop"


def test_a_configuration_with_a_port_drives_through_the_whole_chain_even_when_it_broke(
    world, alone
) -> None:
    bench, port = world
    devices = (
        Description("base", "Hri.Create2", {"port": port.path}),
        Description("drive", "Hri.BaseDrive", bus="base"),
        Description("odometry", "Hri.BaseOdometry", bus="base"),
    )
    with ResourceManager(devices, bench.clock) as manager:
        bus, odometry = manager.obtain("base", BaseBus), manager.obtain("odometry", BaseOdometry)
        bus.unlatch()
        bench.wait("a release", lambda: not bus.state.is_latched)
        drive = manager.obtain("drive", BaseDrive)

        def goes() -> bool:
            drive.set_velocity(Twist(SLOW), bench.clock.now())
            return odometry.pose(0.0).x > goal

        goal = 0.03
        bench.wait("driving", goes)
        assert bench.line.base.body.base.travelled > 0.02

        bus.stop_spoken("someone said stop", bench.clock.now())
        bench.wait("a spoken stop", lambda: bus.is_spoken)
        assert bus.unlatch_spoken(bench.clock.now())
        bench.wait("an end of it", lambda: not bus.is_latched)
        bus.stop_spoken("someone said stop", bench.clock.now())
        bench.wait("another one", lambda: bus.is_spoken)

        (supervisor,) = (p for p in psutil.Process().children() if port.path in str(p.cmdline()))
        supervisor.terminate()
        bench.wait("the end", lambda: bus.state.reason.name == "supervisor")
        assert not bus.unlatch_spoken(bench.clock.now())

        def is_released() -> bool:
            bus.unlatch()
            return not bus.state.is_latched

        bench.wait("a release by another", is_released)
        at = odometry.pose(0.0).x
        assert at >= 0.03
        goal = at + 0.02
        bench.wait("driving on", goes)
    assert not bench.line.base.is_rolling


def test_where_no_supervisor_can_start_it_is_said_and_tried_again(monkeypatch) -> None:
    clock = FakeClock()
    monkeypatch.setattr(remote.Remote, "_start", lambda self: None)
    monkeypatch.setattr(remote, "COMMAND", ("true",))
    connection = Remote(clock, settings("/nowhere"))
    before = connection.pid
    connection._child._process.wait()
    monkeypatch.setattr(remote, "COMMAND", ("/no/such/program",))
    with pytest.raises(NotAvailable, match="no supervisor starts"):
        Remote(clock, settings("/nowhere"))
    for _ in range(100):
        connection.look()
        clock.advance(BEAT)
    assert connection.pid == before
    assert connection.is_mute
    monkeypatch.setattr(remote, "COMMAND", ("true",))
    for _ in range(400):
        connection.look()
        clock.advance(BEAT)
    assert connection.pid != before
    connection.close()


def test_without_a_port_it_is_told_what_to_do(world, tmp_path) -> None:
    missing = Settings(settings("").base, str(tmp_path / "nothing"), -1)
    with pytest.raises(NotAvailable, match="it is not there - plug it in"):
        Remote(world[0].clock, missing)


def another(driving: Driving, before: int) -> None:
    """Wait until another supervisor has taken the place of that one, and its base reports."""

    def is_there() -> bool:
        state = driving.ask()
        return driving.connection.pid != before and not driving.connection.is_mute and state.is_open

    driving.bench.wait("another", is_there)
    assert not psutil.pid_exists(before)


def test_a_supervisor_that_dies_leaves_a_base_at_rest_and_another_comes(driving) -> None:
    before, rolled = driving.connection.pid, driving.state().report.rolled.linear
    time = driving.bench.clock.now()
    os.kill(before, signal.SIGKILL)
    assert driving.bench.stop_after(time) < SOON
    driving.bench.wait("the end", lambda: driving.ask().reason.name == "supervisor")
    assert driving.connection.is_mute
    another(driving, before)
    assert driving.stays()
    state = driving.state()
    assert state.is_latched
    assert state.reason.words == "I stopped because my supervisor was gone"
    assert [n.number for n in state.news] == sorted({n.number for n in state.news})
    drive_to(driving.bench, driving.connection)
    assert driving.state().report.rolled.linear > rolled


@pytest.mark.slow
@pytest.mark.parametrize("watchdog_by", [signal.SIGSTOP, signal.SIGKILL])
@pytest.mark.parametrize("supervisor_by", [signal.SIGSTOP, signal.SIGKILL])
def test_without_supervisor_and_watchdog_the_program_stops_the_base_and_starts_others(
    driving, monkeypatch, supervisor_by, watchdog_by
) -> None:
    monkeypatch.setattr(remote, "GONE", 0.5)
    bench, before, watchdog = driving.bench, driving.connection.pid, driving.watchdog()
    time = bench.clock.now()
    watchdog.send_signal(watchdog_by)
    os.kill(before, supervisor_by)
    assert bench.stop_after(time) < SOON  # while the loop of this program waits
    another(driving, before)
    assert _has_ended(watchdog)
    assert driving.stays()
    assert driving.state().reason.name == "supervisor"
    drive_to(bench, driving.connection)


def test_supervisor_and_watchdog_that_go_on_after_a_rest_know_that_they_were_away(driving) -> None:
    bench, watchdog = driving.bench, driving.watchdog()
    time = bench.clock.now()
    watchdog.suspend()
    os.kill(driving.connection.pid, signal.SIGSTOP)
    bench.stop_after(time)
    os.kill(driving.connection.pid, signal.SIGCONT)
    watchdog.resume()
    bench.wait("an answer", lambda: "frozen" in [n.cause.name for n in driving.ask().news])
    drive_to(bench, driving.connection)


@pytest.mark.slow
def test_a_base_that_was_left_to_itself_by_a_silent_supervisor_is_greeted_again(driving) -> None:
    bench = driving.bench
    os.kill(driving.connection.pid, signal.SIGSTOP)
    bench.clock.advance(ABANDONED + 1.5)  # this program stands still too, and replaces nobody
    assert bench.line.base.mode == PASSIVE
    os.kill(driving.connection.pid, signal.SIGCONT)
    driving.state()
    assert driving.stays()
    drive_to(bench, driving.connection)


@pytest.mark.slow
def test_one_that_stays_silent_is_killed_and_after_many_deaths_nothing_is_left_behind(
    driving, monkeypatch
) -> None:
    program = psutil.Process()
    descriptors, pids = program.num_fds(), {driving.connection.pid}
    monkeypatch.setattr(driving.connection, "_backoff", Backoff(0.0, 0.0))
    monkeypatch.setattr(remote, "COMMAND", ("true",))
    monkeypatch.setattr(remote, "GONE", 0.5)
    os.kill(driving.connection.pid, signal.SIGSTOP)

    def has_died_often() -> bool:
        driving.state()
        pids.add(driving.connection.pid)
        return len(pids) > 15

    driving.bench.wait("deaths", has_died_often)
    monkeypatch.undo()
    another(driving, driving.connection.pid)
    # The port is lent to this program, too, a moment after it was opened.
    driving.bench.wait("the same descriptors", lambda: program.num_fds() == descriptors)
    assert not [c for c in program.children() if c.status() == psutil.STATUS_ZOMBIE]
    drive_to(driving.bench, driving.connection)


def test_supervisors_that_die_at_once_are_started_ever_more_seldom(monkeypatch) -> None:
    clock = FakeClock()
    monkeypatch.setattr(remote.Remote, "_start", lambda self: None)
    monkeypatch.setattr(remote, "COMMAND", ("true",))
    connection, times = Remote(clock, settings("/nowhere")), []
    while len(times) < 10:
        pid = connection.pid
        while connection.pid == pid:
            connection._child._process.wait()
            connection.look()
            clock.advance(BEAT)
        times.append(clock.now())
    connection.close()
    waits = [round(after - before, 6) for before, after in itertools.pairwise(times)]
    assert waits == sorted(waits)
    assert remote.LATEST <= waits[-1] < 2 * remote.LATEST


@pytest.mark.parametrize("by", [signal.SIGKILL, signal.SIGSTOP])
def test_a_program_that_is_killed_or_frozen_no_longer_moves_the_base(world, alone, by) -> None:
    bench, port = world
    assert ended(bench, port.path, by, SLOW) < SOON
    assert not bench.line.base.is_rolling


SOME_ENDS = ("program ended by Ctrl-C", "program, supervisor killed")


@pytest.mark.parametrize(
    "name",
    [name if name in SOME_ENDS else pytest.param(name, marks=pytest.mark.slow) for name in ENDS],
)
def test_whatever_ends_the_base_stands_and_is_left_to_itself(world, alone, name) -> None:
    bench, port = world
    assert is_left_alone(bench, port.path, ENDS[name])


def test_no_process_is_left_behind(world, alone) -> None:
    """After all tests above, their watchdogs have gone by themselves."""
    bench, port = world
    bench.wait(
        "the end of all", lambda: not any(port.path in " ".join(c) for c in _command_lines())
    )
    assert bench.line.base.mode == PASSIVE


def _command_lines() -> Iterator[list[str]]:
    for process in psutil.process_iter():
        with suppress(psutil.Error):
            yield process.cmdline()


def _has_ended(process: psutil.Process) -> bool:
    """Whether it is gone, or waits for nothing but to be collected."""
    return not process.is_running() or process.status() == psutil.STATUS_ZOMBIE


def _fill(path: str) -> None:
    """Write what no base understands until the line takes no more."""
    end = os.open(path, os.O_WRONLY | os.O_NONBLOCK | os.O_NOCTTY)
    for size in (1000, 1):
        with suppress(BlockingIOError):
            while True:
                os.write(end, bytes(size))
    os.close(end)
