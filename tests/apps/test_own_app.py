"""Apps that extend the companion: own commands, replies and tasks, and what starts these."""

import re

import pytest

from hri.cli.main import main
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, AuthoringErrors, HriError
from hri.robot import Robot, load_app
from hri.simulation.world import SimulatedWorld
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for
from tests.devices import TYPED

JOKE = {
    "app.toml": 'extends = "companion"\n',
    "grammar.jsgf": "#JSGF V1.0; /** @extends companion */ grammar twister;\n"
    "public <twister> = tell me a twister;\n",
    "replies.toml": '[reply.twister]\nsay = "What is brown and sticky? A stick."\n',
}
TIMER = {
    **JOKE,
    "grammar.jsgf": "#JSGF V1.0; /** @extends companion */ grammar timer;\n"
    "import <numbers.small>;\n"
    "public <timer> = set a timer for <small> (second | seconds) {seconds=$number};\n",
    "replies.toml": '[reply.timer]\nsay = "Okay."\naction = "timer"\n',
    "tasks.py": "async def timer(context, seconds: float) -> str:\n"
    "    await context.clock.sleep(seconds)\n"
    '    return f"{seconds:g} seconds are over."\n',
}


@pytest.fixture
def put(tmp_path):
    def put(files, name="mine"):
        folder = tmp_path / name
        folder.mkdir(exist_ok=True)
        for file, text in files.items():
            (folder / file).write_text(text)
        return folder

    return put


def robot_of(folder):
    return Robot(str(folder), "simulated", clock=FakeClock(), devices=TYPED)


def live(robot, seconds, lines=(), then=()):
    """What happens while these lines are typed at times, and these things done at times."""
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    for time, line in dict(lines).items():
        robot.clock.call_at(time, lambda line=line, time=time: keyboard.type_line(line, time))
    for time, deed in dict(then).items():
        robot.clock.call_at(time, deed)
    return live_for(robot, seconds, *robot.app.load_tasks())


def named(events, name):
    return [event for event in events if event.name == name]


def said(events):
    return [event.properties["text"] for event in named(events, "speech.said")]


def test_a_twister_is_five_lines_in_a_folder_of_ones_own(put):
    assert sum(text.count("\n") for text in JOKE.values()) == 5
    robot = robot_of(put(JOKE))
    events = live(robot, 8, {1.0: "tell me a twister", 5.0: "what is your name"})
    assert said(events) == ["What is brown and sticky? A stick.", "My name is Robin."]


def test_an_action_is_a_task_of_the_app_with_the_tags_as_arguments(put):
    events = live(robot_of(put(TIMER)), 7, {1.0: "set a timer for four seconds"})
    assert said(events) == ["Okay.", "4 seconds are over."]
    assert named(events, "speech.said")[1].time == pytest.approx(5.1, abs=0.3)


IMMEDIATE = """from hri.task import immediate

@immediate
def timer(context, seconds: float) -> str | None:
    return "That is too long for me." if seconds > 60 else None
"""


@pytest.mark.parametrize(
    ("order", "answer"),
    [("five seconds", "Okay."), ("ninety seconds", "That is too long for me.")],
)
def test_what_a_task_of_one_step_returns_is_said_instead_of_the_reply(put, order, answer):
    robot = robot_of(put({**TIMER, "tasks.py": IMMEDIATE}))
    assert said(live(robot, 4, {1.0: f"set a timer for {order}"})) == [answer]


def test_an_event_starts_an_action_of_the_companion(put):
    app = 'extends = "companion"\n[on]\n"bedtime.came" = "sleep"\n'
    robot = robot_of(put({**JOKE, "app.toml": app}))
    bedtime = {3.0: lambda: robot.events.raise_event("bedtime.came")}
    events = live(robot, 7, {1.0: "what is your name", 5.0: "what is your name"}, bedtime)
    assert said(events) == ["My name is Robin."]


