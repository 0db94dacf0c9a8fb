"""The studio in a real browser: what it costs the robot, how fast it shows and stops, and whether
it stands kills and long hours.

Needs playwright and Chromium. The robot is simulated and runs in real time, but for the long hours.
"""

from __future__ import annotations

import gzip
import os
import random
import signal
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, closing, contextmanager, suppress
from http.cookiejar import CookieJar
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from benchmarks import composer, studio_stop
from benchmarks.studio_robot import (
    DEVICES,
    WINDOW,
    alive,
    chromium,
    chromium_killed,
    companion,
    launcher,
    linked,
    living,
    opened,
    shown_page,
)
from hri.behavior.runner import Runner
from hri.bench.companion_soak import CompanionSoak
from hri.bench.table import Parts, Row, amount, at_least, at_most, measured, share
from hri.robot import Robot
from hri.studio.session import StudioSession
from hri.task.context import TaskContext

SECONDS, QUICK_SECONDS, TURNS = 20.0, 4.0, 3
SETTLING = 4.0
"""Seconds in which a robot loads its models and a page is opened."""
RATE = 100.0
STOPS, KILLS, HOURS, SEED = 10, 50, 2.0, 24
BACK_S = 2.0
"""Until a page is linked again after a kill."""
FPS, DELAY_MS, STOP_MS, INTERACTIVE_S = 20.0, 150.0, 100.0, 1.5
FIRST_KB, SCRIPTS_KB = 250.0, 400.0
MEDIAN, P99 = 1.05, 1.5
BEHAVIORS, WATCHED_TURNS, WATCHED_P99 = 100, 6, 2.0
SETTLED, GROWTH_MB = 0.25, 20.0
"""After this share of the hours, memory may grow by so much."""
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
PICTURES = '{"pictures": ["face", "camera"]}'
VALUES = '{"pictures": [], "networks": ["hundred"]}'
"""What a page asks for."""
READER = """
import socket, sys
link = socket.create_connection(("127.0.0.1", int(sys.argv[1])))
host = f"127.0.0.1:{sys.argv[1]}"
link.sendall(f"GET /api/v1/live HTTP/1.1\\r\\nHost: {host}\\r\\nOrigin: http://{host}\\r\\n"
    "Upgrade: websocket\\r\\nConnection: Upgrade\\r\\nSec-WebSocket-Version: 13\\r\\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\\r\\n"
    f"Cookie: {sys.argv[2]}\\r\\n\\r\\n".encode())
wanted = sys.argv[3].encode()
link.sendall(bytes((0x81, 0x80 | len(wanted), 0, 0, 0, 0)) + wanted)
while link.recv(1 << 20):
    pass
"""
"""A program that takes all that a page takes, and draws nothing."""


# --- what a page costs ---


def _ticks(found: list[float]) -> Callable[[TaskContext], Any]:
    """A job of the robot's loop that is due at `RATE`: how late it begins, ms."""

    async def tick(context: TaskContext) -> None:
        due = context.clock.now()
        while True:
            due = max(due + 1 / RATE, context.clock.now())
            await context.clock.sleep_until(due)
            found.append((context.clock.now() - due) * 1e3)

    return tick


Watch = Callable[[StudioSession], AbstractContextManager[psutil.Process]]


@contextmanager
def _chromium_alone(studio: StudioSession) -> Iterator[psutil.Process]:
    """The page in a Chromium that nothing drives: what drives it would cost this process."""
    words = [chromium(), "--headless=new", "--no-sandbox", "--disable-gpu", "--mute-audio"]
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        words += [
            f"--user-data-dir={folder}",
            f"--window-size={WINDOW['width']},{WINDOW['height']}",
        ]
        with _started([*words, studio.address()]) as process:
            yield process


@contextmanager
def _reader(studio: StudioSession, wanted: str = PICTURES) -> Iterator[psutil.Process]:
    """What a page elsewhere costs here: all is sent, and drawn on another machine."""
    cookies = CookieJar()
    urllib.request.build_opener(urllib.request.HTTPCookieProcessor(cookies)).open(studio.address())
    cookie = "; ".join(f"{one.name}={one.value}" for one in cookies)
    with _started([sys.executable, "-c", READER, str(studio.port), cookie, wanted]) as process:
        yield process


@contextmanager
def _started(words: list[str]) -> Iterator[psutil.Process]:
    """A program with its children, which end at the end."""
    quiet = subprocess.DEVNULL
    process = subprocess.Popen(words, stdout=quiet, stderr=quiet, start_new_session=True)
    try:
        yield psutil.Process(process.pid)
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def _late(seconds: float, watch: Watch | None) -> list[float]:
    """How late ticks are, without a studio or with one that is watched."""
    found: list[float] = []
    robot, wait = companion(), threading.Event().wait
    jobs = (*robot.app.load_tasks(), _ticks(found))
    if watch is None:
        thread = threading.Thread(target=lambda: robot.live_until_over(*jobs))
        with closing(robot):
            thread.start()
            wait(SETTLING)
            found.clear()
            wait(seconds)
            late = list(found)
            robot.context.clock.soon(robot.finish)
            thread.join()
        return late
    with living(robot, robot.live_until_over, *jobs) as studio, watch(studio):
        wait(SETTLING)
        found.clear()
        wait(seconds)
        return list(found)


