import math
import threading

import pytest
from hypothesis import given, settings, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError, NotAvailable
from hri.hal.bumper import Bumper
from hri.hal.camera import Camera
from hri.hal.configuration import load_configuration
from hri.hal.drivers.memory import OffscreenScreen, SilentSpeaker
from hri.hal.microphone import Microphone
from hri.hal.resource import Description, Resource
from hri.hal.resource_manager import ResourceManager
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


@pytest.mark.proves("H31")
def test_of_several_devices_a_stand_in_is_the_last_to_be_found(tmp_path):
    devices = (
        '<Device id="silent" type="Hri.SilentSpeaker"/>'
        '<Device id="front" type="Hri.SilentSpeaker">'
        '<Parameter name="stand_in" value="silent"/></Device>'
        '<Device id="back" type="Hri.SilentSpeaker"/>'
    )
    manager = ResourceManager(load(tmp_path, devices).devices, FakeClock())
    assert manager.ids(Speaker) == ["front", "back", "silent"]
    assert manager.find(Speaker).id == "front"


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
    with pytest.raises(HriError, match="is a OffscreenScreen, not a Microphone"):
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
    with pytest.raises(AuthoringError, match='x: "one" is not a number'):
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


class Counting(Resource):
    """Counts how often it is opened and closed, and notices when that goes wrong."""

    opened = closed = 0
    is_wrong = False

    def _open(self):
        type(self).opened += 1
        type(self).is_wrong |= self.opened - self.closed != 1

    def _close(self):
        type(self).closed += 1
        type(self).is_wrong |= self.opened != self.closed


def counting():
    """A driver of its own for each test, with a manager that knows it as "thing"."""

    class Thing(Counting):
        pass

    manager = ResourceManager((), FakeClock())
    manager.substitute("thing", Thing(Description("thing", "Test.Thing"), manager))
    return Thing, manager


@pytest.mark.proves("H19", "H20")
def test_activating_and_deactivating_again_does_nothing():
    Thing, manager = counting()
    thing = Thing(Description("thing", "Test.Thing"), manager)
    for _ in range(2):
        thing.activate()
        thing.activate()
        assert thing.is_active
        thing.deactivate()
        thing.deactivate()
        assert not thing.is_active
    assert (Thing.opened, Thing.closed) == (2, 2)


@pytest.mark.proves("H18", "H19")
def test_the_last_release_closes():
    Thing, manager = counting()
    first, second = manager.obtain("thing", Thing), manager.obtain("thing", Thing)
    assert first is second
    assert first.reservations == 2
    manager.release(first)
    assert first.is_active
    manager.release(second)
    assert not first.is_active
    manager.release(first)  # once too often
    assert manager.obtain("thing", Thing).is_active
    assert (Thing.opened, Thing.closed) == (2, 1)


@pytest.mark.proves("H19")
@settings(deadline=None, max_examples=20)
@given(st.lists(st.lists(st.booleans(), max_size=20), min_size=2, max_size=6))
def test_many_threads_obtain_and_release_at_will(plans):
    Thing, manager = counting()
    barrier, seen_closed = threading.Barrier(len(plans)), []

    def live(plan):
        held = []
        barrier.wait()
        for wants in plan:
            if wants or not held:
                held.append(manager.obtain("thing", Thing))
            else:
                manager.release(held.pop())
            if held and not held[0].is_active:
                seen_closed.append(plan)
        while held:
            manager.release(held.pop())

    threads = [threading.Thread(target=live, args=(plan,)) for plan in plans]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not seen_closed
    assert not Thing.is_wrong
    assert Thing.opened == Thing.closed


def test_a_wrong_interface_keeps_nothing_open():
    Thing, manager = counting()
    with pytest.raises(HriError, match="not a Screen"):
        manager.obtain("thing", Screen)
    assert Thing.opened == Thing.closed


class Upper(Resource):
    """Uses a thing."""

    def _open(self):
        self.thing = self.use("thing", Counting)
        if self.description.text("fails"):
            raise self.not_available("it fails", "mend it")


def test_a_resource_gives_back_what_it_uses():
    Thing, manager = counting()
    manager.substitute("upper", Upper(Description("upper", "Test.Upper"), manager))
    manager.release(manager.obtain("upper", Upper))
    assert (Thing.opened, Thing.closed) == (1, 1)


