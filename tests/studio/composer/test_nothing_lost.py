"""Two tabs, quick hands, a server that is away: the composer loses no work and does what was asked
last.
"""

import json
import re
from itertools import pairwise

import pytest

from tests.studio.browser import NEEDS, opened, until
from tests.studio.composer.hands import TUTORIAL, Composer

pytest.importorskip("playwright", reason="no playwright - pip install hri[dev]")
from playwright.sync_api import expect

pytestmark = NEEDS

RUNS = """<BehaviorNetwork>
  <Behavior id="constant" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
  <Behavior id="end" type="Hri.InputCollector"/>
  <Link from="constant.value" to="end.input"/>
</BehaviorNetwork>
"""
DRAFTS = re.compile("/api/v1/networks/draft")


@pytest.fixture
def file(studio, request):
    path = studio.home / f"{request.node.name.partition('[')[0][5:]}.xml"
    path.write_text(TUTORIAL)
    return path


@pytest.fixture
def other(studio, file):
    path = file.with_stem(f"{file.stem}_other")
    path.write_text(TUTORIAL.replace("80", "81"))
    return path


def tab(page):
    """Another tab of the same browser."""
    made = page.context.new_page()
    made.set_default_timeout(20_000)
    made.goto(page.url.partition("#")[0])
    expect(made.locator("#link")).to_have_text("linked")
    return made


def named(page, file, name):
    """The hands of a person who has given a network a name, of which a draft is kept."""
    hands = Composer(page)
    hands.open(file)
    decide_later(page)
    hands.set("Name", name)
    expect(page.locator(".status")).to_contain_text("draft kept")
    return hands


def decide_later(page):
    """Drafts of other tabs stay as they are."""
    expect(page.locator(".react-flow__node")).to_have_count(7)
    later = page.get_by_role("button", name="Decide later")
    if later.count():
        later.click()


def is_draft(request, method):
    return request.method == method and bool(DRAFTS.search(request.url))


def drafts(file):
    return {
        json.loads(one.read_text())["text"].partition('name="')[2].partition('"')[0]
        for one in file.parent.glob(f".{file.name}*.draft")
    }


def test_two_tabs_keep_a_draft_each_and_a_save_forgets_one(studio, file):
    with opened(studio.address()) as page:
        first = named(page, file, "first")
        second = named(tab(page), file, "second")
        assert drafts(file) == {"first", "second"}
        first.save()
        assert drafts(file) == {"second"}
        expect(second.page.locator(".composer-dialog")).to_contain_text("The file changed")
        assert all(one.stat().st_mode & 0o077 == 0 for one in file.parent.glob(".*.draft"))
    with opened(studio.address()) as page:
        hands = Composer(page)
        hands.open(file)
        dialog = page.locator(".composer-dialog")
        expect(dialog).to_contain_text("There is a draft that was not saved")
        page.get_by_role("button", name="Continue the draft").click()
        expect(page.get_by_label("Name", exact=True)).to_have_value("second")
        expect(page.locator(".status")).to_contain_text("draft kept")
        hands.save()
        assert 'name="second"' in file.read_text()
        until(page, "() => !document.querySelector('.status').textContent.includes('•')")
    assert drafts(file) == set()


def test_all_drafts_that_are_left_are_offered_and_none_goes_unasked(studio, file):
    with opened(studio.address()) as page:
        named(page, file, "first")
        named(tab(page), file, "second")
    with opened(studio.address()) as page:
        hands = Composer(page)
        hands.open(file)
        offers = page.locator(".composer-dialog .draft")
        expect(offers).to_have_count(2)
        expect(offers.first).to_contain_text("→ second")
        page.keyboard.press("Escape")
        page.get_by_role("button", name="Decide later").click()
        assert drafts(file) == {"first", "second"}
        hands.set("Name", "third")
        expect(page.locator(".status")).to_contain_text("draft kept")
        assert drafts(file) == {"first", "second", "third"}
        page.reload()
        expect(offers).to_have_count(3)
        offers.nth(1).get_by_role("button", name="Discard the draft").click()
        expect(offers).to_have_count(2)
        offers.first.get_by_role("button", name="Continue the draft").click()
        expect(page.locator(".status")).to_contain_text("draft kept")
        page.locator(".react-flow__pane").click(position={"x": 5, "y": 5})
        with page.expect_response(lambda one: is_draft(one.request, "DELETE")):
            hands.key("Control+z")
        expect(page.locator(".status")).to_contain_text("saved")
        assert drafts(file) == {"first"}


