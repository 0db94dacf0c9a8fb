from pathlib import Path

import pytest
from thing import ThingProtocol

from hri.core import FakeClock, Twist
from hri.hal import ResourceManager, load_configuration

FOLDER = Path(__file__).parent


def test_it_is_told_how_fast_to_roll_and_tells_how_far_it_has(monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    ResourceManager(load_configuration(FOLDER / "devices.xml").devices, FakeClock()).check()
    base = ThingProtocol()
    assert base.velocity(Twist(0.2, 0.0)) == b"v 200 200\n"
    assert base.velocity(Twist(0.0, 1.0)) == b"v -100 100\n"
    assert base.recognizes(b"thing 1.0\n")
    assert base.feed(b"0 0\n10 ", 1.0)[0].rolled.linear == 0.0
    (report,) = base.feed(b"10\nnonsense\n", 1.1)
    assert report.rolled.linear == pytest.approx(0.01)
    assert report.velocity is not None
    assert report.velocity.linear == pytest.approx(0.1)
