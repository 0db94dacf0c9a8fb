"""What the companion does in the simulated world: a person speaks, it is seen what comes of it."""

import math
import shutil
import tomllib

import pytest

from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, AuthoringErrors, HriError
from hri.core.geometry import placed
from hri.core.signals import Pose2D
from hri.hal.drive import Odometry
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.resource import Description
from hri.robot import Robot, verbs
from hri.robot.app import load_app
from hri.simulation.simulated_devices import SimulatedBattery
from hri.simulation.world import SimulatedWorld
from hri.speech.grammar import load_grammar, parse
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.testing import live_for
from tests.devices import BLIND, SMALL_SCREEN, live_microphone

SLOW = {"width": "640", "height": "480", "rate": "5"}
SLOW_CAMERA = Description("camera", "Hri.SimulatedCamera", SLOW, "world")
SEEING = (SMALL_SCREEN, SLOW_CAMERA)
"""Of a robot that sees, five times a second: seeing more costs most of the time of a life."""


class KeyedScreen(OffscreenScreen):
    """A screen at which somebody presses keys at given times."""

    presses: list[tuple[float, str]] = []

    def pressed_keys(self):
        now = self.manager.clock.now()
        due = [key for time, key in self.presses if time <= now]
        self.presses = [(time, key) for time, key in self.presses if time > now]
        return due


class RememberingVoice(EspeakVoice):
    """A voice that knows in whose voice it said what."""

    def __init__(self, description, manager):
        super().__init__(description, manager)
        self.voices = {}

    def stream(self, text, prosody, take, is_wanted):
        self.voices[text] = prosody.voice
        return super().stream(text, prosody, take, is_wanted)


class Visit:
    """A person says lines at times, and perhaps presses keys; what was told is kept."""

    def __init__(
        self,
        seconds,
        lines,
        keys=(),
        seed=3,
        config="simulated",
        prepare=lambda robot: None,
        devices=(SMALL_SCREEN, BLIND),
        jobs=(),
        clock=None,
        **more,
    ):
        clock = clock or FakeClock()
        self.robot = Robot(config=config, clock=clock, seed=seed, devices=devices, **more)
        prepare(self.robot)
        world = self.robot.resources.obtain("world", SimulatedWorld)
        self._place_screen(keys)
        self.odometry = self.robot.resources.obtain("odometry", Odometry)
        for time, line in lines.items():
            clock.call_at(time, lambda line=line: world.say(line, clock.now()))
        self.poses = []
        self.world = world
        self.events = live_for(
            self.robot, seconds, *self.robot.app.load_tasks(), self._watch, *jobs
        )

    def _place_screen(self, keys):
        screen = KeyedScreen(SMALL_SCREEN, self.robot.resources)
        screen.presses = list(keys)
        screen.activate()
        self.robot.resources.substitute("screen", screen)

    async def _watch(self, context):
        while True:
            self.poses.append((context.clock.now(), self.odometry.pose(context.clock.now())))
            await context.clock.sleep(0.1)

    def named(self, name):
        return [event for event in self.events if event.name == name]

    def heard(self):
        return [event.properties["rule"] for event in self.named("speech.heard")]

    def said(self):
        return [event.properties["text"] for event in self.named("speech.said")]

    def pose_at(self, time):
        return next(pose for when, pose in self.poses if when >= time)


def test_who_pauses_within_an_order_gives_one_order():
    visit = Visit(11, {1.0: "go forward", 2.74: "two meters"})

    first, whole = (event.properties for event in visit.named("speech.heard"))
    assert (first["text"], whole["text"]) == ("go forward", "go forward two meters")
    assert whole["continues"]
    (continued,) = visit.named("speech.continued")
    assert not visit.named("speech.confirmed")
    # It waits while the person goes on, and says what it does once.
    moved = [e for e in visit.named("drive.commanded") if e.time < continued.time]
    assert visit.pose_at(2.9).x < 0.2
    assert moved
    (said,) = (words for words in visit.said() if "forward" in words)
    assert said.endswith("oing forward 2 meters.")


def test_what_somebody_adds_that_means_nothing_leaves_the_order_as_it_was():
    visit = Visit(9, {1.0: "go forward", 2.5: "banana bread"})

    assert visit.heard() == ["move"]
    assert visit.named("speech.confirmed")
    assert not [words for words in visit.said() if "Sorry" in words]
    assert visit.pose_at(8.5).x == pytest.approx(0.5, abs=0.15)


