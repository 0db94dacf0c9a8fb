import math
import signal
import threading

import pytest

from hri import Robot
from hri.behavior.library.arithmetic import Addition
from hri.behavior.network import Network
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_log import read_events
from hri.hal.drive import Odometry
from hri.hal.speaker import Speaker
from hri.robot import load_app, verbs
from hri.simulation.world import SimulatedWorld
from hri.speech.behaviors import Listener
from hri.task import navigation, speech
from tests.devices import BLIND, TYPED, UNSEEN


@pytest.fixture
def robot():
    devices = [UNSEEN, BLIND]
    with Robot(config="simulated", clock=FakeClock(), seed=1, devices=devices) as robot:
        yield robot


@pytest.fixture
def seeing_robot():
    devices = [UNSEEN]
    with Robot(config="simulated", clock=FakeClock(), seed=1, devices=devices) as robot:
        yield robot


def test_a_script_speaks_and_time_passes_only_inside_its_verbs(robot):
    said = []
    robot.events.subscribe("speech.*", lambda event: said.append((event.name, event.time)))
    before = robot.clock.now()
    robot.say("Hello, I am a robot.")
    end = robot.clock.now()
    assert 1.0 < end - before < 4.0
    sum(range(300_000))  # what a script does between verbs costs the robot no time
    robot.say("Again.")
    assert [name for name, _ in said] == ["speech.said", "speech.finished"] * 2
    assert said[2][1] - end < 0.2


def test_it_drives_as_far_as_it_is_told(robot):
    odometry = robot.resources.obtain("odometry", Odometry)
    assert robot.move(1.0) == pytest.approx(1.0, abs=0.02)
    assert odometry.pose(robot.clock.now()).x == pytest.approx(1.0, abs=0.02)
    assert robot.turn(math.pi / 2) == pytest.approx(math.pi / 2, abs=0.03)
    assert odometry.pose(robot.clock.now()).heading == pytest.approx(math.pi / 2, abs=0.03)


@pytest.mark.parametrize(("gesture", "answer"), [("nod", True), ("shake", False)])
def test_a_nod_is_yes_and_a_shake_is_no(seeing_robot, gesture, answer):
    robot = seeing_robot
    world = robot.resources.obtain("world", SimulatedWorld)
    robot.wait(2.0)

    def respond(event):
        getattr(world.person, gesture)(event.time + 1.0)

    robot.events.subscribe("question.asked", respond)
    assert robot.ask("Do you like me?") is answer


def test_a_spoken_yes_is_an_answer_too_and_silence_is_none(robot):
    world = robot.resources.obtain("world", SimulatedWorld)
    subscription = robot.events.subscribe(
        "question.asked", lambda event: world.say("yes", event.time + 0.8)
    )
    assert robot.ask("Do you like me?") is True
    subscription.cancel()
    assert robot.ask("Are you there?", timeout=3.0) is None


def test_what_was_unclear_of_an_answer_is_asked_again(robot, tmp_path):
    """The first answer is one that the recognizer would be unsure about in noise."""
    order = tmp_path / "order.jsgf"
    order.write_text(
        "#JSGF V1.0;\ngrammar order;\n"
        "public <order> = a (small {size=small} | large {size=large}) coffee with <milk>;\n"
        "public <milk> = (soy {plantMilk=soy} | oat {plantMilk=oat}) milk;\n"
    )
    asked = []

    def respond(event):
        asked.append(event.properties["text"])
        if len(asked) == 1:
            robot.events.raise_event(
                "speech.rejected", sure={"size": "large"}, unsure=["plantMilk"], reason="", text=""
            )
        else:
            robot.visitor.say("soy milk", after=0.5)

    robot.events.subscribe("question.asked", respond)
    answer = robot.ask("What would you like?", grammar=str(order), retries=1)
    assert asked == ["What would you like?", "Which plant milk?"]
    assert answer.tags == {"size": "large", "plantMilk": "soy"}


