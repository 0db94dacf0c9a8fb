"""A simulated companion with a studio, which tests use from outside while it lives."""

import threading
from contextlib import closing, contextmanager

import httpx2 as httpx

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.robot import Robot
from hri.studio.session import StudioSession

HEADLESS = [Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice")]
LONGEST = 3600.0
"""Simulated seconds after which a robot ends that a test has forgotten."""
PAUSE = 0.03
"""Seconds of the machine, for each 0.05 simulated ones."""


@contextmanager
def living(app="companion"):
    """A robot that lives in a thread, with its studio."""
    robot = Robot(app, "simulated", clock=FakeClock(), devices=HEADLESS, notice=lambda _: None)
    studio = StudioSession(robot, port=0)
    is_over = threading.Event()

    async def go_on(context):
        # The pause leaves the browser half of the machine.
        while not is_over.wait(PAUSE) and context.clock.now() < LONGEST:
            await context.clock.sleep(0.05)
        robot.finish()

    jobs = (*robot.app.load_tasks(), *studio.jobs(), go_on)
    thread = threading.Thread(target=lambda: robot.live_until_over(*jobs))
    with closing(robot), closing(studio):
        studio.start()
        thread.start()
        try:
            yield studio, robot
        finally:
            is_over.set()
            thread.join()


@contextmanager
def known(address):
    """A client that has shown the code of this address."""
    base = address.partition("?")[0]
    with httpx.Client(base_url=base, follow_redirects=True, timeout=30) as client:
        assert client.get(address).status_code == 200
        yield client


def told(client, topic, is_true):
    """The value of a topic, once it is as wanted."""
    while True:
        try:
            values = client.get("/api/v1/state").json()
        except httpx.TransportError:  # the server was killed, and comes back
            continue
        if topic in values and is_true(values[topic]):
            return values[topic]
