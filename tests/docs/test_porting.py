"""The page for those who know the platform of 2003 names only what there is."""

import builtins
import importlib
import inspect
import re
from importlib.metadata import entry_points
from pathlib import Path

import pytest

from hri.behavior.catalog import find_behavior
from hri.cli.main import main
from hri.core import paths, registry
from hri.core.errors import HriError
from hri.net.malleable import BIND

PAGE = (paths.house() / "docs" / "porting.md").read_text()
ROWS = [
    [cell.strip() for cell in line.strip("|").split("|")]
    for line in PAGE.splitlines()
    if line.startswith("|")
]
"""The rows of all tables, cell by cell."""
THEIRS = [row for row in ROWS if len(row) == 3 and not re.fullmatch(r"-+|2003|E\d+|", row[0])]
"""Rows that give a name of ours for one of 2003."""


def quoted(cell):
    return re.findall(r"`([^`]+)`", cell)


OURS = sorted({name for _, ours, _ in THEIRS for name in quoted(ours)})


def is_python(name):
    """Whether a dotted name can be imported; instances' own attributes count."""
    parts = name.split(".")
    for length in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:length]))
        except ImportError:
            continue
        for part in parts[length:]:
            if not hasattr(found, part):
                known = inspect.getsource(found) if inspect.isclass(found) else ""
                return re.search(rf"self\.{part}\b|^    {part}: ", known, re.MULTILINE) is not None
            found = getattr(found, part)
        return True
    return hasattr(builtins, name) or name in ("None", "True", "False")


def is_registered(name):
    if any(registry.canonical(name) in registry.known(group) for group in registry.GROUPS):
        return True
    try:
        return find_behavior(name) is not None
    except HriError:
        return False


def is_element(name):
    files = (paths.house() / "config" / "xsd").glob("*.xsd")
    return any(f'name="{name.strip("<>")}"' in file.read_text() for file in files)


def is_command(name):
    command, *words = name.split()
    if command == "make":
        return re.search(rf"^{words[0]}:", Path("Makefile").read_text(), re.MULTILINE) is not None
    if command != "hri":
        return command in {entry.name for entry in entry_points(group="console_scripts")}
    with pytest.raises(SystemExit) as end:
        main([*words, "--help"])
    return end.value.code == 0


KINDS = {
    r"(Hri|Examples)\.\w+": is_registered,
    r"<\w+>": is_element,
    r"[\w-]+(/[\w.-]*)+": lambda name: (paths.house() / name).exists(),
    r"HRI_\w+": lambda name: name in (*paths.VARIABLES, BIND),
    r"(behave|test_\w+|hri \w+|make \w+)": is_command,
    r"\w+(\.\w+)*": is_python,
}
"""What a name looks like, and how to look it up."""


@pytest.mark.parametrize("name", OURS)
def test_every_name_on_our_side_exists(name, monkeypatch, capsys):
    monkeypatch.chdir(paths.house())
    lookup = next(found for form, found in KINDS.items() if re.fullmatch(form, name))
    assert lookup(name), name


@pytest.mark.proves("E12")
def test_every_name_of_theirs_that_we_understand_stands_beside_ours():
    for theirs, ours, _ in THEIRS:
        for name in quoted(theirs):
            if name.startswith("Evolution."):
                assert registry.canonical(name) in quoted(ours)
    known = {name for theirs, _, _ in THEIRS for name in quoted(theirs)}
    assert {name for name in registry.ALIASES if name.startswith("Evolution.")} <= known


def test_every_row_says_where_to_look():
    assert len(THEIRS) > 120
    for theirs, ours, _ in THEIRS:
        assert quoted(ours), theirs


@pytest.mark.parametrize("number", range(1, 16))
def test_every_ruling_is_told(number):
    assert [row for row in ROWS if row[0] == f"E{number}" and len(row) == 3]
