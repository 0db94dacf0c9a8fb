"""Driving a base by hand: keys in, velocities through its supervisor, a picture out."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress

from hri.cli.drive.keys import QUIT, RELEASE, STOP, Steering
from hri.cli.drive.view import Snapshot, View
from hri.core.clock import Clock
from hri.core.errors import NotAvailable
from hri.core.signals import Twist
from hri.drive.supervisor.base_bus import BaseBus
from hri.hal.drive import Odometry
from hri.hal.motion import REST
from hri.hal.rank import Rank

PERIOD = 0.05
"""Seconds between two velocities, and between two pictures."""


class Teleop:
    """Turns keys into velocities until someone quits.

    The supervisor has the last word: it forgets a velocity after 0.2 s, so that the base also stops
    when this program hangs.
    """

    def __init__(
        self,
        bus: BaseBus,
        odometry: Odometry,
        views: Sequence[View],
    ) -> None:
        """Take keys from all views, and show the base in all of them."""
        self._bus, self._odometry, self._views = bus, odometry, views
        self._steering = Steering()
        self._is_asking = False

    def run(self, clock: Clock, is_asked_to_end: Callable[[], bool] = lambda: False) -> None:
        """Drive until a key quits, or until asked to end."""
        while True:
            now = clock.now()
            keys = [key for view in self._views for key in view.read_keys()]
            is_over = self._take(keys, now) or is_asked_to_end()
            twist = REST if is_over else self._wanted(now)
            self._ask(twist)
            if is_over:  # perhaps because the terminal is gone
                return
            state, pose = self._bus.state, self._odometry.pose(now)
            moment = Snapshot(state, pose, twist, self._steering.share, now)
            for view in self._views:
                view.show(moment)
            clock.advance(PERIOD)

    def _take(self, keys: Sequence[str], now: float) -> bool:
        """Handle keys; True if one of them quits."""
        for key in keys:
            if key in QUIT:
                return True
            if key in STOP:
                self._steering.let_go()
                self._bus.stop_latched("you pressed the space bar")
            elif key in RELEASE:
                self._bus.unlatch()
            else:
                self._steering.press(key, now)
        return False

    def _wanted(self, now: float) -> Twist:
        allowed = self._bus.state.allowed
        fastest = Twist(allowed.forward, allowed.angular)
        return self._steering.twist(fastest, allowed.backward, now)

    def _ask(self, twist: Twist) -> None:
        """Repeat the velocity while a key is held, then send one zero."""
        with suppress(NotAvailable):  # the picture says so, and another supervisor may come
            if twist != REST:
                self._bus.teleop(twist)
            elif self._is_asking:
                self._bus.ask(Rank.TELEOP, None)
        self._is_asking = twist != REST