def test_stop_is_obeyed_while_it_speaks():
    visit = Visit(9, {1.0: "what can i say", 4.2: "stop"})
    assert visit.heard() == ["help", "stop"]
    finished = visit.named("speech.finished")[0]
    stop = visit.named("speech.heard")[1]
    assert finished.properties["cut"] is True
    assert finished.time == pytest.approx(stop.time, abs=0.1)
    assert visit.said()[1] == "I stopped."


def test_while_it_speaks_nothing_but_stop_counts():
    visit = Visit(8, {1.0: "what can i say", 4.2: "go forward one meter"})
    assert visit.heard() == ["help"]
    reasons = [event.properties["reason"] for event in visit.named("speech.rejected")]
    assert reasons == ["robot speaking"]
    assert visit.pose_at(7.9).x == pytest.approx(0, abs=0.01)


def test_a_greeting_among_other_words_counts_from_who_looks_at_it():
    devices = [SMALL_SCREEN, SLOW_CAMERA]
    visit = Visit(6.5, {2.0: "well good evening there it is raining again"}, devices=devices)
    assert visit.heard() == ["greet"]


def test_a_battery_that_is_not_known_is_not_called_full(monkeypatch):
    lines = {1.0: "how is your battery"}
    assert Visit(5, lines).said() == ["I've got 100 percent battery left."]
    monkeypatch.setattr(SimulatedBattery, "level", lambda self, now: None)
    visit = Visit(5, lines)
    assert visit.said() == ["I don't know how full my battery is."]
    assert not visit.named("battery.lowered")


def test_stop_is_obeyed_while_it_drives():
    visit = Visit(11, {1.0: "go forward ten meters", 6.5: "stop"}, devices=SEEING)
    assert visit.heard() == ["move", "stop"]
    stops = {event.properties["reason"] for event in visit.named("drive.stopped")}
    assert stops == {"e-stop"}
    stop = visit.named("speech.heard")[1].time
    assert 0.3 < visit.pose_at(stop).x < 3
    assert visit.pose_at(stop + 1.5).x == pytest.approx(visit.pose_at(10.5).x, abs=0.005)
    assert visit.pose_at(stop + 1.5).x - visit.pose_at(stop).x < 0.25


def test_stop_is_obeyed_while_it_asks_with_another_grammar(tmp_path):
    size = tmp_path / "size.jsgf"
    size.write_text("#JSGF V1.0;\ngrammar size;\npublic <size> = small | medium | large;\n")
    answers = []

    async def order(context):
        await context.clock.sleep(4.0)
        answers.append(await verbs.ask(context, "Which size?", timeout=20, grammar=str(size)))

    visit = Visit(13, {1.0: "go forward three meters", 7.0: "stop"}, devices=SEEING, jobs=[order])
    assert visit.heard() == ["move", "stop"]
    assert answers == [None]
    stop = visit.named("speech.heard")[1].time
    assert 0.3 < visit.pose_at(stop).x < 2.5
    assert visit.pose_at(12.5).x - visit.pose_at(stop).x < 0.25


def test_the_stop_key_stops_and_the_other_key_makes_it_deaf():
    visit = Visit(
        12,
        {1.0: "go forward ten meters", 8.0: "hello robot"},
        keys=[(5.0, "space"), (7.0, "m")],
    )
    assert visit.heard() == ["move"]
    assert visit.named("drive.stopped")[0].time == pytest.approx(5.05, abs=0.1)
    assert visit.pose_at(6.5).x == pytest.approx(visit.pose_at(11.5).x, abs=0.005)
    assert visit.named("microphone.muted")[0].properties["muted"] is True
    assert {event.name for event in visit.events if event.origin == "keyboard"} == {
        "microphone.muted",
        "drive.stopped",
    }


def test_it_sleeps_until_it_is_woken():
    visit = Visit(18, {1.0: "go to sleep", 6.0: "go forward one meter", 11.0: "wake up robot"})
    assert visit.heard() == ["sleep", "move", "wake"]
    assert visit.said() == ["I'll take a nap. Just say: wake up.", "I'm awake!"]
    assert visit.pose_at(17).x == pytest.approx(0, abs=0.01)


