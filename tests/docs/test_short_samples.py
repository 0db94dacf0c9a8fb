"""The ten short programs: each runs as it stands, and prints what its reader is to see."""

import re
import subprocess
import sys

import pytest

from hri.core import paths

FOLDER = paths.house() / "docs" / "samples" / "short"
PRINTED = {
    "say_and_ask": "yes",
    "button": "Ouch!",
    "follow_face": r"Pose2D\(x=0\.\d+, y=0\.\d+",
    "sensor_to_face": r"inf m\n0\.\d\d m",
    "emotion": "I am happy, mostly because you praised me",
    "picture": r"\(240, 320, 3\) uint8",
    "parse": r"move \{'distance': 2\.0\}",
    "network": "True 1.",
    "own_behavior": "20",
    "own_driver": r"traveled -?0\.0\d m",
}


def test_the_page_names_all_of_them():
    page = (FOLDER / "README.md").read_text()
    files = {path.name for path in FOLDER.glob("*.py")}
    assert set(re.findall(r"\]\((\w+\.py)\)", page)) == files == {f"{n}.py" for n in PRINTED}


@pytest.mark.slow
@pytest.mark.parametrize("name", PRINTED)
def test_it_is_short_and_prints_what_it_should(name, tmp_path):
    program = FOLDER / f"{name}.py"
    lines = [line for line in program.read_text().splitlines() if line.strip()]
    assert len(lines) <= 18
    run = subprocess.run(
        [sys.executable, program], capture_output=True, text=True, cwd=tmp_path, timeout=300
    )
    assert run.returncode == 0, run.stderr
    assert re.search(PRINTED[name], run.stdout), run.stdout
