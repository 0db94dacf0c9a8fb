from pathlib import Path

import pytest

from hri.core import FakeClock
from hri.hal import Battery, ResourceManager, load_configuration

FOLDER = Path(__file__).parent


def test_it_is_as_full_as_its_configuration_says(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    device = resources.obtain("thing", Battery)
    assert device.voltage(1.0) == 7.0
    assert device.level(1.0) == pytest.approx(0.22, abs=0.01)
    resources.close()
    assert not device.is_active
