"""A robot that joins no fleet knows nothing of it."""

import subprocess
import sys

from hri.core import child

LOOK = """
import sys, threading
from hri.cli.main import main
status = main(["run", sys.argv[1], "--fast", "--headless", "--duration", "1"])
found = sorted(name for name in sys.modules if name.split(".")[0] in ("zenoh", "msgspec"))
found += [name for name in sys.modules if name.startswith("hri.net.zenoh")]
print("FOUND", status, found, [one.name for one in threading.enumerate() if "zenoh" in one.name])
"""


def test_nothing_of_a_fleet_is_imported_or_written(tmp_path):
    network = tmp_path / "network.xml"
    network.write_text('<BehaviorNetwork name="network"/>')
    folders = {f"XDG_{name}_HOME": str(tmp_path / name) for name in ("STATE", "DATA", "CONFIG")}
    done = subprocess.run(
        [sys.executable, "-c", LOOK, str(network)],
        env=child.environment(**folders),
        capture_output=True,
        text=True,
        check=True,
    )
    assert "FOUND 0 [] []" in done.stdout
    assert not list(tmp_path.rglob("fleet"))


def test_a_missing_package_is_one_line(tmp_path):
    code = """
import importlib.util, sys
find = importlib.util.find_spec
importlib.util.find_spec = lambda name, *more: None if name == "zenoh" else find(name, *more)
from hri.cli.main import main
sys.exit(main(["fleet", "list"]))
"""
    done = subprocess.run(
        [sys.executable, "-c", code],
        env=child.environment(XDG_STATE_HOME=str(tmp_path)),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr.splitlines() == [
        "a fleet needs the package eclipse-zenoh - pip install 'hri[zenoh]'"
    ]
