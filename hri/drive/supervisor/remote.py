"""The supervisor in a separate process, and its replacement when it has died. The old one is killed
and waited for before another is started: a port never has two. The new one starts latched, with the
reason.
"""

from __future__ import annotations

import select
import socket
import subprocess
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace

from hri.core import child
from hri.core.clock import Clock
from hri.core.errors import NotAvailable
from hri.drive.supervisor.cause import NO_SUPERVISOR
from hri.drive.supervisor.link import (
    Heartbeat,
    Numbered,
    Order,
    Packets,
    State,
    decoded_state,
    encoded,
    pair,
)
from hri.drive.supervisor.process import Settings
from hri.drive.supervisor.standby import Standby
from hri.drive.supervisor.supervisor_connection import BEAT, SupervisorConnection
from hri.drive.supervisor.watchdog import LastWords
from hri.hal.drivers.serial_id import id_of
from hri.hal.drivers.serial_port import Backoff
from hri.hal.motion import REST, Way
from hri.hal.rank import Rank

COMMAND = child.command("-m", "hri.drive.supervisor")
"""Starts it; its settings come behind."""
STARTING = 10.0
"""Seconds that the supervisor may take to start, and at first to find its base too."""
GONE = 3.0
"""Seconds without an answer, of a program that goes on asking, after which it is given up."""
SOONEST, LATEST = 0.1, 5.0
"""Seconds from a death to the first and to any later attempt to start another."""
STEADY = 10.0
"""Seconds that one must have lived for the next death to count as a first one."""
ENDING = 2.0
"""Seconds that it may take to end, before it is ended."""


class Child:
    """One process, with the line to it, and the thread that stands by for it."""

    def __init__(self, settings: Settings) -> None:
        """Start it. Raises NotAvailable where this machine cannot."""
        words = LastWords.of(settings.make())
        try:
            with _two_pairs() as (ours, theirs, our_lifeline, its_lifeline):
                line, lifeline = theirs.fileno(), its_lifeline.fileno()
                self._process = _started(replace(settings, line=line, lifeline=lifeline))
                self.packets = Packets(_kept(ours))
                self._standby = Standby(_kept(our_lifeline), words)
        except OSError as error:
            raise NotAvailable(f"no supervisor starts: {error} - end other programs") from error
        self.has_spoken = False

    @property
    def pid(self) -> int:
        return self._process.pid

    def kill(self) -> None:
        """End it, however it stands; its watchdog and the thread that stands by stop the base.

        `is_dead` says when it has ended.
        """
        self.packets.close()
        self._process.kill()

    def is_dead(self) -> bool:
        """Whether it has ended, and left nothing behind."""
        return self._process.poll() is not None

    def close(self) -> None:
        """Hang up, so that it stops the base and ends; wait for that."""
        self.packets.close()
        try:
            self._process.wait(ENDING)
        except subprocess.TimeoutExpired:
            self.kill()
            self._process.wait()
        self._standby.wait()