@pytest.mark.parametrize(
    ("second", "mark", "expected"),
    [
        ("oat milk", "", {"plantMilk": "oat"}),
        ("soy milk", "", None),
        ("oat milk", "/** @careful */ ", None),
    ],
)
def test_a_value_in_doubt_that_is_heard_twice_counts_unless_the_robot_moves(
    robot, tmp_path, second, mark, expected
):
    milk = tmp_path / "milk.jsgf"
    milk.write_text(
        "#JSGF V1.0;\ngrammar milk;\n"
        f"{mark}public <milk> = (soy {{plantMilk=soy}} | oat {{plantMilk=oat}}) milk;\n"
    )
    heard = iter(("oat milk", second))

    def respond(event):
        if text := next(heard, ""):
            robot.events.raise_event(
                "speech.rejected", sure={}, unsure=["plantMilk"], reason="", text=text
            )

    robot.events.subscribe("question.asked", respond)
    answer = robot.ask("Which?", grammar=str(milk), retries=1, timeout=2.0)
    assert (answer and answer.tags) == expected


def test_an_answer_that_is_also_a_stop_is_both(robot, tmp_path):
    """A grammar of one's own that has "stop" among its answers."""
    grammar = tmp_path / "go_on.jsgf"
    grammar.write_text(
        "#JSGF V1.0;\ngrammar go_on;\npublic <next> = go on {next=more} | stop {next=end};\n"
    )
    rules = []
    robot.events.subscribe("speech.heard", lambda event: rules.append(event.properties["rule"]))
    robot.events.subscribe("question.asked", lambda event: robot.visitor.say("stop", after=0.5))
    answer = robot.ask("Go on?", grammar=str(grammar))
    assert rules == ["stop"]
    assert (answer.rule, answer.tags) == ("next", {"next": "end"})


def test_it_knows_the_noise_of_the_room(robot):
    robot.wait(4.0)
    listener = robot.context.behavior(Listener)
    assert listener.noise_kind.value == "quiet"
    assert listener.noise.value == pytest.approx(-62.0, abs=1.0)


def test_it_hears_the_person(robot):
    world = robot.resources.obtain("world", SimulatedWorld)
    world.say("hello robot", robot.clock.now() + 0.5)
    heard = robot.listen(timeout=5.0)
    assert heard.rule == "greet"
    assert robot.listen(timeout=1.0) is None


def test_an_expression_the_face_does_not_know_is_refused(robot):
    with pytest.raises(HriError, match=r'no expression "hapy" - did you mean "happy"\?'):
        robot.show("hapy")


def test_a_gesture_takes_its_time_and_can_be_cut(robot):
    ended = []
    robot.events.subscribe("gesture.ended", lambda event: ended.append(event.time))
    before = robot.clock.now()
    robot.gesture("nod", seconds=2.0)
    assert robot.clock.now() - before == pytest.approx(2.0, abs=0.1)

    async def cut_short(context):
        with context.clock.move_on_after(0.5):
            await verbs.gesture(context, "yawn")

    before = robot.clock.now()
    robot.run(cut_short)
    robot.wait(0.1)
    assert ended[-1] - before == pytest.approx(0.5, abs=0.05)
    with pytest.raises(HriError, match=r'no gesture "nodd" - did you mean "nod"\?'):
        robot.gesture("nodd")


def test_a_recording_has_all_its_parts(tmp_path):
    with Robot(config="simulated", clock=FakeClock(), record=tmp_path / "out") as robot:
        robot.say("One two three.")
    for name in ("events.jsonl", "face.mp4", "robot.wav", "timeline.png", "feelings.svg"):
        assert (tmp_path / "out" / name).stat().st_size > 100, name
    events = read_events(tmp_path / "out" / "events.jsonl")
    assert [event["text"] for event in events if event["event"] == "speech.said"] == [
        "One two three."
    ]