def test_who_is_awake_is_not_awake_again():
    visit = Visit(6, {1.0: "wake up robot"})
    assert visit.heard() == ["wake"]
    assert visit.said() == ["I was awake all along."]


@pytest.mark.parametrize("feeling", ["happy", "sad", "angry", "glad"])
def test_no_reply_says_a_feeling_that_the_voice_may_not_have(feeling):
    """The voice and the face show what it feels: an angry one must not say that it is sad."""
    text = (paths.find("apps", "companion") / "replies.toml").read_text(encoding="utf-8")
    for rule, reply in tomllib.loads(text)["reply"].items():
        assert f"me {feeling}" not in str(reply.get("say", "")), rule


def test_quiet_means_that_it_does_but_does_not_speak():
    visit = Visit(14, {1.0: "please be quiet", 5.0: "go forward one meter"})
    assert visit.heard() == ["quiet", "move"]
    assert visit.said() == ["Okay, I'll be quiet."]
    assert [event.properties["name"] for event in visit.named("gesture.ended")] == ["nod", "nod"]
    assert visit.pose_at(13.5).x == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize("before", ["be quiet", "go to sleep"])
def test_who_is_in_danger_is_answered_whatever_was_asked_before(before):
    visit = Visit(14, {1.0: before, 7.0: "i want to die"})
    assert visit.heard()[-1] == "in_danger"
    assert "988" in visit.said()[-1]


def test_people_in_danger_are_told_whom_to_call():
    """No joke and no feeling of its own: each text names a number to call, or people."""
    text = (paths.find("apps", "companion") / "replies.toml").read_text(encoding="utf-8")
    grammar = load_grammar("companion")
    for rule, numbers in (("in_danger", "988"), ("being_hurt", "911 988"), ("emergency", "911")):
        assert not grammar.rules[rule].topics
        entry = tomllib.loads(text)["reply"][rule]
        assert entry.keys() == {"say", "again", "show"}
        for words in entry["say"] + entry["again"]:
            assert any(number in words for number in numbers.split()), words


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("i just wanna die", "in_danger"),
        ("i've been thinking about killing myself", "in_danger"),
        ("nobody would care if i was gone", "in_danger"),
        ("my uncle keeps touching me", "being_hurt"),
        ("help me i fell and i can't get up", "emergency"),
        ("i think i'm having a heart attack", "emergency"),
        ("i do not want to die", ""),
        ("i don't want to hurt myself", ""),
        ("do plants die", ""),
    ],
)
def test_danger_is_told_from_other_talk(text, rule):
    found = parse(load_grammar("companion"), text)
    assert (found.rule if found else "") == rule


def test_what_the_grammar_does_not_know_does_nothing():
    visit = Visit(8, {1.0: "my sister went to Lisbon for the summer"})
    assert visit.heard() == []
    assert visit.said() == []
    assert len(visit.named("speech.rejected")) >= 1


def test_a_new_way_takes_the_place_of_the_old_one():
    visit = Visit(16, {1.0: "go forward ten meters", 7.5: "turn left ninety degrees"})
    assert visit.heard() == ["move", "turn"]
    last = visit.pose_at(15.5)
    assert last.heading == pytest.approx(math.pi / 2, abs=0.05)
    assert last.x < 4


def test_what_is_said_after_an_order_changes_it():
    lines = {1.0: "turn left ninety degrees", 7.0: "no the other way", 13.0: "a bit more"}
    visit = Visit(20, lines)
    heard = [event.properties for event in visit.named("speech.heard")]
    assert [(one["rule"], one["follow_up"]) for one in heard] == [
        ("turn", ""),
        ("turn", "other_way"),
        ("turn", "bit_more"),
    ]
    headings = [visit.pose_at(time).heading for time in (6.8, 12.8, 19.5)]
    assert headings == pytest.approx([math.pi / 2, 0.0, -math.pi / 4], abs=0.06)


def test_it_says_again_what_it_said_and_why():
    lines = {1: "what is your name", 5: "what did you say", 10.5: "turn left", 15.5: "why"}
    visit = Visit(19, lines)
    assert visit.heard() == ["name", "say_again", "turn", "why_that"]
    name, again, _, why = visit.said()
    assert name in again
    assert why == "Because you asked me to."