class Remote(SupervisorConnection):
    """A supervisor over a socket pair that its process inherits, and others after it."""

    def __init__(self, clock: Clock, settings: Settings) -> None:
        """Start it. Raises NotAvailable when the port is not there, or no base answers."""
        super().__init__(clock)
        self._settings = settings
        self._backoff = Backoff(SOONEST, LATEST)
        self._carried = Way()
        """What the wheels rolled under those before."""
        self._told = 0
        """How many news there were."""
        self._is_given_up = self._is_closed = False
        self._begin()
        try:
            self._start()
        except BaseException:
            self.close()
            raise
        # The next supervisor has to find the same adapter, whatever its path is by then.
        self._settings = replace(
            settings, port=id_of(settings.port, settings.by_id) or settings.port
        )

    @property
    def pid(self) -> int:
        """The supervisor's process."""
        return self._child.pid

    def say(self, order: Order) -> None:
        # One that has not spoken has a clock by which no `echo` can be right.
        if self._child.has_spoken:
            self._child.packets.send(encoded(order))

    def look(self) -> None:
        if self._is_closed:
            return
        self._ask()
        if not self._is_given_up:
            self._give_up_if_gone()
        elif self._child.is_dead() and self._backoff.is_due(self.clock.now()):
            self._begin_again()

    def close(self) -> None:
        self._is_closed = True
        self._child.close()

    @property
    def is_mute(self) -> bool:
        return self._child.packets.is_over or not self._child.has_spoken or super().is_mute

    # --- one supervisor ---

    def _begin(self) -> None:
        self._child = Child(self._settings)
        self._is_given_up = False
        self._began = self._asked = self.clock.now()
        self._silence = 0.0
        """Seconds of asking without an answer."""

    def _start(self) -> None:
        """Wait until the base reports; a supervisor that starts says nothing at first."""
        end = self.clock.now() + STARTING
        while self.state.report is None:
            if self._child.packets.is_over:
                raise NotAvailable("the supervisor ended at once - see what it wrote")
            if self.state.trouble:
                raise NotAvailable(self.state.trouble)
            if self.clock.now() > end:
                raise NotAvailable(
                    "no base answers there - see that it is switched on, and of that kind"
                )
            self._ask()
            select.select([self._child.packets], [], [], BEAT)
            self._read()

    def _ask(self) -> None:
        self._read()
        now = self.clock.now()
        # Only what a program lives through counts: one that stood still has asked nothing.
        self._silence += min(now - self._asked, 2 * BEAT)
        self._asked = now
        echo = self.state.time if self._child.has_spoken else 0.0
        self._child.packets.send(encoded(Heartbeat(echo)))

    def _read(self) -> None:
        for packet in reversed(self._child.packets.receive()):
            state = decoded_state(packet)
            if state is not None:
                self._child.has_spoken, self._silence = True, 0.0
                self._hear(self._continued(state))
                return

    # --- and the next ---

    def _give_up_if_gone(self) -> None:
        patience = GONE if self._child.has_spoken else STARTING
        if not self._child.packets.is_over and self._silence <= patience:
            return
        self._is_given_up = True
        self._child.kill()
        self._settings = replace(self._settings, cause=NO_SUPERVISOR)
        now = self.clock.now()
        if now - self._began > STEADY:
            self._backoff.reset()
        self._backoff.fail(now)
        if self._child.has_spoken:
            self._bequeath()

    def _bequeath(self) -> None:
        """Keep what the next one cannot know."""
        last = self.state.news[-1].number if self.state.news else 0
        self._told = max(self._told, last) + 1
        if self.state.report is not None:
            self._carried = self.state.report.rolled
        self._hear(_gone(self.state, self._told))

    def _begin_again(self) -> None:
        """The one before has left nothing behind: no port ever has two."""
        try:
            self._begin()
        except NotAvailable:
            self._backoff.fail(self.clock.now())

    def _continued(self, state: State) -> State:
        """The state, with news and motion counted on from earlier supervisors."""
        news = tuple(replace(item, number=item.number + self._told) for item in state.news)
        report = state.report
        if report is not None:
            rolled, carried = report.rolled, self._carried
            way = Way(rolled.linear + carried.linear, rolled.angular + carried.angular)
            report = replace(report, rolled=way)
        return replace(state, report=report, news=news)


@contextmanager
def _two_pairs() -> Iterator[tuple[socket.socket, ...]]:
    """Both lines of a supervisor, ours before its own each time; closed afterwards unless kept."""
    with ExitStack() as stack:
        ends = (*pair(), *pair())
        for end in ends:
            stack.enter_context(end)
        yield ends


def _kept(end: socket.socket) -> socket.socket:
    """The same end of a line, which stays open after its `with`."""
    return socket.socket(fileno=end.detach())


def _started(settings: Settings) -> subprocess.Popen[bytes]:
    """Raises OSError where this machine cannot."""
    return subprocess.Popen(
        [*COMMAND, settings.encoded()],
        pass_fds=(settings.line, settings.lifeline),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        # A separate process group: Ctrl-C is for the program, which then hangs up.
        start_new_session=True,
        env=child.environment(),
    )


def _gone(state: State, number: int) -> State:
    """What is known of a base whose supervisor has ended: its watchdog has stopped it."""
    return replace(
        state,
        velocity=REST,
        level=Rank.LATCH,
        reason=NO_SUPERVISOR,
        is_latched=True,
        is_open=False,
        trouble="its supervisor is gone - wait until another one has started",
        news=(*state.news, Numbered(number, NO_SUPERVISOR)),
    )
