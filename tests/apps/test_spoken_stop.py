"""After a "stop" the next order to move is obeyed, in every app, and no other stop ends so."""

import pytest

from hri.core.clock import FakeClock
from hri.drive.supervisor_relay import SupervisorRelay
from hri.robot import Robot
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for
from tests.devices import TYPED

ASIDE = "Just say: you may move again."


def live(robot, seconds, lines, deeds=()):
    """What the robot says while lines are typed, and things done, at times; and where it ends."""
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    for time, line in lines.items():
        robot.clock.call_at(time, lambda line=line, time=time: keyboard.type_line(line, time))
    for time, deed in dict(deeds).items():
        robot.clock.call_at(time, lambda deed=deed: deed(robot))
    world = robot.resources.obtain("world", SimulatedWorld)
    events = live_for(robot, seconds, *robot.app.load_tasks())
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    return said, world.base.pose.x


def companion(app="companion"):
    return Robot(str(app), "simulated", clock=FakeClock(), devices=TYPED)


def press_stop(robot):
    robot.context.behavior(SupervisorRelay).halt("someone pressed the stop key")


def touch(robot):
    robot.resources.obtain("world", SimulatedWorld).bump(robot.clock.now())


def test_the_next_order_moves_it_with_the_usual_reply():
    said, x = live(companion(), 10.5, {1: "stop", 3: "go back one meter"})
    assert said == ["I stopped.", "Going back 1 meter."]
    assert x == pytest.approx(-1.0, abs=0.03)


def test_it_goes_on_with_nothing_before_that_and_may_still_be_told_that_it_may():
    lines = {1: "go forward five meters", 4: "stop", 6: "hello", 9: "you may move again"}
    said, x = live(companion(), 13, lines)
    assert said[1:] == [
        "I stopped.",
        "Good morning! It's good to see you.",
        "Thanks. I'll be careful.",
    ]
    assert 0.1 < x < 1.0


@pytest.mark.parametrize(
    ("deed", "why"),
    [
        (press_stop, "I stopped because someone pressed the stop key. "),
        (touch, "I stopped because something touched me. "),
        (lambda robot: robot.events.raise_event("drive.halt"), "I stopped because I was told to. "),
    ],
)
def test_what_stops_it_after_a_spoken_stop_waits_for_a_release(deed, why):
    lines = {1: "stop", 5: "go back one meter", 9: "stop", 12: "turn left", 16: "go forward"}
    said, x = live(companion(), 18, lines, {3: deed})
    assert next(words for words in said if ASIDE in words) == why + ASIDE
    assert sum(ASIDE in words for words in said) == 3
    assert x == pytest.approx(0.0, abs=0.001)


def test_a_key_that_was_pressed_before_the_word_counts():
    said, x = live(companion(), 7, {3: "stop", 5: "go back"}, {1: press_stop})
    assert ASIDE in said[-1]
    assert x == pytest.approx(0.0, abs=0.001)


def test_the_stop_wins_over_what_was_typed_before_it_and_is_heard_later():
    robot = companion()
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)

    def type_all(robot):
        now = robot.clock.now()
        for line in ("what can i say", "go back one meter", "stop"):
            keyboard.type_line(line, now)
            now += 0.01

    said, x = live(robot, 9, {}, {1: type_all})
    assert said[1:3] == ["I stopped.", f"I stopped because someone said stop. {ASIDE}"]
    assert x == pytest.approx(0.0, abs=0.001)


def test_a_line_for_the_listener_counts_as_said():
    robot = companion()

    def type_line(text):
        return lambda robot: robot.context.behavior(Listener).type_line(text)

    said, x = live(robot, 10.5, {}, {1: type_line("stop"), 3: type_line("go back one meter")})
    assert said == ["I stopped.", "Going back 1 meter."]
    assert x == pytest.approx(-1.0, abs=0.03)


DANCE = {
    "app.toml": 'extends = "companion"\n',
    "grammar.jsgf": "#JSGF V1.0; /** @extends companion */ grammar dance;\n"
    "public <dance> = dance for me;\n",
    "replies.toml": '[reply.dance]\nsay = "Look."\naction = "dance"\n',
    "tasks.py": "from hri.robot.verbs import move\n\n\n"
    "async def dance(context):\n    await move(context, -0.5)\n",
}
ALONE = {
    "__init__.py": "",
    "app.toml": 'networks = ["alone.xml"]\ntasks = ["obey"]\n',
    "alone.xml": '<BehaviorNetwork name="alone" invocation_interval="0.02">\n'
    '  <Behavior id="listener" type="Hri.Recognizer"/>\n'
    '  <Behavior id="guard" type="Hri.BaseGuard"/>\n'
    "</BehaviorNetwork>\n",
    "grammar.jsgf": "#JSGF V1.0; grammar alone;\n"
    "public <stop> = stop;\npublic <dance> = dance for me;\npublic <hello> = hello robot;\n",
}
LOOP = """from hri.robot.verbs import listen, move


async def obey(context):
    while True:
        heard = await listen(context)
        if heard.rule == "dance":
            await move(context, -0.5)
"""
QUEUE = """from hri.robot.verbs import move


async def dance(context):
    await move(context, -0.5)


async def obey(context):
    with context.queue("speech.heard") as queue:
        while True:
            if (await queue.get()).properties["rule"] == "dance":
                context.manager.install(dance)
"""
BY_ITSELF = """from hri.robot.verbs import move


async def obey(context):
    with context.queue("speech.heard", "nobody.came") as queue:
        while True:
            if (await queue.get()).name == "nobody.came":
                await move(context, -0.5)
"""
BORED = """from hri.robot.verbs import listen, move


async def obey(context):
    while await listen(context, timeout=1.5):
        pass
    await move(context, -0.5)
"""


@pytest.fixture
def put(tmp_path):
    def put(files):
        for file, text in files.items():
            (tmp_path / file).write_text(text)
        return tmp_path

    return put


@pytest.mark.parametrize(
    "files",
    [DANCE, {**ALONE, "tasks.py": LOOP}, {**ALONE, "tasks.py": QUEUE}],
    ids=["extends the companion", "listens", "takes events"],
)
def test_a_task_that_is_ordered_moves_after_a_spoken_stop_and_after_no_other(put, files):
    app = put(files)
    _, x = live(companion(app), 9, {1: "stop", 3: "dance for me"})
    assert x == pytest.approx(-0.5, abs=0.03)
    _, x = live(companion(app), 9, {1: "stop", 3: "dance for me"}, {2: press_stop})
    assert x == pytest.approx(0.0, abs=0.001)


@pytest.mark.parametrize("tasks", [BY_ITSELF, BORED])
def test_a_task_that_moves_for_another_reason_does_not_lift_a_spoken_stop(put, tasks):
    app = put({**ALONE, "tasks.py": tasks})
    come = {3: lambda robot: robot.events.raise_event("nobody.came")}
    assert live(companion(app), 8, {}, come)[1] == pytest.approx(-0.5, abs=0.03)
    assert live(companion(app), 6, {1: "stop", 2: "hello robot"}, come)[1] == 0.0


def test_a_function_of_a_script_that_is_ordered_moves_after_a_spoken_stop():
    with Robot(config="simulated", clock=FakeClock(), devices=TYPED) as robot:
        robot.when_heard("move", lambda **tags: robot.move(-0.5))
        listener = robot.context.behavior(Listener)
        listener.type_line("stop")
        robot.wait(1.0)
        listener.type_line("go back")
        robot.wait(4.0)
        world = robot.resources.obtain("world", SimulatedWorld)
        assert world.base.pose.x == pytest.approx(-0.5, abs=0.03)
