"""What a task does is the robot's own, whoever caused its start."""

from hri.core.origin import STUDIO, caused_by, origin
from tests.task.stage import Stage


async def wave(context):
    assert origin() == ""
    context.manager.raise_event("hand.waved")
    await context.clock.sleep(0.1)
    context.manager.raise_event("hand.lowered")


async def be_asked(context):
    with caused_by(STUDIO):
        context.manager.raise_event("wave.asked")
        task = context.manager.install(wave)
    await task.wait()


def test_a_task_that_a_request_starts_does_the_robots_own_deeds():
    stage = Stage()
    stage.run(be_asked)
    assert [(event.name, event.origin) for event in stage.events] == [
        ("wave.asked", STUDIO),
        ("hand.waved", ""),
        ("hand.lowered", ""),
    ]
