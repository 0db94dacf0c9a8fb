"""A robot with a studio: what is asked over HTTP happens, and what happens can be seen."""

import math
import os
import re
import signal
import socket
import subprocess
import sys
import threading

import httpx2 as httpx
import jsonschema
import pytest

from hri.core import paths
from hri.core.errors import HriError
from hri.drive.avoidance import ROUTE
from hri.hal.drive import Odometry
from hri.hal.emergency_stop import EmergencyStop
from hri.robot import Robot
from hri.studio.actions import ACTIONS, BECAUSE
from hri.studio.commands import COMMANDS
from hri.studio.request_queue import MOST_REQUESTS, STOP
from hri.studio.session import StudioSession
from tests.studio.living import LONGEST, known, living, told

pytestmark = pytest.mark.slow

REJECTION = {"reason": "not in grammar", "detail": "near: a secret", "text": "a secret"}


def test_there_is_an_action_for_each_command():
    assert ACTIONS.keys() == COMMANDS.keys()


@pytest.fixture(scope="module")
def lived():
    with living() as both:
        yield both


@pytest.fixture
def studio(lived):
    return lived[0]


@pytest.fixture
def robot(lived):
    return lived[1]


@pytest.fixture
def client(studio):
    with known(studio.address()) as made:
        yield made


def test_what_an_operator_says_and_types_is_not_the_robots_own(client, robot):
    client.post("/api/v1/hush")
    heard = []
    robot.events.subscribe("speech.*", heard.append)
    client.post("/api/v1/say", json={"text": "One moment."})
    client.post("/api/v1/hear", json={"text": "hello"})
    client.post("/api/v1/hear", json={"text": "gibberish"})

    def names(origin):
        return {event.name for event in tuple(heard) if event.origin == origin}

    while not names("studio") >= {"speech.said", "speech.finished", "speech.heard"}:
        told(client, "speech", lambda speech: True)
    while "speech.said" not in names("") or "speech.rejected" not in names("studio"):
        told(client, "speech", lambda speech: True)  # its answer is its own
    by_operator = [e.properties["text"] for e in heard if e.origin and e.name == "speech.said"]
    assert by_operator == ["One moment."]


def test_a_refused_command_is_not_told(client, robot):
    asked = []
    listening = robot.events.subscribe("studio.asked", asked.append)
    assert client.post("/api/v1/network_stop", json={"name": "no"}).status_code == 409
    listening.cancel()
    assert not asked


def test_a_typed_sentence_is_heard_and_answered(client, robot):
    heard = []
    robot.events.subscribe("speech.heard", lambda event: heard.append(event.properties["text"]))
    robot.events.subscribe("speech.said", lambda event: heard.append("said"))
    assert client.post("/api/v1/hear", json={"text": "hello"}).status_code == 200
    while heard[-1:] != ["said"] or "hello" not in heard:
        told(client, "speech", lambda speech: True)
    assert "said" in heard[heard.index("hello") :]


def test_stop_needs_no_code_and_latches_until_it_is_released(studio, client, robot):
    client.post("/api/v1/hear", json={"text": "go forward"})
    told(client, "base", lambda base: base["velocity"] and base["velocity"][0] > 0.05)
    with httpx.Client(base_url=studio.address().partition("?")[0]) as stranger:
        assert stranger.post("/api/v1/stop").status_code == 200
        assert stranger.post("/api/v1/release").status_code == 401
    assert all(base.is_latched for base in robot.resources.opened(EmergencyStop))
    base = told(client, "base", lambda base: base["is_stopped"])
    assert base["why"] == f"I stopped because {BECAUSE}"
    client.post("/api/v1/hear", json={"text": "go forward"})
    for _ in range(20):
        assert told(client, "base", lambda base: True)["is_stopped"]
    told(client, "base", lambda base: abs(base["velocity"][0]) < 0.01)
    assert client.post("/api/v1/release").status_code == 200
    told(client, "base", lambda base: not base["is_stopped"])


