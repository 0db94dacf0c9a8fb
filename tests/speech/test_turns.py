"""Who may speak when: the robot, its own voice in its ears, and a person, in the simulated room."""

from __future__ import annotations

import pytest

from hri.behavior.ports import OutputPort
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.hal.resource import Description
from hri.robot import Robot, verbs
from hri.simulation.simulated_devices import SimulatedSpeaker
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import SpeakOn, Voice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.tasks import wait_for_speech
from hri.testing import live_for

from .fakes import Stage

STORY = (
    "Now I shall tell you of a robot that went to the sea. "
    "Say stop when it is enough, and I shall fall silent. "
    "It was a dark and stormy night, and nobody was there."
)

NIGHT = (
    "Now I shall tell you of a robot that went to the sea. "
    "It was a dark and stormy night, and nobody was there, but for a bird that could not sleep."
)


APP = """<BehaviorNetwork name="talk" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
  <Behavior id="listener" type="Hri.Recognizer"/>
  <Link from="voice.is_speaking" to="listener.is_speaking"/>
  <Link from="voice.speech" to="listener.speech"/>
  <Link from="voice.position" to="listener.position"/>
</BehaviorNetwork>
"""


class Talk:
    """A robot whose microphone hears its own speaker, and a person who says lines at times."""

    def __init__(self, folder, seconds, lines, *jobs, level=-12.0, seed=3, natural=False):
        (folder / "talk.xml").write_text(APP)
        (folder / "app.toml").write_text('about = "talks"\nnetworks = ["talk.xml"]\n')
        clock = FakeClock()
        robot = Robot(str(folder), "simulated", clock=clock, seed=seed)
        world = robot.resources.obtain("world", SimulatedWorld)
        loud = Description("speaker", "Hri.SimulatedSpeaker", {"level": str(level)})
        devices = [SimulatedSpeaker(loud, robot.resources)]
        if natural:
            voice = Description("voice", "Hri.NaturalVoice")
            devices.append(NaturalVoice(voice, robot.resources))
        for device in devices:
            device.activate()
            robot.resources.substitute(device.description.id, device)
        for time, line in lines.items():
            clock.call_at(time, lambda line=line: world.say(line, clock.now()))
        self.events = live_for(robot, seconds, *jobs)

    def named(self, name):
        return [event.properties for event in self.events if event.name == name]

    def heard(self):
        return [properties["text"] for properties in self.named("speech.heard")]


async def tell(context):
    context.behavior(Voice).say(STORY)
    context.behavior(Voice).say("And so on.")


def test_its_own_words_are_never_obeyed(tmp_path):
    talk = Talk(tmp_path, 12, {}, tell)

    assert talk.heard() == []
    assert [told["cut"] for told in talk.named("speech.finished")] == [False, False]
    assert {told["reason"] for told in talk.named("speech.rejected")} <= {"robot speaking"}


def test_what_is_left_of_a_low_voice_is_not_made_a_command(tmp_path):
    async def tell_of_the_night(context):
        context.behavior(Voice).say(NIGHT)

    talk = Talk(tmp_path, 4.8, {}, tell_of_the_night, level=-24.0, seed=12, natural=True)

    assert talk.heard() == []


def test_stop_is_heard_as_soon_as_its_own_voice_is_known(tmp_path):
    talk = Talk(tmp_path, 3.8, {2.34: "stop"}, tell, level=-6.0, seed=1, natural=True)

    assert talk.heard() == ["stop"]


@pytest.mark.parametrize("level", [-24.0, -6.0])
def test_stop_is_heard_over_its_own_voice_and_empties_the_queue(tmp_path, level):
    talk = Talk(tmp_path, 9, {6.5: "stop"}, tell, level=level)

    assert talk.heard() == ["stop"]
    assert [told["rule"] for told in talk.named("speech.interrupted")] == ["stop"]
    (story,) = talk.named("speech.finished")
    assert story["cut"]
    assert story["heard"].startswith("Now I shall tell you")


def test_the_first_thing_heard_by_a_rule_is_waited_for(tmp_path):
    answers = []

    async def wait(context):
        answers.append(await wait_for_speech(context, "move turn", 6.0))
        answers.append(await wait_for_speech(context, "move turn", 1.0))

    Talk(tmp_path, 9, {1.0: "show me a happy face", 3.5: "go forward ten meters"}, wait)

    heard, nothing = answers
    assert (heard.rule, heard.tags) == ("move", {"distance": 10.0})
    assert nothing is None


@pytest.mark.proves("R01")
def test_a_question_has_a_grammar_of_its_own(tmp_path):
    drinks = tmp_path / "drinks.jsgf"
    drinks.write_text("#JSGF V1.0;\ngrammar drinks;\npublic <drink> = some red wine {drink=wine};")
    answers = []

    async def ask(context):
        answers.append(await verbs.ask(context, "What would you like?", 4.0, str(drinks), 1))

    talk = Talk(tmp_path, 12, {8.5: "some red wine"}, ask)

    assert len(talk.named("question.asked")) == 2
    (answer,) = answers
    assert (answer.rule, answer.tags) == ("drink", {"drink": "wine"})
    (told,) = talk.named("question.answered")
    assert (told["answer"], told["by"]) == ("some red wine", "speech")


def test_a_question_with_a_wrong_grammar_is_not_asked(tmp_path):
    faulty = tmp_path / "faulty.jsgf"
    faulty.write_text("#JSGF V1.0;\ngrammar faulty;\npublic <a> = <b>;")

    async def ask(context):
        with pytest.raises(HriError, match="no rule <b>"):
            await verbs.ask(context, "Well?", 1.0, str(faulty))

    talk = Talk(tmp_path, 3, {}, ask)

    assert talk.named("speech.said") == []


def test_it_speaks_each_time_its_input_becomes_true():
    behavior = SpeakOn(text="mind the step")
    trigger: OutputPort[bool] = OutputPort()
    behavior.trigger.sources.append(trigger)
    stage = Stage(behavior)
    for value in (True, True, False, True):
        trigger.value = value
        stage.run(2.0)

    said = [properties["text"] for _, name, properties in stage.events if name == "speech.said"]
    assert said == ["mind the step"] * 2
