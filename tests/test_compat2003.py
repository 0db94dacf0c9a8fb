"""The face interface of 2003: what is put on shows on the face, and is not felt."""

import pytest

from hri.compat2003 import FaceInterface
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.emotion.appraisal import GoalEvent
from hri.emotion.behaviors import EmotionModel
from hri.robot import Robot

NETWORK = """<BehaviorNetwork name="emotion" invocation_interval="1/30">
  <Behavior id="emotion" type="Hri.EmotionModel"/>
  <Behavior id="display" type="Hri.EmotionDisplay"/>
  <Behavior id="face" type="Hri.Face"/>
  <Link from="emotion.state" to="display.state"/>
  <Link from="display.expression" to="face.expression"/>
</BehaviorNetwork>
"""


@pytest.fixture
def robot(tmp_path):
    """A face that nobody draws."""
    (tmp_path / "app.toml").write_text('networks = ["emotion.xml"]\n')
    (tmp_path / "emotion.xml").write_text(NETWORK)
    with Robot(str(tmp_path), "simulated", clock=FakeClock(), seed=1) as robot:
        robot.wait(1.0)
        yield robot


def weights(robot, seconds):
    """The largest weight of each target within so many seconds."""
    seen = {}

    def note(sent, now):
        for name, weight in sent.values.items():
            seen[name] = max(seen.get(name, 0.0), weight)

    async def watch(context):
        watch = context.networks.watch("emotion", "face", "weights", note)
        await context.clock.sleep(seconds)
        watch.cancel()

    robot.run(watch)
    return seen


def feeling(robot):
    return robot.context.behavior(EmotionModel).feeling()


@pytest.mark.proves("B24", "R04")
def test_a_set_emotion_shows_for_its_duration_and_is_not_felt(robot):
    before = weights(robot, 0.2).get("mouthSmileLeft", 0.0)
    FaceInterface(robot).set_emotion_value(3.0, "joy", 1.0)
    assert weights(robot, 2.9)["mouthSmileLeft"] > before + 0.3
    assert feeling(robot).label == "calm"
    robot.wait(2.5)
    assert weights(robot, 0.2).get("mouthSmileLeft", 0.0) < before + 0.1


def test_more_of_an_emotion_shows_more(robot):
    smiles = []
    for _ in range(3):
        FaceInterface(robot).set_emotion_increment(60.0, "joy", 0.2)
        robot.wait(1.5)
        smiles.append(weights(robot, 0.1).get("mouthSmileLeft", 0.0))
    assert smiles[0] < smiles[1] < smiles[2]


def test_a_vector_hides_what_is_felt(robot):
    robot.feel("scold")
    assert weights(robot, 2.0)["mouthFrownLeft"] > 0.2
    FaceInterface(robot).set_emotion_vector(5.0, {"joy": 0.8})
    robot.wait(2.0)
    shown = weights(robot, 0.2)
    assert shown["mouthSmileLeft"] > 0.3
    assert shown.get("mouthFrownLeft", 0.0) < 0.05
    assert feeling(robot).label == "sadness"


def test_the_end_of_what_was_put_on_can_be_waited_for(robot):
    start = robot.clock.now()
    assert FaceInterface(robot).wait_for_emotional_change()
    assert robot.clock.now() == start
    FaceInterface(robot).set_emotion_value(2.0, "fear", 0.7)
    assert not FaceInterface(robot).wait_for_emotional_change(timeout=0.5)
    assert robot.clock.now() - start == pytest.approx(0.5)
    assert FaceInterface(robot).wait_for_emotional_change(timeout=5.0)
    assert robot.clock.now() - start == pytest.approx(2.0, abs=0.06)


def test_a_hope_can_be_told_and_its_reason_asked_for(robot):
    robot.appraise(GoalEvent("charger", utility=1.0, likelihood_after=0.9))
    assert feeling(robot).label == "hope"
    assert robot.why() == "I am full of hope because of the charger."
    assert robot.why("sad") == "I am not sad. I am full of hope because of the charger."


def test_an_action_is_played_while_the_script_goes_on(robot):
    events = []
    robot.events.subscribe("gesture.*", lambda event: events.append(event.name))
    start = robot.clock.now()
    FaceInterface(robot).action("nod")
    assert robot.clock.now() == start
    robot.wait(4.0)
    assert events == ["gesture.started", "gesture.ended"]


@pytest.mark.parametrize("phonemes", ["m @ m A: _ m", ["M", "AH0", "M", "'AA1", "SIL", "M"]])
def test_lips_follow_phonemes_for_as_long_as_they_last(robot, phonemes):
    start = robot.clock.now()
    assert weights(robot, 0.3).get("jawOpen", 0.0) < 0.05
    seen = []

    async def watch(context):
        def note(sent, now):
            seen.append((now - start, sent.values.get("jawOpen", 0.0)))

        context.networks.watch("emotion", "face", "weights", note)

    robot.run(watch)
    FaceInterface(robot).speak(phonemes)
    assert robot.clock.now() - start == pytest.approx(0.3 + 6 * 0.08, abs=0.05)
    assert max(jaw for _, jaw in seen) > 0.15
    robot.wait(0.6)
    assert seen[-1][1] < 0.05


@pytest.mark.parametrize(
    ("verb", "arguments", "told"),
    [
        ("action", ("nodd",), 'no gesture "nodd" - did you mean "nod"?'),
        ("set_emotion_value", (1.0, "joyy", 0.5), 'no emotion "joyy" - did you mean "joy"?'),
        ("set_emotion_value", (0.0, "joy", 0.5), "give a time above 0"),
        ("set_emotion_increment", (1.0, "joy", -2.0), "joy of -2.0 - give -1 to 1"),
        ("set_emotion_vector", (1.0, [0.5]), "1 values for 24 emotions"),
        ("speak", ("m " * 2000,), "2000 phonemes - speak at most 1000 at once"),
        ("speak", ("m", "arpa"), '"arpa" is not an alphabet of phonemes - did you mean "arpabet"?'),
    ],
)
def test_mistakes_are_told(robot, verb, arguments, told):
    with pytest.raises(HriError) as error:
        getattr(FaceInterface(robot), verb)(*arguments)
    assert told in str(error.value)