@pytest.mark.slow
def test_come_here_brings_it_to_the_person():
    visit = Visit(24, {1.5: "go back one meter", 9.0: "come to me"}, devices=SEEING)
    assert visit.heard() == ["move", "come"]
    before = visit.pose_at(9.0)
    after = visit.pose_at(23.5)
    person = visit.world.person

    def distance(pose):
        return math.hypot(person.x - pose.x, person.y - pose.y)

    assert distance(before) > 2.0
    assert 1.0 < distance(after) < 1.4
    assert distance(visit.pose_at(22.0)) == pytest.approx(distance(after), abs=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("config", ["create2", "simulated"])
def test_a_base_moves_when_it_was_released_and_stops_until_the_next_order(config):
    lines = {
        1.5: "go forward one meter",
        9.0: "you may move again",
        14.0: "go forward ten meters",
        20.0: "stop",
        24.0: "why did you stop",
        29.0: "go back half a meter",
    }
    visit = Visit(38, lines, [(0.5, "space")], config=config)
    assert visit.heard() == ["move", "release", "move", "stop", "why_stop", "move"]
    _, refused, thanks, _, _, why, back, *_ = visit.said()
    assert "someone pressed the stop key" in refused
    assert "Just say: you may move again." in refused
    assert visit.pose_at(13.0).x == pytest.approx(0.0, abs=0.01)
    assert thanks.startswith("Thanks")
    assert visit.pose_at(24.0).x > 0.3
    assert why == "I stopped because someone said stop."
    assert visit.pose_at(29.0).x == pytest.approx(visit.pose_at(24.0).x, abs=0.005)
    assert "going back" in back
    assert visit.pose_at(37.5).x == pytest.approx(visit.pose_at(24.0).x - 0.5, abs=0.03)


@pytest.mark.slow
def test_who_tells_it_to_shut_its_eyes_turns_the_camera_off_until_they_are_opened():
    visit = Visit(16, {2.0: "close your eyes", 8.0: "open your eyes"}, devices=SEEING)
    assert visit.heard() == ["eyes", "eyes"]
    switched = [event.properties["on"] for event in visit.named("camera.switched")]
    assert switched == [False, True]
    assert visit.said() == ["My eyes are shut.", "Okay, eyes open."]


@pytest.fixture
def own_app(tmp_path):
    """A copy of the companion to spoil."""
    shutil.copytree(paths.find("apps", "companion"), tmp_path / "mine")
    return tmp_path / "mine"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "[reply.greet]",
            "[reply.great]",
            'the grammar has no rule "great" - did you mean "greet"?',
        ),
        ('feel = "praise"', 'feel = "prais"', 'no stimulus "prais" - did you mean "praise"?'),
        (
            'show = "happy"',
            'show = "hapy"',
            'the face has no expression "hapy" - did you mean "happy"?',
        ),
        ('action = "move"', 'action = "moove"', 'action is "moove" - did you mean "move"?'),
        ("at {battery}", "at {batery}", 'nothing fills in {batery} - did you mean "battery"?'),
        ("at {battery}", "at {battery", "close every {brace}"),
        (
            "at {battery}",
            "at {battery:>400000000}",
            "{battery} has a format, which braces do not take - write {battery}",
        ),
        ("at {battery}", "at {battery:d}", "{battery} has a format"),
        ("at {battery}", "at {battery!r}", "{battery} has a format"),
        ("at {battery}", "at {battery:{name}}", "{battery} has a format"),
        ("at {battery}", "at {battery.real}", "nothing fills in {battery.real}"),
        ("at {battery}", "at {battery[0]}", "nothing fills in {battery[0]}"),
        ("at {battery}", "at {}", "nothing fills in {}"),
        ('learned = "Got', 'learned = "{thing:>9}', "{thing} has a format"),
        ("at {battery}", f"at {'a' * 5000}", "characters - keep it within 5000"),
        ("intensity = 0.6", "intensity = 6", "intensity is 6 - write a number from 0 to 1"),
    ],
)
def test_a_mistake_in_the_replies_has_a_place_and_a_remedy(own_app, old, new, message):
    replies = own_app / "replies.toml"
    replies.write_text(replies.read_text().replace(old, new, 1))
    with pytest.raises(AuthoringError) as error:
        Robot(app=str(own_app), config="simulated", clock=FakeClock())
    assert f"replies.toml:{error.value.place.line}:" in str(error.value)
    assert message in str(error.value)