def test_a_draft_that_another_tab_discarded_is_kept_again_while_its_tab_is_open(page, file):
    named(page, file, "first")
    second = tab(page)
    Composer(second).open(file)
    with page.expect_response(lambda one: is_draft(one.request, "PUT")):
        second.get_by_role("button", name="Discard the draft").click()
        expect(second.locator(".composer-dialog")).to_have_count(0)
        page.bring_to_front()
    expect(page.locator(".status")).to_contain_text("draft kept")
    assert drafts(file) == {"first"}


@pytest.mark.parametrize("is_away", [False, True], ids=["at once", "while nothing can be written"])
def test_an_edit_is_kept_when_another_network_opens_at_once(page, file, other, is_away):
    hands = Composer(page)
    hands.open(file)
    hands.part("constant").click()
    if is_away:
        page.route(DRAFTS, lambda route: route.abort())
    page.keyboard.press("Delete")
    hands.open(other)
    if is_away:
        expect(page.locator(".status")).to_contain_text(f"{file.name}: no draft is kept - no link")
        expect(page.locator(".status")).to_contain_text("this browser has it")
    hands.open(file)
    page.get_by_role("button", name="Continue the draft").click()
    expect(hands.part("constant")).to_have_count(0)
    hands.do("undo")
    expect(hands.part("constant")).to_have_count(1)
    hands.do("redo")
    hands.save()
    assert "constant" not in file.read_text()


def test_what_could_not_be_kept_is_there_after_a_reload(page, file):
    hands = Composer(page)
    hands.open(file)
    page.route(DRAFTS, lambda route: route.abort())
    hands.set("Name", "unkept")
    page.reload()  # at once
    dialog = page.locator(".composer-dialog")
    expect(dialog).to_contain_text("in this browser alone")
    page.unroute(DRAFTS)
    page.reload()
    expect(dialog).to_contain_text("→ unkept")
    expect(dialog).not_to_contain_text("in this browser alone")
    assert drafts(file) == {"unkept"}


def test_a_page_asks_before_it_goes_with_what_could_not_be_kept(page, file):
    hands = Composer(page)
    hands.open(file)
    page.route(DRAFTS, lambda route: route.abort())
    hands.set("Name", "unkept")
    expect(page.locator(".status")).to_contain_text("no draft is kept")
    asked = []
    page.on("dialog", lambda dialog: (asked.append(dialog.type), dialog.dismiss()))
    page.close(run_before_unload=True)
    expect(page.locator(".status")).to_contain_text("no draft is kept")
    assert asked == ["beforeunload"]


def test_of_two_networks_the_last_that_was_asked_for_is_shown(page, file, other):
    hands = Composer(page)
    held = []
    slow = re.compile(f"/networks/file.*{file.name}")
    page.route(slow, lambda route: held.append(route))
    with page.expect_request(slow):
        page.evaluate("(path) => location.hash = '#networks/' + path", str(file))
    hands.open(other)
    hands.part("constant").click()
    expect(page.get_by_label("parsed_value", exact=True)).to_have_value("81")
    with page.expect_response(slow):
        held[0].continue_()
    expect(page.locator(".status .path")).to_have_text(other.name)
    expect(page.get_by_label("parsed_value", exact=True)).to_have_value("81")
    page.unroute(slow)
    hands.open(file)


