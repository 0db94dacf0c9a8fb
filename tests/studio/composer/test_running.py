"""Networks are started, paused, stepped, and watched from outside while the robot lives."""

import base64
import json
from itertools import groupby

import cv2
import numpy as np
import pytest
import trio
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.robot import Robot
from hri.studio.link import NETWORK, REASON, THUMBNAIL
from hri.studio.network_watch import NetworkWatch
from hri.studio.port_values import MOST_NUMBERS, shown, thumbnail, written
from hri.studio.running import RunningNetworks
from tests.devices import BLIND, SMALL_SCREEN

pytestmark = pytest.mark.slow

COUNTING = """<BehaviorNetwork invocation_interval="0.01">
  <Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="half" type="Hri.Scale"><Parameter name="factor" value="0.5"/></Behavior>
  <Behavior id="end" type="Hri.InputCollector"/>
  <Link from="three.value" to="half.input"/>
  <Link from="half.scaled" to="end.input"/>
  <Link from="half.scaled" to="board.half"/>
</BehaviorNetwork>"""
DRIVING = """<BehaviorNetwork>
  <Behavior id="drive" type="Hri.DriveSystem"/>
</BehaviorNetwork>"""


@pytest.fixture
def robot():
    devices = [SMALL_SCREEN, BLIND]
    with Robot(config="simulated", clock=FakeClock(), seed=1, devices=devices) as robot:
        robot.wait(0.2)
        yield robot


@pytest.fixture
def running(robot):
    return RunningNetworks(robot.networks)


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "counting.xml"
    path.write_text(COUNTING)
    return str(path)


def row(running, name):
    (found,) = (one for one in running.listed() if one["name"] == name)
    return found


def in_loop(robot, work, *arguments):
    async def job(context):
        return work(*arguments)

    return robot.run(job)


def started(robot, running, *arguments):
    async def job(context):
        await running.start(context, *arguments)

    robot.run(job)


def test_a_file_runs_beside_the_app_and_ends(robot, running, file):
    started(robot, running, file)
    robot.wait(1.0)
    found = row(running, "counting")
    assert (found["path"], found["is_own"], found["is_paused"]) == (file, True, False)
    assert found["ticks"] > 80
    assert {one["is_own"] for one in running.listed() if one["name"] != "counting"} == {False}
    in_loop(robot, running.stop, "counting")
    assert "counting" not in {one["name"] for one in running.listed()}


def test_a_text_runs_without_being_saved_in_the_place_of_what_ran(robot, running, file):
    started(robot, running, file)
    started(robot, running, file, COUNTING.replace("0.01", "0.5"))
    assert row(running, "counting")["interval"] == 0.5
    with pytest.raises(HriError, match="Scael"):
        started(robot, running, file, COUNTING.replace("Hri.Scale", "Hri.Scael"))
    assert row(running, "counting")["interval"] == 0.5, "what ran goes on"


def test_a_network_that_is_the_whole_app_takes_its_own_drive_over(tmp_path):
    path = tmp_path / "alone.xml"
    path.write_text(DRIVING)
    with Robot(str(path), "simulated", clock=FakeClock(), devices=[SMALL_SCREEN]) as robot:
        robot.wait(0.2)
        running = RunningNetworks(robot.networks, robot.app.is_network)
        for text in ("", DRIVING.replace("<B", "<!-- again -->\n<B")):
            started(robot, running, str(path), text)
            robot.wait(0.2)
        assert row(running, "alone")["is_own"]
        with pytest.raises(HriError, match="Scael"):
            started(robot, running, str(path), COUNTING.replace("Hri.Scale", "Hri.Scael"))
        assert row(running, "alone")["ticks"] > 0, "what ran goes on"
        in_loop(robot, running.stop, "alone")
        assert running.listed() == []


@pytest.mark.parametrize(
    ("name", "text", "why"),
    [
        ("x.xml", DRIVING, 'steers "drive" with the rank'),
        ("moving.xml", COUNTING, "the app runs a network"),
        ("x.txt", COUNTING, "name an .xml file"),
        ("x.xml", "", "x.xml"),
        ("x.xml", "<a", "x.xml:1"),
    ],
)
def test_what_cannot_run_is_refused_and_the_robot_goes_on(
    robot, running, tmp_path, name, text, why
):
    before = [one["name"] for one in running.listed()]
    with pytest.raises(HriError, match=why):
        started(robot, running, str(tmp_path / name), text)
    assert [one["name"] for one in running.listed()] == before
    robot.wait(0.5)


