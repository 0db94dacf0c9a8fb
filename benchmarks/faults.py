"""Faults that a base on a line may meet: for each, whether it stands, and says why.

In fake time, with an emulated base, a Create 2 where nothing else is said, that a program drives at
0.3 m/s through the controller and the supervisor. `hri.bench.stops` is about processes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from statistics import median
from typing import Any

from hri.bench.table import Row, at_least, compared, share
from hri.core.signals import Twist
from hri.drive.bases.arduino import ArduinoBridge
from hri.drive.bases.create2 import (
    BUMPS,
    CLIFF_SIGNALS,
    CLIFFS,
    LEFT_COUNT,
    RIGHT_COUNT,
    Create2,
)
from hri.drive.bases.protocol import BaseProtocol
from hri.drive.supervisor.base_rules import rules
from hri.drive.supervisor.controller import TURN, Controller
from hri.drive.supervisor.free_space import Body
from hri.drive.supervisor.link import Ask, Order, Release
from hri.drive.supervisor.supervisor import Supervisor
from hri.drive.velocity_limits import BaseLimits
from hri.hal.rank import Rank
from hri.simulation.bases.emulated_arduino import EmulatedArduino
from hri.simulation.bases.emulated_base import AUTO_STOP
from hri.simulation.bases.emulated_create2 import EmulatedCreate2
from hri.simulation.bases.emulated_line import EmulatedPort, Faults, Line

GO = Twist(0.3)
TRIES, QUICK_TRIES = 100, 10
DAMAGED = 0.01
"""Share of the bytes."""
PATIENCE = 6.0
"""Seconds from a fault to its name; a stuck signal shows only after a meter."""
LATE = 1.0
"""Seconds from the name of the cause to a base at rest; on a bad line a stop may get lost, and is
said again."""


Kind = tuple[type[BaseProtocol], Callable[[], EmulatedArduino | EmulatedCreate2]]
CREATE_2: Kind = Create2, EmulatedCreate2
ARDUINO: Kind = ArduinoBridge, lambda: EmulatedArduino(auto_stop=AUTO_STOP, knows_checks=True)
"""With our firmware."""
OLD_ARDUINO: Kind = ArduinoBridge, lambda: EmulatedArduino(auto_stop=AUTO_STOP)
"""With our firmware of before lines had checks."""


class Chain:
    """A controller that turns each TURN, and the base at the end of its line."""

    def __init__(self, faults: Faults | None = None, kind: Kind = CREATE_2, seed: int = 0) -> None:
        protocol, emulated = kind
        self.base = emulated()
        self.port = EmulatedPort(Line(self.base, faults, seed))
        supervisor = Supervisor(rules(protocol(), BaseLimits(), Body(), {}))
        self.controller = Controller(protocol, self.port, supervisor)
        self.now = 0.0

    def turn(self, *orders: Order) -> None:
        self.now += TURN
        if not self.port.is_plugged:
            self.port.line.feed(b"", self.now)  # what nobody hears; its time goes on
        self.controller.turn(self.now, orders)

    def run(self, seconds: float, twist: Twist | None = None) -> None:
        """Let time pass, with a program that asks for a velocity."""
        for _ in range(round(seconds / TURN)):
            self.turn(*self.asked(twist))

    def asked(self, twist: Twist | None) -> tuple[Order, ...]:
        return () if twist is None else (Ask(Rank.TASKS, twist, self.now),)

    def release(self) -> None:
        self.turn(Release(self.now, self.controller.state(self.now).reason))

    def start(self) -> Chain:
        """Greeted, released, and at 0.3 m/s."""
        self.run(self.controller.protocol.boot + 0.5)
        self.release()
        self.run(1.2, GO)
        return self

    @property
    def speed(self) -> float:
        """Of the base itself, m/s."""
        return self.base.body.base.velocity.linear

    @property
    def causes(self) -> list[str]:
        """Names of the last stops."""
        return [news.cause.name for news in self.controller.state(self.now).news]


def _nothing(chain: Chain) -> None:
    """Leave it as it is."""


@dataclass(frozen=True, slots=True)
class Fault:
    """What goes wrong, and the cause that must be named."""

    inject: Callable[[Chain], object]
    cause: str
    asks: Twist | None = GO
    """What the program goes on asking for."""
    mend: Callable[[Chain], object] = _nothing
    """What ends it when the cause has been named, before the base must rest: where nothing from
    outside can stop it as long as it lasts."""
    kind: Kind = CREATE_2


def _override(chain: Chain, packet: int, value: int) -> None:
    """Let a Create 2 tell something else in a packet."""
    assert isinstance(chain.base, EmulatedCreate2)
    chain.base.overrides[packet] = value


def _overridden(packet: int, value: int) -> Callable[[Chain], object]:
    return lambda chain: _override(chain, packet, value)


def _frozen_counts(chain: Chain) -> None:
    for packet in (LEFT_COUNT, RIGHT_COUNT):
        _override(chain, packet, 1000)


def _spoiled(name: str, value: float) -> Callable[[Chain], object]:
    return lambda chain: setattr(chain.port.line.faults, name, value)


def _pull_out(chain: Chain) -> None:
    chain.port.is_plugged = False


def _put_back(chain: Chain) -> None:
    chain.port.is_plugged = True


def _full_and_free(chain: Chain) -> None:
    chain.port.is_full = True
    chain.run(0.1, GO)
    chain.port.is_full = False
    chain.run(0.05, GO)


def _over_edge(*places: str) -> Callable[[Chain], object]:
    return lambda chain: chain.base.body.over_edge.update(places)


def _edge_without_flag(chain: Chain) -> None:
    _override(chain, CLIFFS["left"], 0)
    chain.base.body.over_edge.add("left")


def _edge_without_signal(chain: Chain) -> None:
    _override(chain, CLIFF_SIGNALS["left"], 1500)
    chain.base.body.over_edge.add("left")


def _time_passes(seconds: float) -> Callable[[Chain], object]:
    def pass_time(chain: Chain) -> None:
        chain.now += seconds

    return pass_time


FAULTS: Mapping[str, Fault] = {
    "program silent": Fault(lambda chain: None, "timeout", asks=None),
    "command not a number": Fault(lambda chain: None, "refused", Twist(math.nan)),
    "command infinite": Fault(lambda chain: None, "refused", Twist(0.1, math.inf)),
    "command out of range": Fault(lambda chain: None, "refused", Twist(5.0)),
    "bump on the left": Fault(lambda chain: chain.base.body.pressed.add("left"), "bump"),
    "bumper stuck": Fault(lambda chain: chain.base.body.pressed.update(BUMPS), "bump"),
    "edge on the left": Fault(_over_edge("left"), "cliff"),
    "edge ahead": Fault(_over_edge("front_left", "front_right"), "cliff"),
    "edge, its flag dead": Fault(_edge_without_flag, "cliff"),
    "edge, its signal dead": Fault(_edge_without_signal, "cliff"),
    "cliff signal stuck": Fault(_overridden(CLIFF_SIGNALS["right"], 1500), "fault"),
    "cliff signal dark": Fault(_overridden(CLIFF_SIGNALS["right"], 2), "cliff"),
    "wheel dropped": Fault(lambda chain: chain.base.body.hanging.add("right"), "wheel drop"),
    "button pressed while driving": Fault(
        lambda chain: chain.base.body.held.add("clean"), "button"
    ),
    "wheels blocked": Fault(_frozen_counts, "fault"),
    "one wheel blocked": Fault(_overridden(LEFT_COUNT, 1000), "fault"),
    "base switched off": Fault(lambda chain: chain.base.feed(b"\x07", chain.now), "stale"),
    "base made passive": Fault(lambda chain: chain.base.feed(b"\x80", chain.now), "disobeys"),
    # A Create 2 drives on until it hears us again.
    "port pulled out and back": Fault(_pull_out, "lost port", mend=_put_back),
    "port of an Arduino pulled out": Fault(_pull_out, "lost port", kind=ARDUINO),
    "line full": Fault(_full_and_free, "jammed"),
    "half of the bytes lost": Fault(_spoiled("lost", 0.5), "stale"),
    "every tenth byte damaged": Fault(_spoiled("damaged", 0.1), "stale"),
    "packets halved": Fault(_spoiled("halved", 0.9), "stale"),
    "every hundredth byte damaged": Fault(_spoiled("damaged", 0.01), "garbled"),
    "every hundredth byte of an Arduino damaged": Fault(
        _spoiled("damaged", 0.01), "unsteady", kind=ARDUINO
    ),
    "reports 0.3 s late": Fault(_spoiled("report_delay", 0.3), "late"),
    "line 0.15 s late in both directions": Fault(_spoiled("delay", 0.15), "late"),
    "answers of an Arduino 0.3 s late": Fault(
        _spoiled("report_delay", 0.3), "unsteady", kind=ARDUINO
    ),
    "supervisor frozen for 0.3 s": Fault(_time_passes(0.3), "frozen"),
    "supervisor frozen for 2 s": Fault(_time_passes(2.0), "frozen"),
    "clock set back": Fault(_time_passes(-1.0), "frozen"),
}
"""By what happens."""


def survived(fault: Fault) -> bool:
    """Whether the base was at rest at most LATE after the cause was named."""
    chain = Chain(kind=fault.kind).start()
    if chain.speed < 0.29:
        return False
    fault.inject(chain)
    for _ in range(round(PATIENCE / TURN)):
        chain.turn(*chain.asked(fault.asks))
        if fault.cause in chain.causes:
            fault.mend(chain)
            return _rests(chain, fault)
    return False


def _rests(chain: Chain, fault: Fault) -> bool:
    for _ in range(round(LATE / TURN)):
        if not chain.base.is_rolling:
            return True
        chain.turn(*chain.asked(fault.asks))
    return False


def rows(quick: bool) -> Iterator[Row]:
    """Each with the base stopped and the cause named; and bases of lines on a damaged line."""
    results = {name: survived(fault) for name, fault in FAULTS.items()}
    what = "faults survived with the base stopped and the cause named"
    row = share(what, sum(results.values()), len(results), at_least(1.0))
    yield row | {"faults": results}
    tries = QUICK_TRIES if quick else TRIES
    told = on_damaged_bytes(ARDUINO, DAMAGED, tries)
    without = on_damaged_bytes(OLD_ARDUINO, DAMAGED, tries)
    what = "way of an Arduino until it latches, 1 % of the bytes damaged, beside one without checks"
    row = compared(what, told["median"], without["median"], "m")
    yield row | {"with_checks": told, "without_checks": without}


def on_damaged_bytes(kind: Kind, share: float, tries: int, seconds: float = 20.0) -> dict[str, Any]:
    """What a base does that is told to go straight on while a share of all bytes is damaged.

    How far it goes until it latches (median and most, m), and the fastest that it turned, rad/s.
    """
    ways, turns = [], [0.0]
    for seed in range(tries):
        chain = Chain(kind=kind, seed=seed).start()
        body = chain.base.body.base
        begun = body.travelled
        chain.port.line.faults.damaged = share
        for _ in range(round(seconds / TURN)):
            chain.turn(*chain.asked(GO))
            turns.append(abs(body.velocity.angular))
            if chain.controller.state(chain.now).is_latched:
                ways.append(body.travelled - begun)
                break
    found = {"latched": len(ways), "of": tries, "fastest_turn": round(max(turns), 3)}
    return found | {"median": round(median(ways), 3), "max": round(max(ways), 3)}
