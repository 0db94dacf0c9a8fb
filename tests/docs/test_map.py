"""The map: what it names is there."""

import re

from hri.core import paths

PAGE = (paths.house() / "docs" / "map.md").read_text()
DECIDED = PAGE.partition("## Where it is decided")[2].partition("\n## ")[0]


def test_each_place_and_test_is_there():
    for line in DECIDED.splitlines():
        folder = paths.house()
        for name in re.findall(r"`([\w/]+[./]\w*)`", line):
            path = paths.house() / name
            if "/" not in name:  # beside the one before
                path = folder / name
            assert path.exists(), name
            folder = path.parent


def test_the_names_in_them_are_there():
    drive = (paths.house() / "hri" / "drive" / "tasks.py").read_text()
    ports = (paths.house() / "hri" / "behavior" / "ports.py").read_text()
    assert "\nCRUISE = " in drive
    assert "\nTURN_RATE = " in drive
    assert "\nDATATYPES" in ports
    assert "[visemes.oh]" in (paths.find("faces", "robot") / "face.toml").read_text()
