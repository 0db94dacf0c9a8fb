"""The sketch of `config/firmware`, compiled for this machine and driven by our own protocol."""

import ctypes
import math
import shutil
import subprocess
from pathlib import Path

import pytest

from hri.core.signals import Twist
from hri.drive.bases.arduino import SHAPE, ArduinoBridge, Wiring
from hri.drive.bases.line_check import checked, without_check
from hri.simulation.bases.emulated_arduino import EmulatedArduino
from hri.simulation.bases.emulated_line import Line
from hri.simulation.bases.emulator import Emulator
from tests.drive.bases.talk import Talk

SKETCH = Path(__file__).parents[3] / "config" / "firmware" / "hri_base" / "hri_base.ino"
BOARD = Path(__file__).with_name("board")
WIRING = Wiring(
    bumps={"left": 10, "right": 11},
    cliffs={"left": 0, "right": 1},
    sonars={"front": 13},
    buttons={"stop": 12},
)
PWM, DIRECTION, ENCODER_A, ENCODER_B = (5, 6), (4, 7), (2, 3), (8, 9)
FIRST_ANALOG = 14
FLOOR = 700
FASTEST = 0.5
"""Of a rim at full power, m/s."""
LAG = 0.08
"""Seconds that a motor takes for most of a change."""
METERS_PER_COUNT = math.pi * SHAPE["wheel_diameter_cm"][0] / 100 / SHAPE["counts_per_turn"][0]


