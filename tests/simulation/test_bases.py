"""The emulated bases: what they sense in a room, their timing, and their lines."""

import pytest

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Twist
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import FORMATS, SLOT, Create2
from hri.hal.resource import Description
from hri.simulation.bases.body import RoomBody
from hri.simulation.bases.emulated_arduino import EmulatedArduino
from hri.simulation.bases.emulated_base import ArduinoLine
from hri.simulation.bases.emulated_create2 import GROUPS, PASSIVE, SAFE, EmulatedCreate2
from hri.simulation.bases.emulated_line import EmulatedPort, Faults, Line
from hri.simulation.bases.emulator import Wire
from hri.simulation.room import Circle, Room, Wall
from hri.simulation.world import SimulatedWorld
from tests.drive.bases.talk import Talk

SIZES = {"b": 1, "B": 1, "h": 2, "H": 2}


@pytest.fixture
def world(build):
    """A room with a wall one meter ahead."""
    world = build().obtain("world", SimulatedWorld)
    world._furnished = world.room = Room([Wall(1.0, -5.0, 1.0, 5.0)])
    return world


@pytest.fixture
def talk(world):
    talk = Talk(Create2(), Line(EmulatedCreate2(RoomBody(world))))
    talk.greet()
    return talk


@pytest.mark.parametrize(
    ("group", "size"),
    [
        (0, 26),
        (1, 10),
        (2, 6),
        (3, 10),
        (4, 14),
        (5, 12),
        (6, 52),
        (100, 80),
        (101, 28),
        (106, 12),
        (107, 9),
    ],
)
def test_groups_of_packets_have_the_sizes_of_the_specification(group, size):
    assert sum(SIZES[FORMATS[packet]] for packet in GROUPS[group]) == size
    base = EmulatedCreate2()
    base.feed(bytes([128, 142, group]), 0.1)
    assert len(base.feed(b"", 0.2)) == size


def test_it_bumps_into_the_wall_and_says_with_which_side(talk, world):
    talk.run(6.0, Twist(0.3, 0.0))
    assert talk.last.bumps == {"left": True, "right": True}
    assert world.base.pose.x == pytest.approx(1.0 - 0.17, abs=0.02)


@pytest.mark.parametrize(("heading", "side"), [(0.7, "right"), (-0.7, "left")])
def test_a_wall_aside_presses_that_side_of_the_bumper(talk, heading, side):
    talk.run(1.0, Twist(0.0, heading))
    talk.run(6.0, Twist(0.3, 0.0))
    other = {"left": "right", "right": "left"}[side]
    assert talk.last.bumps == {side: True, other: False}


def test_light_bumpers_see_the_wall_come(talk):
    talk.run(1.0, Twist(0.3, 0.0))
    assert talk.last.ranges["center_left"] == float("inf")
    talk.run(1.4, Twist(0.3, 0.0))
    assert talk.last.ranges["center_left"] == pytest.approx(
        talk.last.ranges["center_right"], rel=0.1
    )
    assert talk.last.ranges["center_left"] < talk.last.ranges["left"]


def test_it_stops_by_itself_where_the_floor_ends(talk, world):
    world._drops = (Circle(1.2, 0.0, 0.7),)
    talk.run(6.0, Twist(0.3, 0.0))
    assert talk.last.mode == "passive"
    assert 0.25 < world.base.pose.x < 0.5
    assert talk.last.cliffs["front_left"]
    assert talk.last.cliff_signals["front_left"] < 100


def test_somebody_who_pushes_presses_the_bumper(talk, world):
    world.bump(talk.now)
    talk.run(0.1)
    assert talk.last.bumps == {"left": True, "right": True}


def test_the_battery_is_that_of_the_world(talk, world):
    world.set_battery(0.25, talk.now)
    talk.run(0.1)
    assert talk.last.battery == pytest.approx(0.25, abs=0.01)


def test_a_packet_comes_in_each_slot_and_takes_its_time_on_the_line():
    base = EmulatedCreate2()
    base.feed(bytes([128, 148, 1, 35]), 0.0)
    times = []
    for step in range(1, 1000):
        now = step * 0.0001
        times += [now] * len(base.feed(b"", now))
    assert len(times) == 6 * 5
    # A slot's first byte is there when its ten bits are, its last one five bytes later.
    assert times[0] == pytest.approx(SLOT + 10 / 115_200, abs=0.0002)
    assert times[4] - times[0] == pytest.approx(4 * 10 / 115_200, abs=0.0002)
    assert times[5] - times[0] == pytest.approx(SLOT, abs=0.0002)


def test_bytes_queue_up_behind_each_other():
    wire = Wire(10_000)
    wire.send(b"abc", 0.0)
    wire.send(b"def", 0.001)
    assert wire.arrived(0.0021) == b"ab"
    assert wire.arrived(0.0045) == b"cd"
    assert wire.arrived(1.0) == b"ef"


def test_a_base_that_nobody_asks_for_an_hour_remembers_little():
    base = EmulatedCreate2()
    base.feed(bytes([128, 148, 1, 35]), 0.0)
    assert len(base.feed(b"", 3600.0)) < 1000


