"""Questions: who answers with the head, and what may be said while one with a grammar is open."""

from functools import partial

import pytest

from hri.behavior.network import Network
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.robot import Robot, verbs
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for
from hri.vision.behaviors import PersonTracker
from hri.vision.tracking import people
from tests.devices import BLIND, SMALL_SCREEN, TYPED
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
            for number, (gesture, person) in enumerate(gestures, start=1):
                name, _, direction = gesture.partition(" ")
                told = {"person": person} | ({"direction": direction} if direction else {})
                robot.clock.call_at(
                    event.time + 0.2 * number, partial(robot.events.raise_event, name, **told)
                )

        robot.events.subscribe("question.asked", respond)
        live_for(robot, 5.0, job)
        return answers[0]

    return ask


def test_only_the_one_attended_to_answers_with_the_head(asked):
    assert asked(("head.nodded", FAR), ("head.shaken", NEAR)) is False
    assert asked(("head.nodded", FAR)) is None


def test_a_thumb_answers_as_a_nod_does(asked):
    assert asked(("hand.thumb up", NEAR)) is True
    assert asked(("hand.thumb down", NEAR)) is False
    assert asked(("hand.thumb up", FAR), ("hand.thumb sideways", NEAR)) is None


def test_a_head_that_is_not_told_apart_answers_too(asked):
    assert asked(("head.nodded", "")) is True


SIZE = "#JSGF V1.0;\ngrammar size;\npublic <size> = small {size=small} | large {size=large};\n"


class Order:
    """An app asks for a size while lines are typed, or said, after each time it has asked."""

    def __init__(self, folder, lines, job=None, is_spoken=False, size=SIZE, seconds=20.0):
        (folder / "app.toml").write_text('extends = "companion"\n')
        if size:
            (folder / "size.jsgf").write_text(size)
        devices = (SMALL_SCREEN, BLIND) if is_spoken else TYPED
        robot = Robot(str(folder), "simulated", clock=FakeClock(), seed=1, devices=devices)
        left = list(lines)
        self.answers = []

        def respond(event):
            if left and is_spoken:
                robot.visitor.say(left.pop(0), after=0.5)
            elif left:
                keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
                line = left.pop(0)
                robot.clock.call_at(event.time + 1.0, lambda: keyboard.type_line(line, event.time))

        async def order(context):
            await context.clock.sleep(0.5)
            self.answers.append(await (job or ask_size)(context))

        robot.events.subscribe("question.asked", respond)
        self.events = live_for(robot, seconds, *robot.app.load_tasks(), order)

    def named(self, name):
        return [event.properties["text"] for event in self.events if event.name == name]


async def ask_size(context, grammar="size", retries=0):
    return await verbs.ask(context, "Which size?", 4.0, grammar, retries)


@pytest.mark.parametrize("grammar", ["size", "size.jsgf"])
def test_a_grammar_in_the_folder_of_the_app_is_found_by_name(tmp_path, grammar):
    order = Order(tmp_path, ["large"], lambda context: ask_size(context, grammar), seconds=6)
    assert order.answers[0].tags == {"size": "large"}


def test_one_listens_with_a_grammar_of_the_app_too(tmp_path):
    async def listen(context):
        context.events.raise_event("question.asked", text="")
        return await verbs.wait_for_speech(context, "size", 4.0, "size")

    order = Order(tmp_path, ["small"], listen, seconds=5)
    assert order.answers[0].tags == {"size": "small"}


def test_an_app_has_the_grammars_of_the_app_that_it_extends(tmp_path, monkeypatch):
    base, own = tmp_path / "apps" / "shop", tmp_path / "own"
    for folder in (base, own):
        folder.mkdir(parents=True)
    (base / "app.toml").write_text('extends = "companion"\n')
    (base / "size.jsgf").write_text(SIZE)
    (own / "app.toml").write_text('extends = "shop"\n')
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    robot = Robot(str(own), "simulated", clock=FakeClock(), devices=TYPED)
    robot.events.subscribe(
        "question.asked",
        lambda event: robot.resources.obtain("recognizer", TypedRecognizer).type_line("large", 0),
    )
    answers = []

    async def order(context):
        answers.append(await ask_size(context))

    live_for(robot, 5.0, order)
    assert answers[0].tags == {"size": "large"}


@pytest.mark.parametrize("is_spoken", [False, True])
def test_a_question_is_said_again_and_answered_among_other_words(tmp_path, is_spoken):
    lines = ["what did you say", "a large one with ham"]
    order = Order(tmp_path, lines, is_spoken=is_spoken, seconds=11)
    assert order.named("question.asked") == ["Which size?"] * 2
    assert order.answers[0].tags == {"size": "large"}
    assert order.named("question.answered") == ["Which size?"]


@pytest.mark.parametrize("is_spoken", [False, True])
def test_a_question_is_refused_and_the_person_hears_so(tmp_path, is_spoken):
    order = Order(tmp_path, ["never mind"], is_spoken=is_spoken, seconds=9)
    assert order.answers == [None]
    assert order.named("question.refused") == ["Which size?"]
    assert order.named("speech.said") == ["Which size?", "Okay, never mind."]


def test_a_refusal_is_an_answer_where_the_author_has_a_rule_for_it(tmp_path):
    size = SIZE + "public <none> = <asking.cancel>;\n"
    order = Order(tmp_path, ["cancel that"], size=size, seconds=6)
    assert order.answers[0].rule == "none"
    assert order.named("question.refused") == []


def test_who_is_not_heard_hears_so(tmp_path):
    order = Order(tmp_path, [], lambda context: ask_size(context, retries=1))
    assert order.answers == [None]
    said = ["Which size?", "Which size?", "Sorry, I didn't hear an answer."]
    assert order.named("speech.said")[:3] == said
    assert order.named("question.unanswered")[0] == "Which size?"


def test_a_hint_takes_no_time_from_who_answers(tmp_path):
    """What is said to a line that was not understood takes three of the four seconds."""

    async def ask(context):
        keyboard = context.resources.obtain("recognizer", TypedRecognizer)

        def answer(event):
            if "You can say" in event.properties["text"] or "Is it" in event.properties["text"]:
                later = event.time + 3.0
                context.clock.call_at(later, lambda: keyboard.type_line("small", later))

        context.events.subscribe("speech.finished", answer)
        return await ask_size(context)

    order = Order(tmp_path, ["banana"], ask, seconds=12)
    assert order.answers[0].tags == {"size": "small"}


@pytest.mark.parametrize(
    ("size", "error"), [("", 'no "size" in grammars'), (SIZE + "public <a> = <b>;", "no rule <b>")]
)
def test_a_question_that_cannot_be_asked_is_said_to_have_failed(tmp_path, size, error):
    said = []

    async def ask(context):
        context.events.subscribe("speech.finished", lambda e: said.append(e.properties["text"]))
        return await ask_size(context)

    with pytest.raises(ExceptionGroup) as caught:
        Order(tmp_path, [], ask, size=size)
    assert caught.group_contains(HriError, match=error)
    assert said == ["Sorry, my task order failed."]
