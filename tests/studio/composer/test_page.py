"""The composer in a browser: networks are built, run, looked into, and never lost."""

import os
import re
import signal

import pytest

from hri.behavior.network_file import load_network
from hri.core import paths
from tests.studio.browser import DESKTOP, NEEDS, PHONE, opened, violations
from tests.studio.composer.hands import TUTORIAL, Composer

pytest.importorskip("playwright", reason="no playwright - pip install hri[dev]")
from playwright.sync_api import expect

pytestmark = NEEDS

MOVING = str(paths.house() / "apps" / "companion" / "moving.xml")


def test_the_keyboard_alone_builds_a_network(studio, page):
    hands = Composer(page)
    hands.new("keys")
    search = page.locator("#palette-search")
    for words in ("hri.constant", "hri.scale"):
        search.focus()
        page.keyboard.type(words)
        page.keyboard.press("Enter")
        search.fill("")
    expect(page.locator(".side h2").first).to_have_text("scale")
    page.get_by_label("factor", exact=True).focus()
    page.keyboard.press("Control+a")
    page.keyboard.type("0.5")
    page.keyboard.press("Enter")
    choice = page.get_by_label("Link scale.input from", exact=True)
    choice.focus()
    expect(choice.locator("option")).not_to_have_count(1)
    page.keyboard.type("constant.value")
    page.keyboard.press("Enter")
    page.keyboard.press("Tab")
    page.keyboard.press("Control+s")
    expect(page.locator(".status .notice")).to_contain_text("saved")
    network = load_network(studio.home / "keys.xml")
    assert [str(link) for link in network.links] == ["constant.value -> scale.input"]
    assert network["scale"].factor == 0.5


def test_a_wire_that_does_not_fit_is_refused_with_the_reason(page):
    hands = Composer(page)
    hands.open(MOVING)
    hands.link("bumper.is_pressed", "gate.speed")
    notice = page.locator(".status .notice")
    expect(notice).to_contain_text("bumper.is_pressed is boolean, but gate.speed takes double")
    hands.link("bumper.is_pressed", "gate.bump")
    expect(notice).to_contain_text("is there already")
    assert page.locator("[data-action=undo]").is_disabled(), "nothing has changed"


def test_all_is_undone_and_done_again(studio, page):
    hands = Composer(page)
    (studio.home / "undo.xml").write_text(TUTORIAL)
    hands.open(studio.home / "undo.xml")
    hands.part("constant").click()
    hands.set("parsed_value", "7")
    hands.key("Delete")  # in the field: a letter, not the behavior
    page.locator(".react-flow__pane").click(position={"x": 5, "y": 5})
    hands.part("subtraction").click()
    hands.key("Delete")
    expect(hands.part("subtraction")).to_have_count(0)
    expect(page.locator(".react-flow__edge")).to_have_count(4)
    hands.drag(hands.part("camera"), page.locator(".react-flow__controls"))
    hands.key("Control+z")
    hands.key("Control+z")
    expect(hands.part("subtraction")).to_have_count(1)
    hands.key("Control+z")
    expect(page.locator("[data-action=undo]")).to_be_disabled()
    expect(page.locator(".status")).to_contain_text("saved")
    for _ in range(3):
        hands.key("Control+y")
    expect(hands.part("subtraction")).to_have_count(0)
    hands.save()
    saved = (studio.home / "undo.xml").read_text()
    assert 'value="7"' in saved
    assert "subtraction" not in saved
    assert saved.count("<Box") == 1


def test_problems_appear_at_the_part_in_the_words_of_the_checker(studio, page):
    hands = Composer(page)
    (studio.home / "wrong.xml").write_text(TUTORIAL)
    hands.open(studio.home / "wrong.xml")
    hands.do("text")
    hands.choose_word('"true"')
    page.keyboard.type("perhaps")
    expect(hands.part("input_collector").locator(".part.broken")).to_have_count(1)
    expect(page.locator(".problems")).to_contain_text("is not true or false - write true or false")
    page.keyboard.type("<")
    expect(page.locator(".unreadable")).to_be_visible()
    page.keyboard.press("Backspace")
    expect(page.locator(".unreadable")).to_have_count(0)
    page.keyboard.press("Control+z")
    expect(hands.part("input_collector").locator(".part.broken")).to_have_count(0)


