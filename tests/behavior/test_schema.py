import contextlib
import string

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.ports import DATATYPES, Input, Output, Param
from hri.behavior.schema import (
    TYPES,
    Parameter,
    Port,
    Schema,
    load_schema,
    schema_of,
    subclass,
    write_schema,
)
from hri.core import registry
from hri.core.errors import AuthoringError, HriError

# The three schemas of the guide, pages 4-33 and 4-34, with quotes and brackets repaired.
CLIENT = """\
<BehaviorSchema type="Examples.TutorialClient" driver="Evolution.MalleableBehavior"
 display_name="Tutorial Client" library="libevobeutil" category="sample_code">
<Parameter name="tcp_host" type="string" default="localhost"/>
<Parameter name="tcp_port" type="number" default="25000"/>
<Parameter name="tag_name" type="string" default="tutorial"/>
<Inputs>
<Port name="text" datatype="string" description="Text to send to server"
 semantic_type="Evolution.Generic"/>
<Port name="array" datatype="doublearray" description="Double array to send to server"
 semantic_type="Evolution.Generic"/>
</Inputs>
<Outputs>
<Port name="number" datatype="double" description="Number received from the server"
 semantic_type="Evolution.Generic"/>
</Outputs>
</BehaviorSchema>
"""
SERVER = """\
<BehaviorSchema type="Examples.TutorialServer" driver="Evolution.MalleableBehavior"
 display_name="Tutorial Server" library="libevobeutil" category="sample_code">
<Parameter name="tcp_port" type="number" default="25000"/>
<Parameter name="tag_name" type="string" default="tutorial"/>
<Inputs><Port name="number" datatype="double" description="Number to send to client."
 semantic_type="Evolution.Generic"/></Inputs>
<Outputs>
<Port name="text" datatype="string" description="Text received from client"
 semantic_type="Evolution.Generic"/>
<Port name="array" datatype="doublearray" description="Double array received from client"
 semantic_type="Evolution.Generic"/>
</Outputs>
</BehaviorSchema>
"""
NUMBERS = """\
<BehaviorSchema type="MyBehaviors.SendNumbers" driver="Evolution.MalleableBehavior"
 display_name="Send Some Numbers" library="libevobeutil" category="sample_code">
<Parameter name="tcp_host" type="string" default="192.168.1.21"/>
<Parameter name="tcp_port" type="number" default="25000"/>
<Parameter name="tag_name" type="string" default="some_numbers"/>
<Inputs><Port name="numbers" datatype="doublearray" description="Numbers to send."
 semantic_type="Evolution.Generic"/></Inputs>
<Output><Port name="velocity" datatype="double" description="Incoming velocity."
 semantic_type="Evolution.LinearVelocity"/></Output>
</BehaviorSchema>
"""


def load(tmp_path, text):
    path = tmp_path / "schema.xml"
    path.write_text(text)
    return load_schema(path)


def failure(tmp_path, text):
    with pytest.raises(AuthoringError) as error:
        load(tmp_path, text)
    return str(error.value).split("schema.xml:")[1]


@pytest.mark.proves("B01", "B02", "B03")
def test_the_schemas_of_the_guide_parse(tmp_path):
    client = load(tmp_path, CLIENT)
    assert (client.type, client.driver) == (
        "Examples.TutorialClient",
        "Evolution.MalleableBehavior",
    )
    assert (client.display_name, client.category) == ("Tutorial Client", "sample_code")
    assert [(p.name, p.type, p.default) for p in client.parameters] == [
        ("tcp_host", "string", "localhost"),
        ("tcp_port", "number", "25000"),
        ("tag_name", "string", "tutorial"),
    ]
    assert [(port.name, port.datatype) for port in client.inputs] == [
        ("text", "string"),
        ("array", "doublearray"),
    ]
    server = load(tmp_path, SERVER)
    assert [port.name for port in server.outputs] == ["text", "array"]
    numbers = load(tmp_path, NUMBERS)
    assert numbers.outputs[0].semantic_type == "Evolution.LinearVelocity"


@pytest.mark.parametrize("type_name", registry.known("hri.behaviors"))
def test_every_declared_behavior_comes_back_from_its_schema(type_name, tmp_path):
    cls = find_behavior(type_name)
    schema = schema_of(cls)
    path = tmp_path / "schema.xml"
    path.write_text(write_schema(schema), encoding="utf-8")
    assert load_schema(path) == schema
    assert write_schema(load_schema(path)) == path.read_text(encoding="utf-8")
    again = subclass(Behavior, schema)
    assert schema_of(again) == schema


NAMES = st.text(string.ascii_lowercase, min_size=1, max_size=8).map("p_{}".format)
TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cc", "Cs")), max_size=20)