def test_a_list_of_words_is_an_argument(put):
    files = {
        "grammar.jsgf": "#JSGF V1.0; /** @extends companion */ grammar pizza;\n"
        "public <pizza> = a pizza (with <topping> {toppings+=$topping})+;\n"
        "<topping> = ham {topping=ham} | corn {topping=corn};\n",
        "replies.toml": '[reply.pizza]\naction = "bake"\n',
        "tasks.py": "async def bake(context, toppings: tuple[str, ...]) -> str:\n"
        '    return " and ".join(toppings)\n',
    }
    events = live(robot_of(put({**JOKE, **files})), 4, {1.0: "a pizza with ham with corn"})
    assert said(events) == ["ham and corn"]


def test_its_grammar_may_have_the_suffix_of_sphinx(put):
    files = {name.replace(".jsgf", ".gram"): text for name, text in JOKE.items()}
    robot = robot_of(put(files))
    assert said(live(robot, 4, {1.0: "tell me a twister"})) == [
        "What is brown and sticky? A stick."
    ]


def test_an_action_is_a_task_of_an_entry_point(put):
    replies = '[reply.twister]\naction = "Hri.SpeakNow"\n'
    with pytest.raises(AuthoringError, match=r'replies.toml:2:1: unknown task "Hri.SpeakNow" - '):
        robot_of(put({**JOKE, "replies.toml": replies}))
    robot = robot_of(put({**JOKE, "replies.toml": replies.replace("SpeakNow", "Speak")}))
    assert said(live(robot, 4, {1.0: "tell me a twister"})) == ["tell me a twister"]


def test_a_reply_raises_an_event_that_starts_a_task(put):
    files = {
        "replies.toml": '[reply.timer]\nevent = "timer.wanted"\n',
        "app.toml": 'extends = "companion"\n[on]\n"timer.wanted" = "timer"\n',
        "tasks.py": TIMER["tasks.py"].replace("seconds: float", "seconds: float = 60.0"),
    }
    events = live(robot_of(put({**TIMER, **files})), 8, {1.0: "set a timer for four seconds"})
    assert named(events, "timer.wanted")[0].properties["seconds"] == 4.0
    assert named(events, "task.failed") == []


def test_an_event_starts_a_task_once_until_it_is_over(put):
    tasks = (
        "async def count(context, event, number=0):\n"
        "    await context.clock.sleep(1.0)\n"
        '    context.events.raise_event("count.done", of=event.name, number=number)\n'
    )
    files = {"app.toml": 'extends = "companion"\n[on]\n"door.*" = ["count"]\n', "tasks.py": tasks}
    robot = robot_of(put({**JOKE, **files}))
    ring = robot.events.raise_event
    then = {time: lambda time=time: ring("door.rung", number=time) for time in (1.0, 1.5, 3.0)}
    done = named(live(robot, 5, (), then), "count.done")
    assert [event.properties for event in done] == [
        {"of": "door.rung", "number": 1.0},
        {"of": "door.rung", "number": 3.0},
    ]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('action = "timer"', 'action = "timmer"', 'action is "timmer" - did you mean "timer"?'),
        ("seconds: float", "minutes: float", 'gives "seconds", which the task timer does not take'),
        (
            "seconds: float",
            "seconds: float, loud: bool",
            'the task timer needs "loud", which <timer> does not give - give loud a default value',
        ),
        (
            "for <small> (second | seconds) {seconds=$number}",
            "[for <small> seconds {seconds=$number}]",
            'the task timer needs "seconds", which <timer> does not always give',
        ),
        ('action = "timer"', 'event = "timer"', '"timer" does not name an event'),
        ('action = "timer"', 'event = "drive.halt"', "is kept for what the robot itself senses"),
    ],
)
def test_what_does_not_fit_is_refused_before_anything_starts(put, old, new, message):
    files = {name: text.replace(old, new) for name, text in TIMER.items()}
    with pytest.raises(AuthoringError) as error:
        robot_of(put(files))
    assert message in str(error.value)
    assert "replies.toml:3:1" in str(error.value)


