"""A robot with a studio: what is asked over HTTP happens, and what happens can be seen."""

import os
import re
import signal
import socket

import httpx2 as httpx
import pytest

from hri.core import paths
from hri.core.errors import HriError
from hri.hal.emergency_stop import EmergencyStop
from hri.robot import Robot
from hri.studio.actions import ACTIONS, BECAUSE
from hri.studio.commands import COMMANDS
from hri.studio.session import StudioSession
from tests.studio.living import known, living, told


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
    assert [base.is_latched for base in robot.resources.opened(EmergencyStop)] == [True]
    base = told(client, "base", lambda base: base["is_stopped"])
    assert base["why"] == f"I stopped because {BECAUSE}"
    client.post("/api/v1/hear", json={"text": "go forward"})
    for _ in range(20):
        assert told(client, "base", lambda base: True)["is_stopped"]
    told(client, "base", lambda base: abs(base["velocity"][0]) < 0.01)
    assert client.post("/api/v1/release").status_code == 200
    told(client, "base", lambda base: not base["is_stopped"])


def test_the_simulated_person_and_things_obey(client):
    assert client.post("/api/v1/visitor_go", json={"x": 1.0, "y": -0.5}).status_code == 200
    there = pytest.approx([1.0, -0.5], abs=0.05)
    world = told(client, "world", lambda world: world["people"][0]["at"] == there)
    assert len(world["walls"]) >= 4
    client.post("/api/v1/place", json={"name": "cup", "x": 1.5, "y": 0.5})
    told(client, "world", lambda w: {"name": "cup", "at": [1.5, 0.5]} in w["things"])


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


def test_a_server_that_is_killed_comes_back_on_the_same_port_with_the_same_cookie(client, studio):
    killed = studio.server
    os.kill(killed, signal.SIGKILL)
    told(client, "base", lambda base: studio.server != killed)


def test_a_port_that_is_taken_is_refused_with_what_to_do():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        robot = Robot("companion", "simulated", notice=lambda _: None)
        holder = rf"cannot listen on 127.0.0.1:{port}: process {os.getpid()} has it: .* - end it"
        with pytest.raises(HriError, match=holder):
            StudioSession(robot, port)
        robot.close()
