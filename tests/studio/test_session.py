"""A robot with a studio: what is asked over HTTP happens, and what happens can be seen."""

import os
import signal
import socket

import pytest

from hri.core.errors import HriError
from hri.hal.emergency_stop import EmergencyStop
from hri.robot import Robot
from hri.studio.actions import ACTIONS, BECAUSE
from hri.studio.commands import COMMANDS
from hri.studio.session import StudioSession
from tests.studio.living import known, live_with_studio, told


def test_there_is_an_action_for_each_command():
    assert ACTIONS.keys() == COMMANDS.keys()


def test_a_typed_sentence_is_heard_and_answered():
    def script(studio, robot):
        heard = []
        robot.events.subscribe("speech.heard", lambda event: heard.append(event.properties["text"]))
        robot.events.subscribe("speech.said", lambda event: heard.append("said"))
        with known(studio.address()) as client:
            assert client.post("/api/v1/hear", json={"text": "hello"}).status_code == 200
            while "said" not in heard:
                told(client, "speech", lambda speech: True)
        return heard

    assert live_with_studio(script)[:2] == ["hello", "said"]


def test_stop_needs_no_code_and_latches_until_it_is_released():
    def script(studio, robot):
        with known(studio.address()) as client:
            client.post("/api/v1/hear", json={"text": "go forward"})
            told(client, "base", lambda base: base["velocity"] and base["velocity"][0] > 0.05)
            client.cookies.clear()
            assert client.post("/api/v1/stop").status_code == 200
        bases = robot.resources.opened(EmergencyStop)
        stopped = [base.is_latched for base in bases]
        with known(studio.address()) as client:
            base = told(client, "base", lambda base: base["is_stopped"])
            client.post("/api/v1/hear", json={"text": "go forward"})
            for _ in range(20):
                assert told(client, "base", lambda base: True)["is_stopped"]
            rest = told(client, "base", lambda base: abs(base["velocity"][0]) < 0.01)
            assert client.post("/api/v1/release").status_code == 200
            told(client, "base", lambda base: not base["is_stopped"])
        return stopped, base["why"], rest["velocity"]

    stopped, why, velocity = live_with_studio(script)
    assert stopped == [True]
    assert why == f"I stopped because {BECAUSE}"
    assert velocity == pytest.approx([0, 0], abs=0.01)


def test_the_simulated_person_and_things_obey():
    def script(studio, robot):
        with known(studio.address()) as client:
            assert client.post("/api/v1/visitor_go", json={"x": 1.0, "y": -0.5}).status_code == 200
            world = told(
                client,
                "world",
                lambda world: world["people"][0]["at"] == pytest.approx([1.0, -0.5], abs=0.05),
            )
            client.post("/api/v1/place", json={"name": "cup", "x": 1.5, "y": 0.5})
            told(client, "world", lambda w: {"name": "cup", "at": [1.5, 0.5]} in w["things"])
            client.post("/api/v1/watch", json={"on": False})
            told(client, "people", lambda people: not people["is_on"] and not people["persons"])
            client.post("/api/v1/mute", json={"on": True})
            told(client, "speech", lambda speech: speech["is_muted"])
            return world, client.get("/api/v1/state").json()

    world, state = live_with_studio(script)
    assert len(world["walls"]) >= 4
    assert state["about"]["app"] == "companion"
    assert state["about"]["is_simulated"]
    assert {"camera", "microphone", "drive"} <= {one["id"] for one in state["devices"]}
    assert -1 <= state["feeling"]["pleasure"] <= 1
    assert state["base"]["ranges"][0]["id"] == "range_front"


def test_a_code_works_once():
    def script(studio, robot):
        address = studio.address()
        with known(address) as client:
            with known(address) as again:
                assert again.get("/api/v1/state").status_code == 401
            another = client.post("/api/v1/codes").json()["result"]
        with known(another) as client:
            return client.get("/api/v1/state").status_code

    assert live_with_studio(script) == 200


def test_a_server_that_is_killed_comes_back_on_the_same_port_with_the_same_cookie():
    def script(studio, robot):
        with known(studio.address()) as client:
            told(client, "base", lambda base: True)
            for _ in range(3):
                os.kill(studio.server, signal.SIGKILL)
                told(client, "base", lambda base: True)
            return told(client, "base", lambda base: True)["pose"]

    assert live_with_studio(script)


def test_a_port_that_is_taken_is_refused_with_what_to_do():
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        robot = Robot("companion", "simulated", notice=lambda _: None)
        holder = rf"cannot listen on 127.0.0.1:{port}: process {os.getpid()} has it: .* - end it"
        with pytest.raises(HriError, match=holder):
            StudioSession(robot, port)
        robot.close()
