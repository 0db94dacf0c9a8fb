"""Finds bases on the serial ports: tries each kind's protocol, without moving wheels. A running
vacuum cleaner stops; a board that resets when its port is opened restarts.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, field

from hri.core.clock import Clock, RealClock
from hri.core.errors import NotAvailable
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import Create2
from hri.drive.bases.protocol import BaseProtocol
from hri.hal.drivers.serial_port import Port, SerialPort, serial_ports

KINDS: dict[str, type[BaseProtocol]] = {"Hri.Create2": Create2, "Hri.ArduinoBridge": ArduinoBridge}
"""Protocols by device type of a configuration."""
ANSWER_TIME = 0.4
"""Seconds to wait for an answer before asking again."""
QUESTIONS = 2
"""Number of tries per kind."""
MOST_ANSWER = 4096
"""Bytes of an answer to examine."""
PATIENCE = sum(kind.boot + QUESTIONS * ANSWER_TIME for kind in KINDS.values()) + 2.0
"""Seconds after which a silent port is abandoned."""


@dataclass
class Answer:
    """The base at a port."""

    port: str
    about: str = ""
    """Description reported by the adapter."""
    type: str = ""
    """Device type of the base; empty when none answered."""
    says: str = field(default="it does not open - is it in use?")
    """Name of the base, or why none was found."""


def ask_ports(paths: Sequence[str] = ()) -> list[Answer]:
    """Probe these ports, or all of this machine, in parallel; takes up to PATIENCE seconds."""
    answers = [Answer(path) for path in paths] or [
        Answer(port.path, port.about) for port in serial_ports()
    ]
    threads = [
        threading.Thread(target=_ask, args=(answer,), name=f"probe {answer.port}", daemon=True)
        for answer in answers
    ]
    for thread in threads:
        thread.start()
    clock = RealClock()
    for thread in threads:
        thread.join(max(0.0, PATIENCE - clock.now()))
    return answers


def _ask(answer: Answer) -> None:
    """Probe one port."""
    clock = RealClock()
    for type, kind in KINDS.items():
        port = SerialPort(answer.port, kind.baud)
        if not port.open(clock.now()):
            answer.says = port.reason.removeprefix(f"{answer.port}: ")
            return
        try:
            is_there = is_recognized(kind, port, clock)
        except NotAvailable as error:
            answer.says = str(error).removeprefix(f"{answer.port}: ")
            return
        finally:
            port.close()
        if is_there:
            answer.type, answer.says = type, kind.title
            return
    answer.says = "no base answers - make sure that it is switched on"


def is_recognized(kind: type[BaseProtocol], port: Port, clock: Clock) -> bool:
    """Whether a base of that kind answers at an open port. Raises NotAvailable when it is lost."""
    heard = bytearray()

    def is_heard() -> bool:
        heard.extend(port.read(clock.now()))
        del heard[:-MOST_ANSWER]
        return kind.recognizes(bytes(heard))

    # Asked at once as well, since not every port resets its board.
    deaf = [kind.boot] if kind.boot else []
    for wait in [*deaf, *[ANSWER_TIME] * QUESTIONS]:
        port.write(kind.question, clock.now())
        if clock.advance_until(is_heard, wait):
            port.write(kind.farewell, clock.now())
            return True
    return False
