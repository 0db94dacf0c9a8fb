from pathlib import Path

import numpy as np

from hri.core import FakeClock
from hri.hal import Microphone, ResourceManager, load_configuration

FOLDER = Path(__file__).parent


def test_it_hears(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    device = resources.obtain("thing", Microphone)
    ear = device.listen()
    heard = ear.read(1.0)
    assert len(heard) == 8000
    assert 2900 < np.abs(heard).max() <= 3000
    resources.close()
    assert not device.is_active
