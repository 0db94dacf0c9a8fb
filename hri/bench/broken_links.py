"""How soon a base is told to stop when links of its chain are killed or frozen, in each combination
that leaves one of program, supervisor and watchdog alive: real processes, as in `stops`.
"""

from __future__ import annotations

import itertools
import signal
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from typing import Any

import psutil

from hri.bench.figures import summary
from hri.bench.stops import SPEED, Bench, driving_program
from hri.bench.workers import busy_processes

LINKS = ("program", "supervisor", "watchdog")
DEEDS: Mapping[str, signal.Signals] = {"killed": signal.SIGKILL, "frozen": signal.SIGSTOP}
Combination = Mapping[str, str]
"""What is done to which links, such as {"supervisor": "frozen", "watchdog": "killed"}."""


def combinations() -> list[Combination]:
    """All 18 in which something is done and one link stays alive."""
    told = itertools.product(("", *DEEDS), repeat=len(LINKS))
    each = ({link: deed for link, deed in zip(LINKS, deeds, strict=True) if deed} for deeds in told)
    return [done for done in each if 0 < len(done) < len(LINKS)]


def words(done: Combination) -> str:
    """For people: "supervisor frozen, watchdog killed"."""
    return ", ".join(f"{link} {deed}" for link, deed in done.items())


def stopped(bench: Bench, path: str, done: Combination, speed: float = SPEED) -> float:
    """Seconds from the first deed to the bytes that stop the base."""
    with driving_program(bench, path, speed) as program:
        links = dict(zip(LINKS, chain_of(program), strict=True))
        try:
            time = bench.clock.now()
            for link, deed in done.items():
                links[link].send_signal(DEEDS[deed])
            return bench.stop_after(time)
        finally:
            end(links.values())


def figures(tries: int, busy: int = 0) -> dict[str, Any]:
    """Milliseconds by combination and over all, beside a number of busy processes."""
    bench, seconds = Bench(), dict[str, list[float]]()
    with bench.port() as port, busy_processes(busy):
        for done in combinations():
            seconds[words(done)] = [stopped(bench, port.path, done) for _ in range(tries)]
    together = list(itertools.chain.from_iterable(seconds.values()))
    told = {name: _told(values) for name, values in seconds.items()}
    return {"all": _told(together), "combinations": told, "tries": tries, "busy": busy}


def chain_of(program: int) -> Sequence[psutil.Process]:
    """The processes of LINKS. Raises ValueError when one is missing."""
    top = psutil.Process(program)
    (supervisor,) = top.children()
    (watchdog,) = supervisor.children()
    return top, supervisor, watchdog


def end(processes: Iterable[psutil.Process]) -> None:
    """Kill all of them, so that none keeps the port; all stand still before the first one dies, so
    that none has a last word about it."""
    for number, process in itertools.product((signal.SIGSTOP, signal.SIGKILL), list(processes)):
        with suppress(psutil.NoSuchProcess):
            process.send_signal(number)


def _told(seconds: Sequence[float]) -> dict[str, float]:
    ms = [1000 * value for value in seconds]
    return summary(ms, 1) | {"max": round(max(ms), 1)}