def test_a_reply_to_a_rule_names_the_grammar_that_is_missing(put):
    folder = put({name: text for name, text in JOKE.items() if name != "grammar.jsgf"})
    with pytest.raises(AuthoringError) as error:
        robot_of(folder)
    assert f"- add the rule to a grammar.jsgf in {folder}" in str(error.value)


def test_a_function_that_is_not_a_task_is_named(put):
    files = {**TIMER, "tasks.py": "def timer(context, seconds: float):\n    pass\n"}
    message = (
        r"timer in tasks.py is not a task - write: async def timer\(context, \.\.\.\), or deco"
    )
    with pytest.raises(AuthoringError, match=message):
        robot_of(put(files))


def test_a_misspelled_extends_is_named(put):
    folder = put({**JOKE, "app.toml": 'extend = "companion"\n'})
    message = r'app.toml:1:1: unknown key "extend" - did you mean "extends"\?'
    with pytest.raises(AuthoringError, match=message):
        load_app(str(folder))


def test_a_folder_without_app_toml_is_named(put):
    folder = put({"replies.toml": JOKE["replies.toml"]})
    with pytest.raises(HriError, match=r"mine has no app\.toml, which makes a folder an app - add"):
        load_app(str(folder))


def test_a_task_that_fails_is_named(put):
    files = {**TIMER, "tasks.py": "async def timer(context, seconds: float):\n    return 1 / 0\n"}
    events = live(robot_of(put(files)), 3, {1.0: "set a timer for four seconds"})
    assert [event.properties["task"] for event in named(events, "task.failed")] == ["timer"]


FAILS = "async def timer(context, seconds: float):\n    raise ValueError('no clock')\n"


def test_a_task_that_fails_says_so_and_the_log_names_file_and_line(put, caplog):
    folder = put({**TIMER, "tasks.py": FAILS})
    events = live(robot_of(folder), 8, {1.0: "set a timer for four seconds"})
    assert "Sorry, my task timer failed." in said(events)
    assert caplog.messages == [f"timer failed: {folder / 'tasks.py'}:2: no clock"]


@pytest.mark.slow
def test_a_task_that_fails_again_and_again_is_told_of_once_a_minute(put):
    orders = dict.fromkeys((1.0, 6.0, 11.0, 66.0), "set a timer for four seconds")
    events = live(robot_of(put({**TIMER, "tasks.py": FAILS})), 72, orders)
    assert said(events).count("Sorry, my task timer failed.") == 2
    assert len(named(events, "task.failed")) == 4


@pytest.mark.parametrize("order", ["be quiet", "go to sleep"])
def test_who_was_asked_for_quiet_does_not_say_that_a_task_failed(put, order):
    app = 'extends = "companion"\n[on]\n"door.rung" = "timer"\n'
    tasks = FAILS.replace("seconds: float", "seconds: float = 1.0")
    robot = robot_of(put({**TIMER, "app.toml": app, "tasks.py": tasks}))
    ring = robot.events.raise_event
    events = live(robot, 9, {1.0: order}, {6.0: lambda: ring("door.rung")})
    assert len(named(events, "task.failed")) == 1
    assert not [words for words in said(events) if "failed" in words]


def test_a_task_of_the_app_that_ends_the_robot_is_told_of_before(put, caplog):
    app = 'extends = "companion"\ntasks = ["brood"]\n'
    tasks = TIMER["tasks.py"] + (
        "async def brood(context):\n    await context.clock.sleep(1.0)\n    return {}['thoughts']\n"
    )
    folder = put({**TIMER, "app.toml": app, "tasks.py": tasks})
    robot = robot_of(folder)
    spoken = []
    robot.events.subscribe("speech.finished", lambda event: spoken.append(event.properties))
    with pytest.raises(ExceptionGroup) as caught:
        live(robot, 20)
    assert caught.group_contains(KeyError, match="thoughts")
    assert [(one["text"], one["cut"]) for one in spoken] == [
        ("Sorry, my task brood failed.", False)
    ]
    assert f"brood failed: {folder / 'tasks.py'}:6: 'thoughts'" in caplog.messages


