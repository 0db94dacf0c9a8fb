"""The page in a browser: it shows the robot, talks to it, stops it, and works by keyboard alone."""

import os
import signal
from contextlib import closing

import pytest

from tests.studio.browser import DESKTOP, NEEDS, PHONE, chromium, opened, violations
from tests.studio.living import living

pytest.importorskip("playwright", reason="no playwright - pip install hri[dev]")
from playwright.sync_api import expect

pytestmark = NEEDS


def used(script, **more):
    """What a script finds that uses the page."""

    with living() as (studio, _), opened(studio.address(), **more) as page:
        return script(page, studio)


def test_it_shows_the_face_what_it_sees_feels_and_says():
    def script(page, studio):
        expect(page.locator("#robot")).to_have_text("companion, simulated")
        for picture in ("face", "camera"):
            expect(page.locator(f"#{picture}-picture")).to_have_attribute("data-shown", "yes")
        page.fill("#text", "hello")
        page.keyboard.press("Enter")
        expect(page.locator("#lines .person")).to_contain_text("hello")
        expect(page.locator("#lines .robot").first).not_to_be_empty()
        expect(page.locator("#mood")).to_contain_text("I am")
        expect(page.locator("#people li").first).to_contain_text("m")
        assert page.locator("#map .wall").count() >= 4
        assert page.locator("#device-list li").count() >= 8

    used(script)


def test_what_can_be_said_stands_beside_the_conversation_and_is_written_by_a_choice():
    def script(page, studio):
        expect(page.locator("#saying-list option").first).to_have_text("hello")
        page.fill("#seek", "battery")
        expect(page.locator("#saying-list optgroup")).to_have_count(1)
        page.locator("#saying-list").select_option("how is your battery")
        expect(page.locator("#text")).to_have_value("how is your battery")
        page.fill("#text", "turn purple now")
        page.keyboard.press("Enter")
        told = page.locator("#lines .ignored")
        expect(told).to_contain_text("turn purple now")
        expect(told).to_contain_text('Nearest: "turn left"')
        expect(page.locator("#lines .robot").last).to_contain_text("turning")

    used(script)


def test_the_stop_key_works_everywhere_and_the_stop_stays_until_it_is_released():
    def script(page, studio):
        page.fill("#text", "go forward")
        page.keyboard.press("Escape")
        expect(page.locator("#where")).to_contain_text("I stopped because someone pressed stop")
        expect(page.locator("#release")).to_be_visible()
        page.click("#release")
        expect(page.locator("#release")).to_be_hidden()

    used(script)


def test_everything_is_reached_by_the_keyboard_and_has_a_name():
    def script(page, studio):
        names = page.evaluate(
            """() => [...document.querySelectorAll("button, input, select")]
                 .filter((one) => one.offsetParent !== null && !one.disabled)
                 .map((one) => one.innerText || one.labels?.[0]?.innerText || "")"""
        )
        reached = set()
        for _ in range(3 * len(names)):
            page.keyboard.press("Tab")
            reached.add(
                page.evaluate(
                    "document.activeElement.innerText || "
                    "document.activeElement.labels?.[0]?.innerText || ''"
                )
            )
        assert all(names)
        assert set(names) <= reached
        page.locator("#keys").press("?")  # in a field it would be written
        expect(page.locator("#help")).to_be_visible()
        page.keyboard.press("Enter")
        expect(page.locator("#help")).to_be_hidden()

    used(script)


def test_it_comes_back_when_the_server_was_killed():
    def script(page, studio):
        os.kill(studio.server, signal.SIGKILL)
        expect(page.locator("#link")).to_have_text("no link")
        expect(page.locator("#link")).to_have_text("linked")

    used(script)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_it_fits_a_phone(scheme):
    def script(page, studio):
        width = page.evaluate("document.documentElement.scrollWidth")
        return width, page.locator("#stop").is_visible()

    assert used(script, size=PHONE, color_scheme=scheme) == (PHONE["width"], True)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_nothing_stands_in_the_way_of_a_screen_reader(scheme, size):
    def script(page, studio):
        page.fill("#text", "hello")
        page.keyboard.press("Enter")
        expect(page.locator("#lines .robot").first).to_be_visible()
        return violations(page)

    assert used(script, size=size, color_scheme=scheme, bypass_csp=True) == []


def test_a_browser_that_is_not_known_says_what_to_do():
    with living() as (studio, _), chromium() as browser, closing(browser.new_page()) as page:
        page.goto(studio.address().partition("?")[0])
        expect(page.locator("#notice")).to_contain_text("open the address that hri studio")
