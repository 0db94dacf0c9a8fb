"""A simulated companion with a studio, and a script that uses it from outside meanwhile."""

import threading
from contextlib import closing, contextmanager

import httpx2 as httpx

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.robot import Robot
from hri.studio.session import StudioSession

HEADLESS = [Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice")]
LONGEST = 3600.0
"""Simulated seconds in which the script has to end."""


def live_with_studio(script, app="companion"):
    """Run `script(studio, robot)` in a thread while the robot lives; what it returned."""
    robot = Robot(app, "simulated", clock=FakeClock(), devices=HEADLESS, notice=lambda _: None)
    studio = StudioSession(robot, port=0)
    found = []

    async def use(context):
        def run():
            try:
                found.append(script(studio, robot))
            except BaseException as error:
                found.append(error)

        thread = threading.Thread(target=run)
        thread.start()
        while thread.is_alive() and context.clock.now() < LONGEST:
            await context.clock.sleep(0.05)
        robot.finish()

    with closing(robot), closing(studio):
        studio.start()
        robot.live_until_over(*robot.app.load_tasks(), *studio.jobs(), use)
    if isinstance(found[0], BaseException):
        raise found[0]
    return found[0]


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
