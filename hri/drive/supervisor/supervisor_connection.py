"""How a program reaches the supervisor of its base; one on the program's own clock."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence

from hri.core.clock import Clock, Timer
from hri.drive.supervisor.cause import NO_PROGRAM
from hri.drive.supervisor.controller import SAME, TURN, Controller
from hri.drive.supervisor.link import Order, State, Trip
from hri.hal.motion import REST

BEAT = 0.02
"""Seconds between two heartbeats of the program."""
MUTE = 0.5
"""Seconds without an answer after which the supervisor counts as gone."""
GREETED = 0.5
"""Seconds after its boot in which a base reports. A simulated one counts as open for so long when a
program opens it: a real one is waited for until it reports, and a fake clock does not wait."""
LONGEST_NAP = 5.0
"""Seconds of a simulated base that are made up for when the program stood still."""


class SupervisorConnection(ABC):
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


class Inline(SupervisorConnection):
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
        if self.clock.now() - self._turned > SAME:
            self._turn()

    def close(self) -> None:
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
            self._turn((Trip(NO_PROGRAM),))
            self._controller.close(self._turned)

    def _tick(self) -> None:
        self.look()
        self._timer = self.clock.call_at(self._turned + self._interval, self._tick)

    @property
    def _interval(self) -> float:
        """Seconds to the next turn; a base that rests is looked at when it reports."""
        rests = self.state.velocity == REST and not self.state.waiting
        return max(TURN, self._controller.protocol.period) if rests else TURN

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