def test_a_task_that_an_event_may_lack_something_for_is_refused(put):
    app = 'extends = "companion"\n[on]\n"door.rung" = "timer"\n'
    with pytest.raises(HriError, match="timer needs seconds, which an event may lack - give"):
        load_app(str(put({**TIMER, "app.toml": app}))).load_tasks()


def test_an_unknown_task_names_only_what_can_be_meant(put):
    app = 'extends = "companion"\n[on]\n"door.rung" = "sing"\n'
    folder = put({**TIMER, "app.toml": app})
    with pytest.raises(HriError) as error:
        load_app(str(folder)).load_tasks()
    known = ", ".join(sorted([*load_app("companion").task_names(), "timer"]))
    what = f'no task "sing" in {folder}/tasks.py - known are: {known}'
    assert str(error.value) == f"{folder}/app.toml:3:1: {what}"


def test_an_unknown_task_that_runs_from_the_start_is_named_with_its_place(put):
    app = 'extends = "companion"\ntasks = ["sing"]\n'
    folder = put({**TIMER, "app.toml": app})
    with pytest.raises(AuthoringError) as error:
        load_app(str(folder)).load_tasks()
    assert str(error.value).startswith(
        f'{folder}/app.toml:2:1: no task "sing" in {folder}/tasks.py'
    )


def test_own_words_replace_those_of_the_companion(put):
    more = 'name = "Ada"\n[reply.name]\nsay = "{name}!"\n[unasked]\nbump = "Oh!"\n'
    robot = robot_of(put({**JOKE, "replies.toml": more + JOKE["replies.toml"]}))
    bump = {5.0: lambda: robot.events.raise_event("bumper.pressed")}
    events = live(robot, 7, {1.0: "what is your name"}, bump)
    assert said(events) == ["Ada!", "Oh!"]


def test_an_own_rule_hides_one_of_the_companion_and_may_use_it(put):
    grammar = JOKE["grammar.jsgf"] + "public <greet> = howdy | <companion.greet>;\n"
    robot = robot_of(put({**JOKE, "grammar.jsgf": grammar}))
    events = live(robot, 8, {1.0: "howdy", 5.0: "hello robot"})
    assert [event.properties["rule"] for event in named(events, "speech.heard")] == ["greet"] * 2


def test_a_grammar_that_does_not_extend_the_companion_is_all_that_is_heard(put):
    grammar = "#JSGF V1.0; grammar twister;\npublic <twister> = tell me a twister;\n"
    robot = robot_of(put({**JOKE, "grammar.jsgf": grammar}))
    events = live(robot, 9, {1.0: "what is your name", 6.0: "tell me a twister"})
    hint = "I'm not sure. I'm just a small robot."
    assert said(events) == [hint, "What is brown and sticky? A stick."]


def test_a_command_without_a_reply_is_told_where_the_reply_belongs(put):
    folder = put({name: text for name, text in JOKE.items() if name != "replies.toml"})
    with pytest.raises(AuthoringError) as error:
        robot_of(folder)
    assert f"{folder}/replies.toml:1:1: no reply to the rule <twister> of the grammar" in str(
        error.value
    )


def test_an_app_that_extends_itself_is_refused(put, monkeypatch, tmp_path):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    (tmp_path / "apps").mkdir()
    put({"app.toml": 'extends = "two"\n'}, "apps/one")
    put({"app.toml": 'extends = "one"\n'}, "apps/two")
    with pytest.raises(AuthoringError, match=r'app.toml:1:1: "one" has the name of an app that'):
        load_app("one")


