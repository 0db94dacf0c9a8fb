from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.behavior.behavior import Behavior
from hri.behavior.catalog import find_behavior
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.network_writer import save_network, write_network
from hri.core import paths
from hri.core.errors import HriError

SHIPPED = sorted(
    path
    for folder in ("apps", "config", "docs")
    for path in (paths.house() / folder).rglob("*.xml")
    if "<BehaviorNetwork" in path.read_text(encoding="utf-8", errors="replace")
)

CANONICAL = """\
<?xml version="1.0" encoding="UTF-8"?>
<?xml-model href="behavior-network.xsd"?>
<!-- Adds things,
     and shows them. -->
<BehaviorNetwork name="sums" invocation_interval="1/30">
  <!-- One. -->
  <Behavior id="one" type="Hri.Constant">
    <!-- A half turn. -->
    <Parameter name="parsed_value" value="pi"/>
  </Behavior>
  <Behavior id="scale" type="Evolution.Scale">
    <Parameter name="factor" value="1/3"/>
  </Behavior>

  <!-- The wires. -->
  <Link from="one.value" to="scale.input"/>
  <Layout>
    <!-- On the left. -->
    <Box id="one" x="40" y="-8"/>
  </Layout>
  <!-- The end. -->
</BehaviorNetwork>
"""


def load(tmp_path, text):
    path = tmp_path / "net.xml"
    path.write_text(text, encoding="utf-8")
    return load_network(path)


@pytest.mark.proves("B04")
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_every_shipped_network_is_canonical(path, monkeypatch):
    monkeypatch.setenv("HRI_PATH", str(path.parent))  # a tutorial brings its own behaviors
    assert write_network(load_network(path)) == path.read_text(encoding="utf-8")


@pytest.mark.proves("B04")
def test_comments_blank_lines_and_spellings_of_numbers_stay(tmp_path):
    assert write_network(load(tmp_path, CANONICAL)) == CANONICAL


def test_a_disorderly_file_becomes_canonical_and_means_the_same(tmp_path):
    text = """<BehaviorNetwork invocation_interval='1/30' name="sums"
    ><!-- The wires. --><Link to="scale.input" from="one.value"/>



    <Behavior type="Evolution.Scale" id="scale"><Parameter value="1/3" name="factor"></Parameter>
    </Behavior><Behavior type='Hri.Constant' id='one'/></BehaviorNetwork><!-- late -->"""
    before = load(tmp_path, text)
    after = load(tmp_path, write_network(before))
    assert [b.id for b in after.behaviors] == [b.id for b in before.behaviors] == ["one", "scale"]
    assert list(map(str, after.links)) == ["one.value -> scale.input"]
    assert after["scale"].factor == before["scale"].factor
    assert "late" in write_network(after)
    assert write_network(after) == write_network(before)


@pytest.mark.parametrize(
    "change",
    [
        lambda network: network["scale"].set_parameter("factor", 0.25),
        lambda network: setattr(network, "interval", 0.5),
        lambda network: setattr(network, "name", "other"),
    ],
)
def test_one_changed_attribute_is_one_changed_line(tmp_path, change):
    network = load(tmp_path, CANONICAL)
    change(network)
    before, after = CANONICAL.splitlines(), write_network(network).splitlines()
    assert len(before) == len(after)
    assert sum(a != b for a, b in zip(before, after, strict=True)) == 1


def test_what_a_program_adds_and_takes_away_is_written(tmp_path):
    network = load(tmp_path, CANONICAL)
    scale = find_behavior("Hri.Scale")
    network.add(scale("more", factor=2.5))
    network.connect("scale.scaled", "more.input")
    text = write_network(network)
    assert (
        '<Behavior id="more" type="Hri.Scale">\n    <Parameter name="factor" value="2.5"/>' in text
    )
    assert text.index("one.value") < text.index('from="scale.scaled" to="more.input"')
    network.behaviors.remove(network["one"])
    network.links = [link for link in network.links if link.source.id != "one"]
    again = load(tmp_path, write_network(network))
    assert [behavior.id for behavior in again.behaviors] == ["scale", "more"]


def test_a_behavior_without_a_name_cannot_be_written():
    class Private(Behavior):
        """Known to nobody."""

    network = Network("net")
    network.add(Private("p"))
    with pytest.raises(HriError, match="Private has no name"):
        write_network(network)


LETTERS = st.characters(codec="utf-8", exclude_characters=".", exclude_categories=("Cc", "Cs"))
IDS = st.text(LETTERS, min_size=1, max_size=6)
TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cs",), min_codepoint=32))


@st.composite
def networks(draw):
    """Relays in any number, wired forward in any way, with any numbers and texts."""
    network = Network(draw(IDS), draw(st.sampled_from([0.1, 1 / 3, 0.02, 1.0])))
    scale, printer = find_behavior("Hri.Scale"), find_behavior("Hri.PrintBehavior")
    ids = draw(st.lists(IDS, max_size=8, unique=True))
    for id in ids:
        network.add(scale(id, factor=draw(st.floats(-1e9, 1e9)), offset=draw(st.floats(-1, 1))))
    for target in range(1, len(ids)):
        for source in draw(st.lists(st.integers(0, target - 1), max_size=2, unique=True)):
            network.connect(f"{ids[source]}.scaled", f"{ids[target]}.input")
    if "printer" not in ids:
        network.add(printer("printer", text=draw(TEXTS)))
    return network


@pytest.mark.proves("B04")
@given(networks())
def test_any_network_is_the_same_after_it_was_saved_and_loaded(tmp_path_factory, network):
    path = tmp_path_factory.mktemp("nets") / "net.xml"
    save_network(network, path)
    again = load_network(path)
    assert (again.name, again.interval) == (network.name, network.interval)
    assert {b.id: vars_of(b) for b in again.behaviors} == {
        b.id: vars_of(b) for b in network.behaviors
    }
    assert list(map(str, again.links)) == list(map(str, network.links))
    text = path.read_text(encoding="utf-8")
    save_network(again, path)
    assert path.read_text(encoding="utf-8") == text


def vars_of(behavior):
    return {name: getattr(behavior, name) for name in behavior.parameters}


def test_the_shipped_networks_were_found():
    assert Path("apps/companion/face.xml") in {path.relative_to(paths.house()) for path in SHIPPED}
