"""Installing: another Python is refused before anything is downloaded."""

from __future__ import annotations

import subprocess
import tomllib

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet

from hri.core.paths import house

PROJECT = tomllib.loads((house() / "pyproject.toml").read_text())["project"]


@pytest.mark.parametrize(
    ("version", "is_welcome"), [("3.10", False), ("3.15", False), ("3.14", True)]
)
def test_another_python_is_refused_in_one_line(tmp_path, version, is_welcome):
    """A Python of that version is played: it answers the question that the Makefile asks."""
    python = tmp_path / "python"
    major, minor = version.split(".")
    python.write_text(
        f"""#!/bin/sh
case "$2" in
  *ensurepip*) exit 3 ;; # goes no further: nothing is set up
  *) exec python3 -c "import sys; sys.version_info = ({major}, {minor}, 0)
$2" ;;
esac
"""
    )
    python.chmod(0o755)
    command = ["make", "-s", "run", f"PYTHON={python}", f"VENV={tmp_path / 'venv'}"]
    done = subprocess.run(
        command, cwd=house(), capture_output=True, text=True, timeout=60, check=False
    )
    expected = "this Python has no venv" if is_welcome else "hri needs Python 3.11 to 3.14"
    assert done.returncode != 0
    assert done.stdout.startswith(expected)
    assert done.stdout.count("\n") == 1
    assert not (tmp_path / "venv").exists()
    assert SpecifierSet(PROJECT["requires-python"]).contains(version) == is_welcome


@pytest.mark.parametrize("machine", ["x86_64", "aarch64"])
@pytest.mark.parametrize("version", ["3.11", "3.12", "3.13", "3.14"])
def test_every_python_gets_one_pygame(version, machine):
    target = {"python_version": version, "platform_machine": machine}
    wanted = [Requirement(line) for line in PROJECT["dependencies"]]
    names = {one.name for one in wanted if one.marker is None or one.marker.evaluate(target)}
    assert len(names & {"pygame", "pygame-ce"}) == 1
