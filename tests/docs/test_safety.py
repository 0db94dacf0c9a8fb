"""The road to the wheels, as the page on safety draws it, is that of the code."""

import ast
import importlib
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/safety.md").read_text(encoding="utf-8")
ROAD = PAGE.split("## The road to the wheels")[1].split("\n## ")[0]
HOPS = re.findall(r"`(hri\.[\w.]+\.[A-Z]\w+)`", ROAD)
SHAPERS = {"velocity_for", "stopping_speed", "safe_speed", "Trapezoid", "Limiter"}
"""What makes another velocity of one."""
ARITHMETIC = {"hri.hal.motion_profile", "hri.drive.velocity_limits"}


def users_of_shapers() -> Iterator[str]:
    """The modules that import one."""
    for path in (ROOT / "hri").rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if not any(name in text for name in SHAPERS):
            continue  # Reading all the code takes seconds.
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.ImportFrom) and {a.name for a in node.names} & SHAPERS:
                yield ".".join(path.relative_to(ROOT).with_suffix("").parts)


@pytest.mark.parametrize("hop", HOPS)
def test_each_hop_is_a_class(hop: str) -> None:
    module, name = hop.rsplit(".", 1)
    assert isinstance(getattr(importlib.import_module(module), name), type)


def test_the_drawing_and_the_table_have_the_same_hops() -> None:
    drawing, table = ROAD.split("| hop |")
    drawn = set(re.findall(r"\b[A-Z][a-z]+(?:[A-Z][a-z]+)*\b", drawing.split("\n\n", 2)[2]))
    listed = {row.split("`")[1].rsplit(".", 1)[1] for row in table.splitlines() if "| `hri" in row}
    assert drawn == listed


def test_nothing_else_shapes_a_velocity() -> None:
    hops = {hop.rsplit(".", 1)[0] for hop in HOPS}
    assert set(users_of_shapers()) - ARITHMETIC <= hops
