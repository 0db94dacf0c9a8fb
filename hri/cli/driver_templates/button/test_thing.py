from pathlib import Path

from hri.core import FakeClock
from hri.hal import Button, ResourceManager, load_configuration

FOLDER = Path(__file__).parent


def test_it_is_held_as_its_configuration_says(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    device = resources.obtain("thing", Button)
    assert device.is_pressed(1.0)
    resources.close()
    assert not device.is_active
