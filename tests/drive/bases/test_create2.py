"""The Open Interface, byte by byte."""

import math

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.signals import Twist
from hri.drive.bases.create2 import (
    FORMATS,
    LONGEST_NOTE,
    METERS_PER_COUNT,
    STREAMED,
    Create2,
    PacketParser,
)
from hri.drive.bases.protocol import Note
from hri.hal.resource import Description
from hri.simulation.bases.emulated_create2 import FULL, PASSIVE, EmulatedCreate2
from hri.simulation.bases.emulated_line import Line
from tests.drive.bases.talk import Talk


@pytest.fixture
def emulator():
    return EmulatedCreate2()


@pytest.fixture
def talk(emulator):
    talk = Talk(Create2(), Line(emulator))
    talk.greet()
    return talk


def packet(*content):
    """A packet of the stream."""
    data = bytes([19, len(content), *content])
    return data + bytes([-sum(data) & 0xFF])


def test_the_packet_of_the_specification_is_understood():
    example = bytes([19, 5, 29, 2, 25, 13, 0, 163])
    assert PacketParser((29, 13)).feed(example) == [{29: 537, 13: 0}]


def test_all_that_it_asks_for_fits_into_a_slot():
    size = 3 + sum(1 + {"b": 1, "B": 1, "h": 2, "H": 2}[FORMATS[p]] for p in STREAMED)
    assert size <= 172


@given(st.lists(st.binary(max_size=9), max_size=12), st.integers(1, 20))
def test_a_whole_packet_is_found_among_anything(noise, size):
    """Unless the noise itself began one, which the next packet then cures."""
    data = b"".join(noise) + packet(7, 0, 35, 2) * 2
    stream = PacketParser((7, 35))
    found = []
    for start in range(0, len(data), size):
        found += stream.feed(data[start : start + size])
    assert {7: 0, 35: 2} in found


@given(st.binary(max_size=7), st.integers(0, 6), st.integers(1, 255))
def test_a_damaged_packet_is_none(before, index, change):
    damaged = bytearray(packet(7, 0, 35, 2))
    damaged[index] ^= change
    assert PacketParser((7, 35)).feed(bytes(damaged)) == []


def test_a_curve_is_kept_where_the_wheels_are_too_slow():
    command = Create2().velocity(Twist(1.0, 1.0))
    right = int.from_bytes(command[1:3], "big", signed=True)
    left = int.from_bytes(command[3:5], "big", signed=True)
    assert right == 500
    assert left / right == pytest.approx((1.0 - 0.1175) / (1.0 + 0.1175), abs=0.002)


def test_counters_run_over_without_a_leap(talk, emulator):
    talk.run(0.1)
    for packet_number in (43, 44):
        emulator.overrides[packet_number] = 65_530
    talk.run(0.1)
    before = talk.last.rolled.linear
    for packet_number in (43, 44):
        emulator.overrides[packet_number] = 14
    talk.run(0.1)
    assert talk.last.rolled.linear - before == pytest.approx(20 * METERS_PER_COUNT)


def test_counters_that_a_reset_puts_to_zero_move_nothing(talk, emulator):
    talk.run(1.0, Twist(0.3, 0.0))
    before = talk.last.rolled.linear
    for packet_number in (43, 44):
        emulator.overrides[packet_number] = 20_000
    talk.run(0.1)
    assert talk.last.rolled.linear == pytest.approx(before, abs=0.1)


def test_the_firmware_stops_at_a_cliff_and_says_that_it_does_not_obey(talk, emulator):
    talk.run(0.5, Twist(0.2, 0.0))
    emulator.body.over_edge.add("front_left")
    talk.run(0.05)
    assert not emulator.is_rolling
    assert talk.last.mode == "passive"
    assert not talk.last.obeys
    talk.greet()
    talk.run(0.2, Twist(-0.1, 0.0))
    assert talk.last.obeys
    assert emulator.body.base.velocity.linear < 0


def test_a_wheel_that_drops_is_told_and_stops_it(talk, emulator):
    talk.run(0.5, Twist(0.2, 0.0))
    emulator.body.hanging.add("left")
    talk.run(0.05)
    assert talk.last.wheel_drops == {"right": False, "left": True}
    assert talk.last.mode == "passive"


def test_on_the_charger_it_charges_and_stays(talk, emulator):
    emulator.body.is_on_charger = True
    talk.run(0.1, Twist(0.2, 0.0))
    assert talk.last.is_charging
    assert not emulator.is_rolling


def test_it_drives_on_when_nobody_speaks_to_it(talk, emulator):
    """There is no command timeout: that is why there has to be a supervisor."""
    talk.run(0.1, Twist(0.2, 0.0))
    talk.run(10.0)
    assert emulator.body.base.travelled == pytest.approx(2.0, abs=0.1)


def test_battery_and_voltage_are_told(talk):
    assert talk.last.battery == pytest.approx(1.0, abs=0.01)
    assert 10 < talk.last.voltage < 18


