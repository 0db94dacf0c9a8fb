from pathlib import Path

import pytest

from hri.core.clock import FakeClock
from hri.hal.configuration import load_configuration
from hri.hal.manager import ResourceManager
from hri.hal.range_sensor import RangeSensor

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
