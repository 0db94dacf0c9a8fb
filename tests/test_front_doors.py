"""Each package names what it offers in its `__init__.pyi`, and loads it when it is used."""

import ast
import importlib
import subprocess
import sys
from importlib import metadata
from types import FunctionType

import pytest

import hri
from hri.core import paths

PACKAGES = (
    "behavior",
    "conversation",
    "core",
    "drive",
    "emotion",
    "face",
    "hal",
    "net",
    "speech",
    "vision",
)


@pytest.mark.parametrize("package", ["hri", *(f"hri.{name}" for name in PACKAGES)])
def test_every_name_of_a_front_door_is_there(package):
    door = importlib.import_module(package)
    names = dir(door)
    assert names
    for name in names:
        value = getattr(door, name)
        is_named = isinstance(value, (type, FunctionType))
        assert not is_named or value.__name__ == name
    with pytest.raises(AttributeError, match="nothing"):
        door.nothing  # noqa: B018


def test_a_front_door_loads_nothing_before_it_is_used():
    code = f"""
import sys
import {", ".join(f"hri.{name}" for name in PACKAGES)}
print([name for name in sys.modules if name.startswith("hri.") and name.count(".") > 1])
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]", run.stderr
    assert hri.__doc__


def test_an_app_comes_in_by_the_front_doors():
    for file in sorted((paths.house() / "apps").rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text())):
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else []
            if isinstance(node, ast.Import):
                names = [alias.name for alias in node.names]
            deep = [name for name in names if name.startswith("hri.") and name.count(".") > 1]
            assert not deep, f"{file.name}: {deep}"


def test_the_version_is_the_same_everywhere():
    assert metadata.version("hri") == hri.__version__
    for name, line in (
        ("CHANGELOG.md", f"## {hri.__version__}"),
        ("CITATION.cff", f"version: {hri.__version__}"),
    ):
        text = (paths.house() / name).read_text()
        assert f"\n{line}" in text, name