def test_a_network_that_does_not_open_leaves_the_address_of_the_one_that_is_shown(page, file):
    Composer(page).open(file)
    page.evaluate("location.hash = '#networks' + location.hash.slice(9) + '_gone.xml'")
    expect(page.locator(".status .notice")).to_contain_text("there is no such network")
    assert page.evaluate("decodeURIComponent(location.hash)") == f"#networks/{file}"
    expect(page.locator(".status .path")).to_have_text(file.name)


@pytest.mark.parametrize("way", ["keys", "buttons"])
def test_what_is_copied_in_a_tab_is_pasted_in_another(studio, file, other, way):
    with opened(studio.address(), permissions=["clipboard-read", "clipboard-write"]) as page:
        first, second = Composer(page), Composer(tab(page))
        first.open(file)
        second.open(other)
        page.bring_to_front()
        first.part("constant").click()
        first.key("Control+c") if way == "keys" else first.do("copy")
        second.page.bring_to_front()
        second.key("Control+v") if way == "keys" else second.do("paste")
        expect(second.page.locator(".status .notice")).to_have_text("pasted 1")
        expect(second.part("constant2")).to_have_count(1)
        second.save()
        assert other.read_text().count('value="80"') == 1


def test_a_behavior_in_a_mail_is_pasted_and_other_text_is_refused(studio, file):
    with opened(studio.address(), permissions=["clipboard-read", "clipboard-write"]) as page:
        hands = Composer(page)
        hands.open(file)
        mail = 'Hi,\n> try\n>   <Behavior id="half" type="Hri.Scale"/>\n> instead'
        for text in (mail, "a < b, not XML", "<Behavior id='x'", "", "<html><body/></html>"):
            page.evaluate("(text) => navigator.clipboard.writeText(text)", text)
            hands.key("Control+v")
            words = "pasted 1" if text == mail else "no XML of behaviors"
            expect(page.locator(".status .notice")).to_contain_text(words)
        expect(hands.part("half")).to_have_count(1)
        expect(page.locator(".react-flow__node")).to_have_count(8)


def test_arrow_keys_go_through_what_can_be_linked_and_link_nothing(page, file):
    hands = Composer(page)
    file.write_text(re.sub("  <Link .*\n", "", TUTORIAL))
    hands.open(file)
    hands.part("subtraction").click()
    choice = page.get_by_label("Link subtraction.input_positive from", exact=True)
    choice.focus()
    expect(choice.locator("option")).not_to_have_count(1)
    hands.key("ArrowDown")
    hands.key("ArrowDown")
    first_two = choice.locator("option").all_text_contents()[1:3]
    expect(choice).to_have_value(first_two[1])
    expect(page.locator(".react-flow__edge")).to_have_count(0)
    hands.key("Enter")
    expect(page.locator(".react-flow__edge")).to_have_count(1)
    hands.key("ArrowDown")
    expect(page.locator(".react-flow__edge")).to_have_count(1)
    hands.key("Tab")
    hands.key("Enter")
    expect(page.locator(".react-flow__edge")).to_have_count(2)
    hands.save()
    links = re.findall('<Link from="(.*)" to="subtraction.input_positive"', file.read_text())
    assert len(links) == 2


def test_an_error_has_a_mark_in_the_xml_that_the_page_may_show(page, file):
    hands = Composer(page)
    refused = []
    page.on("console", lambda one: refused.append(one.text) if "Policy" in one.text else None)
    file.write_text(TUTORIAL.replace('"true"', '"perhaps"'))
    hands.open(file)
    hands.do("text")
    mark = page.locator(".xml-source .cm-lint-marker-error")
    expect(mark).to_have_css("background-color", "rgb(179, 38, 30)")
    expect(mark).to_have_css("content", "normal")
    expect(mark).to_have_css("width", re.compile(r"^(9|\d\d)(\.\d+)?px$"))
    line = page.locator(".xml-source .cm-lintRange-error").first
    expect(line).to_have_css("text-decoration", re.compile("underline wavy"))
    expect(line).to_have_css("background-image", "none")
    assert refused == []