def test_a_loop_that_was_held_up_stops_before_anything_else_whatever_else_was_asked(
    studio, client, robot
):
    is_held, goes_on, order = threading.Event(), threading.Event(), []

    def hold():
        is_held.set()
        goes_on.wait()

    halted = robot.events.subscribe("drive.halt", lambda event: order.append("stop"))
    robot.clock.soon(hold)
    is_held.wait()
    try:
        robot.clock.soon(lambda: order.append("what was due"))
        with httpx.Client(base_url=studio.address().partition("?")[0]) as stranger:
            for number in range(2 * MOST_REQUESTS):
                assert stranger.get(f"/?code=x{number}").status_code == 303
            answer = stranger.post("/api/v1/stop")
            for number in range(2 * MOST_REQUESTS):
                assert stranger.get(f"/?code=y{number}").status_code == 303
        assert (answer.status_code, answer.json()["will_be_done"]) == (409, True)
    finally:
        goes_on.set()
    told(client, "base", lambda base: base["is_stopped"])
    assert order == ["stop", "what was due"]
    halted.cancel()
    assert client.post("/api/v1/release").status_code == 200


def test_the_base_stops_though_whoever_follows_its_events_fails(client, robot):
    broken = robot.events.subscribe("drive.halt", lambda event: 1 / 0)
    client.post("/api/v1/stop")
    broken.cancel()
    assert all(base.is_latched for base in robot.resources.opened(EmergencyStop))
    assert client.post("/api/v1/release").status_code == 200


def test_the_simulated_person_and_things_obey(client):
    assert client.post("/api/v1/visitor_go", json={"x": 1.0, "y": -0.5}).status_code == 200
    there = pytest.approx([1.0, -0.5], abs=0.05)
    world = told(client, "world", lambda world: world["people"][0]["at"] == there)
    assert len(world["walls"]) >= 4
    client.post("/api/v1/place", json={"name": "cup", "x": 1.5, "y": 0.5})
    told(client, "world", lambda w: {"name": "cup", "at": [1.5, 0.5]} in w["things"])
    client.post("/api/v1/obstacle", json={"name": "box", "x": 2.5, "y": 0.5})
    told(client, "world", lambda w: [o["at"] for o in w["obstacles"]] == [[2.5, 0.5]])
    for name in ("cup", "box"):
        assert client.post("/api/v1/remove", json={"name": name}).status_code == 200
    told(client, "world", lambda w: not w["obstacles"] and "cup" not in str(w["things"]))
    refused = client.post("/api/v1/visitor_nod", json={"who": "Nobody"})
    assert 'nobody in this world is named "Nobody"' in refused.json()["error"]


@pytest.mark.parametrize("command", ["place", "obstacle", "visitor_go"])
@pytest.mark.parametrize("place", [(100, 100), (-2.6, 0), (0, 3.1), (12.5, 0)])
def test_nothing_is_put_outside_of_the_walls(client, command, place):
    named = {} if command == "visitor_go" else {"name": "far"}
    answer = client.post(f"/api/v1/{command}", json={"x": place[0], "y": place[1], **named})
    assert answer.status_code == 409
    walls = "choose x from -2.5 to 12.5 and y from -2.5 to 3"
    where = f"({place[0]:g}, {place[1]:g})"
    assert answer.json()["error"] == f"{where} is outside of the room's walls - {walls}"


@pytest.mark.parametrize("command", ["place", "obstacle"])
def test_nothing_is_put_onto_the_robot(client, command):
    x, y, _ = told(client, "base", lambda base: base["pose"])["pose"]
    answer = client.post(f"/api/v1/{command}", json={"name": "it", "x": x, "y": y})
    assert answer.status_code == 409
    assert answer.json()["error"].startswith("the robot stands there - choose a place")


def test_only_of_what_was_typed_the_words_of_a_rejection_are_told(studio, client, robot):
    events = []
    studio._link.add_event, tell = events.append, studio._link.add_event
    try:
        robot.clock.soon(lambda: robot.events.raise_event("speech.rejected", **REJECTION))
        client.post("/api/v1/hear", json={"text": "Turn  arround"})
        while len(found := [one for one in events if one["event"] == "speech.rejected"]) < 2:
            told(client, "base", lambda base: True)
    finally:
        studio._link.add_event = tell
    said, typed = found
    assert said.keys() & {"text", "detail", "typed", "nearest"} == set()
    assert (typed["text"], typed["typed"]) == ("Turn  arround", True)
    assert typed["nearest"].startswith("turn ")
    assert typed["detail"].startswith('after "turn": a, ')
    assert typed["detail"].endswith(' - did you mean "around"?')