@pytest.mark.parametrize(
    ("charge", "capacity", "level", "said"),
    [
        (0, 2696, 0.0, ""),
        (2696, 2696, 1.0, ""),
        (65_529, 2696, None, "says 65529 of 2696 mAh"),  # an empty battery: -7 mAh
        (2800, 2696, None, "says 2800 of 2696 mAh"),
        (0, 0, None, "says 0 of 0 mAh"),
        (100, 65_530, None, "says 100 of 65530 mAh"),
    ],
)
def test_a_charge_that_cannot_be_is_no_charge(emulator, talk, charge, capacity, level, said):
    emulator.overrides.update({25: charge, 26: capacity})
    talk.run(0.1)
    assert talk.last.battery == level
    assert talk.last.battery_fault == said


@pytest.mark.parametrize("millivolts", [0, 900, 32_000, 65_535])
def test_a_voltage_that_cannot_be_is_no_voltage(emulator, talk, millivolts):
    emulator.overrides[22] = millivolts
    talk.run(0.1)
    assert talk.last.voltage is None
    assert talk.last.battery == pytest.approx(1.0)
    assert talk.last.battery_fault == f"says {millivolts / 1000:g} V"


def test_a_light_bumper_that_tells_what_it_cannot_count_says_nothing(emulator, talk):
    emulator.overrides[48] = 4096
    talk.run(0.1)
    assert "center_left" not in talk.last.ranges
    assert len(talk.last.ranges) == 5


def test_light_bumpers_tell_distances_by_what_they_were_measured_at(emulator):
    talk = Talk(Create2(light_at_10_cm=800.0), Line(emulator))
    emulator.overrides[46] = 800
    emulator.overrides[47] = 3200
    talk.greet()
    talk.run(0.1)
    assert talk.last.ranges["left"] == pytest.approx(0.1)
    assert talk.last.ranges["front_left"] == pytest.approx(0.05)
    assert talk.last.ranges["right"] == math.inf


def test_a_base_that_was_switched_off_obeys_after_another_greeting(talk, emulator):
    emulator.feed(bytes([7]), talk.now)
    before = len(talk.reports)
    talk.run(0.2)
    assert len(talk.reports) - before <= 2
    talk.greet()
    talk.run(0.1)
    assert talk.last.obeys


def test_a_greeting_in_full_mode_ends_in_safe_mode(talk, emulator):
    talk.say(bytes([132]))
    assert emulator.mode == FULL
    talk.greet()
    talk.run(0.1)
    assert talk.last.mode == "safe"


def test_songs_lamps_and_dock_are_understood(talk, emulator):
    talk.say(talk.protocol.song([Note(60, 0.25), Note(69, LONGEST_NOTE)]))
    assert emulator.songs[0] == bytes([60, 16, 69, 255])
    assert emulator.played == [0]
    talk.say(talk.protocol.leds(1.0, is_dock_lit=True))
    assert emulator.leds == (4, 255, 255)
    talk.say(talk.protocol.dock())
    assert emulator.mode == PASSIVE
    assert emulator.is_rolling
    talk.say(talk.protocol.emergency_stop)
    assert not emulator.is_rolling


def test_an_emergency_stop_stops_after_the_beginning_of_any_command(talk, emulator):
    protocol = talk.protocol
    commands = [step.data for step in protocol.greeting()]
    commands += [protocol.song([Note(60, 0.25)] * 16), protocol.leds(1.0), protocol.question]
    for command in commands:
        for count in range(len(command)):
            emulator.feed(bytes([128, 131]) + protocol.velocity(Twist(0.3, 0.0)), talk.now)
            assert emulator.is_rolling
            emulator.feed(command[:count] + protocol.emergency_stop, talk.now)
            assert not emulator.is_rolling, (command, count)


@pytest.mark.parametrize("notes", [[], [Note(60, 1)] * 17, [Note(20, 1)], [Note(60, math.nan)]])
def test_a_song_that_it_cannot_sing_is_refused(notes):
    with pytest.raises(HriError, match="write"):
        Create2().song(notes)


def test_a_parameter_out_of_range_has_its_place():
    with pytest.raises(AuthoringError, match="light_at_10_cm"):
        Create2.described(Description("base", "Hri.Create2", {"light_at_10_cm": "0"}))


def heard_at(data, sent, heard):
    """What a receiver at one speed makes of bytes at another: samples in the middle of bits."""
    levels = [1]
    for byte in data:
        levels += [0, *((byte >> bit) & 1 for bit in range(8)), 1]
    levels += [1] * 20

    def level(time):
        return levels[min(len(levels) - 1, int(time * sent))]

    made, time, end = [], 0.0, (len(levels) - 20) / sent
    step = 1 / (16 * heard)
    while time < end:
        if level(time):
            time += step
            continue
        made.append(sum(level(time + (1.5 + bit) / heard) << bit for bit in range(8)))
        time += 9.5 / heard
    return bytes(made)


def test_the_question_for_another_base_is_no_command_to_this_one():
    """At the wrong speed it reads as other bytes: none of them may move a wheel."""
    from hri.drive.bases.arduino import ArduinoBridge

    heard = heard_at(ArduinoBridge.question, ArduinoBridge.baud, Create2.baud)
    assert heard_at(b"ab", 9600, 9600) == b"ab"
    moving = {134, 135, 136, 137, 138, 143, 144, 145, 146}
    assert not moving & set(heard)
    other = heard_at(Create2.question, Create2.baud, ArduinoBridge.baud)
    assert b"\r" not in other
