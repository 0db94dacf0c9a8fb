"""Quick hands in two tabs of the composer, over ten networks, until the browser is killed: whatever
was typed two seconds before must be on the disk, and is offered when the network opens again.

Each try has its own seed: `--tries 50 --seed 150` are the tries 150 to 199 of any longer run.
"""

from __future__ import annotations

import json
import random
import re
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.composer import home, network_text
from benchmarks.progress import progress
from benchmarks.studio_robot import WINDOW, alive, chromium_killed, launcher, linked
from hri.bench.figures import machine
from hri.bench.table import amount, at_least, at_most, share
from hri.core.errors import HriError
from hri.studio.session import StudioSession

TRIES, SEED = 200, 0
NETWORKS, BEHAVIORS = 10, 4
LOST_S = 2.0
KILL_AFTER = (0.3, 6.0)
"""Seconds in which hands are at work, at least and at most."""
SWITCH, SAVE, TWICE, LATER = 0.3, 0.1, 0.3, 0.3
"""How often another network opens, or it is saved; how often a third opens before the second has;
how often a draft is left for later."""
IN_A_HURRY_MS = 100
"""Between two deeds, at most."""
NAMED = re.compile(r'<BehaviorNetwork name="n(\d+)"')
SHOWN = """(name) => document.querySelector(".status .path")?.textContent.replace(" •", "") === name
  && document.querySelectorAll(".react-flow__node").length > 0"""


@dataclass(eq=False)
class Session:
    """A network that is open in a tab, or was, with what is not saved."""

    path: Path
    value: int = 0
    """The number in its name; 0 when all is saved."""
    typed: float = 0.0
    coming: int = 0
    """The number that is typed at this moment."""


def measure(tries: int = TRIES, seed: int = SEED) -> dict[str, Any]:
    """Kill browsers. Raises NotAvailable without Chromium."""
    worst, wrong = 0.0, []
    with home() as folder, alive() as (_, studio), launcher() as launch:
        for number in progress(range(seed, seed + tries), tries, "killed"):
            one = Try(number, folder / str(number), studio)
            try:
                one.work(launch())
                worst = max(worst, one.check())
                one.reopen(launch())
            except HriError as error:
                wrong.append(f"--seed {number}: {error}")
            finally:
                chromium_killed()
    what = f"two tabs, {NETWORKS} networks, browser killed: nothing older than {LOST_S:g} s is lost"
    rows = [
        share(what, tries - len(wrong), tries, at_least(1)) | {"wrong": wrong[:10]},
        amount("oldest edit that was lost", worst, "s", at_most(LOST_S)),
    ]
    return {"tries": tries, "seed": seed, "rows": rows, "machine": machine()}