def test_a_condition_that_cannot_be_read_stays_with_the_reason(page, file):
    hands = Composer(page)
    file.write_text(RUNS)
    hands.open(file)
    page.locator(".run-bar").get_by_role("button", name="Start", exact=True).click()
    hands.part("constant").click()
    page.get_by_role("button", name="Break when…").first.click()
    condition = page.locator("#condition")
    condition.fill("rubbish <>")
    hands.key("Enter")
    dialog = page.locator(".composer-dialog")
    expect(dialog).to_contain_text("is not a condition")
    expect(condition).to_have_value("rubbish <>")
    condition.fill("< 1000")
    expect(dialog).not_to_contain_text("is not a condition")
    hands.key("Enter")
    expect(dialog).to_have_count(0)
    expect(page.locator(".status .notice")).to_have_text("")
    page.locator(".run-bar").get_by_role("button", name="End", exact=True).click()


def test_a_new_network_is_refused_in_its_dialog_and_the_keyboard_goes_on_in_the_palette(page):
    hands = Composer(page)
    hands.new("../escape")
    dialog = page.locator(".composer-dialog")
    expect(dialog).to_contain_text("is not in a folder of networks")
    for name, why in (("/etc/evil", "is not in a folder"), ("sub/", "has no name")):
        page.fill("#network-name", name)
        hands.key("Enter")
        expect(dialog).to_contain_text(why)
    page.fill("#network-name", "begun")
    hands.key("Enter")
    expect(dialog).to_have_count(0)
    expect(page.locator("#palette-search")).to_be_focused()
    page.locator("[data-action=open]").focus()
    hands.key("Enter")
    page.locator(".composer-dialog").get_by_role("button", name="Cancel").click()
    expect(page.locator("[data-action=open]")).to_be_focused()


def test_xml_that_cannot_be_read_replaces_a_good_file_only_when_that_is_meant(page, file):
    hands = Composer(page)
    hands.open(file)
    hands.do("text")
    hands.choose_word('"true"')
    page.keyboard.type("<")
    expect(page.locator(".unreadable")).to_be_visible()
    hands.do("save")
    dialog = page.locator(".composer-dialog")
    expect(dialog).to_contain_text("Save what cannot be read?")
    page.get_by_role("button", name="Go on editing").click()
    assert file.read_text() == TUTORIAL
    hands.do("save")
    page.get_by_role("button", name="Save it anyway").click()
    expect(page.locator(".status .notice")).to_contain_text("saved")
    assert '"<"' in file.read_text()


def test_all_of_a_long_chain_is_shown(page, file):
    names = [f"b{number}" for number in range(100)]
    parts = "".join(f'<Behavior id="{one}" type="Hri.Scale"/>' for one in names)
    links = "".join(
        f'<Link from="{one}.scaled" to="{other}.input"/>' for one, other in pairwise(names)
    )
    file.write_text(f"<BehaviorNetwork>{parts}{links}</BehaviorNetwork>")
    hands = Composer(page)
    hands.open(file)
    hands.do("fit")
    expect(page.locator(".react-flow__node")).to_have_count(100)
    until(
        page,
        """() => { const all = document.querySelector('.react-flow').getBoundingClientRect();
          return [...document.querySelectorAll('.react-flow__node')].every((one) => {
            const box = one.getBoundingClientRect();
            return box.left >= all.left && box.right <= all.right; }); }""",
    )


def test_of_two_networks_asked_for_while_the_composer_loads_the_last_is_shown(page, file, other):
    held = []
    page.route(re.compile(r"/view-.*\.js"), lambda route: held.append(route))
    with page.expect_request(re.compile(r"/view-.*\.js")):
        page.evaluate("(path) => location.hash = '#networks/' + path", str(file))
    page.evaluate("(path) => location.hash = '#networks/' + path", str(other))
    asked = []
    page.on("request", lambda one: asked.append(one.url) if "/networks/file" in one.url else None)
    held[0].continue_()
    expect(page.locator(".status .path")).to_have_text(other.name)
    assert asked[-1].endswith(other.name)
