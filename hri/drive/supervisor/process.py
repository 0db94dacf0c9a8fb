"""The supervisor's process: the loop around a controller, with a watchdog beside it.

    python -m hri.drive.supervisor SETTINGS

is what `remote` starts; SETTINGS is the JSON text of `Settings`. It ends when the program that
started it is gone or hangs up, after it has stopped the base.
"""

from __future__ import annotations

import gc
import json
import os
import select
import signal
import socket
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import asdict, dataclass, field
from typing import Any, Self

from hri.core.clock import Clock, RealClock
from hri.core.errors import NotAvailable
from hri.core.python_file import class_named
from hri.core.signals import Pose2D
from hri.drive.bases.protocol import BaseProtocol
from hri.drive.supervisor.base_rules import rules
from hri.drive.supervisor.cause import NO_PROGRAM, NO_WATCHDOG, POWER_UP, Cause
from hri.drive.supervisor.controller import TURN, Controller
from hri.drive.supervisor.free_space import Body
from hri.drive.supervisor.link import Packets, decoded_order, encoded
from hri.drive.supervisor.standby import Lifeline
from hri.drive.supervisor.supervisor import Supervisor
from hri.drive.supervisor.watchdog import LastWords, Watchdog
from hri.drive.velocity_limits import BaseLimits
from hri.hal.drivers.serial_id import BY_ID
from hri.hal.drivers.serial_port import SerialPort
from hri.hal.resource import Description

PRIORITY = -10
"""Niceness: goes before what the program computes, and not before the system."""


@dataclass(frozen=True, slots=True)
class Settings:
    """All that the process is told when it starts."""

    base: str
    """The class of the protocol, "module:Class"."""
    port: str
    """Path of the serial port."""
    line: int
    """Descriptor of the socket to the program."""
    id: str = "base"
    parameters: Mapping[str, str] = field(default_factory=dict)
    """What the configuration says of the base."""
    limits: BaseLimits = field(default_factory=BaseLimits)
    body: Body = field(default_factory=Body)
    mounts: Mapping[str, Pose2D] = field(default_factory=dict)
    cause: Cause = POWER_UP
    """Why it begins latched."""
    lifeline: int = -1
    """Descriptor of the socket to the thread of the program that stands by."""
    by_id: str = BY_ID
    """Folder with the ids of serial adapters."""

    def encoded(self) -> str:
        return json.dumps(asdict(self))

    @classmethod
    def decoded(cls, text: str) -> Self:
        """Raises ValueError, KeyError or TypeError for what `encoded` did not write."""
        fields: dict[str, Any] = json.loads(text)
        fields["limits"], fields["body"] = BaseLimits(**fields["limits"]), Body(**fields["body"])
        fields["cause"] = Cause(**fields["cause"])
        fields["mounts"] = {name: Pose2D(**pose) for name, pose in fields["mounts"].items()}
        return cls(**fields)

    def make(self) -> BaseProtocol:
        """A new protocol. Raises AuthoringError for wrong parameters."""
        module, _, name = self.base.rpartition(":")
        kind: type[BaseProtocol] = class_named(module, name)
        return kind.described(Description(self.id, name, self.parameters))


class Process:
    """Turns the controller whenever something has come, and at least every TURN seconds."""

    def __init__(self, settings: Settings, clock: Clock) -> None:
        self._clock = clock
        self._packets = Packets(socket.socket(fileno=settings.line))
        self._lifeline = Lifeline(socket.socket(fileno=settings.lifeline))
        protocol = settings.make()
        self._port = SerialPort(settings.port, protocol.baud, settings.by_id)
        self._supervisor = Supervisor(
            rules(protocol, settings.limits, settings.body, settings.mounts), settings.cause
        )
        self._controller = Controller(settings.make, self._port, self._supervisor)
        self._watchdog: Watchdog | None = None
        self._openings = 0

    def run(self) -> None:
        """Go on until the program is gone."""
        try:
            while not self._packets.is_over:
                self._turn()
        finally:
            self._leave()

    def _leave(self) -> None:
        """Stop the base and leave it to itself, as the watchdog does at the same time.

        Neither waits for the other: each may be killed, and whoever writes last has said all.
        """
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        self._supervisor.trip(NO_PROGRAM)
        self._unwatch()
        self._lifeline.beat(self._clock.now())
        if self._port.is_open:
            LastWords.of(self._controller.protocol).write_all(self._port.fileno())
        self._port.close()

    def _turn(self) -> None:
        self._wait()
        packets = self._packets.receive()
        orders = [order for order in map(decoded_order, packets) if order is not None]
        now = self._clock.now()
        self._watch(now)
        self._lifeline.beat(now)
        self._controller.turn(now, orders)
        if packets:
            self._packets.send(encoded(self._controller.state(now)))

    def _wait(self) -> None:
        sources: list[Any] = [self._packets]
        if self._port.is_open:
            sources.append(self._port)
        try:
            select.select(sources, [], [], TURN)
        except (OSError, ValueError, NotAvailable):
            return  # reading shows who is gone

    def _watch(self, now: float) -> None:
        """See that a watchdog guards the port that is open now."""
        if self._openings != self._controller.openings or not self._port.is_open:
            self._unwatch()
        self._openings = self._controller.openings
        if self._watchdog is not None:
            self._hear_watchdog(self._watchdog, now)
        if self._watchdog is None and self._port.is_open:
            words = LastWords.of(self._controller.protocol)
            self._watchdog = Watchdog(self._port.fileno(), words, now)
            self._lifeline.lend(self._port.fileno(), self._watchdog.pid)

    def _hear_watchdog(self, watchdog: Watchdog, now: float) -> None:
        watchdog.beat(now)
        self._supervisor.is_watched = not watchdog.is_late(now)
        if watchdog.is_dead(now):
            self._supervisor.trip(NO_WATCHDOG)
            watchdog.kill()
            self._unwatch()

    def _unwatch(self) -> None:
        watchdog, self._watchdog = self._watchdog, None
        if watchdog is not None:
            watchdog.close()
            self._lifeline.withdraw()
        self._supervisor.is_watched = True


def main(settings: str) -> None:
    """The process from beginning to end; SIGTERM ends it as the program's end does."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the program decides when it is over
    signal.signal(signal.SIGTERM, _end)
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # watchdogs that have gone leave nothing behind
    with suppress(OSError):  # only some users may
        os.setpriority(os.PRIO_PROCESS, 0, PRIORITY)
    process = Process(Settings.decoded(settings), RealClock())
    gc.freeze()  # what is there stays; so a collection takes microseconds
    process.run()


def _end(*_: object) -> None:
    raise SystemExit(0)
