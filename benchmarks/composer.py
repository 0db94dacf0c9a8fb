"""The composer in a real browser: how fast a large network is shown, moved, and undone; and what is
lost when browser or server are killed while someone edits.
"""

from __future__ import annotations

import json
import os
import random
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import numpy as np
import psutil

from benchmarks.studio_robot import alive, chromium_killed, launcher, linked, opened, shown_page
from hri.behavior.network_file import read_network
from hri.bench.table import Row, amount, at_least, at_most, share
from hri.core.errors import HriError

NODES, QUICK_NODES = 300, 100
PAINT_S, DRAG_MS, UNDO_MS = 1.0, 33.0, 50.0
MOVES, UNDOS = 120, 20
KILLS, LOST_S, SEED = 100, 2.0, 25
EDIT_EVERY_MS, SAVES = 120, 0.1
"""Between two edits, and how many of them are saved."""
PATIENCE = 5.0
"""Seconds until what was typed without a server must be kept."""
SHOW = """(path) => new Promise((done) => {
  const begun = performance.now();
  const look = () => {
    const count = document.querySelectorAll(".react-flow__node").length;
    const wires = document.querySelectorAll(".react-flow__edge").length;
    const isThere = count >= %d && wires > count / 2;
    requestAnimationFrame(isThere ? () => done(performance.now() - begun) : look);
  };
  location.hash = "#networks/" + path;
  look();
})"""
"""Milliseconds until a network with this many nodes is painted."""
FRAMES = "() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"
UNDO = """() => new Promise((done) => {
  const begun = performance.now();
  document.querySelector("[data-action=undo]").click();
  requestAnimationFrame(() => requestAnimationFrame(() => done(performance.now() - begun)));
})"""
"""Milliseconds from the button until the picture with it."""


def network_text(count: int) -> str:
    """A network with this many behaviors in rows of ten, each with its place."""
    behaviors = [f'  <Behavior id="b{n}" type="Hri.Scale"/>' for n in range(count)]
    links = [
        f'  <Link from="b{n - 1}.scaled" to="b{n}.input"/>' for n in range(count) if n % 10 > 0
    ]
    links += [f'  <Link from="b{n}.scaled" to="b{n + 11}.input"/>' for n in range(0, count - 11, 3)]
    boxes = [f'    <Box id="b{n}" x="{n % 10 * 240}" y="{n // 10 * 130}"/>' for n in range(count)]
    inside = "\n".join([*behaviors, *links, "  <Layout>", *boxes, "  </Layout>"])
    return f"<BehaviorNetwork>\n{inside}\n</BehaviorNetwork>\n"


def large(quick: bool) -> Iterator[Row]:
    """A large network: shown, dragged, undone."""
    count = QUICK_NODES if quick else NODES
    with home() as folder, alive() as (_, studio), shown_page(studio) as page:
        path = folder / "large.xml"
        path.write_text(network_text(count))
        page.evaluate("location.hash = '#networks'")
        page.locator(".palette .behavior").first.wait_for()
        took = float(page.evaluate(SHOW % count, str(path))) / 1e3
        yield amount(f"{count} behaviors: until they are painted", took, "s", at_most(PAINT_S))
        frames = _dragged(page)
        what = f"{count} behaviors: scripts of a frame while one is dragged, p95"
        more = {"median": round(float(np.median(frames)), 1)}
        yield amount(what, float(np.percentile(frames, 95)), "ms", at_most(DRAG_MS), **more)
        undone = _undone(page)
        what = f"{count} behaviors: undo until it is painted, median"
        more = {"worst": round(max(undone), 1)}
        yield amount(what, float(np.median(undone)), "ms", at_most(UNDO_MS), **more)


def _dragged(page: Any) -> list[float]:
    """Milliseconds of scripts for each step of the mouse."""
    meter = page.context.new_cdp_session(page)
    meter.send("Performance.enable")

    def script() -> float:
        metrics = meter.send("Performance.getMetrics")["metrics"]
        return next(float(one["value"]) for one in metrics if one["name"] == "ScriptDuration") * 1e3

    box = page.locator(".react-flow__node").nth(45).bounding_box()
    x, y = box["x"] + box["width"] / 2, box["y"] + 4
    page.mouse.move(x, y)
    page.mouse.down()
    found = []
    for step in range(MOVES):
        before = script()
        page.mouse.move(x + step, y + step / 2)
        page.evaluate(FRAMES)
        found.append(script() - before)
    page.mouse.up()
    return found