def test_networks_of_the_app_pause_but_do_not_end(robot, running):
    with pytest.raises(HriError, match="belongs to the app"):
        running.stop("feeling")
    in_loop(robot, running.pause, "feeling", True)
    ticks = row(running, "feeling")["ticks"]
    in_loop(robot, running.tick, "feeling")
    robot.wait(1.0)
    assert row(running, "feeling")["ticks"] == ticks + 1
    in_loop(robot, running.pause, "feeling", False)
    robot.wait(1.0)
    assert row(running, "feeling")["ticks"] > ticks + 5


def test_a_breakpoint_is_shown_and_says_why_it_paused(robot, running, file):
    started(robot, running, file)
    running.break_at("counting", "half.scaled", "> 1")
    robot.wait(0.5)
    found = row(running, "counting")
    assert found["breakpoint"] == {"port": "half.scaled", "condition": "> 1"}
    assert found["is_paused"]
    assert found["hit"] == "half.scaled > 1: 1.5"
    with pytest.raises(HriError, match="write < 30"):
        running.break_at("counting", "half.scaled", "1")
    assert row(running, "counting")["breakpoint"] is not None
    running.break_at("counting", "half.scaled", "")
    assert row(running, "counting")["breakpoint"] is None


def test_a_network_that_is_the_whole_app_is_tried_in_its_place_with_its_breakpoint(tmp_path):
    path = tmp_path / "alone.xml"
    path.write_text(COUNTING)
    with Robot(str(path), "simulated", clock=FakeClock(), devices=[SMALL_SCREEN]) as robot:
        running = RunningNetworks(robot.networks, is_alone=True)
        running.break_at("alone", "half.scaled", "> 2")
        started(robot, running, str(path), COUNTING.replace('value="0.5"', 'value="0.8"'))
        robot.wait(0.5)
        found = row(running, "alone")
        assert (found["is_own"], found["hit"]) == (True, "half.scaled > 2: 2.4")
        started(robot, running, str(path), COUNTING.replace("half", "part"))
        robot.wait(0.5)
        found = row(running, "alone")
        assert (found["is_paused"], found["breakpoint"]) == (False, None)


class Told:
    """Stands for the link: what it was told last, and what is wanted."""

    def __init__(self):
        self.wanted = {NETWORK: [], THUMBNAIL: [], REASON: []}
        self.values, self.is_reading = {}, True

    def wanted_of(self, kind):
        return self.wanted[kind]

    def put(self, topic, value):
        self.values[topic] = value

    def put_later(self, topic, written):
        self.values[topic] = json.loads(written()) if self.is_reading else written


def watched(robot, running, script):
    """Let a script (coroutine function) look at what a page would get, told in its argument."""
    told = Told()
    watch = NetworkWatch(robot.networks, told, running.has_breakpoint)

    async def look(context):
        async with trio.open_nursery() as nursery:
            nursery.start_soon(watch.watch, context)
            await script(told, context.clock.sleep)
            nursery.cancel_scope.cancel()

    robot.run(look)


def test_values_come_while_they_are_wanted(robot, running, file):
    started(robot, running, file)

    async def script(told, sleep):
        await sleep(0.5)
        assert told.values["ports"] == {}
        told.wanted[NETWORK] = ["counting", "nobody"]
        await sleep(0.5)
        values = told.values["ports"]["counting"]
        assert values["values"] == {"three.value": 3, "half.scaled": 1.5, "board.half": 1.5}
        assert set(values["cost"]) >= {"three", "half", "end"}
        assert {len(one) for one in values["cost"].values()} == {4}
        assert values["resting"] == []
        assert list(told.values["ports"]) == ["counting"]
        running.pause("counting", True)
        await sleep(0.3)
        told.wanted[NETWORK] = []
        await sleep(0.3)
        assert told.values["ports"] == {}
        told.wanted[NETWORK] = ["counting"]
        await sleep(0.3)
        paused = told.values["ports"]["counting"]
        assert paused["values"]["half.scaled"] == 1.5, "a page that comes later sees it, too"
        running.pause("counting", False)
        told.wanted[NETWORK] = []
        await sleep(0.3)
        assert robot.networks.runners["counting"].after_tick == []

    watched(robot, running, script)


def test_reasons_come_while_they_are_wanted(robot, running, file):
    started(robot, running, file)

    async def script(told, sleep):
        wanted = ["counting/board.half", "counting/half.nothing", "nobody/x.y"]
        told.wanted[REASON] = wanted
        await sleep(2.0)
        reasons = told.values["reasons"]
        assert list(reasons) == wanted[:2]
        assert reasons[wanted[0]] == [
            {"port": "board.half", "value": 1.5, "words": "written by half.scaled"},
            {"port": "half.scaled", "value": 1.5, "words": "Hri.Scale makes it of its inputs"},
            {"port": "three.value", "value": 3, "words": "Hri.Constant makes it: parsed_value = 3"},
        ]
        assert 'has no port "half.nothing"' in reasons[wanted[1]][0]["words"]
        told.wanted[REASON] = []
        await sleep(2.0)
        assert told.values["reasons"] == {}

    watched(robot, running, script)