@pytest.mark.slow
def test_saved_files_are_taken_while_it_runs(put):
    folder = put(JOKE)
    robot = robot_of(folder)
    grammar = JOKE["grammar.jsgf"] + "public <conundrum> = unwrap a conundrum;\n"
    replies = JOKE["replies.toml"] + '[reply.conundrum]\nsay = "Who am I?"\n'
    then = {
        3.0: lambda: put({"replies.toml": replies}),
        6.0: lambda: put({"grammar.jsgf": grammar}),
        12.0: lambda: put(
            {"replies.toml": replies.replace("[reply.conundrum]", "[reply.conundrm]")}
        ),
    }
    lines = {1.0: "unwrap a conundrum", 9.0: "unwrap a conundrum", 15.0: "tell me a twister"}
    events = live(robot, 19, lines, then)
    assert said(events)[1:] == ["Who am I?", "What is brown and sticky? A stick."]
    refused = named(events, "replies.refused")
    assert [round(event.time) for event in refused] == [3, 12]
    assert 'no rule "conundrm" - did you mean "conundrum"?' in refused[1].properties["error"]
    assert len(named(events, "replies.changed")) == 1


DANCE = {
    **JOKE,
    "replies.toml": '[reply.twister]\naction = "dance"\n',
    "tasks.py": "from hri.robot import verbs\n\n\n"
    "async def dance(context):\n"
    "    await context.clock.sleep(2.0)\n"
    "    for _ in range(9):\n"
    "        await verbs.move(context, 0.2)\n",
}


@pytest.mark.parametrize("stop_at", [2.0, 5.0])
def test_stop_ends_an_own_task_that_drives_or_was_about_to(put, stop_at):
    robot = robot_of(put(DANCE))
    places = {}

    def look(event):
        places[event.time] = event.properties["x_cm"]

    robot.events.subscribe("odometry", look)
    live(robot, 14, {1.0: "tell me a twister", stop_at: "stop"})
    at_stop = [x for time, x in places.items() if time > stop_at + 1.5]
    assert at_stop
    assert max(at_stop) - min(at_stop) < 1.0
    assert (max(places.values()) > 10) is (stop_at == 5.0)


def test_stop_leaves_a_task_that_does_not_drive(put):
    lines = {1.0: "set a timer for six seconds", 3.0: "stop"}
    assert said(live(robot_of(put(TIMER)), 10, lines))[-1] == "6 seconds are over."


@pytest.mark.parametrize(
    ("extends", "message"),
    [
        ("companoin", r'2:5: no grammar "companoin" - did you mean "companion"\?'),
        ("a b", r"2:5: @extends needs the name of one grammar"),
        ("grammar", r'2:5: "grammar" extends itself'),
    ],
)
def test_what_a_grammar_cannot_extend_has_a_place(put, extends, message):
    grammar = (
        f"#JSGF V1.0;\n/** @extends {extends} */\ngrammar twister;\npublic <twister> = a twister;\n"
    )
    with pytest.raises(AuthoringError, match=message):
        robot_of(put({**JOKE, "grammar.jsgf": grammar}))


def test_all_mistakes_of_own_replies_are_told_at_once(put):
    replies = '[reply.twister]\nshow = "hapy"\n[reply.jest]\n'
    with pytest.raises(AuthoringErrors) as error:
        robot_of(put({**JOKE, "replies.toml": replies}))
    assert [e.place.line for e in error.value.errors] == [2, 3]


QUESTION = """[[question]]
ask = "Shall I dance?"
yes = "Here I go."
action = "{}"
"""


@pytest.mark.parametrize(
    "action", ["move", "turn", "come", "follow", "find", "release", "wake", "dance", "Hri.Move"]
)
def test_a_yes_to_a_question_moves_nothing(put, action):
    """Neither an action that moves the base, or lets it move, nor a task that may."""
    files = {**DANCE, "replies.toml": DANCE["replies.toml"] + QUESTION.format(action)}
    with pytest.raises(AuthoringError) as error:
        robot_of(put(files))
    assert f'replies.toml:6:1: action is "{action}" - ' in str(error.value)
    assert "keep, see" in str(error.value)


def test_a_question_may_look_around(put):
    robot_of(put({**DANCE, "replies.toml": DANCE["replies.toml"] + QUESTION.format("see")}))