def _undone(page: Any) -> list[float]:
    for number in range(UNDOS):
        page.locator(".react-flow__node").nth(number).click(position={"x": 10, "y": 4})
        page.keyboard.press("Delete")
    return [float(page.evaluate(UNDO)) for _ in range(UNDOS)]


# --- kills ---


def drafts(quick: bool) -> Iterator[Row]:
    """Browser and server killed in turns while values are typed, and sometimes saved."""
    dice = random.Random(SEED)
    total = KILLS // 10 if quick else KILLS
    lost: list[float] = []
    wrong: list[str] = []
    with home() as folder, alive() as (_, studio), launcher() as launch:
        path = folder / "edited.xml"
        path.write_text(network_text(20))
        hand = _Hand(path, dice)
        hand.take(opened(launch(), studio))
        for number in range(total):
            hand.edit_for(dice.uniform(0.3, 2.5))
            is_server = number % 2 == 0
            if is_server:
                psutil.Process(studio.server).kill()
            else:
                chromium_killed()
            now = time.perf_counter()
            try:
                lost.append(hand.unkept_for(now))
                if is_server:
                    hand.edit_for(0.5)
                    linked(hand.page)
                    hand.wait_until_kept()
                else:
                    hand.take(opened(launch(), studio))
            except (HriError, ValueError) as error:
                wrong.append(str(error))
    what = f"killed while editing: at most {LOST_S:g} s of edits lost"
    more = {"worst_s": round(max(lost), 2), "median_s": round(float(np.median(lost)), 2)}
    yield share(what, sum(one <= LOST_S for one in lost), total, at_least(1)) | more
    what = "killed while editing: files half written, or edits that did not come back"
    yield amount(what, len(wrong), "times", at_most(0), examples=wrong[:3])


class _Hand:
    """Types rising numbers into a parameter, and knows when it typed each."""

    def __init__(self, path: Path, dice: random.Random) -> None:
        self.page: Any = None
        self._path, self._dice = path, dice
        self._times: list[float] = [time.perf_counter()]

    def take(self, page: Any) -> None:
        """Go on in a page, with the draft that it offers."""
        self.page = page
        page.evaluate("(path) => location.hash = '#networks/' + path", str(self._path))
        page.locator(".react-flow__node").first.wait_for()
        kept = _kept(self._path)
        offer = page.get_by_role("button", name="Continue the draft")
        with suppress(Exception):
            offer.first.click(timeout=700)
        page.locator(".react-flow__node").first.click(position={"x": 10, "y": 4})
        shown = self._field().input_value() or "1"
        if int(shown) != kept:
            raise HriError(f"the page shows {shown}, but {kept} was kept")
        del self._times[kept:]

    def _field(self) -> Any:
        return self.page.get_by_label("factor", exact=True)

    def edit_for(self, seconds: float) -> None:
        """Type a number every so often; sometimes save."""
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            self._field().fill(str(len(self._times) + 1))
            self.page.keyboard.press("Enter")
            self._times.append(time.perf_counter())
            if self._dice.random() < SAVES:
                self.page.keyboard.press("Control+s")
            self.page.wait_for_timeout(EDIT_EVERY_MS)

    def unkept_for(self, now: float) -> float:
        """Seconds since the oldest number was typed that is not on the disk."""
        kept = _kept(self._path)
        return now - self._times[kept] if kept < len(self._times) else 0.0

    def wait_until_kept(self) -> None:
        """Raises HriError when the newest number does not get to the disk."""
        end = time.perf_counter() + PATIENCE
        while _kept(self._path) < len(self._times):
            if time.perf_counter() > end:
                raise HriError("what was typed while the server was away was not kept")
            self.page.wait_for_timeout(50)


def _kept(path: Path) -> int:
    """The newest number on the disk, saved or drafted. Raises HriError, or ValueError for what is
    half written.
    """
    texts = [path.read_text()]
    for draft in path.parent.glob(f".{path.name}.*draft"):
        with suppress(FileNotFoundError):  # dropped meanwhile
            texts.append(json.loads(draft.read_text())["text"])
    factors: list[float] = [vars(read_network(text, path)["b0"])["factor"] for text in texts]
    return max(map(round, factors))


@contextmanager
def home() -> Iterator[Path]:
    """The folder where new networks go: the studio is started in it."""
    start = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        try:
            yield Path(folder)
        finally:
            os.chdir(start)
