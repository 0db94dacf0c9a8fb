"""Installing: another Python is refused before anything is downloaded; versions are locked."""

from __future__ import annotations

import re
import subprocess
import tomllib
from itertools import chain

import pytest
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name

from hri.core.paths import house

PYPROJECT = tomllib.loads((house() / "pyproject.toml").read_text())
PROJECT = PYPROJECT["project"]
LOCKED = {
    "build": PYPROJECT["dependency-groups"]["build"],
    "run": PROJECT["dependencies"],
    "dev": [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["dev"]],
}
"""What each file of the folder `.ci/requirements` has to satisfy."""
VERSIONS = ("3.11", "3.12", "3.13", "3.14")
SYSTEMS = (
    ("linux", "x86_64"), ("linux", "aarch64"), ("darwin", "x86_64"), ("darwin", "arm64"),
    ("win32", "AMD64"),
)  # fmt: skip


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
@pytest.mark.parametrize("version", VERSIONS)
def test_every_python_gets_one_pygame(version, machine):
    target = {"python_version": version, "platform_machine": machine}
    wanted = [Requirement(line) for line in PROJECT["dependencies"]]
    names = {one.name for one in wanted if one.marker is None or one.marker.evaluate(target)}
    assert len(names & {"pygame", "pygame-ce"}) == 1


def locked(name):
    """The requirements of a file, each with its hashes."""
    text = (house() / ".ci" / "requirements" / f"{name}.txt").read_text().replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line and not line.lstrip().startswith("#")]
    for line in lines:
        requirement, *hashes = re.split(r"\s+--hash=", line)
        yield Requirement(requirement), hashes


def with_own_extras(lines):
    """Requirements, with those of `hri[...]` instead of it."""
    found = []
    for one in map(Requirement, lines):
        extras = [PROJECT["optional-dependencies"][extra] for extra in one.extras]
        is_own = canonicalize_name(one.name) == "hri"
        found += with_own_extras(chain.from_iterable(extras)) if is_own else [one]
    return found


def chosen(name, version, system, machine):
    """The locked version of each package for a Python and a system."""
    target = {
        "python_version": version, "python_full_version": f"{version}.4",
        "sys_platform": system, "platform_machine": machine, "extra": "",
    }  # fmt: skip
    entries = [one for one, _ in locked(name) if one.marker is None or one.marker.evaluate(target)]
    found = {canonicalize_name(one.name): str(one.specifier).removeprefix("==") for one in entries}
    assert len(found) == len(entries)
    wanted = with_own_extras(LOCKED[name])
    return found, [one for one in wanted if one.marker is None or one.marker.evaluate(target)]


@pytest.mark.parametrize("name", LOCKED)
def test_every_locked_package_has_hashes_and_a_marker_that_every_pip_can_evaluate(name):
    """pip compares releases of kernels as versions, which their names on Linux are not."""
    for requirement, hashes in locked(name):
        assert re.fullmatch(r"==[^,*]+", str(requirement.specifier)), requirement
        assert hashes, requirement
        assert all(re.fullmatch(r"sha256:[0-9a-f]{64}\s*", one) for one in hashes), requirement
        assert requirement.url is None
        assert "platform_release" not in str(requirement.marker)
    assert "://" not in (house() / ".ci" / "requirements" / f"{name}.txt").read_text()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", LOCKED)
def test_what_is_locked_satisfies_the_project_everywhere(name, version):
    """After a change of the dependencies in pyproject.toml: `make wheels`."""
    for system, machine in SYSTEMS:
        found, wanted = chosen(name, version, system, machine)
        for one in wanted:
            assert canonicalize_name(one.name) in found, one
            assert one.specifier.contains(found[canonicalize_name(one.name)], prereleases=True), one


@pytest.mark.parametrize("version", VERSIONS)
def test_tests_run_with_the_versions_that_users_get(version):
    for system, machine in SYSTEMS:
        run, _ = chosen("run", version, system, machine)
        dev, _ = chosen("dev", version, system, machine)
        assert run.items() <= dev.items()


def test_each_locked_package_is_named_among_the_licenses():
    named = {
        canonicalize_name(word)
        for word in re.findall(r"[\w.-]+\w", (house() / "THIRD_PARTY.md").read_text())
    }
    for name in ("build", "run"):
        assert {canonicalize_name(one.name) for one, _ in locked(name)} <= named
