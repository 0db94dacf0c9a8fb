"""What the companion feels about what happens to it, and says of it."""

import pytest

from hri.core.clock import FakeClock
from hri.emotion.behaviors import EmotionModel
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.testing import live_for
from tests.devices import UNSEEN


class Alone:
    """The companion with nobody about, to which things happen at times."""

    def __init__(self, seconds, happenings):
        self.robot = Robot(config="simulated", clock=FakeClock(), devices=[UNSEEN])
        self.robot.resources.obtain("world", SimulatedWorld).person.starts_present = False
        self.emotion = self.robot.context.behavior(EmotionModel)
        self.felt = []
        self.eyes = []
        for time, happening in happenings.items():
            self.robot.clock.call_at(time, happening(self))
        self.events = live_for(self.robot, seconds, *self.robot.app.load_tasks(), self._watch)

    async def _watch(self, context):
        def note(sent, now):
            self.eyes.append(sent.values.get("eyeLookDownLeft", 0.0))

        context.networks.watch("face", "face", "weights", note)

    def said(self):
        return [event.properties["text"] for event in self.events if event.name == "speech.said"]


def event(name, **properties):
    return lambda visit: lambda: visit.robot.events.raise_event(name, **properties)


def look(visit):
    return lambda: visit.felt.append(visit.emotion.feeling())


@pytest.fixture(scope="module")
def visit():
    def drain(visit):
        return lambda: visit.robot.resources.obtain("world", SimulatedWorld).set_battery(0.3, 0.5)

    asked = event("speech.heard", rule="why", text="why are you angry", tags={"emotion": "angry"})
    happenings = {0.5: drain, 1.0: look, 2.0: event("bumper.pressed"), 2.1: look, 3.5: asked}
    return Alone(4.5, happenings)


def test_an_empty_battery_is_a_need(visit):
    assert visit.felt[0].drives["energy"] == pytest.approx(0.7, abs=0.01)


def test_what_happens_is_felt_once_and_talked_about(visit):
    assert 0.6 < visit.felt[1].emotions["surprise"] <= 0.75
    assert visit.said()[0] == "[ouch] I bumped into something."


def test_it_tells_about_the_feeling_that_it_was_asked_about(visit):
    assert "angry because I bumped into something" in visit.said()[1]


def test_who_is_ashamed_looks_down_when_there_is_nobody_to_look_at():
    def scold(visit):
        return lambda: visit.emotion.feel("scold")

    visit = Alone(4.0, {2.0: scold})
    calm, ashamed = visit.eyes[:60], visit.eyes[60:]
    assert sum(ashamed) > sum(calm) + 5.0
