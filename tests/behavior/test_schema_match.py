"""A schema and the class that does its work declare the same, or the loader says what differs."""

import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.network_file import load_network
from hri.behavior.ports import LINEAR_VELOCITY, Input, Output, Param
from hri.behavior.runner import Runner
from hri.behavior.schema import load_schema, schema_of, write_schema
from hri.core.errors import AuthoringError
from hri.testing import context

LIBRARY = '''
from hri.behavior import Behavior
from hri.behavior.ports import Input, Output, Param


class StopCrashBehavior(Behavior):
    """The custom behavior of the guide."""

    stop_limit = Param(60.0, "centimeters", minimum=0)
    is_loud = Param(False, "true or false")
    forward_velocity = Input("double", "cm/s", {meaning!r})
    range_sensor = Input("double", "centimeters", is_optional=True)
    output_velocity = Output("double", "cm/s", name="forward_velocity")

    def compute(self, now, dt):
        velocity = self.forward_velocity.value or 0.0
        if any(reading < self.stop_limit for reading in self.range_sensor.values):
            velocity = 0.0
        self.output_velocity.send(velocity)
'''
LIMIT = '<Parameter name="stop_limit" type="number" default="60"/>'
LOUD = '<Parameter name="is_loud" type="string" default="false"/>'
FORWARD = '<Port name="forward_velocity" datatype="double"{}/>'
VELOCITY = FORWARD.format(f' semantic_type="{LINEAR_VELOCITY}"')
RANGE = '<Port name="range_sensor" datatype="double"/>'
NETWORK = """<BehaviorNetwork>
<Behavior id="three" type="Hri.Constant"><Parameter name="parsed_value" value="3"/></Behavior>
<Behavior id="near" type="Hri.Constant"><Parameter name="parsed_value" value="{}"/></Behavior>
<Behavior id="stop" type="Examples.StopCrashBehavior"/>
<Link from="three.value" to="stop.forward_velocity"/>
<Link from="near.value" to="stop.range_sensor"/>
</BehaviorNetwork>"""


def ports(inputs, outputs):
    return f"\n<Inputs>{inputs}</Inputs>\n<Outputs>{outputs}</Outputs>"


WHOLE = LIMIT + LOUD + ports(VELOCITY + RANGE, VELOCITY)


@pytest.fixture
def write(tmp_path, monkeypatch):
    """Write the schema of the guide's behavior, with the class beside it."""
    monkeypatch.setenv("HRI_PATH", str(tmp_path))

    def _write(body=WHOLE, meaning=LINEAR_VELOCITY, name="StopCrashBehavior"):
        file = tmp_path / "behavior" / "Examples" / f"{name}.xml"
        file.parent.mkdir(parents=True, exist_ok=True)
        (file.parent / "stop.py").write_text(LIBRARY.format(meaning=meaning))
        file.write_text(
            f'<BehaviorSchema type="Examples.{name}" driver="Examples.StopCrashBehavior"'
            f' library="./stop.py" category="sample_code">{body}</BehaviorSchema>'
        )
        return f"Examples.{name}"

    return _write


@pytest.mark.proves("B01", "B14", "B16")
@pytest.mark.parametrize(("reading", "sent"), [("59.9", 0.0), ("60", 3.0)])
def test_the_stop_crash_of_the_guide_runs_with_the_class_that_the_page_says(
    write, tmp_path, reading, sent
):
    write()
    file = tmp_path / "net.xml"
    file.write_text(NETWORK.format(reading))
    network, seen = load_network(file), []
    runner = Runner(network, context())
    runner.watch("stop", "forward_velocity", lambda value, now: seen.append(value))
    runner.tick(0.0)
    runner.tick(0.1)
    assert seen == [sent, sent]


def test_a_schema_that_declares_nothing_takes_all_of_its_class(write):
    stop = find_behavior(write(""))
    assert list(stop.parameters) == ["stop_limit", "is_loud"]
    assert (list(stop.inputs), list(stop.outputs)) == (
        ["forward_velocity", "range_sensor"],
        ["forward_velocity"],
    )


def test_what_a_schema_leaves_open_its_class_says(write, tmp_path):
    generic = FORWARD.format("")
    stop = find_behavior(write(LIMIT + LOUD + ports(generic + RANGE, generic)))
    assert stop.inputs["forward_velocity"].semantic == LINEAR_VELOCITY
    assert stop.inputs["range_sensor"].is_optional
    exported = tmp_path / "exported.xml"
    exported.write_text(write_schema(schema_of(stop)))
    write(exported.read_text().partition('sample_code">')[2].removesuffix("</BehaviorSchema>\n"))
    assert load_schema(exported).inputs == schema_of(find_behavior(write())).inputs