@st.composite
def schemas(draw):
    names = draw(st.lists(NAMES, max_size=8, unique=True))
    kinds = draw(st.lists(st.sampled_from("pio"), min_size=len(names), max_size=len(names)))
    parts = {"p": [], "i": [], "o": []}
    defaults = {
        "string": TEXTS,
        "number": st.floats(-1e6, 1e6).map(Param.text),
        "integer": st.integers(-1000, 1000).map(str),
        "boolean": st.sampled_from(["true", "false"]),
    }
    for name, kind in zip(names, kinds, strict=True):
        if kind == "p":
            type_name = draw(st.sampled_from(sorted(TYPES)))
            default = draw(defaults[type_name])
            parts["p"].append(Parameter(name, type_name, default, draw(TEXTS)))
        else:
            datatype = draw(st.sampled_from(sorted(DATATYPES)))
            parts[kind].append(Port(name, datatype, draw(TEXTS), draw(TEXTS)))
    return Schema(
        "Test.Type",
        "Hri.Constant",
        draw(TEXTS),
        draw(TEXTS),
        draw(TEXTS),
        *map(tuple, parts.values()),
    )


@pytest.mark.proves("B01")
@given(schemas())
def test_any_schema_is_the_same_after_class_and_file(tmp_path_factory, schema):
    path = tmp_path_factory.mktemp("schema") / "schema.xml"
    path.write_text(write_schema(schema), encoding="utf-8")
    assert load_schema(path) == schema
    assert schema_of(subclass(Behavior, schema)) == schema


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ('<Parameter name="x" type="nummer"/>', 'did you mean "number"?'),
        ('<Parameter name="x" type="number" default="much"/>', "is not a number"),
        ('<Parameter name="x" type="number" default="3" maximum="2"/>', "out of range"),
        ('<Parameter name="compute"/>', 'the name "compute" cannot be used'),
        ('<Inputs><Port name="a.b" datatype="double"/></Inputs>', "cannot be used"),
        ('<Inputs><Port name="a" datatype="dooble"/></Inputs>', 'did you mean "double"?'),
        (
            '<Inputs><Port name="a" datatype="double"/></Inputs>'
            '<Inputs><Port name="a" datatype="double"/></Inputs>',
            "used twice",
        ),
        ("<Inputs><Prt/></Inputs>", 'did you mean "Port"?'),
        ("hello", 'the text "hello" has no place'),
    ],
)
def test_mistakes_in_a_schema_have_a_place(tmp_path, body, message):
    head = '<BehaviorSchema type="A.B" driver="Hri.Constant">'
    assert message in failure(tmp_path, f"{head}\n{body}\n</BehaviorSchema>")


class Gain(Behavior):
    """Multiplies."""

    factor = Param(2.0, "the factor", minimum=0, maximum=10)
    number = Input[float]("double", "a number")
    product = Output[float]("double", "number times factor")

    def compute(self, now, dt):
        if (number := self.number.value) is not None:
            self.product.send(number * self.factor)


def test_a_schema_may_change_a_default_but_not_the_range_of_its_driver():
    schema = Schema(
        "My.Triple", "My.Gain", "Triple", "", "util", (Parameter("factor", "number", "3"),)
    )
    triple = subclass(Gain, schema)
    assert triple("t").factor == 3
    with pytest.raises(HriError, match="out of range"):
        triple("t", factor=11)


@pytest.mark.proves("B13")
def test_parameters_are_checked_in_code_as_in_files():
    class Settings(Behavior):
        """Has one parameter of each kind."""

        amount = Param(1.0, "a number", minimum=0, maximum=2)
        count = Param(3, "a whole number")
        is_loud = Param(False, "true or false")
        mode = Param("slow", "a choice", among=("slow", "fast"))

    settings = Settings("s", amount=2, count=4.0, is_loud=True, mode="fast")
    assert (settings.amount, settings.count) == (2.0, 4)
    assert type(settings.amount) is float
    for name, value, message in [
        ("amount", 3, "from 0 to 2"),
        ("amount", float("nan"), "out of range"),
        ("amount", "one", "write a number"),
        ("amount", True, "write a number"),
        ("count", 2.5, "whole number"),
        ("is_loud", 1, "true or false"),
        ("mode", "fats", 'did you mean "fast"'),
        ("mode", 3, "write a text"),
    ]:
        with pytest.raises(HriError, match=message):
            Settings("s", **{name: value})


@given(st.text(max_size=400))
def test_any_text_is_a_schema_or_one_clear_error(tmp_path_factory, body):
    path = tmp_path_factory.mktemp("fuzz") / "schema.xml"
    path.write_text(f'<BehaviorSchema type="A.B" driver="C.D">{body}</BehaviorSchema>', "utf-8")
    with contextlib.suppress(HriError):
        load_schema(path)
