"""A simulated companion that an assistant of the SDK asks, in memory and in little time."""

import threading
from contextlib import closing, contextmanager

import trio
from mcp import Client

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.net.mcp.calls import Calls
from hri.net.mcp.protocol import server_of
from hri.robot import Robot

HEADLESS = [Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice")]
PAUSE = 0.01
"""Seconds of the machine for each 0.05 simulated ones."""
LONGEST = 3600.0
"""Simulated seconds after which a robot ends that a test has forgotten."""


class Assistant:
    """Asks from the thread of a test."""

    def __init__(self, robot):
        self.robot = robot
        self.events = []
        robot.events.subscribe("*", self.events.append)
        self.client = self.context = self.calls = self._token = None
        self.is_ready = threading.Event()

    def run(self, function, *arguments):
        """Await a coroutine function in the robot's loop."""
        return trio.from_thread.run(function, *arguments, trio_token=self._token)

    def call(self, tool, **arguments):
        return self.run(self.client.call_tool, tool, arguments)

    def told(self, tool, **arguments):
        """The text of an answer."""
        return self.call(tool, **arguments).content[0].text

    def heard(self, name):
        return [event for event in self.events if event.name == name]

    def job(self, permission, is_over, mode):
        async def assist(context):
            self._token, self.context = trio.lowlevel.current_trio_token(), context
            self.calls = Calls(self.robot, context, permission)
            async with Client(server_of(self.calls, "memory"), mode=mode) as client:
                self.client = client
                await context.clock.sleep(2.0)
                self.is_ready.set()
                while not is_over.wait(PAUSE) and context.clock.now() < LONGEST:
                    await context.clock.sleep(0.05)
            self.robot.finish()

        return assist


@contextmanager
def living(permission, mode="legacy", tasks=True):
    """A robot that lives in a thread, and who asks it."""
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=HEADLESS, notice=print)
    assistant, is_over = Assistant(robot), threading.Event()
    jobs = (*(robot.app.load_tasks() if tasks else ()), assistant.job(permission, is_over, mode))
    thread = threading.Thread(target=lambda: robot.live_until_over(*jobs), daemon=True)
    with closing(robot):
        thread.start()
        try:
            assert assistant.is_ready.wait(120)
            yield assistant
        finally:
            is_over.set()
            thread.join()
