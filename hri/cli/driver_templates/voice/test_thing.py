from pathlib import Path

from hri.core import FakeClock
from hri.hal import ResourceManager, Synthesizer, load_configuration

FOLDER = Path(__file__).parent


def test_it_speaks(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    devices = load_configuration(FOLDER / "devices.xml").devices
    resources = ResourceManager(devices, FakeClock())
    resources.check()
    device = resources.obtain("thing", Synthesizer)
    speech = device.synthesize("hello")
    assert len(speech.samples) == round(5 * 0.08 * speech.rate)
    assert speech.samples.any()
    resources.close()
    assert not device.is_active
