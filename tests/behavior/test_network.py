import contextlib

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.network import Box, Network
from hri.behavior.network_file import load_network, read_network
from hri.behavior.ports import Input, Output, Param
from hri.core.errors import AuthoringError, AuthoringErrors, HriError


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


@pytest.mark.proves("B04", "B06")
def test_behaviors_run_in_dependency_order_whatever_the_file_says(tmp_path):
    network = load(tmp_path, SUM)
    assert [behavior.id for behavior in network.behaviors] == ["one", "two", "sum", "show"]
    for behavior in network.behaviors:
        behavior.compute(0.0, 0.1)
    assert network["show"].collected == [3.0]


@pytest.mark.proves("B05")
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
            '<Behavior id="a" type="Hri.Scale"><Parameter name="factor" value="x"/></Behavior>',
            'factor: "x" is not a number - write a number',
        ),
        (SUM + '<Link from="one.out" to="sum.input"/>', 'Hri.Constant "one" has no output "out"'),
        (
            SUM.replace("Hri.Constant", "Evolution.Constant")
            + '<Link from="one.out" to="sum.input"/>',
            'Evolution.Constant "one" has no output "out"',
        ),
        (
            '<Behavior id="a" type="Evolution.Constnt"/>',
            'unknown behavior type "Evolution.Constnt" - did you mean "Evolution.Constant"?',
        ),
        (SUM + '<Link from="won.value" to="sum.input"/>', 'no behavior "won"'),
        (SUM + SUM, 'the id "show" is used twice'),
        ("<Behaviour/>", "<Behaviour> has no place"),
    ],
)
def test_mistakes_are_found_at_load_with_their_place(tmp_path, body, message):
    assert message in failure(tmp_path, body)


@pytest.mark.proves("B02")
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


@pytest.mark.proves("B03")
def test_a_meaning_that_does_not_fit_is_a_warning(tmp_path):
    class Distance(Behavior):
        """Sends a distance."""

        out = Output[float]("double", "meters", "Test.Distance")

    class Speed(Behavior):
        """Takes a speed."""

        into = Input[float]("double", "meters a second", "Test.Speed")

    network = load(tmp_path, "")
    network.add(Distance("d"))
    network.add(Speed("s"))
    network.connect("d.out", "s.into")
    assert "means Test.Distance" in str(network.warnings[0])


def test_a_behavior_that_is_declared_wrong_fails_when_it_is_defined():
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


class Sensor(Behavior):
    """Senses something."""

    is_sensor = True
    input = Input[float]("double", "anything")
    reading = Output[float]("double", "a number")


class Plain(Behavior):
    """Is no sensor."""

    input = Input[float]("double", "anything")
    output = Output[float]("double", "a number")


def sorted_ids(*behaviors, links=()):
    network = Network("net")
    for behavior in behaviors:
        network.add(behavior)
    for source, target in links:
        network.connect(source, target)
    network.sort()
    return [behavior.id for behavior in network.behaviors]


@pytest.mark.proves("B06")
def test_sensors_run_first_in_each_cycle():
    ids = sorted_ids(Plain("a"), Sensor("s"), Plain("b"), Sensor("t"))
    assert ids == ["s", "t", "a", "b"]


@pytest.mark.proves("B06")
def test_what_a_sensor_depends_on_runs_before_it_all_the_same():
    ids = sorted_ids(Plain("a"), Plain("b"), Sensor("s"), links=[("b.output", "s.input")])
    assert ids.index("b") < ids.index("s")


@given(st.data())
def test_the_order_always_follows_the_links(data):
    count = data.draw(st.integers(1, 12))
    cls = st.sampled_from([Sensor, Plain])
    behaviors = [data.draw(cls)(f"b{number}") for number in range(count)]
    network = Network("net")
    for behavior in data.draw(st.permutations(behaviors)):
        network.add(behavior)
    for target in range(1, count):
        for source in data.draw(st.lists(st.integers(0, target - 1), max_size=3, unique=True)):
            output = next(iter(behaviors[source].outputs))
            network.connect(f"b{source}.{output}", f"b{target}.input")
    network.sort()
    order = [behavior.id for behavior in network.behaviors]
    for link in network.links:
        assert order.index(link.source.id) < order.index(link.target.id)
    free = [b.id for b in behaviors if not b.input.sources]
    free_sensors = {b.id for b in behaviors if b.is_sensor and b.id in free}
    assert set(order[: len(free_sensors)]) <= {b.id for b in behaviors if b.is_sensor}


def test_ids_that_no_link_could_name_are_refused(tmp_path):
    for id in ("", "a.b"):
        message = failure(tmp_path, f'<Behavior id="{id}" type="Hri.Addition"/>')
        assert "cannot be linked to" in message


