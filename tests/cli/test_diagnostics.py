"""`test_drive_system`, `test_range_sensor` and `hri devices` in simulation."""

import json
import threading

import pytest

from hri.cli import devices, main
from hri.cli.diagnostics import drive_system, range_sensor
from hri.core.signals import RangeReading
from hri.hal.configuration import load_configuration

BASE = """<Resources><Devices><DeviceBus id="world" type="Hri.SimulatedWorld">{world}
<Device id="drive" type="Hri.SimulatedDrive"/><Device id="odometry" type="Hri.SimulatedOdometry"/>
</DeviceBus>{more}</Devices></Resources>"""

ALL_PASSED = """\
*** test_drive_system ***
Obtained drive system: drive
Forward 1 second: passed
Checking velocities: passed
Forward stop: passed
Moving backward 1 second: passed
Backward stop: passed
Forward 10 cm: passed
Backward 10 cm: passed
Turning left 90 degrees: passed
Turning right 180 degrees: passed
Turning left 90 degrees: passed
"""

NARROW = """
[robot]
start = [0, 0]
[person]
at = [5, 5]
[[wall]]
from = [0.25, -9]
to = [0.25, 9]
"""


@pytest.fixture
def write(tmp_path):
    """Writes a configuration with a base and more devices; its path."""

    def to_file(more="", world=""):
        path = tmp_path / "config.xml"
        path.write_text(BASE.format(more=more, world=world))
        return str(path)

    return to_file


@pytest.mark.proves("D01")
def test_the_drive_system_passes_as_in_the_guide(write, capsys):
    assert drive_system.main(["--fast", "--config", write()]) == 0
    assert capsys.readouterr().out == ALL_PASSED


