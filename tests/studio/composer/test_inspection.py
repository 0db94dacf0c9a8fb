"""What the page knows of behaviors, and what is wrong with a network: the words of the checker."""

import pytest

from hri.behavior.network_file import load_network
from hri.cli.main import main
from hri.core import paths
from hri.core.clock import FakeClock
from hri.hal.configuration import load_configuration
from hri.hal.resource_manager import ResourceManager
from hri.studio.composer import inspection
from hri.studio.devices import KINDS, devices_of

HEAD = '<?xml version="1.0" encoding="UTF-8"?>\n<BehaviorNetwork>\n'
SCHEMA = """<BehaviorSchema type="Own.Wave" driver="Own.Wave" display_name="Wave" library="wave.py"
 category="mine"><Outputs><Port name="height" datatype="double"/></Outputs></BehaviorSchema>"""
CODE = """from hri.behavior import Behavior, Output

class Wave(Behavior):
    height = Output("double", "how high")
    def compute(self, now, dt):
        pass
"""


@pytest.fixture(scope="module")
def palette():
    return inspection.palette()


def found(palette, name):
    (one,) = (one for one in palette["behaviors"] if one["type"] == name)
    return one


def check(body):
    return inspection.check(f"{HEAD}{body}\n</BehaviorNetwork>\n", "/tmp/net.xml")


@pytest.mark.proves("V02")
def test_a_new_behavior_appears_under_its_category(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    folder = tmp_path / "config" / "behavior" / "Own"
    folder.mkdir(parents=True)
    (folder / "Wave.xml").write_text(SCHEMA)
    (folder / "wave.py").write_text(CODE)
    wave = found(inspection.palette(), "Own.Wave")
    assert (wave["category"], wave["display_name"]) == ("mine", "Wave")
    assert [port["name"] for port in wave["outputs"]] == ["height"]
    assert inspection.schema("Own.Wave")["path"] == str(folder / "Wave.xml")
    (folder / "Broken.xml").write_text(SCHEMA.replace("Wave", "Broken").replace("wave", "broken"))
    (folder / "broken.py").write_text("1 / 0")
    (broken,) = inspection.palette()["broken"]
    assert (broken["type"], "division by zero" in broken["what"]) == ("Own.Broken", True)


def test_every_declared_behavior_can_be_built_with(palette):
    assert palette["broken"] == []
    assert len(palette["behaviors"]) >= 70
    for one in palette["behaviors"]:
        assert one["category"]
        assert one["about"] or one["type"].startswith("Examples."), one["type"]


def test_parameters_have_their_bounds_units_and_devices(palette):
    battery = found(palette, "Hri.Battery")
    low = next(one for one in battery["parameters"] if one["name"] == "low")
    assert (low["minimum"], low["maximum"], low["default"], low["type"]) == (0, 1, "0.2", "number")
    device = next(one for one in battery["parameters"] if one["name"] == "battery_id")
    assert device["interface"] == "battery"
    delay = found(palette, "Hri.Delay")["parameters"][0]
    assert (delay["name"], delay["unit"]) == ("delay_s", "seconds")


def test_each_kind_of_device_that_is_asked_for_has_an_interface(palette):
    wanted = {
        one["interface"]
        for behavior in palette["behaviors"]
        for one in behavior["parameters"]
        if one["interface"]
    }
    assert wanted <= KINDS.keys()
    path = paths.find("config", "simulated")
    devices = devices_of(ResourceManager(load_configuration(path).devices, FakeClock()))
    assert {"id": "camera", "interface": "camera", "about": "Hri.SimulatedCamera"} in devices


def test_names_of_2003_are_known(palette):
    assert palette["aliases"]["Evolution.Addition"] == "Hri.Addition"
    assert palette["aliases"]["Evolution.WinVoiceRecognizer"] == "Hri.Recognizer"
    assert set(palette["aliases"].values()) <= {one["type"] for one in palette["behaviors"]}


@pytest.mark.parametrize(
    "name", ["feeling", "hearing", "seeing", "moving", "face"], ids=lambda name: name
)
def test_the_networks_of_the_companion_have_no_problems(name):
    path = paths.house() / "apps" / "companion" / f"{name}.xml"
    checked = inspection.check(path.read_text(), str(path))
    assert checked["problems"] == []
    assert checked["order"] == [one.id for one in load_network(path).authored]


@pytest.mark.parametrize(
    ("value", "datatype"),
    [
        ("-5*pi/6", "double"),
        ("(1, pi/2,)", "doublearray"),
        ("True", "boolean"),
        ("1e999", "string"),
    ],
)
def test_a_constant_has_the_datatype_of_its_value(value, datatype):
    parameter = f'<Parameter name="parsed_value" value="{value}"/>'
    checked = check(f'<Behavior id="a" type="Hri.Constant">{parameter}</Behavior>')
    assert checked["datatypes"] == {"a.value": datatype}


def test_problems_are_at_their_behavior_parameter_or_link():
    checked = check(
        '<Behavior id="a" type="Hri.Scale"><Parameter name="factor" value="x"/></Behavior>\n'
        '<Behavior id="b" type="Hri.Constent"/>\n'
        '<Behavior id="c" type="Hri.Constant"/>\n'
        '<Link from="c.value" to="a.inputt"/>'
    )
    wrong, unknown, misfit = checked["problems"]
    assert (wrong["behavior"], wrong["parameter"], wrong["line"]) == ("a", "factor", 3)
    assert (unknown["behavior"], unknown["remedy"]) == ("b", 'did you mean "Hri.Constant"?')
    assert misfit["link"] == {"from": "c.value", "to": "a.inputt"}
    assert {one["grave"] for one in checked["problems"]} == {"error"}


def test_loose_ends_and_unread_files_are_at_their_behavior():
    checked = check(
        '<Behavior id="a" type="Hri.Scale"/>\n'
        '<Behavior id="ears" type="Hri.Recognizer">'
        '<Parameter name="grammar" value="nothing"/></Behavior>'
    )
    loose, unread = (one for one in checked["problems"] if one["behavior"] in ("a", "ears"))
    assert (loose["behavior"], loose["grave"]) == ("a", "warning")
    assert loose["what"] == "nothing reaches a (input)"
    assert (unread["behavior"], unread["grave"]) == ("ears", "error")


def test_the_words_are_those_of_the_command(tmp_path, capsys):
    file = tmp_path / "net.xml"
    body = '<Behavior id="b" type="Hri.Constent"/>\n<Behavior id="b.c" type="Hri.Constant"/>'
    file.write_text(f"{HEAD}{body}\n</BehaviorNetwork>\n")
    assert main(["network", "check", str(file)]) != 0
    printed = capsys.readouterr()
    for one in inspection.check(file.read_text(), str(file))["problems"]:
        line = f"{file}:{one['line']}:{one['column']}: {one['what']} - {one['remedy']}"
        assert line in printed.err + printed.out


@pytest.mark.parametrize(
    "text", ["", "<", "<a/>", "\x00", "<BehaviorNetwork>", "<!DOCTYPE x>", "é"]
)
def test_a_text_that_is_not_a_network_is_one_problem(text):
    (problem,) = inspection.check(text, "/tmp/net.xml")["problems"]
    assert problem["grave"] == "error"