def test_the_values_at_which_it_paused_are_there_for_a_page_that_comes_afterward(
    robot, running, file
):
    started(robot, running, file)

    async def script(told, sleep):
        running.break_at("counting", "board.half", "> 1")
        await sleep(1.0)
        running.break_at("counting", "board.half", "> 2")
        running.pause("counting", False)
        await sleep(0.3)
        running.break_at("counting", "board.half", "sent")
        await sleep(0.3)
        told.wanted[NETWORK] = ["counting"]
        await sleep(0.3)
        assert told.values["ports"]["counting"]["values"]["half.scaled"] == 1.5

    watched(robot, running, script)


def test_what_was_sent_once_is_shown_though_the_server_is_slow(robot, running, file):
    pulse = """<BehaviorNetwork name="counting" invocation_interval="0.01">
      <Behavior id="step" type="Hri.InputCollector"/>
      <Behavior id="half" type="Hri.Scale"><Parameter name="factor" value="0.5"/></Behavior>
      <Link from="half.scaled" to="step.input"/>
    </BehaviorNetwork>"""
    started(robot, running, file, pulse)

    async def script(told, sleep):
        told.wanted[NETWORK] = ["counting"]
        await sleep(0.5)
        assert told.values["ports"]["counting"]["values"]["half.scaled"] is None
        told.is_reading = False
        await sleep(0.1)
        robot.networks.inject("counting", "half", "input", 8.0)
        await sleep(0.2)
        waiting, told.is_reading = told.values["ports"], True
        assert json.loads(waiting())["counting"]["values"]["half.scaled"] is None
        halves = []
        for _ in range(30):
            await sleep(0.01)
            if not callable(told.values["ports"]):
                halves.append(told.values["ports"]["counting"]["values"]["half.scaled"])
        assert [one for one, _ in groupby(halves)] == [4.0, None]

    watched(robot, running, script)


def test_pictures_come_small():
    with Robot(config="simulated", clock=FakeClock(), seed=1, devices=[SMALL_SCREEN]) as robot:
        wanted = "seeing/camera.raw_image"

        async def script(told, sleep):
            told.wanted[THUMBNAIL] = [wanted, "seeing/camera.is_watching", "nobody/x.y"]
            await sleep(2.0)
            assert list(told.values["thumbnails"]) == [wanted]
            assert 500 < len(told.values["thumbnails"][wanted]) < 8000
            assert told.values["ports"] == {}
            told.wanted |= {NETWORK: ["seeing"], THUMBNAIL: []}
            await sleep(0.5)
            seen = told.values["ports"]["seeing"]["values"]["camera.raw_image"]
            assert seen is None or seen["kind"] == "image"
            assert told.values["thumbnails"] == {}

        watched(robot, RunningNetworks(robot.networks), script)


@pytest.mark.parametrize(("width", "shown_width"), [(640, 96), (50, 50)])
def test_a_picture_is_at_most_as_wide_as_a_thumbnail(width, shown_width):
    data = base64.b64decode(thumbnail(np.zeros((400, width, 3), np.uint8)))
    assert cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR).shape[1] == shown_width


@pytest.mark.parametrize(
    ("value", "as_shown"),
    [
        (None, None),
        (True, True),
        (1 / 3, 0.333333),
        (float("inf"), "inf"),
        ("x" * 1000, "x" * 80),
        ((1.0, 2.0), {"kind": "array", "shape": [2], "head": [1.0, 2.0]}),
        ((), {"kind": "array", "shape": [0], "head": []}),
        (np.zeros((2, 3)), {"kind": "array", "shape": [2, 3], "head": [0.0] * 6}),
        (1e300, 1e300),
        (-0.0, 0.0),
        (float("nan"), "nan"),
    ],
)
def test_values_are_short(value, as_shown):
    assert shown(value) == as_shown
    assert json.loads(written(value)) == as_shown


class Nasty:
    """A value that cannot be looked at."""

    _fields = ("x",)

    @property
    def x(self):
        raise RuntimeError("no")


def test_a_value_that_cannot_be_looked_at_is_named():
    assert json.loads(written(Nasty())) == {"kind": "value", "text": "Nasty"}


@given(st.floats() | st.text() | st.booleans() | st.none() | st.tuples(st.floats(), st.floats()))
def test_every_value_can_be_written(value):
    assert json.loads(written(value)) == shown(value)


def test_a_long_array_is_cut():
    assert len(shown(tuple(float(one) for one in range(1000)))["head"]) == MOST_NUMBERS