def test_where_it_was_and_means_to_go_is_shown_in_the_room(client, robot):
    odometry = robot.resources.obtain("odometry", Odometry)
    here = odometry.pose(robot.clock.now())
    ahead = here.x + 2 * math.cos(here.heading), here.y + 2 * math.sin(here.heading)
    route = robot.board.slot(ROUTE)
    route.set(((here.x, here.y), ahead), robot.clock.now() + LONGEST)
    path = told(client, "path", lambda path: path["planned"])
    pose = told(client, "base", lambda base: True)["pose"]
    assert path["planned"][0] == pytest.approx(pose[:2], abs=0.02)
    turned = math.atan2(*(b - a for a, b in reversed(list(zip(*path["planned"], strict=True)))))
    assert math.isclose(math.cos(turned - pose[2]), 1.0, abs_tol=0.01)
    route.clear()
    told(client, "path", lambda path: not path["planned"])
    client.post("/api/v1/hear", json={"text": "go forward"})
    told(client, "path", lambda path: len(path["been"]) > 1)


def test_it_hears_while_the_button_is_held_though_it_is_deaf(client):
    client.post("/api/v1/mute", json={"on": True})
    client.post("/api/v1/talk", json={"on": True})
    assert told(client, "speech", lambda speech: speech["is_held"])["is_muted"]
    told(client, "speech", lambda speech: not speech["is_held"])  # the page has vanished
    client.post("/api/v1/mute", json={"on": False})


def test_what_a_device_lacks_is_shown_with_what_to_do(client, robot):
    robot.resources.notice("camera: no picture for 2 s - see that it is plugged in")
    devices = told(client, "devices", lambda devices: any(d["problem"] for d in devices))
    (camera,) = (one for one in devices if one["problem"])
    assert (camera["id"], camera["state"]) == ("camera", "trouble")
    assert camera["problem"].endswith("plugged in")
    robot.resources.notice("camera: is back")
    told(client, "devices", lambda devices: {one["state"] for one in devices} == {"ok"})
    assert "camera: is back" in [line["text"] for line in told(client, "log", bool)]


def test_eyes_and_ears_can_be_shut_and_opened(client):
    for is_on in (False, True):
        client.post("/api/v1/watch", json={"on": is_on})
        told(client, "people", lambda people, on=is_on: people["is_on"] == on)
        client.post("/api/v1/mute", json={"on": not is_on})
        told(client, "speech", lambda speech, on=is_on: speech["is_muted"] != on)


def test_a_code_works_once(client, studio):
    address = studio.address()
    for is_good in (True, False):
        with known(address) as other:
            assert (other.get("/api/v1/state").status_code == 200) == is_good
    with known(client.post("/api/v1/codes").json()["result"]) as other:
        assert other.get("/api/v1/state").status_code == 200


def test_the_topics_are_those_of_the_page(client):
    told(client, "world", lambda world: True)
    state = client.get("/api/v1/state").json()
    page = (paths.house() / "docs" / "studio.md").read_text()
    named = re.search(r"newest value of each topic: (.*?)\.", page, re.DOTALL)
    assert set(re.findall(r"`(\w+)`", named[1])) == state.keys()
    assert (state["about"]["app"], state["about"]["is_simulated"]) == ("companion", True)
    assert {"camera", "microphone", "drive"} <= {one["id"] for one in state["devices"]}
    assert -1 <= state["feeling"]["pleasure"] <= 1
    assert state["base"]["ranges"][0]["id"] == "range_front"
    assert state["base"]["has_battery"]
    assert 0.9 < state["base"]["battery"] <= 1.0


def test_what_the_robot_sends_is_as_the_document_says(client):
    document = client.get("/api/v1/openapi.json").json()
    told(client, "log", bool)
    state = client.get("/api/v1/state").json()
    schema = {**document, "$ref": "#/components/schemas/State"}
    jsonschema.validate(state, schema)
    for topic, value in state.items():
        message = {"topic": topic, "value": value}
        jsonschema.validate(message, {**document, "$ref": "#/components/schemas/LiveMessage"})


EXAMPLES = {
    "hear": {"text": "hello"},
    "say": {"text": "hello"},
    "talk": {"on": False},
    "mute": {"on": False},
    "watch": {"on": True},
    "visitor_say": {"text": "hello"},
    "visitor_go": {"x": 1.5, "y": 0.0},
    "place": {"name": "cup", "x": 1.5, "y": 0.5},
    "obstacle": {"name": "box", "x": 2.5, "y": 0.5},
    "remove": {"name": "box"},
    "network_start": {"path": str(paths.house() / "config" / "networks" / "unit_test.xml")},
    "network_stop": {"name": "unit_test"},
    "network_pause": {"name": "feeling", "on": True},
    "network_tick": {"name": "feeling"},
    "network_break": {"name": "feeling", "port": "emotion.state"},
}
"""What the commands take that take something."""


