"""What `pip install` puts on a machine."""

import subprocess
import sys
import tomllib
import zipfile

import pytest

from hri.core import paths

PROJECT = paths.house() / "pyproject.toml"
FOLDERS = ("apps", "config", "docs", "emotions", "faces", "grammars")
COMMANDS = ("behave", "hri", "test_camera", "test_drive_system", "test_range_sensor")
CARRIED = """\
hri/data/apps/companion/app.toml
hri/data/config/resource-config.xml
hri/data/config/networks/check_stopcrash.xml
hri/data/config/resource/Hri/Webcam.xml
hri/data/docs/samples/task/patrol.py
hri/data/docs/tutorials/resource-02-config-ir/board.toml
hri/data/emotions/display.toml
hri/data/faces/robot/face.toml
hri/data/grammars/companion.jsgf
hri/cli/templates/driver/devices.xml
hri/hal/resource_manager.py
"""


@pytest.mark.proves("P06", "P07")
def test_the_wheel_is_told_to_carry_all_that_is_authored():
    project = tomllib.loads(PROJECT.read_text())
    carried = project["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    assert carried == {folder: f"hri/data/{folder}" for folder in FOLDERS}
    assert all((PROJECT.parent / folder).is_dir() for folder in FOLDERS)
    assert sorted(project["project"]["scripts"]) == list(COMMANDS)
    assert all((PROJECT.parent / name).is_file() for name in project["project"]["license-files"])


@pytest.mark.proves("P06")
def test_a_wheel_has_commands_configuration_data_documents_and_licenses(tmp_path):
    pytest.importorskip("hatchling", reason="builds the wheel")
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(build, cwd=PROJECT.parent, check=True, capture_output=True, timeout=120)
    with zipfile.ZipFile(next(tmp_path.glob("*.whl"))) as wheel:
        names = wheel.namelist()
        entries = next(name for name in names if name.endswith("entry_points.txt"))
        scripts = wheel.read(entries).decode().partition("[console_scripts]")[2]
    assert set(CARRIED.split()) <= set(names)
    assert all(f"\n{command} = hri.cli." in scripts for command in COMMANDS)
    licenses = {name.rpartition("/")[2] for name in names if "/licenses/" in name}
    assert licenses == {"LICENSE", "THIRD_PARTY.md"}
    kept_out = ("tests/", "benchmarks/")
    assert not [name for name in names if "__pycache__" in name or name.startswith(kept_out)]
