from pathlib import Path

import numpy as np

from hri.core import FakeClock
from hri.hal import ResourceManager, Screen, load_configuration

FOLDER = Path(__file__).parent


def test_it_shows_white_and_black(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    device = resources.obtain("thing", Screen)
    white = np.full((device.height, device.width, 3), 255, np.uint8)
    device.show(white, 1.0)
    assert device.sent == b"\xff" * (64 * 64 // 8)
    device.show(white // 4, 1.1)
    assert not any(device.sent)
    resources.close()
    assert not device.is_active
