"""Packages that would send something are switched off before they are imported."""

import os
import subprocess
import sys

import pytest

SAY = """
import hri.cli.main
status = hri.cli.main.main(["say", "Hello.", "--wav", "hello.wav"])
import sys
assert "onnxruntime" in sys.modules
sys.exit(status)
"""


def test_the_natural_voice_speaks_without_a_device_id_and_a_queue_of_events(tmp_path):
    pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    home = tmp_path / "home"
    home.mkdir()
    kept = {name: value for name, value in os.environ.items() if not name.startswith("XDG_")}
    environment = {**kept, "HOME": str(home), "ORT_DISABLE_TELEMETRY": "0"}
    command = [sys.executable, "-c", SAY]
    subprocess.run(command, check=True, cwd=tmp_path, env=environment, timeout=60)
    assert (tmp_path / "hello.wav").exists()
    assert list(home.iterdir()) == []
