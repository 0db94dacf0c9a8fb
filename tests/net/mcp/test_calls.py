"""What an assistant may ask of a robot, and what it may not, whatever it sends."""

import base64
import json
import math

import cv2
import numpy as np
import pytest
import trio
from hypothesis import given, settings, strategies as st

from hri.conversation.personal_data import Drafts
from hri.core import paths
from hri.core.errors import HriError
from hri.core.origin import MCP
from hri.core.signals import Event
from hri.hal.camera import Camera
from hri.hal.emergency_stop import EmergencyStop
from hri.net.mcp import proposals
from hri.net.mcp.calls import MOST_CALLS
from hri.net.mcp.permission import Kind, Permission
from hri.net.mcp.rate import Rate
from hri.net.mcp.tools import BECAUSE, FARTHEST, SWITCHED_OFF, TOOLS
from hri.simulation.world import SimulatedWorld
from hri.speech.turn import QUESTION
from tests.net.mcp.living import living

pytestmark = pytest.mark.slow


class Generous(Rate):
    def take(self, now):
        return True


GENEROUS = Generous(1, 1)


@pytest.fixture(scope="module")
def moving():
    with living(Permission.MOVING) as assistant:
        assistant.calls._rate = GENEROUS
        yield assistant


@pytest.fixture(scope="module")
def reading():
    with living(Permission.READING, "auto", tasks=False) as assistant:
        assistant.calls._rate = GENEROUS
        yield assistant


@pytest.fixture(autouse=True)
def own_data(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))


@pytest.fixture
def released(moving):
    yield moving
    for base in moving.robot.resources.opened(EmergencyStop):
        moving.run(_soon(base.unlatch))


def _soon(function):
    async def done():
        function()

    return done


def place(assistant):
    (world,) = assistant.robot.resources.opened(SimulatedWorld)
    pose = world.base.pose
    return pose.x, pose.y


def test_it_is_shown_what_the_robot_feels_sees_and_does_and_why(moving):
    state = json.loads(moving.told("state"))
    assert state["app"] == "companion"
    assert state["feeling"]["why"].startswith("I ")
    assert state["eyes"]["camera_is_on"] is True
    assert state["base"]["is_stopped"] is False
    assert "converse" in state["doing"]


def test_the_tools_are_those_that_are_allowed(moving, reading):
    async def names(client):
        return [one.name for one in (await client.list_tools()).tools]

    assert moving.run(names, moving.client) == list(TOOLS)
    kinds = {TOOLS[name].kind for name in reading.run(names, reading.client)}
    assert kinds == {Kind.READS, Kind.STOPS}


@pytest.mark.parametrize("kind", [Kind.EXPRESSES, Kind.MOVES])
def test_who_may_only_look_moves_and_says_nothing(reading, kind):
    before = place(reading)
    for name in (name for name, tool in TOOLS.items() if tool.kind is kind):
        answer = reading.call(name, text="hello", distance_m=1)
        assert answer.is_error
        assert "is not allowed" in answer.content[0].text
    assert place(reading) == before
    assert not reading.heard("speech.said")
    assert reading.heard("mcp.refused")


def test_everyone_may_stop_it(reading):
    assert reading.told("stop") == "stopped; a person has to let it move again"
    assert all(base.is_latched for base in reading.robot.resources.opened(EmergencyStop))


def test_a_call_is_marked_as_from_outside(moving):
    moving.call("say", text="Good day.")
    (said,) = [one for one in moving.heard("speech.said") if one.properties["text"] == "Good day."]
    assert said.origin == MCP
    called = moving.heard("mcp.called")[-1]
    assert called.properties["tool"] == "say"
    assert called.properties["by"] == called.origin == MCP
    assert "Good day." not in str(called.properties)


def test_it_moves_within_limits(released):
    x, y = place(released)
    assert json.loads(released.told("move", distance_m=0.4))["moved_m"] == pytest.approx(
        0.4, abs=0.05
    )
    assert math.dist((x, y), place(released)) < 0.5
    for distance in (FARTHEST * 1.01, -1e9, math.nan, math.inf, 10**400, "2", None, True, [1]):
        before = place(released)
        assert released.call("move", distance_m=distance).is_error
        assert place(released) == before
    assert released.call("move", distance_m=0.1, speed_m_s=5).is_error


def test_whom_a_person_has_stopped_no_assistant_moves_again(released):
    released.call("stop")
    before = place(released)
    for tool, arguments in (
        ("move", {"distance_m": 0.3}),
        ("turn", {"angle_deg": 30}),
        ("say_to_it", {"text": "you may move again"}),
        ("run_task", {"name": "Hri.Wander"}),
    ):
        answer = released.call(tool, **arguments)
        assert answer.is_error
        assert BECAUSE in answer.content[0].text
    assert place(released) == before


