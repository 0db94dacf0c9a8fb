import pytest

from hri.behavior.behavior import Behavior
from hri.behavior.network import load_network
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import AuthoringError, HriError


def load(tmp_path, body, attributes=""):
    path = tmp_path / "net.xml"
    path.write_text(f"<BehaviorNetwork{attributes}>\n{body}\n</BehaviorNetwork>")
    return load_network(path)


def failure(tmp_path, body, attributes=""):
    with pytest.raises(AuthoringError) as error:
        load(tmp_path, body, attributes)
    return str(error.value).split("net.xml:")[1]


SUM = """\
<Behavior id="show" type="Hri.InputCollector">
<Parameter name="print_input" value="false"/></Behavior>
<Behavior id="sum" type="Evolution.Addition"/>
<Behavior id="one" type="Hri.Constant"><Parameter name="parsed_value" value="1"/></Behavior>
<Behavior id="two" type="Hri.Constant"><Parameter name="parsed_value" value="4/2"/></Behavior>
<Link from="one.value" to="sum.input"/>
<Link from="two.value" to="sum.input"/>
<Link from="sum.sum" to="show.input"/>"""


def test_behaviors_run_in_dependency_order_whatever_the_file_says(tmp_path):
    network = load(tmp_path, SUM)
    assert [behavior.id for behavior in network.behaviors] == ["one", "two", "sum", "show"]
    for behavior in network.behaviors:
        behavior.compute(0.0, 0.1)
    assert network["show"].collected == [3.0]


def test_the_interval_is_a_tenth_of_a_second_unless_told(tmp_path):
    assert load(tmp_path, SUM).interval == 0.1
    assert load(tmp_path, SUM, ' invocation_interval="1/30"').interval == pytest.approx(1 / 30)
    assert "an interval of 0 s" in failure(tmp_path, SUM, ' invocation_interval="0"')


@pytest.mark.parametrize(
    ("body", "message"),
    [
        (
            '<Behavior id="a" type="Hri.Constnt"/>',
            '2:18: unknown behavior type "Hri.Constnt" - did you mean "Hri.Constant"?',
        ),
        (
            '<Behavior id="a" type="Hri.Constant">'
            '<Parameter name="parsed_valu" value="1"/></Behavior>',
            '2:38: Hri.Constant has no parameter "parsed_valu" - did you mean "parsed_value"?',
        ),
        (
            '<Behavior id="a" type="Hri.Constant">'
            '<Parameter name="parsed_value" value="x"/></Behavior>',
            'parsed_value: "x" is no number - write a number',
        ),
        (SUM + '<Link from="one.out" to="sum.input"/>', 'Constant "one" has no output "out"'),
        (SUM + '<Link from="won.value" to="sum.input"/>', 'no behavior "won"'),
        (SUM + SUM, 'the id "show" is used twice'),
        ("<Behaviour/>", "<Behaviour> has no place"),
    ],
)
def test_mistakes_are_found_at_load_with_their_place(tmp_path, body, message):
    assert message in failure(tmp_path, body)


def test_ports_of_different_types_do_not_link(tmp_path):
    body = (
        '<Behavior id="one" type="Hri.Constant"/><Behavior id="s" type="Hri.DoubleArraySplitter"/>'
        '\n<Link from="one.value" to="s.array"/>'
    )
    assert failure(tmp_path, body).startswith(
        "3:1: one.value is double, but s.array takes doublearray"
    )


def test_a_circle_is_named_link_by_link(tmp_path):
    body = (
        '<Behavior id="a" type="Hri.Addition"/><Behavior id="b" type="Hri.Addition"/>'
        '<Behavior id="after" type="Hri.Addition"/>'
        '<Link from="a.sum" to="b.input"/><Link from="b.sum" to="a.input"/>'
        '<Link from="b.sum" to="after.input"/>'
    )
    message = failure(tmp_path, body)
    assert "a.sum -> b.input" in message
    assert "b.sum -> a.input" in message
    assert "after" not in message


def test_a_meaning_that_does_not_fit_is_a_warning(tmp_path):
    class Distance(Behavior):
        """Sends a distance."""

        out = Output[float]("double", "metres", "Test.Distance")

    class Speed(Behavior):
        """Takes a speed."""

        into = Input[float]("double", "metres a second", "Test.Speed")

    network = load(tmp_path, "")
    network.add(Distance("d"))
    network.add(Speed("s"))
    network.connect("d.out", "s.into")
    assert "means Test.Distance" in network.warnings[0]


def test_a_behavior_that_is_declared_wrong_fails_when_it_is_defined():
    with pytest.raises(TypeError, match="needs a docstring"):
        type("Bare", (Behavior,), {})
    with pytest.raises(TypeError, match='did you mean "double"'):
        Input("duoble", "a number")
    with pytest.raises(TypeError, match="rename it"):
        type("Clash", (Behavior,), {"__doc__": "x", "stop": Param(1.0, "x")})


def test_an_unknown_parameter_in_code_is_an_error_too():
    class Gain(Behavior):
        """Has a gain."""

        gain = Param(1.0, "gain", minimum=0, maximum=2)

    assert Gain().gain == 1.0
    assert Gain(gain=2.0).gain == 2.0
    with pytest.raises(HriError, match='did you mean "gain"'):
        Gain(gian=1.0)
