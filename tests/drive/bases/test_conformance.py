"""Against pycreate2, another library for the same base: the same bytes, and it drives our base."""

import importlib
from types import SimpleNamespace

import pytest

from hri.core.clock import RealClock
from hri.core.signals import Twist
from hri.drive.bases.create2 import TRACK, Create2, drive_direct
from hri.drive.bases.protocol import Note
from hri.hal.drivers.serial_port import SerialPort
from hri.simulation.bases.emulated_create2 import SAFE, EmulatedCreate2
from hri.simulation.bases.emulated_line import Line
from hri.simulation.bases.pseudo_terminal import PseudoTerminal
from tests.drive.bases.talk import Talk

PATIENCE = 5.0
SPEEDS = [(100, -100), (500, 500), (-500, 3), (0, 0), (-1, 1)]


@pytest.fixture
def pycreate2(monkeypatch):
    pytest.importorskip("pycreate2", reason="the peer library is not installed")
    api = importlib.import_module("pycreate2.create2api")
    # It waits after each command for as long as a base of iron needs.
    monkeypatch.setattr(api, "time", SimpleNamespace(sleep=lambda seconds: None))
    # Its end writes once more, whether there still is a port or not.
    monkeypatch.delattr(api.Create2, "__del__")
    return api


@pytest.fixture
def peer_bytes(pycreate2):
    """What the peer writes for a call."""
    wire = bytearray()
    peer = pycreate2.Create2.__new__(pycreate2.Create2)
    commands = pycreate2.SerialCommandInterface.__new__(pycreate2.SerialCommandInterface)
    commands.ser = SimpleNamespace(write=wire.extend, is_open=False, close=lambda: None)
    peer.SCI, peer.sleep_timer, peer.song_list = commands, 0.0, {}

    def written(call):
        wire.clear()
        call(peer)
        return bytes(wire)

    return written


@pytest.fixture
def terminal():
    with PseudoTerminal(Line(EmulatedCreate2()), RealClock()) as terminal:
        yield terminal


@pytest.mark.parametrize(("right", "left"), SPEEDS)
def test_a_velocity_is_written_in_the_same_bytes(peer_bytes, right, left):
    expected = peer_bytes(lambda peer: peer.drive_direct(right, left))
    assert drive_direct(right, left) == expected
    twist = Twist((right + left) / 2000, (right - left) / 1000 / TRACK)
    assert Create2().velocity(twist) == expected


def test_a_stop_is_written_in_the_same_bytes(peer_bytes):
    assert Create2().stop == peer_bytes(lambda peer: peer.drive_stop())


def test_lamps_are_written_in_the_same_bytes(peer_bytes):
    assert Create2().leds(1.0) == peer_bytes(lambda peer: peer.led(0, 255, 255))
    assert Create2().leds(0.0, is_dock_lit=True) == peer_bytes(lambda peer: peer.led(4, 0, 255))


def test_a_song_is_written_in_the_same_bytes(peer_bytes):
    def sing(peer):
        peer.createSong(0, [60, 16, 72, 32])
        peer.playSong(0)

    assert Create2().song([Note(60, 0.25), Note(72, 0.5)]) == peer_bytes(sing)


def test_the_greeting_has_the_bytes_of_start_and_safe(peer_bytes):
    greeting = [step.data for step in Create2().greeting()]
    assert peer_bytes(lambda peer: peer.start()) in greeting
    safe = peer_bytes(lambda peer: peer.safe())
    assert any(step and safe.startswith(step) for step in greeting)


