"""Finds bases on the serial ports: tries each kind's protocol, without moving wheels. A running
vacuum cleaner stops; a board that resets when its port is opened restarts.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from enum import IntEnum

from hri.core.clock import Clock, RealClock
from hri.core.errors import NotAvailable
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import Create2
from hri.drive.bases.protocol import BaseProtocol, Greeting
from hri.hal.drivers.serial_id import BY_ID, id_of
from hri.hal.drivers.serial_port import SerialPort, serial_ports
from hri.hal.port import Port

KINDS: dict[str, type[BaseProtocol]] = {"Hri.Create2": Create2, "Hri.ArduinoBridge": ArduinoBridge}
"""Protocols by device type of a configuration."""
ANSWER_TIME = 0.4
"""Seconds to wait for an answer before asking again."""
QUESTIONS = 2
"""Number of tries per kind."""
MOST_ANSWER = 4096
"""Bytes of an answer to examine."""
PATIENCE = 2.0 + sum(
    kind.boot + 2 * QUESTIONS * ANSWER_TIME + sum(step.pause for step in kind().waking())
    for kind in KINDS.values()
)
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
    was_asleep: bool = False
    """Whether the base had to be woken; it falls asleep again by itself."""
    by_id: str = ""
    """Path that stays with the adapter, for a configuration; empty where the system has none."""


class Presence(IntEnum):
    """Whether a base is there; true unless it is absent."""

    ABSENT = 0
    AWAKE = 1
    WOKEN = 2


def ask_ports(paths: Sequence[str] = (), by_id: str = BY_ID) -> list[Answer]:
    """Probe these ports, or all of this machine, in parallel; takes up to PATIENCE seconds.

    `by_id` is the folder with the ids of adapters.
    """
    answers = [Answer(path) for path in paths] or [
        Answer(port.path, port.about) for port in serial_ports()
    ]
    for answer in answers:
        answer.by_id = id_of(answer.port, by_id)
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
            presence = is_recognized(kind, port, clock)
        except NotAvailable as error:
            answer.says = str(error).removeprefix(f"{answer.port}: ")
            return
        finally:
            port.close()
        if presence:
            answer.type, answer.says = type, kind.title
            answer.was_asleep = presence is Presence.WOKEN
            return
    answer.says = "no base answers - make sure that it is switched on, and awake"


def is_recognized(kind: type[BaseProtocol], port: Port, clock: Clock) -> Presence:
    """Whether a base of that kind answers at an open port, and whether it had to be woken.

    It is left to itself, so that it may fall asleep. Raises NotAvailable when the port is lost.
    """
    try:
        if _answers(kind, port, clock):
            return Presence.AWAKE
        if waking := kind().waking():
            _wake(waking, port, clock)
            if _answers(kind, port, clock):
                return Presence.WOKEN
        return Presence.ABSENT
    finally:
        with suppress(NotAvailable):
            port.write(kind.farewell, clock.now())


def _wake(steps: Sequence[Greeting], port: Port, clock: Clock) -> None:
    """Pull the wire that wakes a base, without a word: one that is awake would obey it."""
    for step in steps:
        if step.rts is not None:
            port.set_rts(step.rts)
        clock.advance(step.pause)


def _answers(kind: type[BaseProtocol], port: Port, clock: Clock) -> bool:
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
            return True
    return False
