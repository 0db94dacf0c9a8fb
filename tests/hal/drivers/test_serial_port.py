"""The driver of serial ports, over pseudo-terminals."""

import os
import tty
from itertools import pairwise

import pytest

from hri.core.errors import NotAvailable
from hri.hal.drivers.serial_port import Backoff, SerialPort, serial_ports


@pytest.fixture
def ends():
    ours, theirs = os.openpty()
    tty.setraw(ours)
    tty.setraw(theirs)
    open_ends = [ours, theirs]
    yield open_ends
    for end in open_ends:
        os.close(end)


@pytest.fixture
def port(ends):
    port = SerialPort(os.ttyname(ends[1]), 115_200)
    assert port.open(0.0)
    yield port
    port.close()
    port.close()


def test_bytes_go_both_ways_and_nothing_is_waited_for(port, ends):
    assert port.read(0.0) == b""
    assert port.write(b"\x91\x00\x64", 0.0)
    assert os.read(ends[0], 10) == b"\x91\x00\x64"
    os.write(ends[0], b"abc")
    assert port.read(0.0) == b"abc"


def test_a_port_belongs_to_one(port):
    other = SerialPort(port.path, 115_200)
    assert not other.open(0.0)
    assert "something else uses it" in other.reason


def test_a_port_without_a_request_to_send_does_not_mind(port, ends):
    port.set_rts(False)
    port.set_rts(True)
    assert port.write(b"x", 0.0)
    assert os.read(ends[0], 10) == b"x"


def test_a_full_line_is_told_and_never_waited_for(port, ends):
    count = 0
    while port.write(b"x" * 100, 0.0):
        count += 1
        assert count < 10_000
    assert not port.write(b"stop", 0.0)
    port.discard()
    assert port.write(b"stop", 0.0)


def test_a_device_that_has_gone_closes_the_port_and_says_so(port, ends):
    while ends:
        os.close(ends.pop())
    with pytest.raises(NotAvailable, match="the device has gone"):
        port.read(1.0)
    assert not port.is_open
    assert "plugged in" in port.reason
    with pytest.raises(NotAvailable):
        port.write(b"x", 1.0)


def test_writing_tells_that_the_device_has_gone_too(port, ends):
    while ends:
        os.close(ends.pop())
    with pytest.raises(NotAvailable, match="the device has gone"):
        port.write(b"x", 1.0)


@pytest.mark.parametrize(
    ("path", "why"),
    [("/nowhere/tty", "it is not there"), ("/dev/null", "serial"), ("", "not there")],
)
def test_what_is_no_port_does_not_open_and_says_why(path, why):
    port = SerialPort(path, 115_200)
    assert not port.open(0.0)
    assert why in port.reason


def test_a_port_that_comes_back_is_opened_again(tmp_path):
    path = tmp_path / "port"
    port = SerialPort(str(path), 57_600)
    assert not port.open(0.0)
    ours, theirs = os.openpty()
    path.symlink_to(os.ttyname(theirs))
    assert not port.open(0.05)
    assert port.open(0.2)
    assert port.reason == ""
    port.close()
    os.close(ours)
    os.close(theirs)


class Adapters:
    """Serial adapters that come and go: ports by number, and a folder with their ids."""

    def __init__(self, folder):
        self.folder, self.by_id = folder, folder / "by-id"
        self._ends = []

    def plug(self, port, id=""):
        ours, theirs = os.openpty()
        self._ends += [ours, theirs]
        (self.folder / port).symlink_to(os.ttyname(theirs))
        if id:
            self.by_id.mkdir(exist_ok=True)
            (self.by_id / id).symlink_to(self.folder / port)
        return ours

    def unplug(self, port, id=""):
        (self.folder / port).unlink()
        if id:
            (self.by_id / id).unlink()
            self.by_id.rmdir()  # as udev does with an empty one

    def close(self):
        for end in self._ends:
            os.close(end)


@pytest.fixture
def adapters(tmp_path):
    adapters = Adapters(tmp_path)
    yield adapters
    adapters.close()


@pytest.mark.parametrize("configured", ["ttyUSB0", "by-id/usb-base"])
def test_an_adapter_that_comes_back_as_another_port_is_found_by_its_id(adapters, configured):
    adapters.plug("ttyUSB0", "usb-base")
    port = SerialPort(str(adapters.folder / configured), 57_600, str(adapters.by_id))
    assert port.open(0.0)
    adapters.unplug("ttyUSB0", "usb-base")
    port.close()
    adapters.plug("ttyUSB0")  # another device takes its number
    assert not port.open(1.0)
    assert "usb-base is not there - plug it in again" in port.reason or "by-id" in configured
    ours = adapters.plug("ttyUSB1", "usb-base")
    assert port.open(5.0)
    assert port.write(b"hello", 5.0)
    assert os.read(ours, 10) == b"hello"
    port.close()


@pytest.mark.parametrize(("folder", "id"), [("", ""), ("by-path", "usb-cheap")])
def test_an_adapter_without_an_id_or_of_a_socket_is_waited_for_there(adapters, folder, id):
    path = adapters.folder / folder / "ttyUSB0"
    path.parent.mkdir(exist_ok=True)
    adapters.plug(path, id)
    port = SerialPort(str(path), 57_600, str(adapters.by_id))
    assert port.open(0.0)
    adapters.unplug(path, id)
    port.close()
    adapters.plug("ttyUSB7", id)
    assert not port.open(1.0)
    adapters.plug(path)
    assert port.open(5.0)
    port.close()


def test_attempts_become_rarer_up_to_a_limit():
    backoff, now, tries = Backoff(0.1, 2.0), 0.0, []
    for step in range(2000):
        now = step * 0.01
        if backoff.is_due(now):
            tries.append(now)
            backoff.fail(now)
    waits = [b - a for a, b in pairwise(tries)]
    assert waits[:5] == pytest.approx([0.1, 0.2, 0.4, 0.8, 1.6], abs=0.011)
    assert waits[5:] == pytest.approx([2.0] * len(waits[5:]), abs=0.011)


def test_the_ports_of_a_machine_are_listed():
    for port in serial_ports():
        assert port.path


@pytest.mark.parametrize(
    ("what", "said"),
    [
        ("/dev/null", "it is not a serial port - name one, such as /dev/ttyUSB0"),
        (".", "it is a folder - name a serial port, such as /dev/ttyUSB0"),
        ("file", "it is not a serial port - name one, such as /dev/ttyUSB0"),
        ("none", "it is not there - plug it in, or name another port"),
    ],
)
def test_what_is_not_a_port_is_said_in_words(tmp_path, what, said):
    (tmp_path / "file").write_text("no port")
    port = SerialPort(str(tmp_path / what), 115200)
    assert not port.open(0.0)
    assert port.reason == f"{port.path}: {said}"
