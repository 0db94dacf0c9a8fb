"""The view of recordings in a browser: opened, played and searched by mouse, keyboard and touch."""

import json

import pytest

from hri.core.growing_files import GrowingFile
from hri.core.recorded import EVENTS
from hri.core.stored_data_index import note
from tests.studio.browser import DESKTOP, NEEDS, PHONE, opened, until, violations
from tests.studio.living import living
from tests.studio.recorded import visit

pytest.importorskip("playwright", reason="no playwright - pip install hri[dev]")
from playwright.sync_api import expect

pytestmark = NEEDS
COUNTING = """
  window.made = 0;
  for (const [name, step] of [["createObjectURL", 1], ["revokeObjectURL", -1]]) {
    const real = URL[name].bind(URL);
    URL[name] = (what) => { window.made += step; return real(what); };
  }
"""


@pytest.fixture(scope="module")
def studio():
    with living() as (studio, _):
        yield studio


@pytest.fixture
def folder(tmp_path):
    made = visit(tmp_path / "a visit")
    note("recording", made)
    return made


def view(page, folder=""):
    """Go to the list, or to a recording."""
    page.evaluate("(hash) => { location.hash = hash }", f"#recordings/{folder}")
    if folder:
        expect(page.locator("#rec-title")).to_have_text(folder.name)


def seconds(page):
    return float(page.locator("#rec-slider").input_value())


def at(page, time):
    """Wait until the playhead is there."""
    until(
        page, "(time) => Math.abs(document.getElementById('rec-slider').value - time) < 0.01", time
    )


def goes_on(page):
    """Whether time passes; by how many seconds, after it has for a while."""
    before = seconds(page)
    until(page, "(time) => document.getElementById('rec-slider').value > time + 0.7", before)


def test_one_is_opened_from_the_list_and_shown_as_it_was(studio, folder):
    with opened(studio.address()) as page:
        page.click("#to-recordings")
        expect(page.locator("#to-recordings")).to_have_attribute("aria-current", "page")
        row = page.locator("#rec-known a", has_text=str(folder))
        expect(row).to_contain_text("1:00")
        row.click()
        expect(page.locator("#rec-title")).to_be_focused()
        expect(page.locator("#rec-picture")).not_to_have_js_property("naturalWidth", 0)
        expect(page.locator("#rec-lines button")).to_have_count(5)
        assert page.locator("#rec-events button").count() == 11
        assert page.locator("#rec-tracks .lane line").count() == 8
        page.locator("#rec-slider").fill("31.5")
        expect(page.locator("#rec-felt")).to_have_text("I am scared")
        expect(page.locator("#rec-values .arousal")).to_contain_text("0.60")
        expect(page.locator("#rec-events [aria-current]")).to_contain_text("bumper.pressed")
        expect(page.locator("#rec-lines [aria-current]")).to_contain_text("ignored")
        assert page.locator("#rec-wrong").is_hidden()


def test_it_plays_with_its_sound_and_one_picture_is_asked_for_at_a_time(studio, folder):
    with opened(studio.address()) as page:
        page.evaluate(COUNTING)
        page.evaluate(
            """() => { const real = window.fetch; window.open_now = 0; window.most = 0;
                 window.fetch = async (...all) => {
                   if (!String(all[0]).includes("/face")) return real(...all);
                   window.most = Math.max(window.most, ++window.open_now);
                   try { return await real(...all); } finally { window.open_now--; } } }"""
        )
        view(page, folder)
        page.keyboard.press(" ")
        goes_on(page)
        together = """() => {
            const sound = document.getElementById('rec-audio').currentTime;
            const place = document.getElementById('rec-slider').value;
            return sound > 0.5 && Math.abs(sound - place) < 0.3 }"""
        until(page, together)  # a busy machine hands the sound over late
        page.locator("#rec-speeds button").last.click()
        goes_on(page)
        assert page.evaluate("document.getElementById('rec-audio').playbackRate") == 2
        page.keyboard.press(" ")  # a button that was clicked leaves the space bar to the player
        expect(page.locator("#rec-play")).to_have_text("Play")
        box = page.locator("#rec-curves").bounding_box()
        page.mouse.move(box["x"] + 30, box["y"] + 20)
        page.mouse.down()
        page.mouse.move(box["x"] + box["width"] / 2, box["y"] + 20, steps=40)
        page.mouse.up()
        assert seconds(page) == pytest.approx(30, abs=0.2)
        assert page.evaluate("window.most") == 1
        until(page, "() => window.open_now === 0 && window.made <= 3")  # with live pictures


def test_without_sound_the_clock_of_the_page_plays_it(studio, tmp_path):
    silent = visit(tmp_path / "silent", has_sound=False)
    with opened(studio.address()) as page:
        view(page, silent)
        expect(page.locator("#rec-wrong")).to_contain_text("robot.wav")
        expect(page.locator("#rec-mute")).to_be_hidden()
        page.click("#rec-play")
        goes_on(page)
        page.locator("body").press("End")
        expect(page.locator("#rec-play")).to_have_text("Play")
        at(page, 60)


