"""Robots of a fleet, for real, on the loopback network."""

import threading
from contextlib import contextmanager, suppress

import numpy as np
import pytest

pytest.importorskip("zenoh", reason="the extra zenoh is not installed")

from hri.core.errors import HriError
from hri.core.signals import Frame, Utterance
from hri.net.zenoh.fleet import ALL, fleet
from hri.net.zenoh.remote_slot import SILENCE
from hri.net.zenoh.session import FleetSettings
from tests.net.conftest import WITHIN
from tests.net.zenoh.robots import until

READS = '<Link from="board.anna/level" to="double.input"/>'
TAKES = '<Link from="board.wish" to="double.input"/>'


@contextmanager
def looking(names):
    """The fleet as soon as these robots are in it."""
    with fleet(FleetSettings()) as found:
        assert until(lambda: set(names) <= set(found.names()))
        yield found


def test_a_slot_of_another_robot_is_read_and_empties_when_it_ends(living):
    anna, berta = living("anna"), living("berta", READS)
    level, silent = berta.board.slot("anna/level"), []
    berta.robot.events.subscribe("fleet.silent", lambda event: silent.append(event.properties))
    assert until(lambda: level.value == 5.0)
    assert level.datatype == "double"
    assert level.age < WITHIN
    anna.end()
    assert until(lambda: silent == [{"robot": "anna", "slot": "anna/level"}])
    assert level.value is None


def test_a_robot_that_begins_again_is_read_again(living):
    anna, berta = living("anna"), living("berta")
    level = berta.board.slot("anna/level")
    assert until(lambda: level.value == 5.0)
    anna.end()
    assert until(lambda: level.value is None)
    living("anna")
    assert until(lambda: level.value == 5.0)
    assert 0.0 <= level.age < 1.0


def test_a_port_of_a_network_of_another_robot_is_read(living):
    living("anna")
    port = living("berta").board.slot("anna/anna.five.value")
    assert until(lambda: port.value == 5.0)


def test_a_value_is_written_to_another_robot_and_ends_with_its_writer(living):
    anna, berta = living("anna", TAKES), living("berta")
    berta.board.slot("anna/wish").set(3.0, 0.0)
    wish, silent = anna.board.slot("wish"), []
    anna.robot.events.subscribe("fleet.silent", lambda event: silent.append(event.properties))
    assert until(lambda: wish.value == 3.0)
    assert anna.robot.clock.now() - wish.spoken <= SILENCE + 1.0
    assert wish.writer == "berta"
    berta.end()
    assert until(lambda: silent == [{"robot": "berta", "slot": "wish"}])
    assert wish.value is None


def test_a_picture_is_read(living):
    anna, berta = living("anna"), living("berta")
    image = np.full((48, 64, 3), 90, np.uint8)
    anna.board.slot("seen").set(Frame(image, 0.0, 3), 0.0)
    seen = berta.board.slot("anna/seen")
    assert until(lambda: seen.value is not None)
    assert (seen.datatype, seen.value.sequence) == ("image", 3)
    assert np.abs(seen.value.image.astype(int) - image).max() < 8


def test_what_is_computed_elsewhere_comes_first_and_the_own_takes_over(living):
    links = '<Link from="board.wish" to="double.input"/><Link from="five.value" to="double.input"/>'
    anna, berta = living("anna", links), living("berta")
    assert until(lambda: "anna" in anna.robot.networks.runners)
    double = anna.robot.networks.runners["anna"].network["double"]
    assert until(lambda: double.input.value == 5.0)
    berta.board.slot("anna/wish").set(3.0, 0.0)
    assert until(lambda: double.input.value == 3.0)
    berta.end()
    assert until(lambda: double.input.value == 5.0)


@pytest.mark.parametrize("value", ["text", Utterance("go", "move")])
def test_a_value_of_another_type_does_not_come_in(living, value):
    anna, berta = living("anna", TAKES), living("berta")
    berta.board.slot("anna/wish").set(value, 0.0)
    berta.board.slot("anna/other").set(1.0, 0.0)
    assert until(lambda: anna.member.complaints >= 2)
    assert anna.board.slot("wish").value is None
    assert anna.board.slot("other").value is None


