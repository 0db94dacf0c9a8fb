"""The bench of agreement finds what it looks for."""

from benchmarks.face.agreement import TYPED, Looking
from hri.core.clock import FakeClock
from hri.core.signals import FaceWeights
from hri.face.behaviors import Face
from hri.robot import Robot, verbs
from hri.task import TaskContext
from hri.testing import live_for


def test_smiles_tears_merry_gestures_and_words_against_the_feeling_are_found() -> None:
    looking: list[Looking] = []

    async def look(context: TaskContext) -> None:
        looking.append(Looking(context))
        await looking[0].live()

    async def contradict(context: TaskContext) -> None:
        await context.clock.sleep(0.5)
        context.manager.install(verbs.show, "sad", 3.0)
        await context.clock.sleep(0.5)
        context.manager.install(verbs.say, "[giggle] I am so happy!")
        await verbs.gesture(context, "wink")
        face = context.behavior(Face)
        for _ in range(30):
            face.weights.send(FaceWeights({"mouthSmileLeft": 1.0}))
            looking[0].look(context.clock.now())
            await context.clock.sleep(1 / 30)

    robot = Robot(config="simulated", clock=FakeClock(), devices=TYPED)
    live_for(robot, 5.0, look, contradict)
    found = [one.what for one in looking[0].found]
    assert 'says "[giggle] I am so happy!", sad' in found
    assert "makes wink, sad" in found
    assert "smiles, sad" in found