def test_mistakes_come_before_anything_is_opened(tmp_path):
    with pytest.raises(HriError, match='no "companoin" in apps - did you mean "companion"'):
        Robot(app="companoin")
    config = tmp_path / "bad.xml"
    config.write_text(
        '<Resources><Devices><Device id="a" type="Hri.Speeker"/></Devices></Resources>'
    )
    with pytest.raises(AuthoringError, match=r'did you mean "Hri.Speaker"\?'):
        Robot(config=str(config))


def test_leaving_early_by_an_error_closes_everything():
    robot = Robot(config="simulated", clock=FakeClock())

    def fail_inside():
        with robot:
            robot.resources.obtain("odometry", Odometry)
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail_inside()
    with pytest.raises(RuntimeError, match="not running"):
        robot.say("too late")


def test_a_robot_lives_once_and_only_one_does():
    robot = Robot(config="simulated", clock=FakeClock())
    with robot:
        with pytest.raises(RuntimeError, match="runs already"), robot:
            pass
        with pytest.raises(RuntimeError, match="runs already"), Robot(clock=FakeClock()):
            pass
        robot.wait(0.1)
    with pytest.raises(RuntimeError, match="make a new one"), robot:
        pass


def test_parameters_are_checked():
    with pytest.raises(HriError, match=r"listener.strictness: 2 is out of range"):
        Robot(config="simulated", clock=FakeClock(), parameters={"listener": {"strictness": 2.0}})


def test_closing_goes_on_when_something_does_not_close(tmp_path):
    robot = Robot(config="simulated", clock=FakeClock())
    speaker = robot.resources.obtain("speaker", Speaker)

    def fail():
        raise OSError("the cable is off")

    robot.networks.close = fail
    with pytest.raises(OSError, match="cable"):
        robot.close()
    assert not speaker.is_active


@pytest.mark.proves("T04", "T24")
def test_the_tasks_of_2003_go_through_the_networks_of_a_robot(robot):
    commanded = []
    robot.events.subscribe("drive.commanded", commanded.append)
    said = []
    robot.events.subscribe("speech.said", said.append)
    navigation.DriveMoveDelta(50, 20, 20)
    odometry = robot.resources.obtain("odometry", Odometry)
    assert odometry.pose(robot.clock.now()).x == pytest.approx(0.5, abs=0.02)
    assert max(event.properties["linear"] for event in commanded) <= 0.21
    speech.Speak("Here I am.")
    assert [event.properties["text"] for event in said] == ["Here I am."]
    assert speech.Listen(0.5) is None
    assert not [name for name in robot.networks.runners if name.startswith("own ")]


@pytest.mark.proves("T04")
def test_a_way_that_is_not_free_fails_the_task(robot):
    with pytest.raises(HriError, match=r"got -?\d.* of 19.00 m far - clear the way"):
        navigation.DriveMoveDelta(1900, 40)


@pytest.mark.proves("T24")
def test_a_task_swaps_stops_watches_and_feeds_networks(robot):
    seen = []

    async def meddle(context):
        networks = context.networks
        networks.start(Network("sums", 0.1, [Addition("sum")]))
        watch = networks.watch("sums", "sum", "sum", lambda value, now: seen.append(value))
        networks.inject("sums", "sum", "input", 2.0)
        networks.inject("sums", "sum", "input", 3.0)
        await context.clock.sleep(0.5)
        watch.cancel()
        networks.swap("sums", Network("sums", 0.1, [Addition("other")]))
        assert "sums.other" in context.behaviors
        networks.stop("sums")
        assert "sums.other" not in context.behaviors

    robot.run(meddle)
    assert seen == [5.0]


def test_an_app_cannot_name_a_task_that_needs_arguments(tmp_path):
    (tmp_path / "app.toml").write_text('networks = []\ntasks = ["Hri.Say"]\n')
    with pytest.raises(
        HriError, match=r"app.toml:2:1: Hri.Say: missing a required argument: 'text'"
    ):
        load_app(str(tmp_path)).load_tasks()


