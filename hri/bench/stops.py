"""How soon a base is told to stop: real processes, an emulated base behind a pseudo-terminal.

Times are taken where the base is: when the last byte of a report with a hazard has left it, and
when the bytes that stop it come in.
"""

from __future__ import annotations

import math
import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from hri.bench.workers import running
from hri.core.clock import RealClock
from hri.core.errors import HriError
from hri.core.signals import Twist
from hri.drive.bases.create2 import BUMPS_AND_DROPS, STREAMED, Create2, PacketParser
from hri.drive.supervisor.link import Ask, Release
from hri.drive.supervisor.process import Settings
from hri.drive.supervisor.remote import Remote
from hri.drive.supervisor.supervisor_connection import BEAT
from hri.hal.rank import Rank
from hri.simulation.bases.emulated_create2 import EmulatedCreate2
from hri.simulation.bases.emulated_line import Line
from hri.simulation.bases.pseudo_terminal import PseudoTerminal

SPEED = 0.3
"""Meters a second when the program dies."""
SLOW = 0.1
"""When a hazard comes: to get to it takes less time, and changes nothing."""
PATIENCE = 30.0
"""Seconds for anything that should happen at once."""
PROTOCOL = Create2()


class WatchedLine(Line):
    """Remembers when what mattered went by."""

    def __init__(self, emulator: EmulatedCreate2) -> None:
        super().__init__(emulator)
        self.base = emulator
        self.came: list[tuple[float, bytes]] = []
        """What came in, with its time."""
        self.hazards: list[float] = []
        """When reports with a bump or a dropped wheel had left."""
        self._stream = PacketParser(STREAMED)

    def feed(self, data: bytes, now: float) -> bytes:
        if data:
            self.came.append((now, data))
        answer = super().feed(data, now)
        if any(values[BUMPS_AND_DROPS] for values in self._stream.feed(answer)):
            self.hazards.append(now)
        return answer

    def stopped_after(self, time: float) -> float | None:
        """When the first bytes that stop it came in after a time."""
        return next(
            (at for at, data in list(self.came) if at >= time and PROTOCOL.stop in data), None
        )

    def goes(self, speed: float, since: float = -math.inf) -> bool:
        """Whether the last it was told, later than `since`, is this velocity."""
        if not self.came:
            return False
        time, told = self.came[-1]
        return time > since and PROTOCOL.velocity(Twist(speed)) in told


@dataclass
class Bench:
    """An emulated base on a port of this machine."""

    clock: RealClock = field(default_factory=RealClock)
    line: WatchedLine = field(default_factory=lambda: WatchedLine(EmulatedCreate2()))

    @contextmanager
    def port(self) -> Iterator[PseudoTerminal]:
        with PseudoTerminal(self.line, self.clock) as terminal:
            yield terminal

    def wait(self, what: str, is_there: Callable[[], bool]) -> None:
        """Raises HriError when it does not happen."""
        if not self.clock.advance_until(is_there, PATIENCE):
            raise HriError(f"{what} did not happen within {PATIENCE:g} s - see the processes")

    def stop_after(self, time: float) -> float:
        """Seconds from a time to the bytes that stop the base."""
        self.wait("a stop", lambda: self.line.stopped_after(time) is not None)
        return (self.line.stopped_after(time) or time) - time


def settings(path: str) -> Settings:
    """A Create 2 on that port."""
    return Settings(f"{Create2.__module__}:{Create2.__qualname__}", path, -1)


def drive_on(path: str, speed: float = SPEED) -> None:
    """A program that drives until Ctrl-C; mostly it is killed."""
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a job in the background ignores it
    clock = RealClock()
    connection = Remote(clock, settings(path))
    try:
        while True:
            ask(connection, speed)
            clock.advance(BEAT)
    except KeyboardInterrupt:
        connection.close()


def ask(connection: Remote, speed: float) -> None:
    """Go on asking for a velocity, and open the latch: on a busy machine a base may fall silent."""
    connection.look()
    state = connection.state
    if state.is_latched:
        connection.say(Release(state.time, state.reason))
    connection.say(Ask(Rank.TASKS, Twist(speed), state.time))


def program_to_zero(tries: int) -> list[float]:
    """Seconds from a program's end to zero velocity: killed and frozen by turns."""
    bench, figures = Bench(), []
    with bench.port() as port:
        for number in range(tries):
            figures.append(ended(bench, port.path, by_turns(number)))
    return figures


def by_turns(number: int) -> signal.Signals:
    """How a process is ended in one of several tries: killed, or frozen."""
    return (signal.SIGKILL, signal.SIGSTOP)[number % 2]


def ended(bench: Bench, path: str, by: signal.Signals, speed: float = SPEED) -> float:
    """What one program's end takes."""
    with driving_program(bench, path, speed) as program:
        time = bench.clock.now()
        os.kill(program, by)
        return bench.stop_after(time)


@contextmanager
def driving_program(bench: Bench, path: str, speed: float = SPEED) -> Iterator[int]:
    """The id of a program that drives the base at this speed while a `with` lasts."""
    code = f"from hri.bench.stops import drive_on; drive_on({path!r}, {speed!r})"
    with running(code) as program:
        began = bench.clock.now()
        bench.wait("driving", lambda: bench.line.goes(speed, began))
        yield program.pid


def hazard_to_zero(tries: int) -> list[float]:
    """Seconds from a report of a dropped wheel to zero velocity."""
    bench, figures = Bench(), []
    with bench.port() as port:
        connection = Remote(bench.clock, settings(port.path))
        try:
            for _ in range(tries):
                drive_to(bench, connection)
                figures.append(_dropped(bench))
        finally:
            connection.close()
    return figures


def drive_to(bench: Bench, connection: Remote) -> None:
    """Unlatch and drive until the base is told to go SLOW, and then a little on."""

    def goes() -> bool:
        ask(connection, SLOW)
        return bench.line.goes(SLOW)

    bench.wait("driving", goes)


def _dropped(bench: Bench) -> float:
    line, before = bench.line, len(bench.line.hazards)
    line.base.body.hanging.add("left")
    bench.wait("a hazard", lambda: len(line.hazards) > before)
    time = line.hazards[before]
    figure = bench.stop_after(time)
    line.base.body.hanging.clear()
    return figure


def figures(tries: int = 100) -> dict[str, Any]:
    """Both figures, milliseconds: median, 99th percentile and maximum."""
    return {
        "hazard_to_zero_ms": _told(hazard_to_zero(tries)),
        "program_to_zero_ms": _told(program_to_zero(tries)),
        "tries": tries,
    }


def _told(seconds: list[float]) -> dict[str, float]:
    ms = np.array(seconds) * 1000
    return {
        "median": round(float(np.median(ms)), 2),
        "p99": round(float(np.percentile(ms, 99)), 2),
        "max": round(float(ms.max()), 2),
    }