@pytest.mark.proves("D01")
def test_a_base_before_a_wall_fails_and_says_why(write, capsys, tmp_path):
    (tmp_path / "narrow.toml").write_text(NARROW)
    world = f'<Parameter name="file" value="{tmp_path}/narrow.toml"/>'
    assert drive_system.main(["--fast", "--config", write(world=world)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) == len(ALL_PASSED.splitlines())
    assert lines[2].startswith("Forward 1 second: FAILED (it moved ")
    assert lines[2].endswith("not 15.0 - check motors, wheels and power)")


def test_the_help_of_the_drive_test_warns(capsys):
    assert drive_system.main(["--help"]) == 0
    shown = capsys.readouterr().out
    assert shown.startswith("Usage: test_drive_system [OPTIONS] [<drive_id>]\n")
    assert "4 feet (1.2 m) clear all around" in shown


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["motor"], 'no device "motor"'),
        (["world"], "not a DriveSystem - check the id"),
        (["--config", "nowhere.xml"], 'no "nowhere.xml" in config'),
    ],
)
def test_what_is_no_drive_is_one_clear_error(write, capsys, arguments, said):
    assert drive_system.main(["--fast", "--config", write(), *arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert said in captured.err
    assert len(captured.err.splitlines()) == 1


SENSORS = """
<Device id="IR_tnw" type="Evolution.USBIrSensor"><Parameter name="yaw" value="pi/4"/></Device>
<Device id="IR_tn" type="Evolution.USBIrSensor">
<Parameter name="max_range" value="30"/><Parameter name="noise" value="0"/></Device>"""


@pytest.mark.proves("D03")
def test_range_sensors_are_read_as_in_the_guide(write, capsys):
    arguments = ["--fast", "--config", write(SENSORS), "--read-count", "2", "--pause-time", "0.25"]
    assert range_sensor.main(arguments) == 0
    assert capsys.readouterr().out == (
        "*** test_range_sensor ***\n"
        "Obtained range sensors: IR_tn, IR_tnw\n"
        "IR_tn: distance = 1250 raw = 6 time = 0\n"
        "IR_tnw: distance = 1.798e+308 raw = 0 time = 0\n"
        "IR_tn: distance = 1250 raw = 6 time = 0.25\n"
        "IR_tnw: distance = 1.798e+308 raw = 0 time = 0.25\n"
    )


@pytest.mark.proves("D03")
@pytest.mark.parametrize(
    ("distance", "raw", "shown"),
    [
        (0.494812, 34, "IR_tn: distance = 49.48 raw = 34 time = 0"),
        (0.449, 164, "IR_tn: distance = 44.9 raw = 164 time = 0"),
        (float("inf"), 0, "IR_tn: distance = 1.798e+308 raw = 0 time = 0"),
        (0.6, None, "IR_tn: distance = 60 raw = 0 time = 0"),
    ],
)
def test_numbers_have_four_digits(distance, raw, shown):
    assert range_sensor.told("IR_tn", RangeReading("IR_tn", distance, 0.0, raw)) == shown


def test_sensors_that_are_all_missing_end_in_a_sentence(write, sonar, capsys):
    assert range_sensor.main(["--fast", "--config", write(sonar), "sonar"]) == 1
    assert capsys.readouterr().err.endswith("none of them is available - see the lines above\n")


def test_only_the_named_sensors_are_read(write, capsys):
    arguments = ["--fast", "--config", write(SENSORS), "--read-count", "1", "IR_tn"]
    assert range_sensor.main(arguments) == 0
    assert len(capsys.readouterr().out.splitlines()) == 3


def test_a_configuration_without_range_sensors_is_an_error(write, capsys):
    assert range_sensor.main(["--fast", "--config", write()]) == 2
    assert "no range sensor in it" in capsys.readouterr().err


@pytest.mark.parametrize("wrong", [["--read-count", "0"], ["--pause-time", "nan"]])
def test_options_have_limits(wrong, capsys):
    with pytest.raises(SystemExit) as end:
        range_sensor.main(wrong)
    assert end.value.code == 2


OWN_SENSOR = """
from hri.hal.range_sensor import RangeSensor

class Sonar(RangeSensor):
    def _open(self):
        raise self.not_available("cannot open /dev/sonar0", "check permissions")

    def read(self, now):
        raise AssertionError("it never opened")
"""


@pytest.fixture
def sonar(tmp_path, monkeypatch):
    """A sensor that is not there."""
    folder = tmp_path / "resource" / "My"
    folder.mkdir(parents=True)
    (folder / "sonar.py").write_text(OWN_SENSOR)
    (folder / "Sonar.xml").write_text('<ResourceSpec id="Sonar" library="sonar.py"/>')
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    return '<Device id="sonar" type="My.Sonar"/>'


@pytest.mark.proves("D04")
def test_a_sensor_that_is_not_there_costs_the_exit_status_alone(write, sonar, capsys):
    arguments = ["--fast", "--config", write(SENSORS + sonar), "--read-count", "1"]
    assert range_sensor.main(arguments) == 1
    captured = capsys.readouterr()
    assert captured.err == "Initializing...sonar: cannot open /dev/sonar0 - check permissions\n"
    assert "Obtained range sensors: IR_tn, IR_tnw\n" in captured.out


LISTED = """
<Device id="eye" type="My.Sonar"><Parameter name="stand_in" value="eye_too"/></Device>
<Device id="eye_too" type="Evolution.USBIrSensor"/>
<Device id="what" type="Hri.Bumpr"/>
<Device id="wrong" type="Hri.SilentSpeaker"><Parameter name="rat" value="1"/></Device>"""


def test_devices_tells_what_is_present_and_why_something_is_not(write, sonar, capsys):
    path = write(LISTED)
    assert main.main(["devices", "--config", path]) == 0
    lines = {line.split()[0]: line for line in capsys.readouterr().out.splitlines()}
    assert lines["id"].split() == ["id", "type", "bus", "driver", "state"]
    drive = ["drive", "Hri.SimulatedDrive", "world", "SimulatedDrive", "present"]
    assert lines["drive"].split() == drive
    assert lines["eye"].split()[1:5] == ["My.Sonar", "-", "Sonar", "missing"]
    assert lines["eye"].endswith(
        "cannot open /dev/sonar0 - check permissions (using eye_too instead)"
    )
    assert "unknown  unknown device type" in lines["what"]
    assert 'Hri.SilentSpeaker has no parameter "rat"' in lines["wrong"]


def test_devices_prints_json_as_well(write, sonar, capsys):
    assert main.main(["devices", "--config", write(sonar), "--json"]) == 0
    found = {device["id"]: device for device in json.loads(capsys.readouterr().out)}
    assert found["drive"]["state"] == "present"
    assert found["sonar"]["state"] == "missing"
    assert set(found["sonar"]) == {"id", "type", "bus", "driver", "state", "says", "stand_in"}


HANGING = """
import threading
from hri.hal.bumper import Bumper

RELEASED = threading.Event()

class Hangs(Bumper):
    def _open(self):
        RELEASED.wait()

    def is_pressed(self, now):
        return False
"""


def test_a_device_that_hangs_is_told_and_holds_up_nothing(write, tmp_path, sonar):
    folder = tmp_path / "resource" / "My"
    (folder / "hangs.py").write_text(HANGING)
    (folder / "Hangs.xml").write_text('<ResourceSpec id="Hangs" library="hangs.py"/>')
    path = write('<Device id="stuck" type="My.Hangs"/><Device id="b" type="Hri.SimulatedBumper"/>')
    configuration = load_configuration(tmp_path / path)
    try:
        found = {device.id: device for device in devices.examine(configuration, patience=0.2)}
        assert (found["stuck"].state, found["b"].state) == ("missing", "present")
        assert "does not open" in found["stuck"].says
    finally:
        from hri.core.python_file import load_class

        load_class(folder / "hangs.py", "Hangs")._open.__globals__["RELEASED"].set()
        for thread in threading.enumerate():
            if thread.daemon and thread.name.startswith("hri devices"):
                thread.join(5)
