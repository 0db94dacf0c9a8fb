"""Robots of a fleet for tests: each lives in a thread, for real, on the loopback network."""

from __future__ import annotations

import threading
from contextlib import suppress

import trio

from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.net.zenoh.member import Member
from hri.robot import Robot
from tests.net.conftest import WITHIN

NETWORK = """
<BehaviorNetwork name="{name}" invocation_interval="0.02">
  <Behavior id="five" type="Hri.Constant"><Parameter name="parsed_value" value="5"/></Behavior>
  <Behavior id="double" type="Hri.Multiplication"/>
  <Link from="five.value" to="board.level"/>
  {links}
</BehaviorNetwork>
"""


class Living:
    """A robot of a fleet that lives in a thread."""

    def __init__(self, settings, path, devices=()):
        self.robot = Robot(str(path), "simulated", clock=RealClock(), devices=devices)
        self.member = Member(self.robot, settings)
        self.board = self.robot.board
        self.failed = []
        self._lives = threading.Event()
        self._thread = threading.Thread(target=self._live, daemon=True)
        self._thread.start()

    def _live(self):
        try:
            self.robot.live_until_over(self.member.be_in_fleet, self._wait)
        except HriError as error:
            self.failed.append(error)

    async def _wait(self, context):
        token = trio.lowlevel.current_trio_token()
        self._end = lambda: token.run_sync_soon(self.robot.finish)
        self._lives.set()
        await trio.sleep_forever()

    def end(self):
        assert self._lives.wait(WITHIN)
        with suppress(trio.RunFinishedError):
            self._end()
        self._thread.join(WITHIN)
        assert not self._thread.is_alive()


def until(holds):
    """Whether something holds within a while."""
    clock, moment = RealClock(), threading.Event()
    while not holds():
        if clock.now() > WITHIN:
            return False
        moment.wait(0.01)
    return True
