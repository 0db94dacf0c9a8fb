"""Buttons at the header of a board and at serial ports, with the kernel and the wires played."""

import errno
import fcntl
import os
import struct

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, NotAvailable
from hri.hal.button import TAP_S
from hri.hal.drivers import gpio_line, wired_button
from hri.hal.drivers.gpio_line import EVENT, GpioLine, Pull
from hri.hal.drivers.wired_button import WiredButton
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

RISING, FALLING = 1, 2


def button(**parameters):
    description = Description("button", "Hri.Button", {k: str(v) for k, v in parameters.items()})
    WiredButton.check(description)
    return WiredButton(description, ResourceManager((), FakeClock()))


class Board:
    """The kernel's side of the chip, as `linux/gpio.h` describes it."""

    def __init__(self, folder, monkeypatch):
        self.chip = folder / "gpiochip0"
        self.chip.write_text("")
        self.level, self.error, self.events = 0, 0, -1
        monkeypatch.setattr(fcntl, "ioctl", self.ioctl)

    def ioctl(self, descriptor, request, data):
        if self.error:
            raise OSError(self.error, os.strerror(self.error))
        if request == 0xC250B407:
            assert len(data) == 592
            self.offset = struct.unpack_from("=I", data, 0)[0]
            self.consumer = bytes(data[256:288]).rstrip(b"\0")
            self.flags, attributes = struct.unpack_from("=QI", data, 288)
            self.attribute = struct.unpack_from("=I4xI4xQ", data, 320)
            self.lines = struct.unpack_from("=I", data, 560)[0]
            assert attributes == 1
            theirs, self.events = os.pipe()
            struct.pack_into("=i", data, 588, theirs)
        else:
            assert (request, len(data)) == (0xC010B40E, 16)
            struct.pack_into("=Q", data, 0, self.level)

    def change(self, *edges):
        for edge in edges:
            os.write(self.events, EVENT.pack(0, edge, self.offset, 0, 0))
            self.level = int(edge == RISING)


@pytest.fixture
def board(tmp_path, monkeypatch):
    board = Board(tmp_path, monkeypatch)
    yield board
    if board.events >= 0:
        os.close(board.events)


def test_the_kernel_is_asked_for_a_debounced_input_and_its_edges(board):
    line = GpioLine(str(board.chip), 17, Pull.UP)
    assert (board.offset, board.consumer, board.lines) == (17, b"hri", 1)
    # ACTIVE_LOW, INPUT, EDGE_RISING, EDGE_FALLING, BIAS_PULL_UP
    assert board.flags == 2 | 4 | 16 | 32 | 256
    assert board.attribute == (3, gpio_line.DEBOUNCE_US, 1)
    line.close()
    line.close()


@pytest.mark.parametrize(("pull", "flags"), [("down", 512), ("none", 1024 | 2), ("up", 256 | 2)])
def test_what_holds_the_line_says_what_pressed_is(board, pull, flags):
    one = button(gpio=4, chip=board.chip, pull=pull)
    one.activate()
    assert board.flags & (2 | 256 | 512 | 1024) == flags
    one.deactivate()


def test_a_button_of_a_board_is_pressed_while_its_line_is_active(board):
    one = button(gpio=17, chip=board.chip)
    one.activate()
    assert not one.is_pressed(0.0)
    board.change(RISING)
    assert one.is_pressed(0.1)
    assert one.is_pressed(9.0)
    board.change(FALLING)
    assert not one.is_pressed(9.1)
    one.deactivate()


def test_a_tap_between_two_looks_is_noticed_once(board):
    one = button(gpio=17, chip=board.chip)
    one.activate()
    board.change(RISING, FALLING)
    assert [one.is_pressed(now) for now in (1.0, 1.0 + TAP_S / 2, 1.01 + TAP_S, 2.0)] == [
        True, True, False, False,
    ]  # fmt: skip
    one.deactivate()


