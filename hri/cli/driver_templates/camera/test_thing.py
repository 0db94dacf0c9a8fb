from pathlib import Path

from hri.core import FakeClock
from hri.hal import Camera, ResourceManager, load_configuration

FOLDER = Path(__file__).parent


def test_it_gives_pictures(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    device = resources.obtain("thing", Camera)
    frame = device.take()
    assert frame.image.shape == (240, 320, 3)
    assert frame.image.max() == 200
    assert device.read(frame.time) is None
    resources.close()
    assert not device.is_active
