"""How fast the simulated world runs: three range sensors, 25 obstacles, a base that goes about."""

from __future__ import annotations

import math
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hri.bench.table import Row, amount, at_least
from hri.core.clock import FakeClock
from hri.core.signals import Twist
from hri.hal.drive import DriveSystem
from hri.hal.range_sensor import RangeSensor
from hri.hal.resource_manager import ResourceManager
from hri.simulation.navigation_trips import SENSORS, devices

LEAST = 100.0
"""Times real time."""
STEP = 0.02
"""Seconds between two readings and commands, as in the quickest network of the companion."""
SECONDS, QUICK_SECONDS = 60.0, 4.0
TIMES = 5
OBSTACLES = 25
RING = 2.5
"""Meters from the middle to where they stand."""


def rows(quick: bool) -> Iterator[Row]:
    """CPU time of one thread; the median of some times."""
    seconds = QUICK_SECONDS if quick else SECONDS
    rates = [seconds / spent(seconds) for _ in range(TIMES)]
    what = f"simulated world, 3 sensors and {OBSTACLES} obstacles"
    rate = float(np.median(rates))
    yield amount(what, rate, "times real time", at_least(LEAST), slowest=round(min(rates), 1))


def spent(seconds: float) -> float:
    """CPU seconds per period of the world's time."""
    clock = FakeClock()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ring.toml"
        path.write_text(_ring(), encoding="utf-8")
        with ResourceManager(devices(path, 1, SENSORS["three sensors"]), clock) as resources:
            drive = resources.obtain("drive", DriveSystem)
            sensors = [resources.obtain(id, RangeSensor) for id in resources.ids(RangeSensor)]
            begun = time.thread_time()
            for _ in range(round(seconds / STEP)):
                clock.advance(STEP)
                now = clock.now()
                near = min(sensor.read(now).distance for sensor in sensors)
                drive.set_velocity(Twist(0.3 if near > 0.5 else 0.05, 0.5), now)
            return time.thread_time() - begun


def _ring() -> str:
    """A world with a ring of round obstacles."""
    lines = ["[robot]", "start = [0, 0]", "[person]", "at = [1.5, 0.2]"]
    for number in range(OBSTACLES):
        angle = math.tau * number / OBSTACLES
        x, y = RING * math.cos(angle), RING * math.sin(angle)
        lines += ["[[circle]]", f"center = [{x:.3f}, {y:.3f}]", "radius = 0.2"]
    return "\n".join([*lines, ""])
