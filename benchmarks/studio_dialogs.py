"""How each dialog of the studio's page comes to be open, for what must work while it is."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from hri.core import paths

RUNNING = paths.house() / "apps" / "companion" / "moving.xml"
"""A network that the companion runs."""
CONSTANT = '<BehaviorNetwork>\n  <Behavior id="a" type="Hri.Constant"/>\n</BehaviorNetwork>\n'


def _compose(page: Any, file: Path) -> None:
    page.evaluate("(path) => location.hash = '#networks/' + path", str(file))
    page.locator(".status .path", has_text=file.name).wait_for()
    page.locator(".palette .behavior").first.wait_for()
    page.locator(".react-flow__node").first.wait_for()


def _keys(page: Any, home: Path) -> None:
    page.evaluate("location.hash = '#live'")
    page.locator("body").press("?")


def _by_button(action: str) -> Callable[[Any, Path], None]:
    def open(page: Any, home: Path) -> None:
        _compose(page, RUNNING)
        page.click(f"[data-action={action}]")

    return open


def _schema(page: Any, home: Path) -> None:
    _compose(page, RUNNING)
    page.locator(".react-flow__node").first.click(button="right")
    page.get_by_role("menuitem", name="Schema of").click()


def _break(page: Any, home: Path) -> None:
    _compose(page, RUNNING)
    page.locator(".react-flow__node").first.click()
    page.get_by_role("button", name="Break when…").first.click()


def _edited(page: Any, home: Path, name: str) -> Path:
    """A file that was changed on the page and is not saved."""
    file = home / name
    file.write_text(CONSTANT)
    _compose(page, file)
    page.click("[data-action=arrange]")
    page.locator(".status", has_text="draft kept").wait_for()
    return file


def _conflict(page: Any, home: Path) -> None:
    """It opens by itself, a while after another program has changed the file."""
    file = _edited(page, home, "conflict.xml")
    file.write_text(CONSTANT.replace('"a"', '"b"'))


def _draft(page: Any, home: Path) -> None:
    _edited(page, home, "draft.xml")
    page.reload()


DIALOGS: Mapping[str, Callable[[Any, Path], None]] = {
    "keys": _keys,
    "open": _by_button("open"),
    "new": _by_button("new"),
    "save as": _by_button("save-as"),
    "schema": _schema,
    "break": _break,
    "conflict": _conflict,
    "draft": _draft,
}
"""By name: opens it on a page, with a folder for files."""


def dialog(page: Any) -> Any:
    """The one that is open, once it is."""
    found = page.locator("dialog[open]")
    found.wait_for()
    return found
