"""Networks are started, paused, stepped, and watched from outside while the robot lives."""

import json

import pytest
import trio

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.robot import Robot
from hri.studio.link import RobotEnd
from hri.studio.port_values import MOST_NUMBERS, shown
from hri.studio.running import RunningNetworks
from tests.devices import BLIND, SMALL_SCREEN

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
def link():
    made = RobotEnd()
    yield made
    made.close()


@pytest.fixture
def running(robot, link):
    return RunningNetworks(robot.networks, link)


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


def test_a_file_runs_beside_the_app_and_ends(robot, running, file):
    in_loop(robot, running.start, file)
    robot.wait(1.0)
    found = row(running, "counting")
    assert (found["path"], found["is_own"], found["is_paused"]) == (file, True, False)
    assert found["ticks"] > 80
    assert {one["is_own"] for one in running.listed() if one["name"] != "counting"} == {False}
    in_loop(robot, running.stop, "counting")
    assert "counting" not in {one["name"] for one in running.listed()}


def test_a_text_runs_without_being_saved_in_the_place_of_what_ran(robot, running, file):
    in_loop(robot, running.start, file)
    in_loop(robot, running.start, file, COUNTING.replace("0.01", "0.5"))
    assert row(running, "counting")["interval"] == 0.5
    with pytest.raises(HriError, match="Scael"):
        in_loop(robot, running.start, file, COUNTING.replace("Hri.Scale", "Hri.Scael"))
    assert row(running, "counting")["interval"] == 0.5, "what ran goes on"


def test_a_network_that_is_the_whole_app_takes_its_own_drive_over(tmp_path, link):
    path = tmp_path / "alone.xml"
    path.write_text(DRIVING)
    with Robot(str(path), "simulated", clock=FakeClock(), devices=[SMALL_SCREEN]) as robot:
        robot.wait(0.2)
        running = RunningNetworks(robot.networks, link, robot.app.is_network)
        for text in ("", DRIVING.replace("<B", "<!-- again -->\n<B")):
            in_loop(robot, running.start, str(path), text)
            robot.wait(0.2)
        assert row(running, "alone")["is_own"]
        with pytest.raises(HriError, match="Scael"):
            in_loop(robot, running.start, str(path), COUNTING.replace("Hri.Scale", "Hri.Scael"))
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
        in_loop(robot, running.start, str(tmp_path / name), text)
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
    in_loop(robot, running.start, file)
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


def test_values_come_while_they_are_wanted(robot, link, running, file):
    told = {}
    link.put = told.__setitem__
    in_loop(robot, running.start, file)

    async def look(context):
        async with trio.open_nursery() as nursery:
            nursery.start_soon(running.watch, context)
            await context.clock.sleep(0.5)
            assert told["ports"] == {}
            link.wanted = frozenset({"network:counting", "network:nobody"})
            await context.clock.sleep(0.5)
            values = told["ports"]["counting"]
            assert values["values"] == {"three.value": 3, "half.scaled": 1.5, "board.half": 1.5}
            assert set(values["cost"]) >= {"three", "half", "end"}
            assert values["resting"] == []
            running.pause("counting", True)
            await context.clock.sleep(0.3)
            assert told["ports"]["counting"]["values"]["half.scaled"] == 1.5, "it stays in sight"
            link.wanted = frozenset()
            await context.clock.sleep(0.2)
            assert told["ports"] == {}
            nursery.cancel_scope.cancel()

    robot.run(look)
    assert robot.networks.runners["counting"].after_tick == []


def test_pictures_come_small(link):
    with Robot(config="simulated", clock=FakeClock(), seed=1, devices=[SMALL_SCREEN]) as robot:
        running = RunningNetworks(robot.networks, link)
        told = {}
        link.put = told.__setitem__
        link.wanted = frozenset({"network:seeing", "thumbnail:seeing/camera.raw_image"})

        async def look(context):
            async with trio.open_nursery() as nursery:
                nursery.start_soon(running.watch, context)
                await context.clock.sleep(2.0)
                nursery.cancel_scope.cancel()

        robot.run(look)
        (picture,) = told["thumbnails"].values()
        assert 500 < len(picture) < 8000
        assert told["ports"]["seeing"]["values"]["camera.raw_image"]["kind"] == "image"


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
    ],
)
def test_values_are_short(value, as_shown):
    assert shown(value) == as_shown
    json.dumps(shown(value), allow_nan=False)


def test_a_long_array_is_cut():
    assert len(shown(tuple(float(one) for one in range(1000)))["head"]) == MOST_NUMBERS
