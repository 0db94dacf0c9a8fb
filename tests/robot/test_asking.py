"""Who answers a question with the head, when several people are before the robot."""

import pytest

from hri.behavior.network import Network
from hri.core.clock import FakeClock
from hri.robot import Robot, verbs
from hri.testing import live_for
from hri.vision.behaviors import PersonTracker
from hri.vision.tracking import people
from tests.vision.stage import Player, Stage, standing
from tests.vision.test_behaviors import Projector
from tests.vision.tracking.test_people import ANNA, BEN

VOICE = """<BehaviorNetwork name="talk" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
</BehaviorNetwork>
"""
NEAR, FAR = "p1", "p2"


@pytest.fixture
def asked(tmp_path, monkeypatch):
    """Asks two people, of whom the nearer is attended to; the answer to gestures of (name, who)."""
    (tmp_path / "talk.xml").write_text(VOICE)
    (tmp_path / "app.toml").write_text('networks = ["talk.xml"]\n')

    def ask(*gestures):
        stage = Stage([Player(standing(90, size=100), **ANNA), Player(standing(250), **BEN)])
        monkeypatch.setattr(people, "load_detectors", lambda setting: stage.detectors())
        projector = Projector("projector")
        projector.stage, projector.odd = stage, []
        seeing = Network("seeing", 1 / 15)
        seeing.add(projector)
        seeing.add(PersonTracker("tracker"))
        seeing.connect("projector.image", "tracker.image")
        answers = []

        async def job(context):
            context.networks.start(seeing)
            answers.append(await verbs.ask(context, "Well?", timeout=1.5))

        robot = Robot(str(tmp_path), "simulated", clock=FakeClock(), seed=1)

        def respond(event):
            assert robot.context.behavior(PersonTracker).last.attended == NEAR
            for number, (name, person) in enumerate(gestures, start=1):
                robot.clock.call_at(
                    event.time + 0.2 * number,
                    lambda name=name, person=person: robot.events.raise_event(name, person=person),
                )

        robot.events.subscribe("question.asked", respond)
        live_for(robot, 5.0, job)
        return answers[0]

    return ask


def test_only_the_one_attended_to_answers_with_the_head(asked):
    assert asked(("head.nodded", FAR), ("head.shaken", NEAR)) is False
    assert asked(("head.nodded", FAR)) is None


def test_a_head_that_is_not_told_apart_answers_too(asked):
    assert asked(("head.nodded", "")) is True
