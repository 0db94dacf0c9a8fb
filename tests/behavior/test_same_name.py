"""An input and an output of one name are two ports."""

import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.network import Network
from hri.behavior.ports import Input, Output
from hri.behavior.runner import Runner
from hri.behavior.schema import schema_of
from hri.core.errors import HriError
from hri.testing import context

SCHEMA = """<BehaviorSchema type="Mine.Talk" driver="Evolution.MalleableBehavior">
<Inputs><Port name="text" datatype="string"/></Inputs>
<Outputs><Port name="text" datatype="double"/></Outputs>
</BehaviorSchema>"""


class Next(Behavior):
    """Sends the number after the one that comes."""

    number = Input[float]("double", "a number")
    following = Output[float]("double", "one more", name="number")

    def compute(self, now, dt):
        self.following.send((self.number.value or 0.0) + 1)


def test_links_and_watches_reach_each_of_the_two():
    network = Network("two", 0.1, behaviors=[Next("a"), Next("b")])
    network.connect("a.number", "b.number")
    runner, seen = Runner(network, context()), []
    runner.watch("b", "number", lambda value, now: seen.append(value))
    runner.inject("a", "number", 5.0)
    runner.tick(0.0)
    runner.tick(0.1)
    assert seen == [7.0, 2.0]


def test_a_schema_may_give_both_ports_one_name(tmp_path, monkeypatch):
    folder = tmp_path / "behavior" / "Mine"
    folder.mkdir(parents=True)
    (folder / "Talk.xml").write_text(SCHEMA)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    cls = find_behavior("Mine.Talk")
    assert (cls.inputs["text"].datatype, cls.outputs["text"].datatype) == ("string", "double")
    assert [port.name for port in schema_of(cls).outputs] == ["text"]
    behavior = cls("talk")
    behavior.check()
    behavior.output_port("text").send(2.0)
    assert behavior.text.value is None


def test_of_both_ports_of_one_name_the_datatype_must_travel(tmp_path, monkeypatch):
    folder = tmp_path / "behavior" / "Mine"
    folder.mkdir(parents=True)
    (folder / "Talk.xml").write_text(SCHEMA.replace('"string"', '"image"'))
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    with pytest.raises(HriError, match=r"talk\.text is image, which does not travel"):
        find_behavior("Mine.Talk")("talk").check()