def shown(robot, times):
    """The expressions that are shown in place of a felt one at these times."""
    seen = {}
    slot = robot.board.slot("expression.override")

    def look(time):
        seen[time] = slot.value.label if slot.value is not None else ""

    return seen, {time: lambda time=time: look(time) for time in times}


def test_what_is_not_understood_is_shown_and_hinted_at_once(put):
    robot = robot_of(put(JOKE))
    seen, looks = shown(robot, [2.0, 5.5])
    lines = {
        1.0: "tell us a twister",
        5.0: "tell us two twisters",
        9.0: "what is your name",
        12.0: "glue a zeppelin",
    }
    events = live(robot, 15, lines, looks)
    assert said(events) == [
        'I almost got that. Try "tell me a twister".',
        'That was close. I do know "tell me a twister".',
        "My name is Robin.",
        "I heard you, but I don't know those words yet.",
    ]
    assert seen == {2.0: "confused", 5.5: "confused"}


def test_what_goes_on_is_answered_by_what_the_talk_is_about(put):
    then = '[[then]]\nafter = ["twister"]\nsay = ["Twist on!"]\n'
    robot = robot_of(put({**JOKE, "replies.toml": JOKE["replies.toml"] + then}))
    lines = {1.0: "tell me a twister", 6.0: "purple and green", 10.0: "purple and green"}
    assert said(live(robot, 14, lines)) == [
        "What is brown and sticky? A stick.",
        "Twist on!",
        "Okay.",
    ]


@pytest.mark.parametrize(
    ("then", "what"),
    [
        ('after = ["twistr"]\nsay = ["A."]', 'no rule "twistr" - did you mean "twister"?'),
        ('after = ["twister"]\nsay = ["{what}."]', "nothing fills in {what}"),
        ('after = ["twister"]\nsays = ["A."]', '"say" is missing'),
    ],
)
def test_a_mistake_in_what_follows_is_refused_with_its_place(put, then, what):
    replies = f"{JOKE['replies.toml']}[[then]]\n{then}\n"
    with pytest.raises(AuthoringError, match=r"replies\.toml:\d+:\d+: ") as refused:
        live(robot_of(put({**JOKE, "replies.toml": replies})), 1, {})
    assert what in str(refused.value)


def test_an_answer_without_words_says_nothing(put):
    silent = JOKE["replies.toml"] + '[unasked]\nasked = ""\n'
    robot = robot_of(put({**JOKE, "replies.toml": silent}))
    events = live(robot, 9, {1.0: "is tuesday a vegetable", 5.0: "tell me a twister"})
    assert said(events) == ["What is brown and sticky? A stick."]


SCREENS = {
    "app.toml": 'extends = "companion"\n',
    "grammar.jsgf": "#JSGF V1.0;\n/** @extends companion */\ngrammar screens;\n"
    "/** @anywhere */\npublic <show> = show the (map {what=map} | clock {what=clock});\n",
    "replies.toml": '[reply.show]\nsay = "Here is the {what}."\n',
}


def test_of_two_phrases_it_asks_which_was_meant(put):
    robot = robot_of(put(SCREENS))
    lines = {1.0: "show the map or show the clock", 6.0: "well show the clock"}
    assert said(live(robot, 10, lines)) == [
        "Do you mean show the clock, or show the map?",
        "Here is the clock.",
    ]


@pytest.mark.slow
def test_what_can_be_said_names_own_commands_first_and_then_others(put):
    robot = robot_of(put(JOKE))
    events = live(robot, 18, {1.0: "what can I say", 10.0: "what can I say"})
    told = [re.findall('"(.+?)"', text) for text in said(events)]
    first, second = filter(None, told)
    assert first[0] == "tell me a twister"
    assert first[-1] == second[-1] == "stop"
    assert len({*first, *second}) == 9


