"""The studio in a real browser: what it costs the robot, how fast it shows and stops.

Needs playwright and Chromium. The robot is simulated and runs in real time.
"""

from __future__ import annotations

import gzip
import shutil
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from importlib import resources
from typing import Any

import numpy as np

from hri.bench.table import Row, amount, at_least, at_most, attempted, report
from hri.core.errors import NotAvailable
from hri.hal.resource import Description
from hri.robot import Robot
from hri.studio.session import StudioSession
from hri.task.context import TaskContext

DEVICES = (Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice"))
SECONDS, QUICK_SECONDS, TURNS = 20.0, 4.0, 3
SETTLING = 4.0
"""Seconds in which a robot loads its models and a page is opened."""
RATE = 100.0
STOPS = 10
FPS, DELAY_MS, STOP_MS, INTERACTIVE_S, SCRIPTS_KB = 20.0, 150.0, 100.0, 1.5, 250.0
MEDIAN, P99 = 1.05, 1.5
FRAMES = """(seconds) => new Promise((done) => {
  const found = [], socket = new WebSocket(`ws://${location.host}/api/v1/live`);
  socket.binaryType = "arraybuffer";
  socket.onopen = () => socket.send('{"pictures": ["face"]}');
  socket.onmessage = async (event) => {
    if (typeof event.data === "string") return;
    const time = new DataView(event.data).getFloat64(1);
    await createImageBitmap(new Blob([event.data.slice(9)], {type: "image/jpeg"}));
    found.push([time, Date.now() / 1000]);
  };
  setTimeout(() => { socket.close(); done(found); }, seconds * 1000);
})"""
"""Of each frame of the face that was decoded: its time and that of the wall."""


PRESS = """() => {
  const now = Date.now() / 1000;
  document.getElementById("stop").click();
  return now;
}"""
"""When the stop button was pressed."""


@contextmanager
def _living(jobs: list[Any], has_studio: bool) -> Iterator[tuple[Robot, StudioSession | None]]:
    """A companion in real time, in a thread."""
    robot = Robot("companion", "simulated", devices=DEVICES, notice=lambda line: None)
    studio = StudioSession(robot, port=0) if has_studio else None
    own = studio.jobs() if studio else []
    tasks = robot.app.load_tasks()
    thread = threading.Thread(target=lambda: robot.live_until_over(*tasks, *own, *jobs))
    with closing(robot):
        if studio is not None:
            studio.start()
        thread.start()
        try:
            yield robot, studio
        finally:
            robot.context.clock.soon(robot.finish)
            thread.join()
            if studio is not None:
                studio.close()


@contextmanager
def _page(studio: StudioSession) -> Iterator[Any]:
    """The page in Chromium, once it is linked. Raises NotAvailable."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        raise NotAvailable("no playwright - pip install hri[dev]") from None
    if chromium is None:
        raise NotAvailable("no Chromium - apt install chromium")
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        try:
            page = browser.new_page(viewport={"width": 1360, "height": 900})
            page.goto(studio.address())
            _linked(page)
            yield page
        finally:
            browser.close()


def _linked(page: Any) -> None:
    page.get_by_text("linked", exact=True).wait_for()


def _ticks(found: list[float]) -> Callable[[TaskContext], Any]:
    """A job of the robot's loop that is due at `RATE`: how late it begins, ms."""

    async def tick(context: TaskContext) -> None:
        due = context.clock.now()
        while True:
            due = max(due + 1 / RATE, context.clock.now())
            await context.clock.sleep_until(due)
            found.append((context.clock.now() - due) * 1e3)

    return tick


def _late(seconds: float, has_studio: bool) -> list[float]:
    """How late ticks are, with a page that looks or without a studio."""
    found: list[float] = []
    with _living([_ticks(found)], has_studio) as (_, studio):
        if studio is None:
            threading.Event().wait(SETTLING)
            found.clear()
            threading.Event().wait(seconds)
        else:
            with _page(studio) as page:
                page.wait_for_timeout(SETTLING * 1e3)
                found.clear()
                page.wait_for_timeout(seconds * 1e3)
                return list(found)
    return found


def _cost(seconds: float) -> Iterator[Row]:
    """In turns, without and with a page that shows everything."""
    without, beside = [], []
    for _ in range(TURNS):
        without += _late(seconds, has_studio=False)
        beside += _late(seconds, has_studio=True)
    for name, part, limit in (("median", 50, MEDIAN), ("p99", 99, P99)):
        before, now = (float(np.percentile(late, part)) for late in (without, beside))
        what = f"ticks at {RATE:g} Hz with a page: lateness, {name}, times that without a studio"
        ms = {"without_ms": round(before, 3), "with_ms": round(now, 3)}
        yield amount(what, now / before, "times", at_most(limit), **ms)


def _seen(seconds: float) -> Iterator[Row]:
    """What the page gets, and how fast its stop works."""
    stopped: list[float] = []
    with _living([], has_studio=True) as (robot, studio):
        assert studio is not None
        offset = time.time() - robot.clock.now()  # noqa: TID251 - the browser has no other clock
        robot.events.subscribe("drive.stopped", lambda event: stopped.append(event.time + offset))
        with _page(studio) as page:
            page.wait_for_timeout(SETTLING * 1e3)
            frames = np.array(page.evaluate(FRAMES, seconds))
            yield amount("face on the page", len(frames) / seconds, "1/s", at_least(FPS))
            delays = (frames[:, 1] - frames[:, 0] - offset) * 1e3
            more = {"p95": round(float(np.percentile(delays, 95)), 1)}
            what = "from the robot's frame to the decoded one on the page, median"
            yield amount(what, float(np.median(delays)), "ms", at_most(DELAY_MS), **more)
            took = [_stop(page, stopped) for _ in range(STOPS)]
            more = {"worst": round(max(took), 1)}
            what = "from the stop button to the base's latched stop, median"
            yield amount(what, float(np.median(took)), "ms", at_most(STOP_MS), **more)
            asked = "performance.getEntriesByType('resource').map((one) => one.name)"
            others = [n for n in page.evaluate(asked) if f"127.0.0.1:{studio.port}" not in n]
            others = [name for name in others if not name.startswith("blob:")]
            yield amount("requests to other hosts", len(others), "requests", at_most(0))
            begun = time.perf_counter()
            page.reload()
            _linked(page)
            took_s = time.perf_counter() - begun
            yield amount("the page: until it is linked", took_s, "s", at_most(INTERACTIVE_S))


def _stop(page: Any, stopped: list[float]) -> float:
    """Milliseconds from a click to the stop; released again afterward."""
    count = len(stopped)
    pressed = float(page.evaluate(PRESS))
    while len(stopped) == count:
        page.wait_for_timeout(5)
    page.click("#release")
    page.locator("#release").wait_for(state="hidden")
    return (stopped[count] - pressed) * 1e3


def _size() -> Row:
    built = resources.files("hri.studio") / "built"
    scripts = [file for file in built.iterdir() if file.name.endswith(".js")]
    size = sum(len(gzip.compress(file.read_bytes())) for file in scripts) / 1e3
    return amount("scripts of the page, gzip", size, "kB", at_most(SCRIPTS_KB))


def _rows(seconds: float) -> Iterator[Row]:
    yield _size()
    yield from _seen(seconds)
    yield from _cost(seconds)


def measure(quick: bool = False) -> dict[str, Any]:
    """All rows."""
    seconds = QUICK_SECONDS if quick else SECONDS
    rows = list(attempted("the studio", lambda: _rows(seconds)))
    return report("studio", rows, quick)