def test_robots_are_listed_and_asked(living):
    anna = living("anna")
    events = []
    anna.robot.events.subscribe("fleet.asked", events.append)
    with looking(["anna"]) as found:
        assert found.names() == ["anna"]
        state = found.ask("anna", "state", {})
        assert (state["app"], state["networks"]) == ("anna", ["anna"])
        assert found.chosen([ALL]) == ["anna"]
        found.ask("anna", "stop", {})
        with pytest.raises(HriError, match='no request "dance"'):
            found.ask("anna", "dance", {})
        for wrong in ({"reader": "x", "addresses": 5}, {"reader": 5, "addresses": ["x"]}):
            with pytest.raises(HriError, match=r"addresses is not a list|at most"):
                found.ask("anna", "want", wrong)
        with pytest.raises(HriError, match="list of at most"):
            found.ask("anna", "run", {"task": "x", "arguments": 5})
        with pytest.raises(HriError, match='no task "run_all"'):
            found.ask("anna", "run", {"task": "run_all"})
        with pytest.raises(HriError, match=r'no robot "ana" .* "anna"'):
            found.chosen(["ana"])
    assert [one.properties["verb"] for one in events] == ["stop", "run", "run"]
    assert events[0].origin == "fleet"


def test_who_does_not_know_the_token_gets_and_does_nothing(living, monkeypatch):
    anna = living("anna")
    events = []
    anna.robot.events.subscribe("fleet.asked", events.append)
    with looking(["anna"]):
        monkeypatch.setenv("HRI_TOKEN", "another-token-of-many-letters")
        with fleet(FleetSettings()) as stranger, pytest.raises(HriError, match="HRI_TOKEN"):
            stranger.ask("anna", "stop", {})
    assert events == []


def test_two_robots_cannot_have_one_name(living):
    living("anna")
    with looking(["anna"]):
        second = living("anna")
        assert until(lambda: second.failed)
    assert "already" in str(second.failed[0])


def test_what_happens_is_watched(living):
    living("anna")
    with looking(["anna"]) as found:
        over = threading.Event()

        def ask_until_over():
            while not over.wait(0.05):
                found.ask("anna", "release", {})

        asking = threading.Thread(target=ask_until_over)
        asking.start()
        watched = found.events(["anna"], WITHIN)
        event = next(one for one in watched if one["event"] == "fleet.asked")
        over.set()
        asking.join(WITHIN)
    assert (event["robot"], event["verb"], event["origin"]) == ("anna", "release", "fleet")


def test_who_comes_later_is_watched_and_who_goes_ends_nothing(living):
    with fleet(FleetSettings()) as found:
        watched = found.events([ALL], WITHIN)
        first, second = living("anna"), None
        robots = set()
        over = threading.Event()

        def ask_until_over():
            while not over.wait(0.05):
                for name in found.names():
                    with suppress(HriError):
                        found.ask(name, "release", {})

        asking = threading.Thread(target=ask_until_over)
        asking.start()
        for event in watched:
            robots.add(event["robot"])
            if second is None:
                first.end()
                second = living("berta")
            if robots == {"anna", "berta"}:
                break
        over.set()
        asking.join(WITHIN)
    assert robots == {"anna", "berta"}


@pytest.mark.parametrize("name", ["Anna", "an na", "a/b", "*", "", "x" * 40])
def test_a_name_is_plain(name):
    if name:
        with pytest.raises(HriError, match="cannot name a robot"):
            FleetSettings(name)


def test_other_machines_need_a_word():
    with pytest.raises(HriError, match="--allow-remote"):
        FleetSettings("anna", connect=("tcp/192.168.1.5:7447",))


SPEED = '<Behavior id="crash" type="Hri.StopCrash"/><Link from="crash.velocity" to="{}"/>'
TURN = (
    '<Behavior id="wheels" type="Hri.DriveSystem"/><Link from="{}" to="wheels.angular_velocity"/>'
)


@pytest.mark.parametrize(
    ("sends", "reads", "warned"),
    [
        ("board.speed", "board.anna/speed", "anna/speed"),
        ("board.berta/turn", "board.turn", "turn"),
        ("board.speed", "board.anna/anna.crash.velocity", "anna/anna.crash.velocity"),
    ],
)
def test_a_value_that_means_something_else_is_warned_of(living, caplog, sends, reads, warned):
    living("anna", SPEED.format(sends))
    living("berta", TURN.format(reads))
    line = (
        f"fleet: anna sends Evolution.LinearVelocity, but {warned} is read as"
        " Evolution.AngularVelocity"
    )
    assert until(lambda: line in [one.message for one in caplog.records])