@pytest.mark.parametrize(
    ("error", "message"),
    [
        (errno.EACCES, "no permission - add yourself to its group: sudo usermod -aG gpio"),
        (errno.EBUSY, "line 17: something else uses the line - close the other program"),
        (errno.EINVAL, "it has no such input - check the line"),
        (errno.ENOTTY, "it has no inputs - check the chip"),
        (errno.EIO, "Input/output error - check gpio and chip"),
    ],
)
def test_a_line_that_cannot_be_had_is_not_available_and_says_why(board, error, message):
    board.error = error
    with pytest.raises(NotAvailable, match=message):
        button(gpio=17, chip=board.chip).activate()


def test_a_machine_without_such_a_chip_says_so(tmp_path):
    with pytest.raises(NotAvailable, match=r"gpiochip9, line 17: it is not there - use a board"):
        button(gpio=17, chip=tmp_path / "gpiochip9").activate()


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({}, "name gpio or port, one of them"),
        ({"gpio": 1, "port": "/dev/ttyUSB0"}, "name gpio or port, one of them"),
        ({"gpio": -1}, "from 0 to 1023"),
        ({"gpio": 1, "pull": "left"}, "pull"),
        ({"port": "/dev/x", "signal": "cst"}, 'did you mean "cts"'),
        ({"gipo": 1, "gpio": 1}, 'did you mean "gpio"'),
    ],
)
def test_a_description_that_makes_no_sense_is_refused(parameters, message):
    with pytest.raises(AuthoringError, match=message):
        button(**parameters)


@pytest.fixture
def wire():
    ours, theirs = os.openpty()
    yield ours, os.ttyname(theirs)
    for end in (ours, theirs):
        os.close(end)


@pytest.mark.parametrize(("down", "up"), [(b"pressed", b"released"), (b"1", b"0"), (b" 1\r", b"0")])
def test_a_board_says_at_its_serial_port_that_the_button_is_pressed(wire, down, up):
    ours, path = wire
    one = button(port=path)
    one.activate()
    assert not one.is_pressed(0.0)
    os.write(ours, down[:1])
    assert not one.is_pressed(0.1)
    os.write(ours, down[1:] + b"\n")
    assert [one.is_pressed(0.2), one.is_pressed(0.9)] == [True, True]
    os.write(ours, b"hello\n" + up + b"\n")
    assert not one.is_pressed(1.0)
    os.write(ours, down + b"\n" + up + b"\n")
    assert [one.is_pressed(1.1), one.is_pressed(1.3)] == [True, False]
    one.deactivate()


def test_a_serial_button_that_is_unplugged_is_not_pressed_and_comes_back(tmp_path, caplog):
    path = tmp_path / "port"
    ours, theirs = os.openpty()
    path.symlink_to(os.ttyname(theirs))
    one = button(port=path)
    one.activate()
    os.write(ours, b"1\n")
    assert one.is_pressed(0.0)
    os.close(ours)
    os.close(theirs)
    path.unlink()
    assert [one.is_pressed(1.0), one.is_pressed(1.5)] == [False, False]
    assert caplog.text.count("the device has gone") == 1
    ours, theirs = os.openpty()
    path.symlink_to(os.ttyname(theirs))
    assert not one.is_pressed(9.0)
    os.write(ours, b"1\n")
    assert one.is_pressed(9.1)
    one.deactivate()
    os.close(ours)
    os.close(theirs)


def test_a_button_may_connect_two_wires_of_an_adapter(wire, monkeypatch):
    wires = {"cts": False}
    monkeypatch.setattr(wired_button.SerialPort, "is_clear_to_send", lambda self, now: wires["cts"])
    one = button(port=wire[1], signal="cts")
    one.activate()
    assert not one.is_pressed(0.0)
    wires["cts"] = True
    assert one.is_pressed(0.1)
    one.deactivate()


def test_a_serial_port_that_is_not_there_is_not_available():
    with pytest.raises(NotAvailable, match=r"/nowhere/tty: it is not there - plug it in"):
        button(port="/nowhere/tty").activate()