def test_everything_is_done_by_keyboard(studio, folder):
    with opened(studio.address()) as page:
        view(page, folder)
        for key, time in {
            "ArrowRight": 1, "Shift+ArrowRight": 11, "ArrowLeft": 10, "End": 60, "Home": 0,
        }.items():  # fmt: skip
            page.keyboard.press(key)
            at(page, time)
        page.locator("#rec-slider").focus()
        page.keyboard.press("Shift+ArrowRight")
        at(page, 10)
        expect(page.locator("#rec-slider")).to_have_attribute(
            "aria-valuetext", "10 seconds of 1 minute 0 seconds"
        )
        page.locator("#rec-lines [tabindex='0']").focus()
        page.keyboard.press("ArrowDown")
        page.keyboard.press("ArrowDown")
        expect(page.locator("#rec-lines button").nth(3)).to_be_focused()
        page.keyboard.press("Enter")
        at(page, 45)
        assert page.locator("#rec-lines [tabindex='0']").count() == 1
        page.keyboard.press("Escape")  # stops the robot here, too
        expect(page.locator("#release")).to_be_visible()
        page.click("#release")
        expect(page.locator("#release")).to_be_hidden()


def test_a_finger_moves_the_playhead_on_a_phone(studio, folder):
    with opened(studio.address(), PHONE, has_touch=True) as page:
        view(page, folder)
        page.locator("#rec-curves").scroll_into_view_if_needed()
        box = page.locator("#rec-tracks .lane").first.bounding_box()
        page.touchscreen.tap(box["x"] + box["width"] / 2, box["y"] + 8)
        assert seconds(page) == pytest.approx(30, abs=0.5)


def test_the_address_names_what_is_shown(studio, folder):
    with opened(studio.address()) as page:
        view(page)
        view(page, folder)
        page.reload()
        expect(page.locator("#rec-title")).to_have_text(folder.name)
        page.go_back()
        expect(page.locator("#rec-list")).to_be_visible()
        page.go_back()
        expect(page.locator("#live")).to_be_visible()
        expect(page.locator("#recordings")).to_be_hidden()


def test_a_folder_is_opened_by_its_path_and_what_is_none_is_refused(studio, folder):
    with opened(studio.address()) as page:
        view(page)
        for wrong in (folder.parent, "/missing", "%"):
            page.fill("#rec-folder", str(wrong))
            page.keyboard.press("Enter")
            expect(page.locator("#rec-notice")).to_contain_text(f"{wrong}: not a recording")
            expect(page.locator("#rec-list")).to_be_visible()
            expect(page.locator("#rec-folder")).to_have_value(str(wrong))
        page.fill("#rec-folder", str(folder))
        page.keyboard.press("Enter")
        expect(page.locator("#rec-title")).to_have_text(folder.name)
        expect(page.locator("#rec-notice")).to_be_hidden()


def test_a_refusal_that_comes_late_leaves_what_was_typed_since(studio, folder):
    with opened(studio.address()) as page:

        def type_on(route):
            page.fill("#rec-folder", str(folder))
            route.continue_()

        view(page)
        expect(page.locator("#rec-known")).to_contain_text(folder.name)
        page.route("**/api/v1/recordings", type_on)
        page.fill("#rec-folder", "/missing")
        page.keyboard.press("Enter")
        expect(page.locator("#rec-notice")).to_contain_text("/missing: not a recording")
        expect(page.locator("#rec-folder")).to_have_value(str(folder))


def test_one_that_is_still_written_says_so_and_grows(studio, tmp_path):
    growing = tmp_path / "now"
    growing.mkdir()
    log = GrowingFile(growing / EVENTS)

    def say(time, text):
        log.append(json.dumps({"t": time, "event": "speech.said", "text": text}).encode() + b"\n")

    say(1.0, "One.")
    with opened(studio.address()) as page:
        view(page, growing)
        expect(page.locator("#rec-growing")).to_be_visible()
        expect(page.locator("#rec-lines button")).to_have_count(1)
        say(5.0, "Two.")
        expect(page.locator("#rec-lines button")).to_have_count(2)
        log.close()
        expect(page.locator("#rec-growing")).to_be_hidden()
        expect(page.locator("#rec-end")).to_have_text("0:05")


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_nothing_stands_in_the_way_of_a_screen_reader(studio, folder, scheme, size):
    with opened(studio.address(), size, color_scheme=scheme, bypass_csp=True) as page:
        view(page)
        expect(page.locator("#rec-known a").first).to_be_visible()
        assert violations(page) == []
        view(page, folder)
        expect(page.locator("#rec-lines button")).to_have_count(5)
        page.locator("#rec-slider").fill("31.5")
        assert violations(page) == []
        assert page.evaluate("document.documentElement.scrollWidth") == size["width"]
        expect(page.locator("#stop")).to_be_in_viewport()
