"""Each package names what it offers in its `__init__.pyi`, and loads it when it is used."""

import importlib
import subprocess
import sys
from importlib import metadata

import pytest

import hri
from hri.core import paths

PACKAGES = ("behavior", "core", "drive", "emotion", "face", "hal", "net", "speech", "vision")


@pytest.mark.parametrize("package", ["hri", *(f"hri.{name}" for name in PACKAGES)])
def test_every_name_of_a_front_door_is_there(package):
    door = importlib.import_module(package)
    names = dir(door)
    assert names
    for name in names:
        assert getattr(door, name).__name__ == name
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


def test_the_version_is_the_same_everywhere():
    assert metadata.version("hri") == hri.__version__
    for name, line in (
        ("CHANGELOG.md", f"## {hri.__version__}"),
        ("CITATION.cff", f"version: {hri.__version__}"),
    ):
        text = (paths.house() / name).read_text()
        assert f"\n{line}" in text, name