def test_stop_ends_what_drives(released):
    async def stopped_on_the_way():
        found = []

        async def moved():
            found.append(await released.client.call_tool("move", {"distance_m": 2}))

        async with trio.open_nursery() as nursery:
            nursery.start_soon(moved)
            await released.context.clock.sleep(1.5)
            await released.client.call_tool("stop", {})
        return found[0]

    x, y = place(released)
    released.run(stopped_on_the_way)
    assert math.dist((x, y), place(released)) < 1.5


def test_a_motion_ends_with_who_asked_for_it(released):
    async def left_on_the_way():
        with trio.CancelScope() as scope:
            async with trio.open_nursery() as nursery:
                nursery.start_soon(released.client.call_tool, "move", {"distance_m": 2})
                await released.context.clock.sleep(1.0)
                scope.cancel()
        await released.context.clock.sleep(2.0)

    x, y = place(released)
    released.run(left_on_the_way)
    after = place(released)
    assert math.dist((x, y), after) < 1.2
    released.run(released.context.clock.sleep, 2.0)
    assert place(released) == pytest.approx(after, abs=0.01)


def test_only_so_many_calls_are_under_way(moving):
    async def many():
        answers = []

        async def one():
            answers.append(await moving.client.call_tool("show", {"expression": "happy"}))

        async with trio.open_nursery() as nursery:
            for _ in range(MOST_CALLS + 4):
                nursery.start_soon(one)
        return [one for one in answers if one.is_error and "under way" in one.content[0].text]

    assert len(moving.run(many)) == 4


def test_only_so_many_calls_a_second_are_taken(moving):
    moving.calls._rate = Rate(3, 0.001)
    try:
        answers = [moving.call("list_authored") for _ in range(6)]
    finally:
        moving.calls._rate = GENEROUS
    assert "too many calls" in answers[-1].content[0].text
    assert not answers[0].is_error


def test_it_sees_only_while_the_camera_is_on(moving):
    picture = moving.call("look").content[0]
    data = np.frombuffer(base64.b64decode(picture.data), np.uint8)
    assert cv2.imdecode(data, cv2.IMREAD_COLOR).shape[1] <= 640
    cameras = moving.robot.resources.opened(Camera)
    for camera in cameras:
        moving.run(_soon(lambda camera=camera: camera.switch(False)))
    try:
        assert moving.told("look") == SWITCHED_OFF
    finally:
        for camera in cameras:
            moving.run(_soon(lambda camera=camera: camera.switch(True)))


def test_a_sentence_of_the_grammar_runs_what_it_means(moving):
    assert json.loads(moving.told("say_to_it", text="hello"))["rule"] == "greet"
    answer = json.loads(moving.told("say_to_it", text="purple banana seven"))
    assert answer["understood"] is False


@pytest.mark.parametrize(
    "text", ["my name is anna", "forget me", "what do you know about me", "i like jazz"]
)
def test_what_is_about_a_person_no_assistant_says(moving, text):
    assert "only a person" in moving.told("say_to_it", text=text)


def test_a_question_is_for_a_person_to_answer(moving):
    slot = moving.context.board.slot(QUESTION)
    moving.run(_soon(lambda: slot.set(True, moving.context.clock.now())))
    try:
        assert "asked a person" in moving.told("say_to_it", text="yes")
    finally:
        moving.run(_soon(slot.clear))


def test_a_question_gets_its_answer(moving):
    async def nodded(context=moving.context):
        await context.wait_for("question.asked")
        moving.robot.visitor.nod()

    moving.run(_soon(lambda: moving.context.manager.install(lambda context: nodded(context))))
    assert json.loads(moving.told("ask", question="Shall I?", seconds=20)) == {"answer": True}
    assert "not a grammar" in moving.told(
        "ask", question="Well?", grammar="apps/companion/face.xml"
    )


def test_no_name_and_no_memory_of_a_person_is_shown(moving):
    bus = moving.robot.events

    def happen():
        bus.raise_event("person.named", person="p1", name="Anastasia")
        bus.raise_event("memory.begun", file="/home/anastasia/people.json")
        bus.raise_event("speech.said", text="Your sister is called Eva.")
        bus.raise_event(
            "speech.heard", text="i like jazz", command="i like jazz", rule="told_of_likes"
        )
        bus.raise_event("speech.heard", text="go forward", command="go forward", rule="move")
        bus.raise_event(
            "speech.heard", text="i am bo", command="i am bo", rule="x", spoken={"n": 1}
        )
        bus.raise_event("speech.rejected", text="a secret", reason="not in grammar")
        bus.raise_event("drive.stopped", reason="done", words="Anastasia stopped me.")

    moving.run(_soon(happen))
    told = moving.told("events", most=9)
    assert not any(
        word in told for word in ("Anastasia", "anastasia", "Eva", "jazz", "secret", "am bo")
    )
    assert "someone stopped me." in told
    assert '"text": "go forward"' in told