def test_a_resource_that_fails_to_open_gives_back_what_it_uses():
    Thing, manager = counting()
    upper = Upper(Description("upper", "Test.Upper", {"fails": "yes"}), manager)
    manager.substitute("upper", upper)
    with pytest.raises(NotAvailable, match="upper: it fails - mend it"):
        manager.obtain("upper", Upper)
    assert (Thing.opened, Thing.closed) == (1, 1)


class Stubborn(Resource):
    """Fails to close."""

    def _close(self):
        raise OSError("stuck")


def test_one_that_fails_to_close_keeps_no_other_open(caplog):
    Thing, manager = counting()
    thing = manager.obtain("thing", Thing)
    manager.substitute("stubborn", Stubborn(Description("stubborn", "Test.Stubborn"), manager))
    manager.obtain("stubborn", Stubborn)
    manager.close()
    assert not thing.is_active
    assert "stubborn: closing failed" in caplog.text


@pytest.mark.proves("H31")
def test_the_first_device_that_is_there_is_found(tmp_path):
    configuration = load(
        tmp_path,
        '<Device id="real" type="Hri.Webcam"/><Device id="blank" type="Hri.BlankCamera"/>',
    )
    manager = ResourceManager(configuration.devices, FakeClock())
    assert manager.find(Camera).id == "blank"
    with pytest.raises(NotAvailable):
        ResourceManager(configuration.devices[:1], FakeClock()).find(Camera)


SHAPED = """<Resources>
<Dimensions><Shape id="body" type="{type}"><Parameter name="lx" value="60"/>
<Parameter name="{name}" value="-15"/><Parameter name="yaw" value="pi/2"/></Shape></Dimensions>
<Devices/></Resources>"""


@pytest.mark.proves("H02")
def test_dimensions_are_meters(tmp_path):
    path = tmp_path / "shaped.xml"
    path.write_text(SHAPED.format(type="rectangular", name="x"))
    manager = ResourceManager((), FakeClock(), shapes=load_configuration(path).shapes)
    body = manager.dimensions
    assert (body.lx, body.ly, body.x, body.z) == (0.6, 0.0, -0.15, 0.0)
    assert body.yaw == pytest.approx(1.5707963)
    assert ResourceManager((), FakeClock()).dimensions.lx == 0


@pytest.mark.parametrize(
    ("type", "name", "said"),
    [
        ("round", "x", '2:30: a shape of type "round" is unknown'),
        ("rectangular", "ly", "3:1: ly is -15 - write a number from 0 to 1000"),
        ("rectangular", "lw", '3:1: a shape has no parameter "lw"'),
    ],
)
def test_mistakes_in_a_shape_have_a_place(tmp_path, type, name, said):
    path = tmp_path / "shaped.xml"
    path.write_text(SHAPED.format(type=type, name=name))
    with pytest.raises(AuthoringError) as error:
        load_configuration(path)
    assert said in str(error.value)


@pytest.mark.proves("H05")
def test_a_pose_follows_its_links():
    arm = Description("arm", "Hri.Bus", {"x": "10", "yaw": "pi/2"})
    hand = Description("hand", "Hri.Bus", {"link": "arm", "x": "5", "z": "2", "yaw": "pi/4"})
    manager = ResourceManager((arm, hand), FakeClock())
    pose = manager.pose_of("hand")
    assert (pose.x, pose.y, pose.z) == pytest.approx((0.1, 0.05, 0.02))
    assert pose.yaw == pytest.approx(3 * math.pi / 4)
    assert hand.pose.x == 0.05
    assert (arm.link, hand.link) == ("origin", "arm")


@pytest.mark.parametrize(
    ("link", "said"), [("b", "links run in a circle: a -> b -> a"), ("c", 'no device "c"')]
)
def test_links_to_nothing_and_in_a_circle_are_refused(link, said):
    one = Description("a", "Hri.Bus", {"link": link})
    other = Description("b", "Hri.Bus", {"link": "a"})
    with pytest.raises(AuthoringError, match=said):
        ResourceManager((one, other), FakeClock()).pose_of("a")


OWN_DRIVER = """
from hri.hal.bumper import Bumper

class Doorbell(Bumper):
    parameters = ("loudness",)
    def is_pressed(self, now):
        return self.description.number("loudness", 0) > 1
"""