def test_a_draft_is_offered_after_the_browser_and_the_server_were_killed(studio):
    file = studio.home / "lost.xml"
    file.write_text(TUTORIAL)
    with opened(studio.address()) as page:
        hands = Composer(page)
        hands.open(file)
        hands.part("constant").click()
        hands.set("parsed_value", "9")
        expect(page.locator(".status")).to_contain_text("draft kept", timeout=2000)
    os.kill(studio.server, signal.SIGKILL)
    assert file.read_text() == TUTORIAL
    with opened(studio.address()) as page:
        hands = Composer(page)
        hands.open(file)
        dialog = page.locator(".composer-dialog")
        expect(dialog).to_contain_text("constant: parsed_value 80 → 9")
        dialog.get_by_role("button", name="Continue the draft").click()
        hands.save()
    assert file.read_text() == TUTORIAL.replace('"80"', '"9"')


def test_a_save_whose_answer_was_lost_is_known_again_and_drafts_go_on(studio, page):
    file = studio.home / "unanswered.xml"
    file.write_text(TUTORIAL)
    hands = Composer(page)
    hands.open(file)
    hands.part("constant").click()

    def lose_the_answer(route):
        route.fetch()
        route.abort()

    saving = re.compile("/api/v1/networks/file$")
    for value, is_looked_at in (("7", True), ("8", False)):
        hands.set("parsed_value", value)
        page.route(saving, lose_the_answer)
        with page.expect_event("requestfailed"):
            hands.do("save")
        hands.set("parsed_value", f"{value}1")
        expect(page.locator(".status")).to_contain_text("draft kept")
        assert f'"{value}"' in file.read_text()
        page.unroute(saving)
        if is_looked_at:
            with page.expect_response(re.compile("/api/v1/networks/watch")):
                pass
        hands.save()
        assert f'"{value}1"' in file.read_text()
    expect(page.locator(".composer-dialog")).to_have_count(0)


def test_a_file_that_changed_outside_is_a_choice(studio, page):
    file = studio.home / "both.xml"
    file.write_text(TUTORIAL)
    hands = Composer(page)
    hands.open(file)
    file.write_text(TUTORIAL.replace('"80"', '"70"'))
    expect(page.locator(".status .notice")).to_contain_text("changed outside")
    hands.part("constant").click()
    expect(page.get_by_label("parsed_value", exact=True)).to_have_value("70")
    hands.set("parsed_value", "60")
    file.write_text(TUTORIAL.replace('"80"', '"50"'))
    dialog = page.locator(".composer-dialog")
    expect(dialog).to_contain_text("constant: parsed_value 60 → 50")
    dialog.get_by_role("button", name="Keep what I have").click()
    hands.save()
    assert '"60"' in file.read_text()


def test_the_whole_app_is_shown_together(page):
    hands = Composer(page)
    hands.open(MOVING)
    alone = page.locator(".react-flow__node").count()
    hands.do("whole")
    expect(page.locator(".react-flow__node.other").first).to_be_visible()
    assert page.locator(".react-flow__node").count() > alone + 8
    page.locator(".react-flow__node[data-id='hearing/listener']").dblclick()
    expect(page.locator(".status .path")).to_have_text("hearing.xml")


def test_the_schema_is_shown_on_right_click(page):
    hands = Composer(page)
    hands.open(MOVING)
    hands.part("gate").click(button="right")
    page.get_by_role("menuitem", name="Schema of").click()
    expect(page.locator(".composer-dialog pre")).to_contain_text('<Port name="twist"')


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
def test_nothing_stands_in_the_way_of_a_screen_reader(studio, scheme, size):
    more = {"color_scheme": scheme, "bypass_csp": True}
    with opened(studio.address(), size, **more) as page:
        hands = Composer(page)
        hands.open(MOVING)
        hands.part("gate").focus()
        page.keyboard.press("Enter")
        hands.do("text")
        expect(page.locator(".xml-source .cm-content")).to_be_visible()
        found = violations(page)
        width = page.evaluate("document.documentElement.scrollWidth")
    assert found == []
    assert width == size["width"]