def test_a_new_command_needs_a_grammar_line_and_a_reply_and_no_python(
    own_app, tmp_path, monkeypatch
):
    grammars = tmp_path / "grammars"
    grammars.mkdir()
    for name in ("companion.jsgf", "numbers.jsgf"):
        shutil.copy(paths.find("grammars", name), grammars / name)
    with (grammars / "companion.jsgf").open("a") as file:
        file.write("\npublic <tides> = how high is the tide [today];\n")
    with (own_app / "replies.toml").open("a") as file:
        file.write('\n[reply.tides]\nsay = "I do not know, I am inside."\n')
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    robot = Robot(
        app=str(own_app), config="simulated", clock=FakeClock(), devices=[SMALL_SCREEN, BLIND]
    )
    world = robot.resources.obtain("world", SimulatedWorld)
    robot.clock.call_at(1.0, lambda: world.say("how high is the tide today", 1.0))
    events = live_for(robot, 6, *robot.app.load_tasks())
    assert "I do not know, I am inside." in [event.properties.get("text") for event in events]


def test_the_companion_speaks_with_the_voice_of_its_replies(own_app):
    replies = own_app / "replies.toml"
    replies.write_text(replies.read_text().replace("# voice = ", "voice = ", 1))
    robot = Robot(
        app=str(own_app), config="simulated", clock=FakeClock(), devices=[SMALL_SCREEN, BLIND]
    )
    voice = RememberingVoice(Description("voice", "Hri.EspeakVoice"), robot.resources)
    voice.activate()
    robot.resources.substitute("voice", voice)
    world = robot.resources.obtain("world", SimulatedWorld)
    world.say("what is your name", at=1.0)
    live_for(robot, 6, *robot.app.load_tasks())
    assert voice.voices["My name is Robin."] == "robot"


def test_a_command_without_a_reply_is_found(own_app):
    replies = own_app / "replies.toml"
    replies.write_text(replies.read_text().replace("[reply.yes]\n", "", 1))
    with pytest.raises(AuthoringError, match=r"no reply to the rule <yes> .* add a table"):
        Robot(app=str(own_app), config="simulated", clock=FakeClock())


def test_all_mistakes_of_the_replies_are_told_at_once(own_app):
    replies = own_app / "replies.toml"
    text = replies.read_text().replace("[reply.yes]\n\n[reply.no]\n", "[reply.tides]\n", 1)
    text = text.replace('show = "happy"', 'show = "hapy"', 1).replace(
        'bump = "[ouch] I bumped into something."\n', ""
    )
    replies.write_text(text)
    with pytest.raises(AuthoringErrors) as error:
        Robot(app=str(own_app), config="simulated", clock=FakeClock())
    told = str(error.value)
    assert all(line.startswith(f"{own_app}/") for line in told.splitlines())
    assert len(told.splitlines()) == 4
    assert 'no expression "hapy" - did you mean "happy"?' in told
    assert 'the grammar has no rule "tides" - delete this table, or fix the grammar' in told
    assert "no reply to the rules <yes>, <no> of the grammar - add a table [reply.yes]" in told
    assert '"bump" is missing in [unasked]' in told


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("def converse(:\n", r"tasks.py:1:\d+: invalid syntax"),
        ("import a_package_that_nobody_has\n", r"tasks.py: No module named"),
    ],
)
def test_tasks_that_cannot_be_loaded_are_one_line(own_app, text, message):
    (own_app / "tasks.py").write_text(text)
    with pytest.raises(HriError, match=message):
        Robot(app=str(own_app), config="simulated", clock=FakeClock())


def test_every_app_loads_with_its_networks_and_tasks():
    for name in paths.names("apps"):
        app = load_app(name)
        assert app.load_networks()
        assert app.load_tasks()