class Try:
    """What two tabs do until the browser is killed, and what is then on the disk."""

    def __init__(self, seed: int, folder: Path, studio: StudioSession) -> None:
        self._dice, self._studio = random.Random(seed), studio
        folder.mkdir()
        self._paths = [folder / f"net{number}.xml" for number in range(NETWORKS)]
        for path in self._paths:
            path.write_text(network_text(BEHAVIORS))
        self._sessions: list[Session] = []
        self._saved: dict[Path, int] = {}
        self._count = 0
        self._killed = 0.0

    def work(self, browser: Any) -> None:
        """Raises HriError when the page does not do what it is told."""
        from playwright.sync_api import Error

        timer = threading.Timer(self._dice.uniform(*KILL_AFTER), self._kill)
        try:
            context = browser.new_context(viewport=WINDOW)
            tabs = [_Tab(context.new_page(), self._studio.address()) for _ in range(2)]
            for tab in tabs:
                self._switch(tab)
            timer.start()
            while True:
                tab = self._dice.choice(tabs)
                self._deed(tab)
                tab.page.wait_for_timeout(self._dice.uniform(0, IN_A_HURRY_MS))
        except Error as error:
            if not self._killed:
                raise HriError(f"before the browser was killed: {error}") from error
        finally:
            timer.cancel()

    def _kill(self) -> None:
        self._killed = time.perf_counter()
        chromium_killed()

    def _deed(self, tab: _Tab) -> None:
        chance = self._dice.random()
        tab.keep_mine()
        if chance < SWITCH:
            self._switch(tab)
        elif chance < SWITCH + SAVE:
            self._save(tab)
        else:
            self._edit(tab)

    def _switch(self, tab: _Tab) -> None:
        others = [path for path in self._paths if path != tab.session.path]
        for path in self._dice.sample(others, 2 if self._dice.random() < TWICE else 1):
            tab.ask_for(path)
        tab.wait_for(path)
        tab.session = Session(path)
        if tab.is_asked("There "):
            if self._dice.random() < LATER:
                tab.press("Decide later")
            else:
                tab.press("Continue the draft")
                self._continued(tab)
        self._sessions.append(tab.session)

    def _continued(self, tab: _Tab) -> None:
        """The session has the draft of another, which needs no draft if its tab has left it."""
        value = int(tab.name()[1:])
        open_ones = [session for session in self._sessions if session is not tab.session]
        for one in open_ones:
            if one.path == tab.session.path and one.value == value:
                self._sessions.remove(one)
        tab.session.value, tab.session.typed = value, time.perf_counter()

    def _edit(self, tab: _Tab) -> None:
        self._count += 1
        tab.session.coming = self._count
        while tab.name() != f"n{self._count}" or tab.is_asked(""):
            tab.keep_mine()
            tab.set_name(f"n{self._count}")
        tab.session.value, tab.session.typed = self._count, time.perf_counter()
        tab.session.coming = 0

    def _save(self, tab: _Tab) -> None:
        session = tab.session
        if not session.value:
            return
        self._saved.pop(session.path, None)
        if tab.save():
            self._saved[session.path] = session.value
            session.value = 0

    def check(self) -> float:
        """Seconds since the oldest edit that was lost. Raises HriError for one that is too old."""
        worst = 0.0
        kept = {path: {_number(text) for text in _texts(path)} for path in self._paths}
        for path, value in self._saved.items():
            if value not in kept[path]:
                raise HriError(f"{path.name}: n{value} was saved and is gone")
        for one in self._sessions:
            if one.value and not {one.value, one.coming or one.value} & kept[one.path]:
                age = self._killed - one.typed
                if age > LOST_S:
                    raise HriError(
                        f"{one.path.name}: n{one.value}, typed {age:.1f} s before, is gone"
                    )
                worst = max(worst, age)
        return worst

    def reopen(self, browser: Any) -> None:
        """See that all drafts of a network are offered, newest first. Raises HriError."""
        drafted = [path for path in self._paths if len(_texts(path)) > 1]
        if not drafted:
            return
        path = self._dice.choice(drafted)
        saved, *drafts = _texts(path)
        expected = [f"n{_number(text)}" for text in drafts if text != saved]
        tab = _Tab(browser.new_context(viewport=WINDOW).new_page(), self._studio.address())
        tab.ask_for(path)
        tab.wait_for(path)
        offered = tab.page.locator(".composer-dialog .draft").all_inner_texts()
        found = [re.findall(r"→ (n\d+)", one)[-1] for one in offered]
        if found != expected:
            raise HriError(f"{path.name}: {expected} are kept, but {found} are offered")


class _Tab:
    """The hands of a person in a tab."""

    def __init__(self, page: Any, address: str) -> None:
        self.page = page
        self.session = Session(Path())
        page.goto(address)
        linked(page)

    def ask_for(self, path: Path) -> None:
        self.page.evaluate("(path) => { location.hash = '#networks/' + path; }", str(path))

    def wait_for(self, path: Path) -> None:
        self._until(lambda: self.page.evaluate(SHOWN, path.name), f"{path.name} is not shown")

    def _until(self, holds: Callable[[], bool], what: str) -> None:
        end = time.perf_counter() + 20.0
        while not holds():
            if time.perf_counter() > end:
                raise HriError(what)
            self.page.wait_for_timeout(10)

    def is_asked(self, title: str) -> bool:
        asked = self.page.locator("dialog.composer-dialog").all_inner_texts()
        return any(title in one for one in asked)

    def press(self, name: str) -> None:
        self.page.get_by_role("button", name=name).first.click()
        self._until(lambda: not self.is_asked(""), f'a dialog stays after "{name}"')

    def keep_mine(self) -> None:
        """Answer the question that comes by itself when the other tab has saved."""
        if self.is_asked("The file changed"):
            self.press("Keep what I have")

    def name(self) -> str:
        return str(self.page.get_by_label("Name", exact=True).input_value())

    def set_name(self, name: str) -> None:
        self.page.get_by_label("Name", exact=True).fill(name)
        self.page.keyboard.press("Enter")

    def save(self) -> bool:
        """Whether it was saved; else the other tab has, and this one keeps what it has."""
        saved = self.page.get_by_text(f"saved {self.session.path}", exact=True)
        self.page.locator("[data-action=save]").click()
        what = f"{self.session.path.name} is neither saved nor refused"
        self._until(lambda: saved.count() > 0 or self.is_asked("The file changed"), what)
        is_saved = not self.is_asked("The file changed")
        self.keep_mine()
        return is_saved


def _texts(path: Path) -> list[str]:
    """The file, then its drafts, newest first. Raises HriError for half a draft."""
    while True:
        with suppress(FileNotFoundError):  # the server is still at it: a draft went meanwhile
            return [path.read_text(), *_drafts(path)]


def _drafts(path: Path) -> list[str]:
    try:
        drafts = [json.loads(one.read_text()) for one in path.parent.glob(f".{path.name}.*draft")]
    except ValueError as error:
        raise HriError(f"{path.name}: half a draft was written") from error
    return [one["text"] for one in sorted(drafts, key=lambda one: -one["time"])]


def _number(text: str) -> int:
    found = NAMED.search(text)
    return int(found[1]) if found else 0