def test_in_off_mode_only_a_start_counts():
    base = EmulatedCreate2()
    base.feed(bytes([131, 145, 0, 100, 0, 100]), 0.1)
    assert not base.is_rolling
    base.feed(bytes([128]), 0.2)
    assert base.mode == PASSIVE
    base.feed(bytes([145, 0, 100, 0, 100]), 0.3)
    assert not base.is_rolling
    base.feed(bytes([131, 145, 0, 100, 0, 100]), 0.4)
    assert (base.mode, base.is_rolling) == (SAFE, True)


@pytest.mark.parametrize(
    ("command", "right", "left"),
    [
        ([137, 0, 200, 0x80, 0], 200, 200),
        ([137, 0, 100, 0, 1], 100, -100),
        ([137, 0, 100, 0xFF, 0xFF], -100, 100),
        ([137, 0, 200, 1, 244], 247, 153),
        ([146, 0, 255, 0, 255], 500, 500),
        ([145, 0x7F, 0xFF, 0x80, 0], 500, -500),
    ],
)
def test_every_way_to_drive_turns_the_wheels(command, right, left):
    base = EmulatedCreate2()
    base.feed(bytes([128, 131, *command, 149, 2, 41, 42]), 0.1)
    base.feed(bytes([149, 2, 41, 42]), 0.2)
    answer = base.feed(b"", 0.3)[-4:]
    told = [int.from_bytes(answer[i : i + 2], "big", signed=True) for i in (0, 2)]
    assert told == [right, left]


def test_the_way_since_it_was_last_asked_is_told_once():
    base = EmulatedCreate2()
    base.feed(bytes([128, 131, 145, 0, 200, 0, 200]), 0.0)
    base.feed(b"", 1.0)
    base.feed(bytes([149, 2, 19, 20]), 1.0)
    first = base.feed(b"", 1.01)
    base.feed(bytes([149, 2, 19, 20]), 1.01)
    second = base.feed(b"", 1.02)
    assert 150 < int.from_bytes(first[:2], "big") < 200
    assert int.from_bytes(second[:2], "big") < 10


def test_our_own_firmware_stops_sooner():
    base = EmulatedArduino(auto_stop=0.5)
    base.feed(b"m 20 20\r", 0.0)
    base.feed(b"", 0.4)
    assert base.is_rolling
    base.feed(b"", 0.6)
    assert not base.is_rolling


@pytest.mark.parametrize(
    ("command", "answer"),
    [
        (b"b\r", b" 57600\r\n"),
        (b"e\r", b"0 0\r\n"),
        (b"m 0 0\r", b"OK\r\n"),
        (b"r\r", b"OK\r\n"),
        (b"\r", b"Invalid Command\r\n"),
        (b"hello\r", b"Invalid Command\r\n"),
    ],
)
def test_the_text_protocol_answers_as_the_firmware_of_2012(command, answer):
    base = EmulatedArduino()
    base.feed(command, 0.0)
    assert base.feed(b"", 0.1) == answer


def test_a_line_spoils_the_same_bytes_for_the_same_seed():
    def heard(seed):
        line = Line(EmulatedArduino(), Faults(lost=0.1, damaged=0.1, halved=0.1), seed)
        return b"".join(line.feed(b"e\rb\r", step * 0.01) for step in range(50))

    assert heard(1) == heard(1) != heard(2)


def test_a_late_line_brings_everything_later():
    line = Line(EmulatedArduino(), Faults(delay=0.1))
    line.feed(b"b\r", 0.0)
    assert line.feed(b"", 0.15) == b""
    assert line.feed(b"", 0.2) == b""  # the answer left at 0.15, when the question had been read
    assert line.feed(b"", 0.3) == b" 57600\r\n"


def test_a_port_that_is_pulled_out_is_gone_until_it_comes_back():
    port = EmulatedPort(Line(EmulatedArduino()))
    assert port.open(0.0)
    assert port.write(b"b\r", 0.0)
    port.is_plugged = False
    with pytest.raises(NotAvailable, match="the device has gone"):
        port.read(0.1)
    assert not port.open(0.2)
    assert "plug it in" in port.reason
    port.is_plugged = True
    assert port.open(0.3)
    assert port.write(b"b\r", 0.3)
    assert port.read(0.4) == b" 57600\r\n"
    port.close()
    with pytest.raises(NotAvailable, match="closed"):
        port.write(b"", 0.5)


def test_a_full_port_takes_nothing():
    port = EmulatedPort(Line(EmulatedArduino()))
    port.open(0.0)
    port.is_full = True
    assert not port.write(b"m 10 10\r", 0.0)
    assert not port.line.emulator.is_rolling


def test_a_line_of_the_world_leads_to_its_base(world):
    wiring = {"bumps": "left:2 right:3", "cliffs": "front:0", "sonars": "front:9"}
    line = ArduinoLine(Description("line", "Test", wiring, bus="world"), world.manager)
    line.activate()
    talk = Talk(ArduinoBridge.described(line.description), line.port.line)
    talk.greet()
    talk.run(0.2)
    assert talk.last.ranges["front"] == pytest.approx(1.0 - 0.12, abs=0.02)
    talk.run(6.0, Twist(0.2, 0.0))
    assert talk.last.bumps == {"left": True, "right": True}
    line.deactivate()


def test_a_place_that_the_emulated_base_has_not_is_refused(world):
    description = Description("line", "Test", {"sonars": "frnt:9"}, bus="world")
    with pytest.raises(HriError, match='did you mean "front"'):
        ArduinoLine(description, world.manager).activate()
