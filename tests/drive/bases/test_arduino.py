"""The text protocol of ROSArduinoBridge."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError
from hri.core.signals import Twist
from hri.drive.bases.arduino import ArduinoBridge, Wiring
from hri.drive.bases.line_check import checked, without_check
from hri.hal.resource import Description
from hri.simulation.bases.emulated_arduino import EmulatedArduino
from hri.simulation.bases.emulated_line import Line
from tests.drive.bases.talk import WIRING, Talk


@pytest.fixture
def talk():
    return Talk(ArduinoBridge(WIRING), Line(EmulatedArduino(WIRING)))


def test_a_velocity_is_counts_a_frame():
    """0.2 m/s with a wheel of 65 mm and 1440 counts a turn, 30 frames a second."""
    counts = 0.2 / (math.pi * 0.065 / 1440) / 30
    assert ArduinoBridge().velocity(Twist(0.2, 0.0)) == b"m %d %d\r" % ((round(counts),) * 2)


def test_the_wheel_inside_a_curve_is_slower():
    _, left, right = ArduinoBridge().velocity(Twist(0.2, 0.5)).split()
    assert 0 < int(left) < int(right)


def test_it_stops_by_itself_when_nobody_speaks_to_it(talk):
    talk.greet()
    talk.run(1.0, Twist(0.2, 0.0))
    talk.run(2.5)
    assert not talk.line.emulator.is_rolling
    assert talk.last.velocity == Twist()


def test_everything_is_asked_in_one_go_and_only_one_sonar():
    asked = ArduinoBridge(WIRING).poll(1.0)
    assert asked == b"e\rd 7\rd 8\ra 0\ra 1\rp 4\r"


def test_nothing_is_asked_while_an_answer_is_due():
    protocol = ArduinoBridge(WIRING)
    assert protocol.poll(1.0)
    assert not protocol.poll(1.05)


def test_a_late_answer_is_not_taken_for_that_to_the_next_question():
    protocol = ArduinoBridge(WIRING)
    protocol.poll(1.0)
    assert not protocol.poll(1.11)
    assert protocol.feed(b"10 10\r\n1\r\n1\r\n700\r\n700\r\n0\r\n", 1.12) == []
    assert not protocol.poll(1.15)
    assert protocol.poll(1.2)
    assert protocol.feed(b"10 10\r\n1\r\n0\r\n700\r\n700\r\n0\r\n", 1.21)[0].bumps["right"]


def test_answers_to_velocities_come_in_between():
    protocol = ArduinoBridge(WIRING)
    protocol.poll(1.0)
    reports = protocol.feed(b"OK\r\n10 10\r\n1\r\nOK\r\n1\r\n700\r\n50\r\n25\r\n", 1.01)
    assert reports[0].cliffs == {"left": False, "right": True}
    assert reports[0].ranges == {"front_left": 0.25}


def test_a_lost_answer_is_asked_for_again_while_velocities_go_on():
    protocol = ArduinoBridge(WIRING)
    protocol.poll(1.0)
    asked = []
    for step in range(1, 30):
        now = 1.0 + step * 0.01
        protocol.feed(b"OK\r\n", now)
        asked.append(protocol.poll(now))
    assert any(asked)


@pytest.mark.parametrize("answer", [b"Invalid Command", b"1 2 3", b"7", b"x", b"1" * 500, b"\xff"])
def test_an_answer_that_makes_no_sense_ends_the_round(answer):
    protocol = ArduinoBridge(WIRING)
    protocol.poll(1.0)
    assert protocol.feed(answer + b"\r\n10 10\r\n1\r\n1\r\n700\r\n700\r\n0\r\n", 1.01) == []
    assert protocol.poll(1.2)


def test_a_button_whose_wire_is_broken_counts_as_pressed():
    protocol = ArduinoBridge(Wiring(buttons={"stop": 12}))
    assert b"c 12 0\rw 12 1\r" in b"".join(step.data for step in protocol.greeting())
    assert protocol.poll(1.0) == b"e\rd 12\r"
    assert protocol.feed(b"0 0\r\n1\r\n", 1.01)[0].buttons == {"stop": True}


def test_a_board_without_buttons_reports_none(talk):
    talk.greet()
    talk.run(0.1)
    assert talk.last.buttons == {}


def test_a_board_that_knows_checks_gets_them_and_is_believed_only_with_them():
    line = Line(EmulatedArduino(WIRING, knows_checks=True))
    talk = Talk(ArduinoBridge(WIRING), line)
    talk.greet()
    assert talk.protocol.velocity(Twist()) == checked(b"m 0 0") + b"\r"
    for _ in range(10):
        talk.say(talk.protocol.emergency_stop)
        talk.run(0.1, Twist(0.2, 0.0))
    talk.run(1.0, Twist(0.2, 0.0))
    assert talk.last.velocity.linear == pytest.approx(0.2, abs=0.02)
    assert talk.protocol.senseless < 500, "only the answers to returns without a command"
    asked = talk.protocol.poll(talk.now + 1.0) + talk.protocol.poll(talk.now + 2.0)
    assert asked.startswith(checked(b"e") + b"\r" + checked(b"d 7") + b"\r")
    reports = len(talk.reports)
    talk.hear(b"9999 9999\r\n1\r\n1\r\n700\r\n700\r\n0\r\n")
    assert len(talk.reports) == reports


def test_a_board_of_old_goes_on_as_it_is(talk):
    talk.greet()
    talk.run(0.5, Twist(0.2, 0.0))
    assert talk.protocol.velocity(Twist()) == b"m 0 0\r"
    assert talk.last.velocity.linear == pytest.approx(0.2, abs=0.02)


@given(st.binary(max_size=30), st.integers(0, 33), st.integers(1, 255))
def test_a_check_finds_every_wrong_byte(text, at, wrong):
    line = bytearray(checked(text))
    assert without_check(bytes(line)) == text
    line[at % len(line)] ^= wrong
    assert without_check(bytes(line)) is None


def test_a_reset_of_the_counts_moves_nothing(talk):
    talk.greet()
    talk.run(2.0, Twist(0.3, 0.0))
    rolled = talk.last.rolled.linear
    talk.say(b"m 0 0\rr\r")
    talk.run(0.5)
    assert talk.last.rolled.linear == pytest.approx(rolled, abs=0.1)


def test_the_battery_is_read_now_and_then():
    protocol = ArduinoBridge(battery={"battery_pin": 5})
    talk = Talk(protocol, Line(EmulatedArduino(battery_pin=5)))
    talk.run(0.1)
    assert talk.last.voltage == pytest.approx(8.4, abs=0.02)
    assert talk.last.battery == pytest.approx(1.0, abs=0.02)


@pytest.mark.parametrize(
    ("counts", "level", "volts"),
    [
        (0, None, None),  # no battery at the pin
        (200, None, None),
        (430, 0.0, 6.3),
        (590, 1.0, 8.65),  # on the charger
        (1023, None, None),
    ],
)
def test_a_battery_that_cannot_be_is_not_known(counts, level, volts):
    base = EmulatedArduino(battery_pin=5)
    base.overrides[5] = counts
    talk = Talk(ArduinoBridge(battery={"battery_pin": 5}), Line(base))
    talk.run(0.1)
    assert talk.last.battery == level
    assert talk.last.voltage == (volts if volts is None else pytest.approx(volts, abs=0.02))
    assert bool(talk.last.battery_fault) == (volts is None)


@pytest.mark.parametrize("boot", [0.0, 0.4, 1.5])
@pytest.mark.parametrize("way", [480, 3000])
def test_a_board_that_restarts_moves_nothing_back(boot, way):
    base = EmulatedArduino(WIRING)
    talk = Talk(ArduinoBridge(WIRING), Line(base))
    talk.run(way * 0.000142 / 0.3 + 0.1, Twist(0.3))
    before = talk.last.rolled.linear
    assert before > 0.9 * way * 0.000142
    base.reset(talk.now, boot)
    talk.run(boot + 0.5)
    assert talk.last.time > talk.now - 0.1
    slowest = min(r.velocity.linear for r in talk.reports if r.velocity)
    assert slowest >= 0.0
    assert -0.001 < talk.last.rolled.linear - before < 0.06  # it coasts


def test_counts_that_no_counter_holds_make_no_sense():
    talk = Talk(ArduinoBridge(), Line(EmulatedArduino()))
    talk.run(0.1)
    before = len(talk.reports)
    talk.say(talk.protocol.poll(talk.now + 0.02))
    talk.hear(b"9999999999 0\r\n")
    assert len(talk.reports) == before


def test_what_a_configuration_says_is_used():
    parameters = {
        "bumps": "left:2 right:3",
        "sonars": "front:9",
        "buttons": "stop:12",
        "track_cm": "30",
        "max_speed": "1",
    }
    protocol = ArduinoBridge.described(Description("base", "Hri.ArduinoBridge", parameters))
    assert protocol.sensors.bumps == ("left", "right")
    assert protocol.sensors.ranges == ("front",)
    assert protocol.sensors.buttons == ("stop",)
    assert protocol.track == pytest.approx(0.3)
    assert protocol.limits == Twist(1.0, pytest.approx(2 / 0.3))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("bumps", "left"),
        ("cliffs", "left:a0"),
        ("sonars", "left:100"),
        ("track_cm", "0"),
        ("full_volts", "5"),
    ],
)
def test_a_parameter_that_is_wrong_has_its_place(name, value):
    with pytest.raises(AuthoringError, match=name):
        ArduinoBridge.described(Description("base", "Hri.ArduinoBridge", {name: value}))
