"""A simulated robot with its studio, and Chromium with its page, for what is measured there."""

from __future__ import annotations

import shutil
import threading
from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager, suppress
from functools import partial
from typing import Any

import psutil

from hri.core.errors import NotAvailable
from hri.hal.resource import Description
from hri.robot import Robot
from hri.studio.session import StudioSession

DEVICES = (Description("screen", "Hri.OffscreenScreen"), Description("voice", "Hri.SilentVoice"))
WINDOW = {"width": 1360, "height": 900}
"""Pixels."""


@contextmanager
def living(robot: Robot, run: Callable[..., object], *jobs: Any) -> Iterator[StudioSession]:
    """A robot in a thread, with a studio."""
    studio = StudioSession(robot, port=0)
    thread = threading.Thread(target=lambda: run(*studio.jobs(), *jobs))
    with closing(robot), closing(studio):
        studio.start()
        thread.start()
        while not studio.server:  # it starts in a thread
            threading.Event().wait(0.01)
        try:
            yield studio
        finally:
            robot.context.clock.soon(robot.finish)
            thread.join()


def companion() -> Robot:
    """In real time."""
    return Robot("companion", "simulated", devices=DEVICES, notice=lambda line: None)


@contextmanager
def alive() -> Iterator[tuple[Robot, StudioSession]]:
    """The companion with its studio, in real time."""
    robot = companion()
    with living(robot, robot.live_until_over, *robot.app.load_tasks()) as studio:
        yield robot, studio


def chromium() -> str:
    """Its path. Raises NotAvailable."""
    found = shutil.which("chromium") or shutil.which("chromium-browser")
    if found is None:
        raise NotAvailable("no Chromium - apt install chromium")
    return found


@contextmanager
def launcher() -> Iterator[Any]:
    """Launches Chromium, to be driven from here. Raises NotAvailable."""
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        raise NotAvailable("no playwright - pip install hri[dev]") from None
    path = chromium()
    with sync_playwright() as playwright:
        launch = partial(playwright.chromium.launch, executable_path=path, args=["--no-sandbox"])
        yield launch


@contextmanager
def shown_page(studio: StudioSession) -> Iterator[Any]:
    """The page in Chromium, once it is linked. Raises NotAvailable."""
    with launcher() as launch, closing(launch()) as browser:
        yield opened(browser, studio)


def opened(browser: Any, studio: StudioSession, **more: Any) -> Any:
    """The page in a browser, once it is linked."""
    page = browser.new_page(viewport=WINDOW, **more)
    page.goto(studio.address())
    linked(page)
    return page


def linked(page: Any) -> None:
    """Wait until a page is linked to the robot."""
    page.get_by_text("linked", exact=True).wait_for()


def chromium_killed() -> None:
    """All of Chromium that this process has started."""
    for process in psutil.Process().children(recursive=True):
        with suppress(psutil.NoSuchProcess):
            if "chrom" in process.name():
                process.kill()
