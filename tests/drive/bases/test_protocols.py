"""What holds for every base."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Twist
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import Create2
from hri.hal.resource import Description
from hri.simulation.bases.emulated_arduino import EmulatedArduino
from hri.simulation.bases.emulated_create2 import EmulatedCreate2
from hri.simulation.bases.emulated_line import Faults, Line
from tests.drive.bases.talk import WIRING, Talk

BASES = {
    "create2": (Create2, EmulatedCreate2),
    "arduino": (lambda: ArduinoBridge(WIRING), lambda: EmulatedArduino(WIRING)),
}
WITH_BUTTON = replace(WIRING, buttons={"stop": 6})
BUTTONED = {
    **BASES,
    "arduino": (lambda: ArduinoBridge(WITH_BUTTON), lambda: EmulatedArduino(WITH_BUTTON)),
}
PROTOCOLS = [made for made, _ in BASES.values()]


@pytest.fixture(params=BASES)
def talk(request):
    protocol, emulator = BASES[request.param]
    return Talk(protocol(), Line(emulator()))


def rolls(talk):
    return talk.line.emulator.is_rolling


def test_a_base_that_was_greeted_obeys_and_stands(talk):
    talk.greet()
    talk.run(0.2)
    assert talk.last.obeys
    assert not rolls(talk)
    assert talk.last.rolled.linear == 0
    assert talk.last.velocity == Twist()


@pytest.mark.parametrize("twist", [Twist(0.3, 0.0), Twist(-0.2, 0.5), Twist(0.0, -1.0)])
def test_it_goes_where_it_is_told_to_and_tells_so(talk, twist):
    talk.greet()
    talk.run(2.0, twist)
    assert talk.last.velocity.linear == pytest.approx(twist.linear, abs=0.02)
    assert talk.last.velocity.angular == pytest.approx(twist.angular, abs=0.1)
    base = talk.line.emulator.body.base
    assert talk.last.rolled.linear == pytest.approx(base.travelled, abs=0.01)
    assert talk.last.rolled.angular == pytest.approx(base.odometry.heading, abs=0.1)


def test_a_stop_stops_it(talk):
    talk.greet()
    talk.run(1.0, Twist(0.3, 0.0))
    talk.say(talk.protocol.stop)
    talk.run(0.5)
    assert not rolls(talk)
    assert talk.line.emulator.body.base.velocity == Twist()


@pytest.mark.parametrize("count", range(8))
def test_an_emergency_stop_stops_it_after_half_a_command(talk, count):
    talk.greet()
    talk.run(0.5, Twist(0.3, 0.0))
    talk.say(talk.protocol.velocity(Twist(0.2, 0.3))[:count])
    talk.say(talk.protocol.emergency_stop)
    assert not rolls(talk)
    talk.run(0.1, Twist(0.1, 0.0))
    assert rolls(talk)


def test_reports_come_at_the_pace_of_the_protocol(talk):
    talk.greet()
    del talk.reports[:]
    talk.run(2.0)
    assert len(talk.reports) > 0.5 * 2.0 / talk.protocol.period
    times = [report.time for report in talk.reports]
    assert max(b - a for a, b in pairwise(times)) < 0.05


def test_a_report_names_the_sensors_that_were_promised(talk):
    talk.greet()
    talk.run(0.5)
    sensors, last = talk.protocol.sensors, talk.last
    for table in ("bumps", "cliffs", "cliff_signals", "wheel_drops", "buttons", "ranges"):
        assert set(getattr(last, table)) == set(getattr(sensors, table)), table


@pytest.mark.parametrize("name", BUTTONED)
def test_a_button_is_told_by_its_name(name):
    protocol, emulator = BUTTONED[name]
    talk = Talk(protocol(), Line(emulator()))
    talk.greet()
    talk.run(0.3)
    assert set(talk.last.buttons) == set(talk.protocol.sensors.buttons) != set()
    assert not any(talk.last.buttons.values())
    for button in talk.protocol.sensors.buttons:
        talk.line.emulator.body.held = {button}
        talk.run(0.1)
        assert [n for n, is_pressed in talk.last.buttons.items() if is_pressed] == [button]


def test_bumper_cliffs_and_distances_are_told(talk):
    talk.greet()
    body = talk.line.emulator.body
    talk.run(0.3)
    assert not any((*talk.last.bumps.values(), *talk.last.cliffs.values()))
    assert set(talk.last.ranges.values()) == {math.inf}
    body.pressed.add("left")
    body.over_edge.add("right")
    body.near["front_left"] = 0.15
    talk.run(0.3)
    assert talk.last.bumps == {"left": True, "right": False}
    assert [place for place, is_edge in talk.last.cliffs.items() if is_edge] == ["right"]
    assert talk.last.cliff_signals["right"] < talk.last.cliff_signals["left"]
    assert talk.last.ranges["front_left"] == pytest.approx(0.15, abs=0.02)


@settings(max_examples=30, deadline=None)
@given(
    made=st.sampled_from(PROTOCOLS),
    linear=st.floats(-5, 5),
    angular=st.floats(-20, 20),
)
def test_the_emulated_wheels_never_exceed_the_limits(made, linear, angular):
    protocol = made()
    emulator = EmulatedCreate2() if isinstance(protocol, Create2) else EmulatedArduino(WIRING)
    talk = Talk(protocol, Line(emulator))
    talk.greet()
    talk.run(0.1, Twist(linear, angular))
    left, right = talk.line.emulator.body.rolled
    talk.run(0.1, Twist(linear, angular))
    further_left, further_right = talk.line.emulator.body.rolled
    most = protocol.limits.linear * 0.11
    assert abs(further_left - left) <= most
    assert abs(further_right - right) <= most


@given(made=st.sampled_from(PROTOCOLS), linear=st.floats(), angular=st.floats())
def test_a_velocity_is_bytes_or_refused(made, linear, angular):
    protocol = made()
    if math.isfinite(linear) and math.isfinite(angular):
        assert len(protocol.velocity(Twist(linear, angular))) <= 16
    else:
        with pytest.raises(HriError, match="send finite numbers"):
            protocol.velocity(Twist(linear, angular))


@settings(max_examples=150, deadline=None)
@given(made=st.sampled_from(PROTOCOLS), chunks=st.lists(st.binary(max_size=300), max_size=8))
def test_no_bytes_harm_a_protocol(made, chunks):
    protocol = made()
    now = 0.0
    for chunk in chunks:
        now += 0.02
        protocol.poll(now)
        for report in protocol.feed(chunk, now):
            assert math.isfinite(report.rolled.linear)
    assert not any(len(part) > 512 for part in vars(protocol).values() if hasattr(part, "__len__"))


@settings(max_examples=150, deadline=None)
@given(made=st.sampled_from([made for _, made in BASES.values()]), data=st.binary(max_size=600))
def test_no_bytes_harm_an_emulated_base(made, data):
    emulator = made()
    emulator.feed(bytes([128, 131]) + data, 0.1)
    emulator.feed(b"", 0.2)


@pytest.mark.parametrize(
    "faults",
    [
        Faults(lost=0.01),
        Faults(damaged=0.01),
        Faults(halved=0.2),
        Faults(delay=0.03, lost=0.005, damaged=0.005),
    ],
    ids=["lost", "damaged", "halved", "late"],
)
def test_what_the_line_spoils_costs_some_reports_and_no_more(talk, faults):
    talk.greet()
    talk.line.faults.lost, talk.line.faults.damaged = faults.lost, faults.damaged
    talk.line.faults.halved, talk.line.faults.delay = faults.halved, faults.delay
    talk.run(0.5)
    before = len(talk.reports)
    talk.run(5.0)
    assert len(talk.reports) - before > 30
    # Not a millimeter is invented, whatever the bytes were.
    assert {report.rolled.linear for report in talk.reports} <= {0.0}, faults


def test_a_base_is_recognized_by_its_answer_only(talk):
    answer = talk.line.feed(talk.protocol.question, 0.0)
    for step in range(1, 20):
        answer += talk.line.feed(b"", step * 0.01)
    assert [made().recognizes(answer) for made in PROTOCOLS] == [
        made().title == talk.protocol.title for made in PROTOCOLS
    ]
    assert not talk.protocol.recognizes(b"")
    assert not talk.protocol.recognizes(b"$GPGGA,092750.000,5321.6802,N,00630.3372,W,1,8\r\n" * 5)


def test_asking_what_it_is_moves_no_wheel(talk):
    for now in (0.0, 0.1, 0.2):
        talk.line.feed(talk.protocol.question, now)
        assert not rolls(talk)


@pytest.mark.parametrize("extra", ["song", "leds", "dock"])
def test_what_a_base_has_not_is_not_available(extra):
    arguments = {"song": [[]], "leds": [0.5], "dock": []}[extra]
    with pytest.raises(NotAvailable, match="Arduino"):
        getattr(ArduinoBridge(), extra)(*arguments)


def test_a_description_may_leave_everything_out():
    for protocol in (Create2, ArduinoBridge):
        assert protocol.described(Description("base", "Test")).limits.linear > 0
