"""Stop on the page while a crowd presses on its port and dialogs are open, by a finger."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
import urllib.request
from collections.abc import Iterator
from contextlib import chdir, contextmanager
from http.cookiejar import CookieJar
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.studio_crowd import CODES, PAGES, SLOW
from benchmarks.studio_dialogs import DIALOGS, dialog
from benchmarks.studio_robot import alive, launcher, opened
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.hal.emergency_stop import EmergencyStop
from hri.robot import Robot
from hri.studio.session import StudioSession

STOPS, QUICK_STOPS = 50, 16
MEMBERS = 3 * SLOW + CODES + PAGES
LATER_MS = 150.0
"""By which a stop may come later than on an idle machine."""
LOST_S = 5.0
"""Seconds after which a stop counts as lost."""
LONGEST_MS = 120_000
"""That a page takes to open a dialog; under the crowd all but Stop may be slow."""
SETTLING_MS = 3000
"""Until the whole crowd is there."""
WATCH = (
    """() => addEventListener("pointerdown", () => { window.touched = Date.now() / 1000; }, true)"""
)


def stops(quick: bool) -> Iterator[Row]:
    """Each dialog in turn, without the crowd and with it."""
    count = QUICK_STOPS if quick else STOPS
    idle = _pressed(count, is_crowded=False)
    crowded = _pressed(count, is_crowded=True)
    base = float(np.median([took for took in idle if took is not None]))
    what = "stop under each dialog, by touch"
    done = [took for took in crowded if took is not None]
    yield share(f"{what}: the base stops", count - idle.count(None), count, at_least(1))
    what = f"{what}, while {MEMBERS} connections press on the port"
    yield share(f"{what}: the base stops", len(done), count, at_least(1))
    if done:
        more = {"median": round(float(np.median(done)), 1), "idle_median": round(base, 1)}
        later = max(done) - base
        yield amount(f"{what}: later than without, worst", later, "ms", at_most(LATER_MS), **more)


def _pressed(count: int, is_crowded: bool) -> list[float | None]:
    """Of each stop the milliseconds from the touch to the latched base; None where it was lost."""
    found: list[float | None] = []
    with (
        tempfile.TemporaryDirectory() as folder,
        chdir(folder),
        alive() as (robot, studio),
        launcher() as launch,
    ):
        stopped: list[float] = []
        robot.events.subscribe("drive.stopped", lambda event: stopped.append(event.time))
        page = opened(launch(), studio, has_touch=True)
        page.set_default_timeout(LONGEST_MS)
        with _crowd(studio, is_crowded):
            page.wait_for_timeout(SETTLING_MS)
            for place, (name, open_dialog) in enumerate(DIALOGS.items()):
                open_dialog(page, Path(folder))
                dialog(page)
                page.evaluate(WATCH)
                for _ in range(len(range(place, count, len(DIALOGS)))):
                    found.append(_touched(page, robot, stopped))
                print(f"{name}: {found[-1]}", file=sys.stderr)
                page.goto(studio.address())
                page.get_by_text("linked", exact=True).wait_for()
    return found


def _touched(page: Any, robot: Robot, stopped: list[float]) -> float | None:
    count = len(stopped)
    page.locator("#stop").tap()
    for _ in range(round(LOST_S / 0.01)):
        if len(stopped) > count:
            break
        page.wait_for_timeout(10)
    robot.context.clock.soon(lambda: _release(robot))
    page.locator("#release").wait_for(state="hidden")
    if len(stopped) == count:
        return None
    offset = time.time() - robot.clock.now()  # noqa: TID251 - the browser has no other clock
    return (stopped[count] + offset - float(page.evaluate("window.touched"))) * 1e3


def _release(robot: Robot) -> None:
    for base in robot.resources.opened(EmergencyStop):
        base.unlatch()


@contextmanager
def _crowd(studio: StudioSession, is_there: bool) -> Iterator[None]:
    """The crowd in a separate program; half of its pages have a cookie."""
    if not is_there:
        yield
        return
    cookies = CookieJar()
    urllib.request.build_opener(urllib.request.HTTPCookieProcessor(cookies)).open(studio.address())
    cookie = "; ".join(f"{one.name}={one.value}" for one in cookies)
    words = [sys.executable, "-m", "benchmarks.studio_crowd", str(studio.port), cookie]
    root = Path(__file__).parents[1]
    process = subprocess.Popen(words, cwd=root, start_new_session=True)
    try:
        yield
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