@pytest.fixture(scope="module")
def compiled(tmp_path_factory):
    compiler = shutil.which("g++") or shutil.which("clang++")
    if compiler is None:
        pytest.skip("no C++ compiler")
    made = tmp_path_factory.mktemp("board") / "board.so"
    words = [compiler, "-std=c++17", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC"]
    words += [f"-I{BOARD}", f'-DSKETCH="{SKETCH}"', str(BOARD / "board.cpp"), "-o", str(made)]
    subprocess.run(words, check=True)
    return made


@pytest.fixture
def library(compiled, tmp_path):
    """A board of its own for each test: a library that is loaded twice keeps its variables."""
    return ctypes.CDLL(str(shutil.copy(compiled, tmp_path / "board.so")))


class Board(Emulator):
    """The sketch at work, with motors that follow its power and wheels that turn its encoders."""

    baud = 57_600

    def __init__(self, library):
        self.library = library
        self.speeds, self.ways, self.counts = [0.0, 0.0], [0.0, 0.0], [0, 0]
        self._milliseconds = 0
        for pin in (*WIRING.bumps.values(), *PWM):
            library.board_set(pin, 1)
        library.board_start()
        for pin in WIRING.bumps.values():
            library.board_set(pin, 1)
        for number in WIRING.cliffs.values():
            library.board_set(FIRST_ANALOG + number, FLOOR)

    @property
    def is_rolling(self):
        return any(self.library.board_power(*pins) for pins in zip(PWM, DIRECTION, strict=True))

    def feed(self, data, now):
        while self._milliseconds < round(now * 1000):
            self._milliseconds += 1
            self._roll()
            self.library.board_advance(1)
        if data:
            self.library.board_receive(data, len(data))
        answer = ctypes.create_string_buffer(4096)
        size = self.library.board_sent(answer, len(answer))
        return answer.raw[:size]

    def _roll(self):
        for side in (0, 1):
            power = self.library.board_power(PWM[side], DIRECTION[side])
            self.speeds[side] += (power / 255 * FASTEST - self.speeds[side]) * 0.001 / LAG
            self.ways[side] += self.speeds[side] * 0.001
            while abs(missing := self.ways[side] / METERS_PER_COUNT - self.counts[side]) >= 1:
                step = 1 if missing > 0 else -1
                self.library.board_turn(ENCODER_A[side], ENCODER_B[side], step > 0)
                self.counts[side] += step


@pytest.fixture
def talk(library):
    talk = Talk(ArduinoBridge(WIRING), Line(Board(library)))
    talk.greet()
    return talk


@pytest.fixture
def board(talk):
    return talk.line.emulator


@pytest.mark.parametrize("twist", [Twist(0.2, 0.0), Twist(-0.15, 0.0), Twist(0.1, 0.6)])
def test_the_wheels_turn_as_they_are_told(talk, board, twist):
    talk.run(2.5, twist)
    left, right = board.speeds
    assert (left + right) / 2 == pytest.approx(twist.linear, abs=0.02)
    assert (right - left) / talk.protocol.track == pytest.approx(twist.angular, abs=0.15)
    assert talk.last.velocity.linear == pytest.approx(twist.linear, abs=0.02)
    assert talk.last.rolled.linear == pytest.approx(sum(board.ways) / 2, abs=0.02)


def test_it_stops_within_half_a_second_when_nobody_speaks_to_it(talk, board):
    talk.run(1.0, Twist(0.2, 0.0))
    assert board.is_rolling
    talk.run(0.55)
    assert not board.is_rolling


def test_a_stop_takes_the_power_from_the_motors_at_once(talk, board):
    talk.run(1.0, Twist(0.2, 0.0))
    talk.say(talk.protocol.stop)
    assert not board.is_rolling


def press(board, is_pressed):
    board.library.board_set(WIRING.bumps["left"], not is_pressed)


def push_stop(board, is_pressed):
    board.library.board_set(WIRING.buttons["stop"], is_pressed)


def look_over_an_edge(board, is_there):
    board.library.board_set(FIRST_ANALOG + WIRING.cliffs["right"], 20 if is_there else FLOOR)


@pytest.mark.parametrize("endanger", [press, look_over_an_edge])
def test_in_danger_it_goes_back_and_never_ahead(talk, board, endanger):
    talk.run(1.0, Twist(0.2, 0.0))
    endanger(board, True)
    talk.run(0.3)
    assert not board.is_rolling
    assert talk.last.bumps["left"] or talk.last.cliffs["right"]
    talk.run(0.5, Twist(0.2, 0.0))
    assert not board.is_rolling
    talk.run(0.5, Twist(-0.1, 0.0))
    assert max(board.speeds) < -0.03
    endanger(board, False)
    talk.run(0.5, Twist(0.2, 0.0))
    assert min(board.speeds) > 0.1


@pytest.mark.parametrize("twist", [Twist(0.2, 0.0), Twist(-0.1, 0.0), Twist(0.0, 1.0)])
def test_while_the_stop_switch_is_pressed_nothing_moves(talk, board, twist):
    talk.run(1.0, twist)
    assert board.is_rolling
    push_stop(board, True)
    talk.run(0.1)
    assert not board.is_rolling
    assert talk.last.buttons == {"stop": True}
    talk.run(0.5, twist)
    assert not board.is_rolling
    push_stop(board, False)
    talk.run(0.2)
    assert not board.is_rolling, "it waits for another command"
    assert talk.last.buttons == {"stop": False}
    talk.run(0.5, twist)
    assert board.is_rolling


@pytest.mark.parametrize("target", [20_000, 32_767, 2_000_000_000])
def test_nonsense_does_not_get_it_past_a_bumper(talk, board, target):
    press(board, True)
    talk.say(b"m %d %d\r" % (target, target))
    talk.run(0.1)
    assert not board.is_rolling


def test_the_motors_can_only_be_driven_and_the_stop_switch_only_be_read(talk, board):
    for command in (b"x 5 255\r", b"w 5 1\r", b"c 5 0\r", b"p 4\r", b"w 12 0\r", b"c 12 1\r"):
        assert board.feed(command, talk.now) == b"Invalid Command\r\n"
    assert not board.is_rolling


def test_a_sonar_tells_centimeters_and_infinity_without_an_echo(talk, board):
    board.library.board_echo(58 * 42)
    talk.run(0.2)
    assert talk.last.ranges["front"] == pytest.approx(0.42)
    board.library.board_echo(0)
    talk.run(0.2)
    assert talk.last.ranges["front"] == math.inf


@pytest.mark.parametrize(
    "command",
    [
        b"b\r",
        b"e\r",
        b"m 0 0\r",
        b"r\r",
        b"\r",
        b"hello\r",
        b"u 20:12:0:50\r",
        b"m 10\r",
        b"\n\nb\r",
    ],
)
def test_it_answers_as_the_emulated_board_does(board, command):
    expected = EmulatedArduino()
    expected.feed(command.replace(b"\n", b""), 0.0)
    assert board.feed(command, 0.5) == expected.feed(b"", 1.0)


@pytest.mark.parametrize("command", [b"b", b"e", b"d 12", b"m 10 10", b"hello", b""])
def test_a_line_with_a_check_is_answered_with_one_as_the_emulated_board_does(board, command):
    expected = EmulatedArduino(WIRING, knows_checks=True)
    answer = board.feed(checked(command) + b"\r", 0.5)
    expected.feed(checked(command) + b"\r", 0.0)
    assert answer == expected.feed(b"", 1.0)
    assert without_check(answer.strip(b"\r\n")) is not None


@pytest.mark.parametrize("at", range(len(checked(b"m 20 20"))))
def test_a_velocity_that_was_damaged_anywhere_moves_nothing(talk, board, at):
    talk.run(0.1, Twist())
    whole = checked(b"m 20 20")
    damaged = whole[:at] + bytes([whole[at] ^ 0x11]) + whole[at + 1 :]
    assert b"Invalid Command" in board.feed(damaged + b"\r", talk.now)
    assert not board.is_rolling
    assert b"OK" in board.feed(whole + b"\r", talk.now)
    assert board.is_rolling
    assert board.feed(b"m 0 0\r", talk.now) == b"OK\r\n", "a stop needs no check"
    assert not board.is_rolling


def test_a_program_that_knows_no_checks_drives_once_the_other_has_gone(talk, board):
    talk.run(0.1, Twist())
    assert board.feed(b"m 20 20\r", talk.now) == b"Invalid Command\r\n"
    talk.run(2.1)
    assert board.feed(b"m 20 20\r", talk.now) == b"Invalid Command\r\n", "it still asks"
    board.feed(b"", talk.now + 2.1)
    assert board.feed(b"m 20 20\r", talk.now + 2.1) == b"OK\r\n"


def test_a_line_without_an_end_does_no_harm(board):
    assert board.feed(b"m 10 10 " * 1000 + b"\r", 0.5) == b"Invalid Command\r\n"
    assert not board.is_rolling
    assert board.feed(b"b\r", 0.6) == b" 57600\r\n"
