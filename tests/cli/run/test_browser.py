"""`--open` shows the page to its user, and its code to nobody else."""

import argparse
import os
import re
import stat
from html import unescape
from pathlib import Path
from urllib.parse import unquote, urlsplit

import httpx2 as httpx
import psutil
import pytest

from hri.cli.run import browser
from hri.cli.run.studio_options import show_address, studio_of
from hri.core import paths
from hri.core.errors import HriError
from hri.core.token import own_token
from hri.studio.port import PortTaken
from tests.studio.browser import CHROMIUM, NEEDS_BROWSER
from tests.studio.living import living

ADDRESS = "http://127.0.0.1:8311/?code=a-code"
OPEN = argparse.Namespace(open=True, port=8311, allow_remote=False)


class Browser:
    """Stands in for a browser: a program with arguments that everybody can read."""

    def __init__(self, monkeypatch):
        self.words = []
        monkeypatch.setattr("webbrowser.open", self.open)
        self.is_there = True

    def open(self, words):
        self.words.append(words)
        return self.is_there

    @property
    def file(self):
        """What it was told to open last."""
        address = urlsplit(self.words[-1])
        assert (address.scheme, address.netloc) == ("file", "")
        return Path(unquote(address.path))

    def leads_to(self):
        """Where the refresh and the link of that file lead."""
        text = self.file.read_text()
        (there,) = re.findall(r'http-equiv="refresh" content="0; url=([^"]*)"', text)
        (link,) = re.findall(r'<a href="([^"]*)"', text)
        assert there == link
        return unescape(there)


@pytest.fixture
def shown(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "a folder & more"))
    monkeypatch.setattr(browser, "SNAPS", tmp_path / "no snaps")
    return Browser(monkeypatch)


def test_the_code_is_in_a_file_of_its_user_alone(shown):
    before = os.umask(0)
    try:
        browser.open_page(ADDRESS)
    finally:
        os.umask(before)
    assert "a-code" not in shown.words[0]
    assert shown.leads_to() == ADDRESS
    assert stat.S_IMODE(shown.file.stat().st_mode) == 0o600
    assert stat.S_IMODE(shown.file.parent.stat().st_mode) == 0o700
    assert shown.file.is_relative_to(paths.state_folder())
    browser.forget_page(8311)
    assert not shown.file.parent.exists()
    browser.forget_page(8311)


def test_the_page_is_reached_by_the_file_and_gives_a_cookie(shown):
    with living() as (studio, robot):
        while robot.clock.now() < 0.1:  # it answers from then on
            os.sched_yield()
        told = []
        show_address(studio, OPEN, told.append)
        with httpx.Client(follow_redirects=True) as client:
            assert client.get(shown.leads_to()).status_code == 200
            state = f"http://127.0.0.1:{studio.port}/api/v1/state"
            assert client.get(state).status_code == 200
        token, secrets = own_token(), (studio._config["secret"], *studio._codes._open)
        children = psutil.Process().children(recursive=True)
        assert studio.server in [child.pid for child in children]
        for child in children:
            told_to_it = [*child.cmdline(), *child.environ().values()]
            assert not [one for one in (token, *secrets) if one in "\n".join(told_to_it)]
        assert re.fullmatch(rf"studio +http://127.0.0.1:{studio.port}/\?code=\S+", told[0])
        assert "open this address" in told[1]
        browser.forget_page(studio.port)


@pytest.mark.slow
@NEEDS_BROWSER
def test_a_real_browser_is_led_to_the_page_and_known_there(shown):
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright")
    with living() as (studio, robot), playwright.sync_playwright() as started:
        while robot.clock.now() < 0.1:
            os.sched_yield()
        browser.open_page(studio.address())
        chromium = started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        page = chromium.new_page()
        page.goto(shown.words[0])
        linked = page.locator("#link")
        playwright.expect(linked).to_have_text("linked", timeout=20_000)
        assert page.url.startswith(f"http://127.0.0.1:{studio.port}/")
        assert "code" not in page.url
        chromium.close()
        browser.forget_page(studio.port)


def test_what_is_written_is_text_and_no_markup(shown):
    browser.open_page(address := 'http://127.0.0.1:1/?code="><script>alert(1)</script>&x')
    assert "<script" not in shown.file.read_text()
    assert shown.leads_to() == address


def test_the_page_of_another_robot_is_opened_by_a_file_too(shown, monkeypatch):
    def taken(*_):
        raise PortTaken("it is taken", ADDRESS)

    monkeypatch.setattr("hri.cli.run.studio_options.StudioSession", taken)
    with pytest.raises(PortTaken):
        studio_of(None, OPEN)
    assert shown.leads_to() == ADDRESS
    browser.open_page(ADDRESS + "-newer")
    assert shown.leads_to() == ADDRESS + "-newer"


def test_browsers_of_snaps_get_a_folder_that_they_can_see(shown, monkeypatch, tmp_path):
    monkeypatch.setattr(browser, "SNAPS", tmp_path)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    (tmp_path / "home").mkdir(mode=0o755)
    browser.open_page(ADDRESS)
    assert shown.file == tmp_path / "home" / "hri-studio-8311" / "open.html"
    assert shown.leads_to() == ADDRESS
    browser.forget_page(8311)
    assert list((tmp_path / "home").iterdir()) == []
    assert stat.S_IMODE((tmp_path / "home").stat().st_mode) == 0o755


@pytest.mark.parametrize("make", [Path.mkdir, Path.touch, lambda path: path.symlink_to("/tmp")])
def test_what_someone_put_there_is_not_used(shown, make):
    folder = paths.state_folder() / "hri-studio-8311"
    folder.parent.mkdir(parents=True)
    make(folder)
    if folder.is_dir() and not folder.is_symlink():
        (folder / "mine.txt").touch()
    with pytest.raises(HriError, match=r"hri-studio-8311: cannot be made: .* - move it away"):
        browser.open_page(ADDRESS)
    assert shown.words == []


def test_without_a_browser_the_printed_address_is_named(shown):
    shown.is_there = False
    told = []
    robot = argparse.Namespace(address=lambda: ADDRESS)
    show_address(robot, OPEN, told.append)
    assert "no browser was found" in told[1]
    assert "open this address in a browser" in told[1]
