"""Datatypes of one's own, for the ports of an app's behaviors."""

import pytest

from hri.behavior.catalog import find_behavior
from hri.behavior.network_file import load_network
from hri.behavior.ports import DATATYPES, OutputPort, declare_datatype
from hri.cli import behave
from hri.core.errors import AuthoringError

LIBRARY = """
from dataclasses import dataclass

from hri.behavior.behavior import Behavior
from hri.behavior.ports import Input, Output, declare_datatype


@dataclass(frozen=True)
class Track:
    x: float


declare_datatype("My.Track", Track)


class Finder(Behavior):
    track = Output[Track]("My.Track", "what is followed")

    def compute(self, now: float, dt: float) -> None:
        self.track.send(Track(3.0))


class Keeper(Behavior):
    track = Input[Track]("My.Track", "what is followed")
    x = Output[float]("double", "where it is")

    def compute(self, now: float, dt: float) -> None:
        if self.track.value is not None:
            self.x.send(self.track.value.x)
"""
SCHEMA = (
    '<BehaviorSchema type="My.{0}" driver="My.{0}" library="../../tracks.py"><{1}>'
    '<Port name="track" datatype="{2}" description="what is followed"/></{1}>{3}</BehaviorSchema>'
)
X = '<Outputs><Port name="x" datatype="double"/></Outputs>'
NETWORK = (
    '<BehaviorNetwork><Behavior id="finder" type="My.Finder"/><Behavior id="keeper"'
    ' type="My.Keeper"/><Behavior id="show" type="Hri.InputCollector"/>'
    '<Link from="{}" to="keeper.track"/><Link from="keeper.x" to="show.input"/></BehaviorNetwork>'
)


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    (tmp_path / "tracks.py").write_text(LIBRARY)
    (tmp_path / "behavior" / "My").mkdir(parents=True)
    for name, ports in (("Finder", "Outputs"), ("Keeper", "Inputs")):
        schema(tmp_path, name, ports, "My.Track")
    yield tmp_path
    DATATYPES.pop("My.Track", None)


def schema(folder, name, ports, datatype):
    path = folder / "behavior" / "My" / f"{name}.xml"
    path.write_text(SCHEMA.format(name, ports, datatype, X if name == "Keeper" else ""))


def network(folder, source="finder.track"):
    path = folder / "net.xml"
    path.write_text(NETWORK.format(source))
    return path


def test_a_value_of_a_datatype_of_ones_own_travels(folder, capsys):
    options = ["--without-resources", "--fast", "--invocation-count=1"]
    assert behave.main([str(network(folder)), *options]) == 0
    assert "Input show  double: 3\n" in capsys.readouterr().out


def test_a_link_of_another_datatype_is_refused_at_load(folder):
    with pytest.raises(AuthoringError, match=r"keeper.x is double, but keeper.track takes My.Tr"):
        load_network(network(folder, "keeper.x"))


def test_a_datatype_that_its_library_does_not_declare_is_refused_at_its_place(folder):
    schema(folder, "Keeper", "Inputs", "My.Trak")
    with pytest.raises(AuthoringError, match=r'Keeper.xml:1:\d+: the datatype "My.Trak" - did you'):
        find_behavior("My.Keeper")


def test_a_value_of_another_type_is_not_sent(folder):
    find_behavior("My.Finder")
    with pytest.raises(TypeError, match=r"this output is a My.Track"):
        OutputPort(datatype="My.Track").send(3.0)


@pytest.mark.parametrize(
    ("name", "kind", "message"),
    [
        ("track", dict, "write Namespace.Name"),
        ("My.Track", "dict", "give a class"),
        ("Your.Track", dict, 'datatype "Your.Track" is builtins.list already'),
    ],
)
def test_a_name_or_a_class_that_does_not_do_is_refused(monkeypatch, name, kind, message):
    monkeypatch.setitem(DATATYPES, "Your.Track", list)
    with pytest.raises(TypeError, match=message):
        declare_datatype(name, kind)