def test_quiet_is_answered_and_shown_and_ends_with_a_greeting(put):
    robot = robot_of(put(JOKE))
    seen, looks = shown(robot, [4.0, 10.0])
    lines = {1.0: "be quiet", 5.0: "what is your name", 7.0: "hello", 11.0: "what is your name"}
    events = live(robot, 14, lines, looks)
    assert [said(events)[0], *said(events)[2:]] == ["Okay, I'll be quiet.", "My name is Robin."]
    assert said(events)[1].startswith("Good morning!")
    assert seen[4.0] == "listening"
    assert seen[10.0] != "listening"


@pytest.mark.slow
def test_quiet_is_over_after_a_minute(put):
    robot = robot_of(put(JOKE))
    seen, looks = shown(robot, [50.0, 63.0])
    events = live(robot, 67, {1.0: "be quiet", 64.0: "what is your name"}, looks)
    assert said(events) == ["Okay, I'll be quiet.", "My name is Robin."]
    assert seen == {50.0: "listening", 63.0: ""}


@pytest.mark.slow
def test_typed_lines_wait_until_it_has_spoken_and_stop_does_not(put):
    robot = robot_of(put({**JOKE, "replies.toml": '[reply.twister]\nsay = "Ha."\n'}))
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    lines = ["what can I say", *["tell me a twister"] * 24, "what is your name"]
    for line in lines:
        keyboard.type_line(line, 0.0)
    events = live(robot, 34)
    assert len(named(events, "speech.heard")) == len(lines)
    assert not any(event.properties["cut"] for event in named(events, "speech.finished"))
    assert said(events)[len(lines) - 1] == "My name is Robin."
    robot = robot_of(put(JOKE, "other"))
    events = live(robot, 6, {1.0: "what can I say", 2.0: "tell me a twister", 2.5: "stop"})
    rules = [(event.properties["rule"], event.time) for event in named(events, "speech.heard")]
    assert [rule for rule, _ in rules] == ["help", "stop", "twister"]
    assert rules[1][1] == pytest.approx(2.6, abs=0.2)


def test_the_companion_lives_in_a_bare_room_and_who_speaks_there_is_missed(tmp_path):
    (tmp_path / "bare.toml").write_text("[robot]\nstart = [0, 0]\n")
    config = tmp_path / "bare.xml"
    text = paths.find("config", "simulated").read_text()
    config.write_text(text.replace('value="home"', 'value="bare.toml"'))
    robot = Robot(config=str(config), clock=FakeClock(), devices=TYPED[:2])
    world = robot.resources.obtain("world", SimulatedWorld)
    with pytest.raises(HriError, match=r"nobody is in this world - add \[person\]"):
        world.say("hello", at=1.0)
    events = live_for(robot, 2.0, *robot.app.load_tasks())
    assert "person.seen" not in {event.name for event in events}


def test_a_network_that_is_missing_is_reported_where_it_is_named(put):
    folder = put(
        {"app.toml": 'networks = [\n  "rovr.xml",\n]\n', "rover.xml": "<BehaviorNetwork/>"}
    )
    with pytest.raises(AuthoringError, match=r'app\.toml:1:1: .*did you mean "rover\.xml"'):
        load_app(str(folder))


def test_an_action_that_no_file_has_names_the_file_for_it(put):
    replies = '[reply.twister]\naction = "steep"\n'
    with pytest.raises(AuthoringError, match=r"tasks\.py is missing"):
        robot_of(put({**JOKE, "replies.toml": replies}))


def test_a_deed_that_fails_leaves_the_others_of_a_new_app(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert main(["new", "app", "rover"]) == 0
    tasks = tmp_path / "rover" / "tasks.py"
    tasks.write_text(tasks.read_text().replace("last: float", "until: float"))
    robot = robot_of(tmp_path / "rover")
    events = live(robot, 8, {1.0: "count to three", 3.0: "hello"})
    assert [event.properties["task"] for event in named(events, "task.failed")] == ["count"]
    assert said(events) == ["Sorry, my task count failed.", "Hello, I am rover."]