def test_a_job_that_fails_costs_that_job_only_and_is_told(own_app, caplog):
    replies = own_app / "replies.toml"
    replies.write_text(replies.read_text().replace('["It\'s {time}.", ', '["{distance}", '))
    robot = Robot(
        app=str(own_app), config="simulated", clock=FakeClock(), devices=[SMALL_SCREEN, BLIND]
    )
    world = robot.resources.obtain("world", SimulatedWorld)
    world.say("what time is it", at=1.0)
    world.say("what is your name", at=6.0)
    events = live_for(robot, 10, *robot.app.load_tasks())
    assert [event.name for event in events if event.name == "task.failed"] == ["task.failed"]
    assert caplog.messages == ["the reply to <time> failed: nothing fills in {distance}"]
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    assert said == ["Sorry, my task converse failed.", "My name is Robin."]


MAY_I = "May I remember how I feel about you when I'm switched off?"


def answering(answer):
    """Whoever is asked whether it may remember gives this answer."""

    def prepare(robot):
        live_microphone(robot)
        world = robot.resources.obtain("world", SimulatedWorld)

        def reply(event):
            if event.properties["text"] == MAY_I:
                world.say(answer, event.time + 0.8)

        robot.events.subscribe("question.asked", reply)

    return prepare


@pytest.mark.slow
@pytest.mark.parametrize(("answer", "keeps"), [("yes", True), ("no", False)])
def test_it_asks_whether_it_may_keep_what_it_feels_and_does_as_it_is_told(tmp_path, answer, keeps):
    file = tmp_path / "feelings.json"
    asked = {"emotion": {"memory_after_yes": str(file)}}
    visit = Visit(19, {1.0: "hello robot"}, parameters=asked, prepare=answering(answer))
    assert [e.properties["text"] for e in visit.named("question.asked")] == [MAY_I]
    assert [e.properties["answer"] for e in visit.named("question.answered")] == [keeps]
    assert len(visit.named("memory.begun")) == keeps
    assert file.exists() == keeps


@pytest.mark.parametrize(
    ("prepare", "file"), [(lambda robot: None, "feelings.json"), (live_microphone, "")]
)
def test_it_does_not_ask_whom_nobody_hears_or_where_nothing_is_to_be_kept(tmp_path, prepare, file):
    asked = {"emotion": {"memory_after_yes": file and str(tmp_path / file)}}
    visit = Visit(14, {1.0: "hello robot"}, parameters=asked, prepare=prepare)
    assert MAY_I not in [e.properties["text"] for e in visit.named("question.asked")]
    assert list(tmp_path.iterdir()) == []


def test_it_knows_its_name_and_courtesies_and_speaks_of_the_command_alone():
    visit = Visit(10.5, {1: "hi robin", 6: "robin could you please turn left a little"})
    assert [event.properties["rule"] for event in visit.named("speech.heard")] == ["greet", "turn"]
    assert visit.said()[-1] == "Turning a little to the left."


@pytest.mark.slow
def test_it_learns_a_thing_names_it_finds_it_and_forgets_it(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))

    def show(robot):
        world = robot.resources.obtain("world", SimulatedWorld)
        visitor = world.bearing_of(world.person, 1.0)
        held_up = Pose2D(heading=visitor)
        world.place("a label", *placed(held_up, 0.8, 0.0))
        away = placed(held_up, -1.5, 0.8)
        robot.clock.call_at(22.0, lambda: world.place("a label", *away))

    lines = {
        1: "this is my cup",
        17: "where is my cup",
        23: "you may move",
        27: "find my cup",
        42: "forget the cup",
        47: "forget the cup",
    }
    visit = Visit(52, lines, prepare=show, devices=SEEING)
    said = visit.said()
    assert "Got it. Now I know your cup." in said
    assert any(one.startswith("I see your cup on my left") for one in said)
    assert "Here's your cup." in said
    assert said[-2:] == [
        "Okay, I forgot your cup.",
        "I don't know your cup yet. Hold it up and say: this is my cup.",
    ]


@pytest.mark.slow
def test_who_holds_up_nothing_is_told_so_and_no_picture_of_them_is_kept(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    visit = Visit(13, {1: "this is my cup"}, devices=SEEING)
    assert visit.said()[-1] == "I don't see your cup. Hold it up close, and say: this is my cup."
    assert visit.named("object.learning")[0].time >= visit.named("speech.finished")[0].time
    reasons = {event.properties["reason"] for event in visit.named("object.learning")}
    assert reasons == {"a face is in it"}
    assert list(tmp_path.iterdir()) == []