def test_what_a_script_catches_of_ctrl_c_has_stopped_the_base(robot):
    def interrupt():
        robot.clock.hold()
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    robot.clock.call_at(robot.clock.now() + 3.0, interrupt)
    with pytest.raises(KeyboardInterrupt):
        robot.move(1.9)
    robot.clock.release()
    assert robot.tasks.running == []
    odometry = robot.resources.obtain("odometry", Odometry)
    robot.wait(2.0)
    before = odometry.pose(robot.clock.now()).x
    robot.wait(3.0)
    assert odometry.pose(robot.clock.now()).x == pytest.approx(before, abs=0.001)
    assert 0.1 < before < 1.5


def test_the_visitor_answers_when_asked_to(robot):
    robot.events.subscribe("question.asked", lambda event: robot.visitor.say("yes", after=0.5))
    assert robot.ask("Do you like me?") is True
    assert robot.visitor is robot.visitor


def test_who_is_not_simulated_cannot_be_told_what_to_do(tmp_path):
    config = tmp_path / "bare.xml"
    config.write_text("<Resources/>")
    app = tmp_path / "app"
    app.mkdir()
    (app / "app.toml").write_text("networks = []\n")
    robot = Robot(str(app), str(config), clock=FakeClock())
    with pytest.raises(
        HriError, match=r'nobody is simulated here - use Robot\(config="simulated"\)'
    ):
        robot.visitor.say("hello")


def test_a_function_of_the_script_is_called_with_the_tags_of_what_is_heard(robot):
    asked = []

    def come(distance=None, **tags):
        asked.append(tags)
        robot.say("As you wish.")

    task = robot.when_heard("turn", come)
    said = []
    robot.events.subscribe("speech.said", lambda event: said.append(event.properties["text"]))
    robot.visitor.say("turn left", after=0.5)
    robot.wait(5.0)
    assert len(asked) == 1
    assert "As you wish." in said
    task.cancel()
    robot.visitor.say("turn left", after=0.5)
    robot.wait(5.0)
    assert len(asked) == 1


def test_a_function_of_the_script_that_a_stop_ended_is_called_again():
    asked = []

    def go(**tags):
        asked.append(tags)
        robot.move(1.0)

    with Robot(config="simulated", clock=FakeClock(), devices=TYPED) as robot:
        robot.when_heard("move", go)
        for line in ("go forward", "stop", "go back"):
            robot.context.behavior(Listener).type_line(line)
            robot.wait(1.5)
    assert [tags["distance"] for tags in asked] == [0.5, -0.5]


def test_a_function_of_the_script_is_called_at_each_event_and_again_after_it_failed(robot, caplog):
    numbers = []

    def note(event):
        numbers.append(event.properties["number"])
        if event.properties["number"] == 1:
            raise ZeroDivisionError("first")

    robot.on("door.*", note)
    robot.wait(0.1)
    for number in (1, 2):
        robot.events.raise_event("door.rung", number=number)
        robot.wait(0.1)
    assert numbers == [1, 2]
    assert "what was to be done at door.* failed: first" in caplog.text


def test_a_script_says_how_fast_and_stops(robot):
    odometry = robot.resources.obtain("odometry", Odometry)
    before = robot.clock.now()
    assert robot.move(0.4, speed=0.1) == pytest.approx(0.4, abs=0.02)
    assert robot.clock.now() - before > 4.0
    going = robot.tasks.install(verbs.move, 5.0)
    robot.wait(2.0)
    assert odometry.velocity(robot.clock.now()).linear > 0.2
    robot.stop()
    assert abs(odometry.velocity(robot.clock.now()).linear) < 0.01
    robot.wait(0.5)
    assert going.is_over


def test_a_rule_that_the_grammar_does_not_have_is_refused(robot):
    with pytest.raises(HriError, match='no rule "trun" in the grammar - did you mean "turn"'):
        robot.when_heard("trun", print)