@pytest.mark.parametrize("command", COMMANDS)
def test_each_command_is_obeyed_and_told(client, robot, command):
    if command == "network_tick":
        paused = {"name": "feeling", "on": True}
        assert client.post("/api/v1/network_pause", json=paused).status_code == 200
    asked = []
    listening = robot.events.subscribe("studio.asked", asked.append)
    arguments = EXAMPLES.get(command, {})
    answer = client.post(f"/api/v1/{command}", json=arguments)
    assert (answer.status_code, answer.json()["result"]) == (200, None)
    listening.cancel()
    told = {} if command == "hear" else arguments
    assert [(one.properties, one.origin) for one in asked] == [
        ({"command": command, "arguments": told}, "studio")
    ]
    if command == "visitor_leave":
        assert client.post("/api/v1/visitor_enter").status_code == 200
    if command == "network_tick":
        going = {"name": "feeling", "on": False}
        assert client.post("/api/v1/network_pause", json=going).status_code == 200
    if command == STOP:
        assert client.post("/api/v1/release").status_code == 200


def test_a_typed_sentence_is_answered_with_what_became_of_it(client):
    def hear(text):
        return client.post("/api/v1/hear", json={"text": text}).json()

    assert hear("hello") == {
        "result": None, "understood": True, "text": "hello", "rule": "greet", "tags": {},
    }  # fmt: skip
    moved = hear("go forward one meter")
    assert (moved["understood"], moved["rule"], moved["tags"]["distance"]) == (True, "move", 1)
    client.post("/api/v1/stop")
    client.post("/api/v1/release")
    strange = hear("purple elephants sing")
    assert (strange["understood"], strange["reason"]) == (False, "not in grammar")
    assert strange["detail"]
    document = client.get("/api/v1/openapi.json").json()
    about = document["paths"]["/api/v1/hear"]["post"]["responses"]["200"]["description"]
    assert all(
        f"`{key}`" in about for key in (*moved.keys() - {"result"}, *strange.keys() - {"result"})
    )


def test_what_is_typed_and_not_understood_gets_an_answer_aloud(client, robot):
    said = []
    robot.events.subscribe("speech.said", lambda event: said.append(event.properties["text"]))
    client.post("/api/v1/hush")
    client.post("/api/v1/hear", json={"text": "turn the lights on"})
    while not said:
        told(client, "base", lambda base: True)


def test_what_can_be_said_is_told_by_rule(client):
    shown = told(client, "sayings", bool)
    by_rule = {one["rule"]: one for one in shown}
    assert by_rule["turn"]["examples"][0] == "turn left"
    assert by_rule["turn"]["about"].startswith("On the spot")
    assert by_rule["help"]["examples"][0] == "what can I say"
    assert "yes" not in by_rule


def test_a_push_against_the_base_is_felt(client, robot):
    felt = []
    robot.events.subscribe("bumper.pressed", felt.append)
    assert client.post("/api/v1/bump").status_code == 200
    while not felt:
        told(client, "base", lambda base: True)


def test_an_action_that_fails_is_answered_and_the_robot_goes_on(client, monkeypatch, caplog):
    monkeypatch.setitem(ACTIONS, "hush", lambda asked: 1 / 0)
    refused = client.post("/api/v1/hush")
    assert refused.status_code == 409
    assert refused.json()["error"].startswith("hush failed: ZeroDivisionError")
    assert "hush failed" in caplog.text
    assert client.post("/api/v1/hear", json={"text": "hello"}).status_code == 200


def test_a_server_that_is_killed_comes_back_on_the_same_port_with_the_same_cookie(client, studio):
    killed = studio.server
    os.kill(killed, signal.SIGKILL)
    told(client, "base", lambda base: studio.server != killed)


def test_a_second_start_names_the_first_and_its_page(studio):
    holder = rf"process {os.getpid()} has it: .* - its page is (\S+);"
    second = "from hri.studio.port import listening; import sys; listening(int(sys.argv[1]), False)"
    words = [sys.executable, "-c", second, str(studio.port)]
    ended = subprocess.run(words, capture_output=True, text=True, check=False)
    with known(re.search(holder, ended.stderr)[1]) as client:
        assert client.get("/api/v1/state").status_code == 200


def test_a_port_that_is_taken_is_refused_with_what_to_do():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        robot = Robot("companion", "simulated", notice=lambda _: None)
        holder = rf"cannot listen on 127.0.0.1:{port}: process {os.getpid()} has it: .* - end it"
        with pytest.raises(HriError, match=holder):
            StudioSession(robot, port)
        robot.close()