def test_the_peer_drives_the_emulated_base(pycreate2, terminal, capsys):
    emulator = terminal._line.emulator
    peer = pycreate2.Create2(terminal.path)
    peer.start()
    peer.safe()
    peer.drive_direct(200, 100)
    sensors = peer.get_sensors()
    assert emulator.mode == SAFE
    assert sensors.open_interface_mode == SAFE
    assert (sensors.velocity_right, sensors.velocity_left) == (200, 100)
    assert sensors.battery_capacity > 2000
    assert sensors.cliff_left_signal > 1000
    emulator.body.over_edge.add("right")
    clock = RealClock()
    assert clock.advance_until(lambda: emulator.mode != SAFE, PATIENCE)
    sensors = peer.get_sensors()
    assert sensors.cliff_right
    assert not sensors.cliff_left
    assert sensors.open_interface_mode == 1
    peer.drive_stop()
    assert clock.advance_until(lambda: not emulator.is_rolling, PATIENCE)
    peer.close()


def test_our_protocol_reads_what_the_peer_reads(pycreate2):
    talk = Talk(Create2(), Line(EmulatedCreate2(seed=3)))
    talk.greet()
    talk.run(1.0, Twist(0.2, 0.3))
    body = talk.line.emulator.body
    body.pressed.add("left")
    body.hanging.add("right")
    body.near["left"] = 0.1
    talk.run(0.1)
    talk.line.emulator.feed(bytes([150, 0]), talk.now)
    talk.line.emulator.feed(b"", talk.now + 0.01)
    talk.line.emulator.feed(bytes([142, 100]), talk.now + 0.01)
    peer = pycreate2.SensorPacketDecoder(talk.line.emulator.feed(b"", talk.now + 0.02))
    ours = talk.last
    assert ours.voltage == pytest.approx(peer.voltage / 1000)
    assert ours.battery == pytest.approx(peer.battery_charge / peer.battery_capacity)
    assert ours.cliff_signals["left"] == pytest.approx(peer.cliff_left_signal, abs=30)
    assert ours.ranges["left"] == pytest.approx(0.1, abs=0.01)
    assert peer.light_bumper_left > peer.light_bumper_right
    # The peer has the two sides of the bumper and of the wheels the wrong way round: in packet 7
    # of the specification bit 0 is the right bumper, bit 1 the left one, 2 and 3 the wheels.
    assert ours.bumps == {"left": True, "right": False}
    assert (peer.bumps_wheeldrops.bump_right, peer.bumps_wheeldrops.bump_left) == (True, False)
    assert ours.wheel_drops == {"left": False, "right": True}
    assert peer.bumps_wheeldrops.wheeldrop_left
    assert not peer.bumps_wheeldrops.wheeldrop_right


def test_our_driver_drives_the_emulated_base_over_a_port(terminal):
    clock, protocol, reports = RealClock(), Create2(), []
    port = SerialPort(terminal.path, protocol.baud)
    assert port.open(0.0)

    def hear():
        reports.extend(protocol.feed(port.read(clock.now()), clock.now()))
        return reports

    for step in protocol.greeting():
        port.write(step.data, clock.now())
        clock.advance_until(lambda: bool(hear()), step.pause)
    assert clock.advance_until(lambda: bool(hear()) and reports[-1].obeys, PATIENCE)
    port.write(protocol.velocity(Twist(0.3, 0.0)), clock.now())
    assert clock.advance_until(lambda: hear()[-1].rolled.linear > 0.02, PATIENCE)
    port.write(protocol.stop, clock.now())
    assert clock.advance_until(lambda: hear()[-1].velocity == Twist(), PATIENCE)
    port.close()


def test_a_base_that_is_pulled_out_and_comes_back_is_opened_again(terminal):
    clock, protocol = RealClock(), Create2()
    port = SerialPort(terminal.path, protocol.baud)
    assert port.open(0.0)
    terminal.unplug()

    def is_lost():
        try:
            port.read(clock.now())
        except Exception:
            return True
        return False

    assert clock.advance_until(is_lost, PATIENCE)
    assert not port.open(clock.now() + 1.0)
    terminal.plug()
    assert clock.advance_until(lambda: port.open(clock.now() + 1.0), PATIENCE)
    port.write(protocol.question, clock.now())
    answer = bytearray()
    assert clock.advance_until(
        lambda: answer.extend(port.read(clock.now())) or Create2.recognizes(bytes(answer)), PATIENCE
    )
    port.close()
