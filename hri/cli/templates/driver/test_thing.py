from pathlib import Path

import pytest

from hri.core import FakeClock
from hri.hal import RangeSensor, ResourceManager, load_configuration

FOLDER = Path(__file__).parent


def test_it_measures_what_its_configuration_says(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    sensor = resources.obtain("thing", RangeSensor)
    assert sensor.read(1.0).distance == pytest.approx(0.42)
    resources.close()
    assert not sensor.is_active
