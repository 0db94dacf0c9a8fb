"""How a program reaches the supervisor of its base: in a process of its own, or on a fake clock."""

from __future__ import annotations

import os
import select
import subprocess
import sys
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import replace

from hri.core.clock import Clock, Timer
from hri.core.errors import NotAvailable
from hri.drive.supervisor.cause import NO_PROGRAM, NO_SUPERVISOR
from hri.drive.supervisor.controller import TURN, Controller
from hri.drive.supervisor.link import (
    Look,
    Numbered,
    Order,
    Packets,
    State,
    Trip,
    decoded_state,
    encoded,
    pair,
)
from hri.drive.supervisor.multiplexer import Level
from hri.drive.supervisor.process import Settings
from hri.hal.motion import REST

BEAT = 0.02
"""Seconds between two heartbeats of the program."""
STARTING = 10.0
"""Seconds that the supervisor may take to start and to find its base."""
MUTE = 0.5
"""Seconds without an answer after which the supervisor counts as gone."""
GREETED = 0.5
"""Seconds after its boot in which a base reports. A simulated one counts as open for so long when a
program opens it: a real one is waited for until it reports, and a fake clock does not wait."""
LONGEST_NAP = 5.0
"""Seconds of a simulated base that are made up for when the program stood still."""
ENDING = 2.0
"""Seconds that it may take to end, before it is ended."""


class Connection(ABC):
    """Orders down, the newest state up."""

    def __init__(self, clock: Clock) -> None:
        self.clock = clock
        self.state = State(0.0)
        """The newest; its time is the supervisor's."""
        self.heard_at = clock.now()
        """When it came, by the program's clock."""

    @abstractmethod
    def say(self, order: Order) -> None:
        """Give an order, never waiting; one that cannot be sent is dropped."""

    @abstractmethod
    def look(self) -> None:
        """Fetch the newest state, and show that the program lives."""

    @abstractmethod
    def close(self) -> None:
        """Stop the base and hang up; a second call does nothing."""

    @property
    def is_mute(self) -> bool:
        """Whether the supervisor no longer answers."""
        return self.clock.now() - self.heard_at > MUTE

    def _hear(self, state: State) -> None:
        self.state, self.heard_at = state, self.clock.now()


class Inline(Connection):
    """The supervisor on the program's own clock: for simulated bases, the same in every run.

    It protects from nothing that happens to the program itself.
    """

    def __init__(self, clock: Clock, controller: Controller) -> None:
        super().__init__(clock)
        self._controller = controller
        self._turned = clock.now() - controller.protocol.boot - GREETED
        self._timer: Timer | None = None
        self._tick()

    def say(self, order: Order) -> None:
        self._turn((order,))

    def look(self) -> None:
        if self.clock.now() > self._turned:
            self._turn()

    def close(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
            self._turn((Trip(NO_PROGRAM),))
            self._controller.close(self._turned)

    def _tick(self) -> None:
        self._turn()
        self._timer = self.clock.call_at(self._turned + TURN, self._tick)

    def _turn(self, orders: Sequence[Order] = ()) -> None:
        """Turn, after the turns that a program which stood still has missed."""
        now = self.clock.now()
        self._turned = max(self._turned, now - LONGEST_NAP)
        while now - self._turned > 1.5 * TURN:
            self._turned += TURN
            self._controller.turn(self._turned)
        self._turned = now
        self._controller.turn(now, orders)
        self._hear(self._controller.state(now))


class Remote(Connection):
    """The supervisor in a process of its own, over a socket pair that it inherits."""

    def __init__(self, clock: Clock, settings: Settings) -> None:
        """Start it. Raises NotAvailable when the port is not there, or no base answers."""
        super().__init__(clock)
        ours, theirs = pair()
        with theirs:
            told = replace(settings, line=theirs.fileno()).encoded()
            self._process = subprocess.Popen(
                [sys.executable, "-m", "hri.drive.supervisor", told],
                pass_fds=(theirs.fileno(),),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                # A process group of its own: Ctrl-C is for the program, which then hangs up.
                start_new_session=True,
                env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            )
        self._packets = Packets(ours)
        try:
            self._start()
        except BaseException:
            self.close()
            raise

    @property
    def pid(self) -> int:
        """The supervisor's process."""
        return self._process.pid

    def say(self, order: Order) -> None:
        self._packets.send(encoded(order))

    def look(self) -> None:
        self._read()
        self.say(Look(self.state.time))
        if self._packets.is_over and self.state.reason != NO_SUPERVISOR:
            self._hear(_gone(self.state))

    def close(self) -> None:
        self._packets.close()
        try:
            self._process.wait(ENDING)
        except subprocess.TimeoutExpired:
            self._process.kill()  # its watchdog stops the base
            self._process.wait()

    @property
    def is_mute(self) -> bool:
        return self._packets.is_over or super().is_mute

    def _read(self) -> None:
        for packet in reversed(self._packets.receive()):
            state = decoded_state(packet)
            if state is not None:
                self._hear(state)
                return

    def _start(self) -> None:
        """Wait until the base reports; a supervisor that starts says nothing at first."""
        end = self.clock.now() + STARTING
        while self.state.report is None:
            if self._packets.is_over:
                raise NotAvailable("the supervisor ended at once - see what it wrote")
            if self.state.trouble:
                raise NotAvailable(self.state.trouble)
            if self.clock.now() > end:
                raise NotAvailable(
                    "no base answers there - see that it is switched on, and of that kind"
                )
            self.look()
            select.select([self._packets], [], [], BEAT)
            self._read()


def _gone(state: State) -> State:
    """What is known of a base whose supervisor has ended: its watchdog has stopped it."""
    number = state.news[-1].number + 1 if state.news else 1
    return replace(
        state,
        velocity=REST,
        level=Level.LATCH,
        reason=NO_SUPERVISOR,
        is_latched=True,
        is_open=False,
        news=(*state.news, Numbered(number, NO_SUPERVISOR)),
    )