def _cost(quick: bool) -> Iterator[Row]:
    """In turns: without a studio, with a page that is drawn elsewhere, and with one drawn here."""
    ways: dict[str, Watch | None] = {
        "": None,
        "a page on another machine": _reader,
        "a page on this machine, its browser drawing without a GPU": _chromium_alone,
    }
    late: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(1 if quick else TURNS):
        for name, watch in ways.items():
            late[name] += _late(QUICK_SECONDS if quick else SECONDS, watch)
    for name in list(ways)[1:]:
        for part, percent, limit in (("median", 50, MEDIAN), ("p99", 99, P99)):
            before, now = (float(np.percentile(late[one], percent)) for one in ("", name))
            what = (
                f"ticks at {RATE:g} Hz with {name}: lateness, {part}, times that without a studio"
            )
            ms = {"without_ms": round(before, 3), "with_ms": round(now, 3)}
            yield amount(what, now / before, "times", at_most(limit), **ms)


# --- what it costs to watch values ---


def _hundred(folder: Path) -> Path:
    """A network of behaviors in a row, each with an output, at `RATE`."""
    path = folder / "hundred.xml"
    scale = '<Parameter name="factor" value="1.001"/>'
    rows = ['<Behavior id="b0" type="Hri.Constant"><Parameter name="parsed_value" value="1"/>']
    rows += [f'<Behavior id="b{n}" type="Hri.Scale">{scale}' for n in range(1, BEHAVIORS)]
    outputs = ["b0.value", *(f"b{number}.scaled" for number in range(1, BEHAVIORS))]
    links = [f'<Link from="{outputs[n - 1]}" to="b{n}.input"/>' for n in range(1, BEHAVIORS)]
    inside = "\n".join([f"{row}</Behavior>" for row in rows] + links)
    head = f'<BehaviorNetwork name="hundred" invocation_interval="{1 / RATE:g}">'
    path.write_text(f"{head}\n{inside}\n</BehaviorNetwork>\n")
    return path


def _timed(runner: Runner, found: list[tuple[float, float]]) -> None:
    """Note of each tick how late it begins and how long it takes, all that follows it included;
    milliseconds.
    """
    tick, now = runner.tick, time.perf_counter

    def timed(at: float) -> float:
        begun = now()
        took = tick(at)
        found.append((runner.statistics.lateness.last * 1e3, (now() - begun) * 1e3))
        return took

    runner.tick = timed  # type: ignore[assignment, method-assign]


def _watched(quick: bool) -> Iterator[Row]:
    """In turns: a page that looks at no network, and one that gets all its values."""
    seconds, turns = (QUICK_SECONDS, 1) if quick else (SECONDS / 2, WATCHED_TURNS)
    ways = {"without": PICTURES, "with": VALUES}
    ticks: dict[str, list[tuple[float, float]]] = {name: [] for name in ways}
    found: list[tuple[float, float]] = []
    wait = threading.Event().wait
    with tempfile.TemporaryDirectory() as folder:
        path = _hundred(Path(folder))
        robot = Robot(str(path), "simulated", devices=DEVICES, notice=lambda line: None)
        with living(robot, robot.live_until_over) as studio:
            wait(SETTLING)
            _timed(robot.networks.runners["hundred"], found)
            for _ in range(turns):
                for name, wanted in ways.items():
                    with _reader(studio, wanted):
                        wait(1.0)
                        found.clear()
                        wait(seconds)
                        ticks[name] += found
    late, took = ({name: np.array(ticks[name])[:, part] for name in ways} for part in (0, 1))
    what = f"a network of {BEHAVIORS} behaviors at {RATE:g} Hz, all its outputs watched"
    for part, times, percent, limit in (
        ("a tick with all that follows it, median", took, 50, MEDIAN),
        ("lateness, p99", late, 99, WATCHED_P99),
    ):
        before, now = (float(np.percentile(times[name], percent)) for name in ways)
        ms = {"without_ms": round(before, 4), "with_ms": round(now, 4)}
        what_part = f"{what}: {part}, times that without"
        yield amount(what_part, now / before, "times", at_most(limit), **ms)


# --- what a page shows ---


def _seen(quick: bool) -> Iterator[Row]:
    """What the page gets, and how fast its stop works."""
    yield from _sizes()
    stopped: list[float] = []
    seconds = QUICK_SECONDS if quick else SECONDS
    with alive() as (robot, studio):
        offset = time.time() - robot.clock.now()  # noqa: TID251 - the browser has no other clock
        robot.events.subscribe("drive.stopped", lambda event: stopped.append(event.time + offset))
        with shown_page(studio) as page:
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
            linked(page)
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


