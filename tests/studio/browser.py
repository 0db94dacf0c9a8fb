"""Chromium with the page of a studio, for tests."""

import shutil
from contextlib import contextmanager

import pytest

from hri.core import paths

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or ""
NEEDS_BROWSER = pytest.mark.skipif(not CHROMIUM, reason="no Chromium - apt install chromium")
NEEDS = [pytest.mark.slow, NEEDS_BROWSER, pytest.mark.usefixtures("one_browser")]
"""The marks of a module whose tests all work in a browser, which takes long."""
AXE = paths.house() / "hri" / "studio" / "page" / "node_modules" / "axe-core" / "axe.min.js"
DESKTOP, PHONE = {"width": 1360, "height": 900}, {"width": 390, "height": 844}


_running = []


@contextmanager
def chromium():
    """The browser that runs, or one that ends behind the `with`."""
    from playwright.sync_api import expect, sync_playwright

    # A busy machine takes its time; how fast a thing is, tests say beside the thing.
    expect.set_options(timeout=20_000)
    if _running:
        yield _running[0]
        return
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        _running.append(browser)
        try:
            yield browser
        finally:
            _running.clear()
            browser.close()


@contextmanager
def opened(address, size=DESKTOP, **more):
    """The page of a studio in a fresh profile, once it is linked; what goes wrong is an error."""
    from playwright.sync_api import expect

    with chromium() as browser:
        profile = browser.new_context(viewport=size, **more)
        try:
            page = profile.new_page()
            page.set_default_timeout(20_000)
            wrong, asked = [], []
            page.on("pageerror", lambda error: wrong.append(str(error)))
            page.on("request", lambda request: asked.append(request.url))
            page.goto(address)
            expect(page.locator("#link")).to_have_text("linked")
            yield page
            assert wrong == []
            own = (address.partition("?")[0], "blob:", "ws://127.0.0.1:")
            assert [url for url in asked if not url.startswith(own)] == []
        finally:
            profile.close()


def violations(page):
    """What axe-core finds to stand in the way of people; its page must have `bypass_csp`."""
    if not AXE.exists():
        pytest.skip("no axe-core - npm ci in hri/studio/page")
    page.evaluate(AXE.read_text())
    return page.evaluate(
        """() => axe.run().then((found) => found.violations
             .filter((one) => ["serious", "critical"].includes(one.impact))
             .map((one) => [one.id, one.nodes.map((node) => node.html)]))"""
    )


def until(page, condition, arg=None):
    """Wait until a function of JavaScript returns true for an argument.

    The page's policy forbids `eval`, by which Playwright's `wait_for_function` looks a second time.
    """
    page.evaluate(
        f"""async (arg) => {{
          const holds = {condition}, end = performance.now() + 20_000;
          while (!holds(arg)) {{
            if (performance.now() > end) throw new Error(`never so: ${{holds}}`);
            await new Promise((go_on) => setTimeout(go_on, 20)); }} }}""",
        arg,
    )
