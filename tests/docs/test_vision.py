"""The page about seeing: what it shows works, and what it names is there."""

import re
from pathlib import Path

import pytest

from hri.behavior.catalog import find_behavior
from hri.behavior.network_file import load_network
from hri.core import registry
from hri.core.clock import FakeClock
from hri.hal.camera import Camera
from hri.hal.configuration import load_configuration
from hri.hal.resource_manager import ResourceManager

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs/vision.md").read_text()
CODE = (
    "\n".join(
        path.read_text()
        for folder in ("vision", "behavior", "hal", "core")
        for path in (ROOT / "hri" / folder).rglob("*.py")
    )
    + (ROOT / "config/gestures.toml").read_text()
)


def blocks(language):
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


def test_the_network_of_the_page_loads(tmp_path):
    (network,) = [block for block in blocks("xml") if "<BehaviorNetwork" in block]
    path = tmp_path / "seeing.xml"
    path.write_text(network)
    assert len(load_network(path).behaviors) == 4


def test_the_device_of_the_page_is_accepted(tmp_path):
    (device,) = [block for block in blocks("xml") if "<Device" in block]
    path = tmp_path / "resource-config.xml"
    path.write_text(f"<Resources><Devices>{device}</Devices></Resources>")
    manager = ResourceManager(load_configuration(path).devices, FakeClock())
    manager.check()
    assert manager.ids(Camera) == ["camera"]
    assert manager.pose_of("camera").z == pytest.approx(1.2)


def test_every_type_it_names_is_there():
    for name in set(re.findall(r"`(Hri\.\w+)`", PAGE)):
        known = [*registry.known("hri.resources"), *registry.known("hri.behaviors")]
        assert name in known, name
        if name in registry.known("hri.behaviors"):
            assert find_behavior(name)


def test_every_event_it_names_is_raised():
    table = PAGE.split("| event |")[1].split("\n\n")[0]
    names = re.findall(r"`(\w+\.\w+)`", table)
    assert len(names) > 12
    assert [name for name in names if f'"{name}"' not in CODE] == []


def test_its_links_lead_somewhere():
    for link in re.findall(r"\]\(([^)#]+)\)", PAGE):
        assert (ROOT / "docs" / link).exists(), link


def test_every_option_it_names_is_one_of_hri_watch(capsys):
    from hri.cli.main import main

    with pytest.raises(SystemExit):
        main(["watch", "--help"])
    help = capsys.readouterr().out
    table = PAGE.split("| option |")[1].split("\n\n")[0]
    options = re.findall(r"--\w+", table)
    assert len(options) >= 6
    assert [option for option in options if option not in help] == []
