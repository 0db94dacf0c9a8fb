"""The engine: what a behavior costs, how even its ticks are, how soon `behave` runs.

Each case of the ticks' evenness runs in a separate process (`hri.bench.ticks`), since a priority
is a property of a process.
"""

from __future__ import annotations

import gc
import json
import os
import subprocess
import tempfile
import time
from collections.abc import Callable
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Behavior, Context
from hri.behavior.network import DEFAULT_INTERVAL, Network
from hri.behavior.ports import Input, Output
from hri.behavior.runner import Runner
from hri.bench.checkout import has_research, research
from hri.bench.figures import machine, summary
from hri.bench.table import attempt
from hri.bench.workers import busy_processes
from hri.core import child
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_bus import EventBus
from hri.hal.resource_manager import ResourceManager

SECONDS = 60.0
BEHAVIORS = 100
TICKS = 3000
STARTS = 9
"""How often `behave` is started."""
COMPANION_SECONDS = 30.0
"""The most that is measured while the companion runs: so long is its demo busy for sure."""


class Relay(Behavior):
    """Passes on what comes in: the least that a behavior with ports can do."""

    input = Input[float]("double", "any number")
    output = Output[float]("double", "the same")

    def compute(self, now: float, dt: float) -> None:
        if (value := self.input.value) is not None:
            self.output.send(value)


class Source(Behavior):
    """Sends the time."""

    output = Output[float]("double", "seconds")

    def compute(self, now: float, dt: float) -> None:
        self.output.send(now)


def measure(seconds: float = SECONDS) -> dict[str, Any]:
    """Measure all; `seconds` is how long each case of the ticks' evenness runs."""
    return {
        "bench": "behavior",
        "machine": machine(),
        "behaviors": BEHAVIORS,
        "cost": attempt(cost),
        "ticks_at_100_hz": attempt(lambda: ticks(seconds)),
        "behave_start_s": attempt(lambda: summary(starts())),
    }


def relays(count: int, interval: float = DEFAULT_INTERVAL) -> Network:
    """A source and relays, each linked to the one before."""
    network = Network("chain", interval)
    network.add(Source("0"))
    for number in range(1, count):
        network.add(Relay(str(number)))
        network.connect(f"{number - 1}.output", f"{number}.input")
    network.sort()
    return network


def chain(count: int) -> Runner:
    """Those, ready to run."""
    clock = FakeClock()
    return Runner(relays(count), Context(clock, EventBus(clock), ResourceManager((), clock)))


def cost(count: int = BEHAVIORS, repeats: int = TICKS) -> dict[str, Any]:
    """Microseconds for each behavior and tick, and the same for a tree of as many nodes.

    They take turns tick by tick, so that whatever else the machine does strikes all alike.
    """
    runner = chain(count)
    contenders: dict[str, Callable[[], object]] = {"hri": lambda: runner.tick(0.0)}
    peer = "not installed" if has_research() else "compared only in a checkout of hri"
    if find_spec("py_trees") is not None and (trees := research("trees")) is not None:
        peer = version("py_trees")
        contenders |= {"py_trees_sequence": trees.sequence(count)}
        contenders |= {"py_trees_parallel": trees.parallel(count)}
    times = _in_turns(contenders, repeats)
    figures: dict[str, Any] = {
        f"{name}_us": summary([t / count * 1e6 for t in taken]) for name, taken in times.items()
    }
    figures["py_trees"] = peer
    own = figures["hri_us"]["median"]
    for name in ("py_trees_sequence", "py_trees_parallel"):
        if name in times:
            figures[f"times_faster_than_{name}"] = round(figures[f"{name}_us"]["median"] / own, 1)
    return figures


def _in_turns(contenders: dict[str, Callable[[], object]], repeats: int) -> dict[str, list[float]]:
    times: dict[str, list[float]] = {name: [] for name in contenders}
    gc.collect()
    gc.disable()
    try:
        for _ in range(repeats):
            for name, act in contenders.items():
                begun = time.perf_counter()
                act()
                times[name].append(time.perf_counter() - begun)
    finally:
        gc.enable()
    return {name: taken[repeats // 10 :] for name, taken in times.items()}


def ticks(seconds: float) -> dict[str, Any]:
    """Period and lateness at 100 Hz: alone, beside busy processes, and beside the companion."""
    foreign = os.cpu_count() or 1
    figures: dict[str, Any] = {"foreign_processes": foreign}
    for priority in ("plain", "realtime"):
        figures[f"alone_{priority}"] = _case("alone", priority, seconds)
        with busy_processes(foreign):
            figures[f"beside_foreign_{priority}"] = _case("alone", priority, seconds)
        with_companion = min(seconds, COMPANION_SECONDS)
        figures[f"with_companion_{priority}"] = _case("companion", priority, with_companion)
    return figures


def _case(load: str, priority: str, seconds: float) -> dict[str, Any]:
    command = child.command("-m", "hri.bench.ticks", load, priority, str(seconds))
    done = subprocess.run(command, capture_output=True, text=True, env=child.environment())
    if done.returncode:
        raise HriError(f"{' '.join(command)} failed: {done.stderr[-500:].strip()} - run it by hand")
    figures: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return figures


def starts(count: int = STARTS) -> list[float]:
    """Seconds from the start of `behave` to its first tick, as its output shows it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "one.xml"
        path.write_text(
            '<BehaviorNetwork><Behavior id="one" type="Hri.Constant"/>'
            '<Behavior id="show" type="Hri.InputCollector">'
            '<Parameter name="print_input" value="true"/></Behavior>'
            '<Link from="one.value" to="show.input"/></BehaviorNetwork>'
        )
        return [_start(path) for _ in range(count)]


def _start(path: Path) -> float:
    command = child.command("-u", "-m", "hri.cli.behave", path, "--invocation-count=1")
    begun = time.perf_counter()
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, text=True, env=child.environment()
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            if line.startswith("Input"):
                return time.perf_counter() - begun
    raise HriError("behave ended before its first tick - run it by hand")
