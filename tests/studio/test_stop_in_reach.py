"""Stop stays in reach of a finger above every dialog, and dialogs keep the focus otherwise."""

import pytest

from benchmarks.studio_dialogs import DIALOGS, dialog
from tests.studio.browser import DESKTOP, NEEDS, PHONE, opened, violations
from tests.studio.living import known, living, told

pytest.importorskip("playwright", reason="no playwright - pip install hri[dev]")
from playwright.sync_api import expect

pytestmark = NEEDS


@pytest.fixture(scope="module")
def lived(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_DATA_HOME", str(tmp_path_factory.mktemp("data")))
        home = tmp_path_factory.mktemp("home")
        patch.chdir(home)  # networks below it may be opened
        with living() as (studio, _), known(studio.address()) as client:
            yield studio, client, home


@pytest.mark.parametrize("size", [DESKTOP, PHONE], ids=["desktop", "phone"])
@pytest.mark.parametrize("name", DIALOGS)
def test_stop_is_tapped_above_a_dialog(name, size, lived):
    studio, client, home = lived
    with opened(studio.address(), size=size, has_touch=True, bypass_csp=True) as page:
        folder = home / f"{name} {size['width']}"
        folder.mkdir()
        DIALOGS[name](page, folder)
        shown = dialog(page)
        page.locator("#stop").tap()
        told(client, "base", lambda base: base["is_stopped"])
        assert shown.is_visible(), "the dialog stays"
        box, stop = shown.bounding_box(), page.locator("#stop").bounding_box()
        assert box["y"] >= stop["y"] + stop["height"]
        assert box["y"] + box["height"] <= size["height"]
        page.locator("#release").tap()
        told(client, "base", lambda base: not base["is_stopped"])
        if size is PHONE:
            assert violations(page) == []
            return
        for _ in range(30):
            page.keyboard.press("Tab")
            where = "document.activeElement.closest('dialog[open], #stop, #release') !== null"
            assert page.evaluate(f"document.activeElement === document.body || {where}")


def test_a_dialog_gives_the_focus_and_the_page_back(lived):
    studio, _, home = lived
    with opened(studio.address()) as page:
        page.locator("#keys").focus()
        page.keyboard.press("Enter")
        expect(dialog(page).get_by_role("button", name="Close")).to_be_focused()
        page.keyboard.press("Enter")
        expect(page.locator("dialog[open]")).to_have_count(0)
        expect(page.locator("#keys")).to_be_focused()
        assert page.locator("[inert]").count() == 0
        DIALOGS["new"](page, home)
        expect(page.locator("#network-name")).to_be_focused()
        page.get_by_role("button", name="Cancel").click()
        expect(page.locator("[data-action=new]")).to_be_focused()
        assert page.locator("[inert]").count() == 0


def test_another_view_is_not_held_up_by_a_dialog_that_it_does_not_show(lived):
    studio, _, home = lived
    with opened(studio.address()) as page:
        DIALOGS["new"](page, home)
        dialog(page)
        page.evaluate("location.hash = '#live'")
        page.fill("#text", "hello")
        page.keyboard.press("Enter")
        expect(page.locator("#lines .person").first).to_contain_text("hello")
        page.evaluate("location.hash = '#networks'")
        expect(page.locator("#networks .palette")).to_have_attribute("inert", "")


def test_a_stop_gets_through_though_every_connection_of_the_page_is_in_use(lived):
    studio, client, _ = lived
    with opened(studio.address()) as page:
        page.route("**/api/v1/stop", lambda route: None)  # never sent, never answered
        page.keyboard.press("Escape")
        told(client, "base", lambda base: base["is_stopped"])
        expect(page.locator("#notice")).to_be_hidden()
        page.unroute_all(behavior="ignoreErrors")
        page.click("#release")
        told(client, "base", lambda base: not base["is_stopped"])
