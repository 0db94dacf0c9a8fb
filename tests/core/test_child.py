"""No child process runs what lies in the folder that a program was started in."""

import importlib
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from hri.bench.workers import worker_pool
from hri.core import child
from hri.core.clock import RealClock
from hri.core.errors import NotAvailable
from hri.core.fetch.download import RemoteFile
from hri.core.fetch.pypi_wheel import Wheel, download_wheel
from hri.core.service import ProcessService
from hri.drive.supervisor.remote import COMMAND

TIMEOUT = 60
HRI = Path(child.__file__).parents[1]
PLANTED = ("random", "json", "struct", "socket", "selectors", "logging", "runpy", "pip", "numpy")
"""Modules that children import, in name; those here leave a mark when they are run."""

PROGRAM = """
with open({mark!r}, "a") as file:
    file.write(__name__ + "\\n")
raise SystemExit(9)
"""


@pytest.fixture
def hostile(tmp_path, monkeypatch):
    """The current folder, with modules in it that must not be run; its list of those that were."""
    for name in PLANTED:
        importlib.import_module(name)  # this program has what it needs
    folder = tmp_path / "current"
    folder.mkdir()
    mark = (
        f"with open({str(tmp_path / 'mark')!r}, 'a') as file:\n    file.write(__name__ + '\\n')\n"
    )
    for name in PLANTED:
        (folder / f"{name}.py").write_text(mark + "raise SystemExit(9)\n")
    monkeypatch.chdir(folder)
    # As Python itself does for `python -c` and `python -m`.
    monkeypatch.setattr(sys, "path", ["", str(folder), *sys.path])
    yield lambda: (tmp_path / "mark").read_text() if (tmp_path / "mark").exists() else ""
    assert not (tmp_path / "mark").exists()


def run(words, **options):
    return subprocess.run(words, capture_output=True, text=True, timeout=TIMEOUT, **options)


def test_the_planted_modules_would_be_run_without_it(hostile, tmp_path):
    run([sys.executable, "-c", "import random"])
    assert hostile() == "random\n"
    (tmp_path / "mark").unlink()


@pytest.mark.parametrize(
    "words",
    [("-c", f"import {', '.join(PLANTED)}"), ("-m", "pip", "--version"), ("-m", "json.tool", "-h")],
)
def test_a_command_runs_the_real_modules(hostile, words):
    ended = run(child.command(*words), env=child.environment())
    assert ended.returncode == 0, ended.stderr


def test_the_supervisor_of_a_base_starts_past_a_random_py(hostile):
    ended = run([*COMMAND, "{}"], env=child.environment())
    assert "KeyError" in ended.stderr  # it came as far as its settings


def test_children_of_a_child_are_protected_as_well(hostile):
    code = "import subprocess, sys; subprocess.run([sys.executable, '-c', 'import random'])"
    assert run(child.command("-c", code), env=child.environment()).returncode == 0


def test_a_service_starts_there(hostile):
    clock = RealClock()
    service = ProcessService(dict, clock.now)
    try:
        while service.is_busy:
            clock.advance(0.01)
            service.poll()
        assert service.process_id is not None
    finally:
        service.close()


def test_workers_of_a_bench_start_there_and_leave_the_path_as_it_was(hostile):
    before = sys.path[:], dict(os.environ)
    with worker_pool(1) as pool:
        assert pool.submit(os.getcwd).result(TIMEOUT) == os.getcwd()
    assert (sys.path, dict(os.environ)) == before


def test_pip_is_the_real_one(hostile, tmp_path, monkeypatch):
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    wheel = Wheel("hri-no-such-wheel==1", "3.11", "any")
    with pytest.raises(NotAvailable, match="pip cannot fetch it"):
        download_wheel(wheel, RemoteFile("", 1, ""), tmp_path / "file", lambda here, size: None)


def test_a_folder_that_is_named_in_full_is_looked_into(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "path", ["", str(tmp_path), *sys.path])
    assert str(tmp_path) not in child.folders()
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    assert str(tmp_path) in child.folders()
    monkeypatch.setenv("PYTHONPATH", ":.")
    assert str(tmp_path) not in child.folders()


def test_every_child_of_python_is_started_that_way():
    """Also those that are written next year: only one module knows where Python is."""
    for path in HRI.rglob("*.py"):
        text = path.read_text()
        if re.search(r"\bsys\.executable\b", text):
            assert path == Path(child.__file__), path
        # Nor does an empty entry of PYTHONPATH bring the current folder back.
        assert text.count("child.command(") <= text.count("child.environment("), path
        if re.search(r"ProcessPoolExecutor\(|get_context\(\"spawn\"\)", text):
            assert "safe_start" in text, path