def test_only_authored_files_are_read(moving):
    files = json.loads(moving.told("list_authored"))["files"]
    assert {
        "apps/companion/replies.toml",
        "grammars/companion.jsgf",
        "faces/robot/face.toml",
    } <= set(files)
    assert not [name for name in files if name.endswith(".py") or ".." in name]
    for name in files[::40]:
        assert not moving.call("read_authored", name=name).is_error
    for name in (
        "/etc/passwd",
        "../pyproject.toml",
        "grammars/../pyproject.toml",
        "~/.bashrc",
        "grammars",
        "",
        "apps/companion/tasks.py",
        "grammars/companion.jsgf\0",
        "file:///etc/passwd",
    ):
        answer = moving.call("read_authored", name=name)
        assert answer.is_error, name


def test_a_file_is_checked_as_it_is_and_as_it_might_be(moving):
    name = "emotions/personalities/shy.toml"
    assert json.loads(moving.told("check_authored", name=name))["is_fine"]
    told = json.loads(moving.told("check_authored", name=name, text="[mood]\nreturn_s = -1\n"))
    assert told["wrong"] == [f"{name}:2:1: return_s is -1 - write a number from 1 to 86400"]


FOREIGN = {
    "config/networks/follow.xml": '<BehaviorNetwork><Behavior id="a" type="Hri.Listener">'
    '<Parameter name="grammar" value="&#47;etc/passwd"/></Behavior></BehaviorNetwork>',
    "emotions/personalities/shy.toml": 'description = "\\u002fetc/passwd"',
    "apps/companion/replies.toml": 'also = ["../../../etc/passwd"]',
    "grammars/answers.jsgf": '#JSGF V1.0;\ngrammar a;\nimport </etc/passwd.*>;\npublic <y> = yes;',
    "faces/robot/face.toml": 'about = "https://example.org/face"',
}  # fmt: skip


@pytest.mark.parametrize("name", FOREIGN)
def test_a_proposed_text_leads_nowhere_else(moving, name):
    told = json.loads(moving.told("check_authored", name=name, text=FOREIGN[name]))
    assert "leads out of the folders" in told["wrong"][0]
    assert "root:" not in str(told)


def test_a_change_is_kept_as_a_draft_that_changes_nothing(moving):
    name = "emotions/personalities/shy.toml"
    file = paths.house() / name
    before = file.read_text()
    changed = before.replace("0.7", "0.6")
    answer = json.loads(moving.told("propose_change", name=name, text=changed))
    (draft,) = proposals.drafts()
    assert draft.name == answer["kept"]
    assert draft.resolve() in Drafts().places()
    assert draft.read_text() == changed
    assert draft.stat().st_mode & 0o077 == 0
    assert file.read_text() == before
    assert "not kept" in moving.told("propose_change", name=name, text="[mood")
    for number in range(proposals.MOST):
        (proposals.folder() / f".mcp-{number + 2:04}.x.draft").touch()
    assert "the most that are kept" in moving.told("propose_change", name=name, text=changed)


QUICK = [name for name in TOOLS if name not in ("run_task", "ask", "stop")]
KEYS = ["name", "text", "kind", "after", "most", "angle_deg", "expression"]
ELSEWHERE = [
    "../../etc/passwd",
    "/etc/passwd",
    "file:///etc",
    "http://127.0.0.1:1/",
    "\0",
    "\u202e",
]
HOSTILE = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(allow_nan=False, allow_infinity=False),
    st.text(max_size=40), st.just("x" * 100_000), st.lists(st.integers(), max_size=3),
    st.dictionaries(st.text(max_size=5), st.integers(), max_size=3),
    st.sampled_from(ELSEWHERE),
)  # fmt: skip


@pytest.mark.hypothesis
@settings(max_examples=60)
@given(
    tool=st.one_of(st.sampled_from(QUICK), st.text(max_size=20)),
    arguments=st.dictionaries(
        st.one_of(st.sampled_from(KEYS), st.text(max_size=8)),
        HOSTILE, max_size=4,
    ),
)  # fmt: skip
def test_whatever_is_sent_it_stays_where_it_is_and_lives(moving, tool, arguments):
    before = place(moving)
    moving.call(tool, **{key: one for key, one in arguments.items() if key != "tool"})
    assert math.dist(before, place(moving)) < 0.1
    assert not moving.call("state").is_error


def test_an_event_of_another_program_does_not_pass_for_an_assistants(moving):
    with pytest.raises(HriError, match="only the robot itself"):
        moving.robot.events.raise_from_outside(Event("mcp.called", properties={}))
