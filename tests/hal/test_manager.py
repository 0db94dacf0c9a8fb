import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError, NotAvailable
from hri.hal.camera import Camera
from hri.hal.configuration import load_configuration
from hri.hal.drivers.memory import OffscreenScreen, SilentSpeaker
from hri.hal.manager import ResourceManager
from hri.hal.microphone import Microphone
from hri.hal.resource import Description
from hri.hal.screen import Screen
from hri.hal.speaker import Speaker


def load(tmp_path, devices):
    path = tmp_path / "config.xml"
    path.write_text(f"<Resources><Devices>\n{devices}\n</Devices></Resources>")
    return load_configuration(path)


def failure(tmp_path, devices):
    def read_and_check():
        ResourceManager(load(tmp_path, devices).devices, FakeClock()).check()

    with pytest.raises(AuthoringError) as error:
        read_and_check()
    return str(error.value).split("config.xml:")[1]


@pytest.mark.parametrize(
    ("devices", "message"),
    [
        (
            '<Device id="a" type="Hri.Micorphone"/>',
            '2:16: unknown device type "Hri.Micorphone" - did you mean "Hri.Microphone"?',
        ),
        (
            '<Device id="a" type="Hri.SilentSpeaker"><Parameter name="rat" value="1"/></Device>',
            '2:41: Hri.SilentSpeaker has no parameter "rat"',
        ),
        ('<Device id="a" type="Hri.SilentSpeaker">', "mismatched tag"),
        (
            '<Device id="a" type="Hri.SilentSpeaker"/><Device id="a" type="Hri.SilentSpeaker"/>',
            'the id "a" is used twice',
        ),
        (
            '<Device id="a" type="Hri.Webcam"><Parameter name="stand_in" value="b"/></Device>',
            'no device "b"',
        ),
        (
            '<Device id="a" type="Hri.Webcam"><Parameter name="stand_in" value="b"/></Device>\n'
            '<Device id="b" type="Hri.Webcam"><Parameter name="stand_in" value="a"/></Device>',
            "2:34: stand-ins run in a circle: a -> b -> a",
        ),
        ('<Devise id="a"/>', '<Devise> has no place in <Devices> - did you mean "Device"?'),
    ],
)
def test_mistakes_in_a_configuration_have_a_place(tmp_path, devices, message):
    assert message in failure(tmp_path, devices)


class Logged(SilentSpeaker):
    log: list[str] = []

    def _open(self):
        super()._open()
        self.log.append(f"open {self.id}")

    def _close(self):
        self.log.append(f"close {self.id}")


def test_resources_open_when_needed_and_close_in_reverse():
    Logged.log = []
    manager = ResourceManager((), FakeClock())
    for id in ("a", "b"):
        speaker = Logged(Description(id, "Test.Logged"), manager)
        speaker.activate()
        speaker.activate()
        manager.substitute(id, speaker)
    assert manager.obtain("a", Speaker) is manager.obtain("a", Speaker)
    manager.close()
    manager.close()
    assert Logged.log == ["open a", "open b", "close b", "close a"]


def test_on_fake_time_hardware_gives_way_to_its_stand_in(tmp_path):
    configuration = load(
        tmp_path,
        '<Device id="speaker" type="Hri.Speaker">'
        '<Parameter name="stand_in" value="silent"/></Device>'
        '<Device id="silent" type="Hri.SilentSpeaker"/>'
        '<Device id="camera" type="Hri.Webcam"/>',
    )
    manager = ResourceManager(configuration.devices, FakeClock())
    assert isinstance(manager.obtain("speaker", Speaker), SilentSpeaker)
    assert manager.stand_in_of("speaker") == "silent"
    with pytest.raises(NotAvailable, match="needs real time"):
        manager.obtain("camera", Camera)


def test_unknown_ids_and_wrong_interfaces_are_clear():
    description = Description("screen", "Hri.OffscreenScreen")
    manager = ResourceManager([description], FakeClock())
    with pytest.raises(HriError, match='no device "scren" - did you mean "screen"'):
        manager.obtain("scren", Screen)
    with pytest.raises(HriError, match="is a OffscreenScreen, no Microphone"):
        manager.obtain("screen", Microphone)
    assert isinstance(manager.find(Screen), OffscreenScreen)
    assert manager.find(Microphone) is None


def test_numbers_of_a_description_may_be_expressions(tmp_path):
    configuration = load(
        tmp_path,
        '<Device id="a" type="Evolution.USBIrSensor">'
        '<Parameter name="yaw" value="-5*pi/6"/><Parameter name="x" value="one"/></Device>',
    )
    device = configuration.devices[0]
    assert device.number("yaw", 0) == pytest.approx(-2.6179939)
    with pytest.raises(AuthoringError, match='x: "one" is no number'):
        device.number("x", 0)


def test_a_spec_gives_defaults_and_the_device_wins(tmp_path, monkeypatch):
    spec = tmp_path / "resource" / "Hri"
    spec.mkdir(parents=True)
    (spec / "OffscreenScreen.xml").write_text(
        '<ResourceSpec id="Hri.OffscreenScreen"><Parameter name="width" value="320"/>'
        '<Parameter name="height" value="240"/></ResourceSpec>'
    )
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    configuration = load(
        tmp_path,
        '<Device id="s" type="Hri.OffscreenScreen"><Parameter name="width" value="64"/></Device>',
    )
    screen = ResourceManager(configuration.devices, FakeClock()).obtain("s", Screen)
    assert (screen.width, screen.height) == (64, 240)