@pytest.fixture
def own(tmp_path, monkeypatch):
    """A folder of the user with a spec and the driver beside it."""
    spec = tmp_path / "resource" / "My"
    spec.mkdir(parents=True)
    (spec / "doorbell.py").write_text(OWN_DRIVER)
    (spec / "Doorbell.xml").write_text(
        '<ResourceSpec id="Doorbell" library="doorbell.py" driver="My.Doorbell">'
        '<Parameter name="loudness" value="1"/></ResourceSpec>'
    )
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    return spec


@pytest.mark.proves("H16", "H21")
def test_a_driver_of_ones_own_is_a_file_beside_its_spec(tmp_path, own):
    configuration = load(
        tmp_path,
        '<Device id="quiet" type="My.Doorbell"/><Device id="loud" type="My.Doorbell">'
        '<Parameter name="loudness" value="2"/></Device>',
    )
    manager = ResourceManager(configuration.devices, FakeClock())
    manager.check()
    assert [manager.obtain(id, Bumper).is_pressed(0) for id in ("quiet", "loud")] == [False, True]
    assert manager.ids(Bumper) == ["quiet", "loud"]


@pytest.mark.parametrize(
    ("python", "said"),
    [
        ("class Doorbel: pass", 'no class "Doorbell" - did you mean "Doorbel"?'),
        ("class Doorbell: pass", "My.Doorbell is not a driver"),
        (
            "from hri.hal.bumper import Bumper\nclass Doorbell(Bumper): pass",
            "My.Doorbell lacks is_pressed - write it",
        ),
        ("class Doorbell(:", "doorbell.py:1:16: "),
        ("import no_such_package", "No module named 'no_such_package' - install it"),
    ],
)
def test_mistakes_in_a_driver_of_ones_own_are_told(tmp_path, own, python, said):
    (own / "doorbell.py").write_text(python)
    configuration = load(tmp_path, '<Device id="bell" type="My.Doorbell"/>')
    with pytest.raises(HriError) as error:
        ResourceManager(configuration.devices, FakeClock()).check()
    assert said in str(error.value)


@pytest.mark.proves("H16")
def test_a_library_of_2003_does_not_matter(tmp_path, own):
    (own / "Doorbell.xml").write_text(
        '<ResourceSpec id="Doorbell" library="./libDoorbell.so" driver="Evolution.LinuxCamera"/>'
    )
    configuration = load(tmp_path, '<Device id="bell" type="My.Doorbell"/>')
    manager = ResourceManager(configuration.devices, FakeClock())
    manager.check()
    assert manager.ids(Camera) == ["bell"]


def test_a_type_nobody_knows_names_the_folders_that_were_searched(tmp_path, own):
    said = failure(tmp_path, '<Device id="a" type="My.Bell"/>')
    assert '2:16: unknown device type "My.Bell"' in said
    assert f"no spec of it in {tmp_path}/config/resource/My, {tmp_path}/resource/My" in said


def test_a_type_cannot_lead_out_of_the_folders(tmp_path):
    assert "unknown device type" in failure(tmp_path, '<Device id="a" type="../../etc.passwd"/>')


@pytest.mark.proves("H18", "H23")
def test_a_configuration_is_loaded_by_name_opened_when_needed_and_closed_at_the_end():
    with ResourceManager.load("simulated", FakeClock()) as resources:
        screen = resources.obtain("screen", Screen)
        assert screen.is_active
        assert resources.clock.is_fake
    assert not screen.is_active
    with pytest.raises(HriError, match='no "simulatde" in config - did you mean "simulated"'):
        ResourceManager.load("simulatde")


def test_a_device_that_fails_to_open_as_files_do_is_not_available(tmp_path, own):
    (own / "doorbell.py").write_text(
        "from hri.hal.drivers.memory import SilentSpeaker\n"
        "class Doorbell(SilentSpeaker):\n"
        "    parameters = ('loudness',)\n"
        "    def _open(self): raise OSError(2, 'No such file or directory')\n"
    )
    configuration = load(tmp_path, '<Device id="bell" type="My.Doorbell"/>')
    manager = ResourceManager(configuration.devices, FakeClock())
    with pytest.raises(NotAvailable, match="bell: No such file or directory - see that it is plug"):
        manager.obtain("bell", Speaker)
