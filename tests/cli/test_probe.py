"""`hri devices --probe`: which base is at a serial port."""

import argparse
import json

import pytest

from hri.cli import devices
from hri.cli.probe import KINDS, Presence, ask_ports, is_recognized
from hri.core.clock import FakeClock, RealClock
from hri.simulation.bases.emulated_arduino import EmulatedArduino
from hri.simulation.bases.emulated_create2 import (
    OFF,
    PASSIVE,
    SAFE,
    SLEEPY,
    EmulatedCreate2,
)
from hri.simulation.bases.emulated_line import EmulatedPort, Line
from hri.simulation.bases.emulator import Emulator
from hri.simulation.bases.pseudo_terminal import PseudoTerminal

EMULATORS = {"Hri.Create2": EmulatedCreate2, "Hri.ArduinoBridge": EmulatedArduino}


class Babbler(Emulator):
    """A device other than a base that never falls silent, such as a GPS receiver."""

    baud = 115_200

    def feed(self, data, now):
        return b"$GPGGA,092750.000,5321.6802,N,00630.3372,W,1,8,1.03,61.7,M,55.2,M,,*76\r\n" * 10


class Booting(EmulatedArduino):
    """A board that is deaf until its boot loader is through."""

    def feed(self, data, now):
        return super().feed(data if now > 1.8 else b"", now)


def opened(emulator):
    port = EmulatedPort(Line(emulator))
    port.open(0.0)
    return port


def test_each_kind_of_base_is_recognized_as_what_it_is():
    for type, emulator in EMULATORS.items():
        found = [
            kind for kind in KINDS if is_recognized(KINDS[kind], opened(emulator()), FakeClock())
        ]
        assert found == [type]


def test_no_wheel_moves_and_no_stream_goes_on():
    for type, make in EMULATORS.items():
        emulator, clock = make(), FakeClock()
        port = opened(emulator)
        for kind in KINDS.values():
            is_recognized(kind, port, clock)
            assert not emulator.is_rolling, type
        clock.advance(0.5)
        port.read(clock.now())
        clock.advance(0.5)
        assert port.read(clock.now()) == b""


def asleep():
    base = EmulatedCreate2()
    base.feed(b"\x80", 0.0)
    for second in range(round(SLEEPY) + 2):
        base.feed(b"", float(second))
    assert base.is_asleep
    return base


@pytest.mark.parametrize("mode", [OFF, PASSIVE, SAFE])
def test_a_base_that_is_awake_is_left_in_passive_mode(mode):
    base = EmulatedCreate2()
    base.feed(b"\x80\x83"[:mode], 0.0)
    assert base.mode == mode
    assert is_recognized(KINDS["Hri.Create2"], opened(base), FakeClock()) is Presence.AWAKE
    assert base.mode == PASSIVE
    assert not base.is_asleep


def test_a_base_that_sleeps_is_woken_and_left_so_that_it_can_fall_asleep_again():
    base, clock = asleep(), FakeClock()
    clock.advance(SLEEPY + 2)
    port = EmulatedPort(Line(base))
    port.open(clock.now())
    assert is_recognized(KINDS["Hri.Create2"], port, clock) is Presence.WOKEN
    assert base.mode == PASSIVE
    for _ in range(round(SLEEPY) + 2):
        clock.advance(1.0)
        port.read(clock.now())
    assert base.is_asleep


def test_a_base_whose_answers_are_lost_does_not_go_on_talking():
    base, clock = EmulatedCreate2(), FakeClock()
    port = opened(base)
    port.line.faults.report_delay = 100.0
    assert not is_recognized(KINDS["Hri.Create2"], port, clock)
    assert base.mode == PASSIVE
    assert not base._is_streaming


def test_what_the_probe_found_is_told_with_the_path_that_stays(capsys, monkeypatch):
    with PseudoTerminal(Line(EmulatedCreate2()), RealClock()) as terminal:
        (answer,) = ask_ports([terminal.path], terminal.by_id)
        assert answer.by_id == terminal.by_id + "/usb-emulated_base"
        assert not answer.was_asleep
    answer.was_asleep = True
    monkeypatch.setattr(devices, "ask_ports", lambda ports: [answer])
    parser = argparse.ArgumentParser()
    devices.add_arguments(parser)
    devices.run(parser.parse_args(["--probe"]))
    assert f"or Roomba, was asleep - name it {answer.by_id}" in capsys.readouterr().out


def test_a_board_that_its_port_resets_is_asked_again():
    clock = FakeClock()
    assert is_recognized(KINDS["Hri.ArduinoBridge"], opened(Booting()), clock)
    assert clock.now() > 1.8


@pytest.mark.parametrize("make", [Babbler, lambda: EmulatedCreate2()])
def test_what_is_no_base_of_that_kind_costs_a_bounded_time(make):
    clock = FakeClock()
    assert not is_recognized(KINDS["Hri.ArduinoBridge"], opened(make()), clock)
    assert clock.now() < 4.0


def test_a_base_at_a_real_port_is_named(capsys):
    with PseudoTerminal(Line(EmulatedCreate2()), RealClock()) as terminal:
        parser = argparse.ArgumentParser()
        devices.add_arguments(parser)
        assert devices.run(parser.parse_args(["--probe", terminal.path, "/nowhere", "--json"])) == 0
    found = json.loads(capsys.readouterr().out)
    assert [answer["type"] for answer in found] == ["Hri.Create2", ""]
    assert found[0]["says"] == "iRobot Create 2 or Roomba"
    assert "it is not there" in found[1]["says"]


def test_a_table_names_ports_and_bases(capsys, monkeypatch):
    answers = ask_ports(["/nowhere"])
    answers[0].about = "an adapter"
    monkeypatch.setattr(devices, "ask_ports", lambda ports: answers)
    parser = argparse.ArgumentParser()
    devices.add_arguments(parser)
    devices.run(parser.parse_args(["--probe"]))
    shown = capsys.readouterr().out
    assert (
        "/nowhere  -     it is not there - plug it in, or name another port (an adapter)" in shown
    )


def test_a_machine_without_serial_ports_says_so(capsys, monkeypatch):
    monkeypatch.setattr(devices, "ask_ports", lambda ports: [])
    parser = argparse.ArgumentParser()
    devices.add_arguments(parser)
    devices.run(parser.parse_args(["--probe"]))
    assert "plug the base in" in capsys.readouterr().out