def test_a_meaning_has_two_spellings(write):
    spelled = FORWARD.format(' semantic_type="Hri.LinearVelocity"')
    find_behavior(write(LIMIT + LOUD + ports(spelled + RANGE, spelled)))


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (
            LIMIT + LOUD + ports(VELOCITY + RANGE, VELOCITY + '\n<Port name="x" datatype="any"/>'),
            '4:1: StopCrashBehavior has no output "x" - known are: forward_velocity',
        ),
        (
            LIMIT + LOUD + ports(VELOCITY, VELOCITY),
            '1:1: the input "range_sensor" of StopCrashBehavior is missing'
            ' - add <Port name="range_sensor" datatype="double"/> to <Inputs>',
        ),
        (
            LIMIT + LOUD + f"<Inputs>{VELOCITY}{RANGE}</Inputs>",
            '1:1: the output "forward_velocity" of StopCrashBehavior is missing'
            ' - add <Port name="forward_velocity" datatype="double"/> to <Outputs>',
        ),
        (
            LIMIT + LOUD + ports(VELOCITY, VELOCITY + "\n" + RANGE),
            '4:1: StopCrashBehavior has no output "range_sensor" - its input has that name: move',
        ),
        (
            LIMIT + LOUD + ports(VELOCITY + "\n" + RANGE.replace("double", "string"), VELOCITY),
            '3:1: the input "range_sensor" of StopCrashBehavior is double'
            ' - write datatype="double"',
        ),
        (
            LIMIT
            + LOUD
            + ports("\n" + FORWARD.format(' semantic_type="Hri.AngularVelocity"') + RANGE, ""),
            f'3:1: the input "forward_velocity" of StopCrashBehavior is {LINEAR_VELOCITY} - write',
        ),
        (
            LOUD + ports(VELOCITY + RANGE, VELOCITY),
            '1:1: the parameter "stop_limit" of StopCrashBehavior is missing'
            ' - add <Parameter name="stop_limit" type="number" default="60"/>',
        ),
        (LIMIT + LOUD, '1:1: the input "forward_velocity" of StopCrashBehavior is missing'),
        (
            f"\n{LIMIT.replace('number', 'string')}",
            '2:1: the parameter "stop_limit" of StopCrashBehavior is number - write type="number"',
        ),
        (
            f"\n{LIMIT.replace('number', 'integer')}",
            '2:1: the parameter "stop_limit" of StopCrashBehavior is number - write type="number"',
        ),
        (
            f"\n{LIMIT.replace('60', 'far').replace('number', 'string')}",
            "2:1: stop_limit: ",
        ),
        (f"\n{LIMIT.replace('60', '-1')}", "2:1: stop_limit: -1 is out of range"),
        (
            '\n<Parameter name="stop_limit" type="number" default="60" minimum="5"/>',
            '2:1: the parameter "stop_limit" of StopCrashBehavior is 0 - write minimum="0"',
        ),
        (
            '\n<Parameter name="range_sensor" type="number" default="1"/>',
            '2:1: StopCrashBehavior has no parameter "range_sensor" - its input has that name',
        ),
    ],
)
def test_what_differs_is_told_at_load_with_its_place(write, body, message):
    name = write(body)
    with pytest.raises(AuthoringError) as error:
        find_behavior(name)
    assert str(error.value).partition("StopCrashBehavior.xml:")[2].startswith(message)


def test_a_variant_of_a_behavior_of_the_library_may_leave_parameters_out(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    file = tmp_path / "behavior" / "My" / "Ring.xml"
    file.parent.mkdir(parents=True)
    text = '<BehaviorSchema type="My.Ring" driver="Hri.StopCrash">{}</BehaviorSchema>'
    file.write_text(text.format('<Parameter name="stop_limit" default="40"/>'))
    assert find_behavior("My.Ring")("r").stop_limit == 40.0
    file.write_text(text.format(f"<Inputs>{RANGE}</Inputs>"))
    with pytest.raises(AuthoringError, match='input "forward_velocity" of StopCrash is missing'):
        find_behavior("My.Ring")


def test_your_own_example_of_2003_goes_before_the_one_of_the_library(write):
    assert find_behavior("Examples.StopCrash") is find_behavior("Hri.StopCrash")
    own = find_behavior(write(name="StopCrash"))
    assert own.__mro__[1].__name__ == "StopCrashBehavior"


def test_names_that_both_ports_of_a_malleable_behavior_have_do_not_meet(tmp_path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    file = tmp_path / "behavior" / "My" / "Talk.xml"
    file.parent.mkdir(parents=True)
    text, text_out = (f'<Port name="{name}" datatype="string"/>' for name in ("text", "text_out"))
    file.write_text(
        '<BehaviorSchema type="My.Talk" driver="Evolution.MalleableBehavior">'
        f"{ports(text + text_out, text + text_out)}</BehaviorSchema>"
    )
    talk = find_behavior("My.Talk")("talk")
    talk.output_port("text").send("a")
    talk.output_port("text_out").send("b")
    assert (talk.input_port("text").value, talk.input_port("text_out").value) == (None, None)
    assert (talk.output_port("text").value, talk.output_port("text_out").value) == ("a", "b")


class Base(Behavior):
    number = Input("double", "a number")
    twice = Output("double", "a number", name="number")
    gain = Param(1.0, "a factor")


@pytest.mark.parametrize(
    ("members", "message"),
    [
        ({"number": Output("double", "x")}, "number is the Input of a base class - rename"),
        ({"gain": Input("double", "x")}, "gain is the Param of a base class - rename"),
        ({"more": Output("double", "x", name="number")}, 'output "number" as more, too - call'),
        (
            {"a": Output("double", "x", name="b"), "b": Output("double", "x")},
            'output "b" as b, too - call both a',
        ),
    ],
)
def test_a_class_says_at_once_what_its_base_contradicts(members, message):
    with pytest.raises(TypeError, match=message):
        type("Own", (Base,), members)