def test_loose_ends_are_told():
    network = Network("net")
    network.add(Plain("lonely"))
    assert [end.what for end in network.loose_ends()] == ["nothing reaches lonely (input)"]


@given(st.text(max_size=300))
def test_any_text_is_a_network_or_one_clear_error(tmp_path_factory, body):
    path = tmp_path_factory.mktemp("fuzz") / "net.xml"
    path.write_text(f"<BehaviorNetwork>{body}</BehaviorNetwork>", "utf-8")
    with contextlib.suppress(HriError):
        load_network(path)


TYPES = st.sampled_from(["Hri.Constant", "Evolution.Scale", "Hri.Nothing", "../x", "A.B"])
WORDS = st.sampled_from(["a", "b", "a.value", "b.input", "parsed_value", "factor", "1/0", "9**9"])
TAGS = st.sampled_from(["Behavior", "Link", "Parameter"])


@given(st.lists(st.tuples(TAGS, TYPES, WORDS, WORDS), max_size=6), WORDS)
def test_any_wiring_is_a_network_or_one_clear_error(tmp_path_factory, parts, interval):
    lines = [
        f'<{tag} id="{first}" type="{kind}"><Parameter name="{first}" value="{second}"/></{tag}>'
        if tag == "Behavior"
        else f'<{tag} from="{first}" to="{second}"/>'
        for tag, kind, first, second in parts
    ]
    path = tmp_path_factory.mktemp("fuzz") / "net.xml"
    body = "".join(lines)
    path.write_text(
        f'<BehaviorNetwork invocation_interval="{interval}">{body}</BehaviorNetwork>', "utf-8"
    )
    with contextlib.suppress(HriError):
        load_network(path)


def test_a_parameter_is_set_once(tmp_path):
    twice = "".join(f'\n<Parameter name="parsed_value" value="{n}"/>' for n in (1, 2))
    message = failure(tmp_path, f'<Behavior id="a" type="Hri.Constant">{twice}</Behavior>')
    assert message.startswith('4:12: "parsed_value" is set twice')


def test_a_link_is_made_once(tmp_path):
    again = '\n<Link from="two.value" to="sum.input"/>'
    message = failure(tmp_path, SUM + again)
    assert "10:1: the link two.value -> sum.input is there twice" in message


@pytest.mark.parametrize("type_name", ["Hri.Share", "Hri.Shared"])
def test_who_shares_needs_a_slot(tmp_path, type_name):
    with pytest.raises(HriError, match="it has no slot on the board - set its parameter slot"):
        load(tmp_path, f'<Behavior id="it" type="{type_name}"/>').check()


def test_no_class_hides_the_id_of_a_behavior():
    with pytest.raises(TypeError, match="hides what Behavior uses"):

        class Named(Behavior):
            """Would lose its name."""

            id = Output[float]("double", "a number")


def test_all_mistakes_are_found_at_once_each_with_its_place(tmp_path):
    body = """\
<Behavior id="one" type="Hri.Constent"/>
<Behavior id="two" type="Evolution.Scale"><Parameter name="facto" value="1"/>
<Parameter name="factor" value="x"/></Behavior>
<Link from="one.value" to="two.input"/>
<Link from="two.result" to="three.input"/>"""
    with pytest.raises(AuthoringErrors) as caught:
        load(tmp_path, body)
    found = {error.place.line: error.what for error in caught.value.errors}
    assert list(found) == [2, 3, 4, 6], "the link of the first is not wrong for its type"
    assert "Constent" in found[2]
    assert 'no parameter "facto"' in found[3]
    assert 'no output "result"' in found[6]


def test_a_text_is_read_as_the_file_that_it_is_for(tmp_path):
    path = tmp_path / "my_sum.xml"
    network = read_network(f"<BehaviorNetwork>{SUM}</BehaviorNetwork>", path)
    assert (network.name, network.path) == ("my_sum", path)
    with pytest.raises(AuthoringError, match=r"my_sum\.xml:1:18: "):
        read_network("<BehaviorNetwork><Nothing/></BehaviorNetwork>", path)


def test_an_editor_gives_parts_their_places(tmp_path):
    layout = '<Layout><Box id="sum" x="-20" y="140"/>\n<Box id="gone" x="1" y="2"/></Layout>'
    network = load(tmp_path, SUM + layout)
    assert network.boxes == {"sum": Box(-20, 140), "gone": Box(1, 2)}
    (remark,) = network.warnings
    assert '"gone", which is not there' in str(remark)
    assert remark.place.line == 10
    message = failure(tmp_path, SUM + '<Layout><Box id="sum" x="1.5" y="2"/></Layout>')
    assert 'x "1.5" - write whole pixels' in message
    message = failure(tmp_path, SUM + layout + layout)
    assert "a second <Layout>" in message