def _sizes() -> Iterator[Row]:
    """Of the scripts that come first, and of those of all views."""
    built = resources.files("hri.studio") / "built"
    sizes = {
        file.name: len(gzip.compress(file.read_bytes())) / 1e3
        for file in built.iterdir()
        if file.name.endswith(".js")
    }
    first = sizes["studio.js"]
    yield amount("scripts of the page at first, gzip", first, "kB", at_most(FIRST_KB))
    whole = sum(sizes.values())
    yield amount("scripts of the page, all views, gzip", whole, "kB", at_most(SCRIPTS_KB))


# --- kills ---


def _killed(quick: bool) -> Iterator[Row]:
    """The server and the browser in turns, at random moments; the robot must go on."""
    dice = random.Random(SEED)
    took: list[float] = []
    goes_on: list[bool] = []
    ticks: list[float] = []
    robot = companion()
    jobs = (*robot.app.load_tasks(), _ticks(ticks))
    with living(robot, robot.live_until_over, *jobs) as studio, launcher() as launch:
        browser = launch()
        page = opened(browser, studio)
        for number in range(KILLS // 10 if quick else KILLS):
            page.wait_for_timeout(dice.uniform(0, 500))
            count, begun = len(ticks), time.perf_counter()
            if number % 2 == 0:
                psutil.Process(studio.server).kill()
                page.get_by_text("no link", exact=True).wait_for()
                linked(page)
            else:
                chromium_killed()
                browser = launch()
                begun = time.perf_counter()  # from when a person opens it again
                page = opened(browser, studio)
            took.append(time.perf_counter() - begun)
            goes_on.append(len(ticks) - count > took[-1] * RATE / 2)
        page.click("#stop")  # it still works
        page.locator("#release").wait_for()
        browser.close()
    yield share(
        "killed, browser or server: the robot goes on", sum(goes_on), len(took), at_least(1)
    )
    what = f"killed, browser or server: the page is linked again within {BACK_S:g} s"
    more = {"median_s": round(float(np.median(took)), 2), "worst_s": round(max(took), 2)}
    yield share(what, sum(one <= BACK_S for one in took), len(took), at_least(1)) | more


# --- long hours ---


def _long(quick: bool) -> Iterator[Row]:
    """Simulated hours of visits, as fast as they go, with a page: the memory of each process."""
    hours = HOURS / 10 if quick else HOURS
    found: dict[str, list[float]] = {"the server": [], "the browser": [], "the robot": []}
    processes: dict[str, psutil.Process] = {}
    is_over = threading.Event()

    def note(line: str) -> None:
        if not processes:  # a notice of the start
            return
        memory = {name: _memory(process) for name, process in processes.items()}
        memory["the robot"] = _memory(psutil.Process()) - sum(memory.values())
        for name, megabytes in memory.items():
            found[name].append(megabytes)
        print(
            f"{line}; {', '.join(f'{n} {m[-1]:.0f} MB' for n, m in found.items())}", file=sys.stderr
        )

    soak = CompanionSoak(hours, note)

    def run(*jobs: Any) -> None:
        soak.run(*jobs)
        is_over.set()

    begun = time.perf_counter()
    with living(soak.robot, run) as studio, _chromium_alone(studio) as browser:
        server = psutil.Process(studio.server)
        processes |= {"the server": server, "the browser": browser}
        is_over.wait()
        looks = any(one.status == "ESTABLISHED" for one in server.net_connections("tcp"))
    more: dict[str, Any] = {
        "visits": soak.verdict.visits,
        "real_s": round(time.perf_counter() - begun),
    }
    faults = [*soak.verdict.faults, *([] if looks else ["the page had gone"])]
    yield amount(f"{hours:g} hours with a page: faults", len(faults), "faults", at_most(0), **more)
    for name, memory in found.items():
        settled = memory[int(len(memory) * SETTLED)]
        more = {"from_mb": round(settled, 1), "to_mb": round(memory[-1], 1)}
        what = f"{hours:g} hours with a page: growth of {name} after a quarter"
        yield amount(what, memory[-1] - settled, "MB", at_most(GROWTH_MB), **more)


def _memory(process: psutil.Process) -> float:
    """MB of a process with its children; what they share is counted once."""
    total = 0
    for one in (process, *process.children(recursive=True)):
        with suppress(psutil.NoSuchProcess):
            total += one.memory_full_info().pss
    return total / 1e6


PARTS: Parts = {
    "page": _seen,
    "stop": studio_stop.stops,
    "cost": _cost,
    "ports": _watched,
    "large": composer.large,
    "drafts": composer.drafts,
    "kills": _killed,
    "hours": _long,
}


def measure(quick: bool = False, only: str | None = None) -> dict[str, Any]:
    """All parts, or one."""
    return measured("studio", {}, quick, only)
