"""Two networks are compared by what they do; each part of the picture has the shade of its fate."""

from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.behavior.network_difference import compare, drawn_together
from hri.behavior.network_file import read_network
from hri.behavior.network_svg import SHADES, to_svg
from hri.cli.main import main
from hri.core import paths

OLD = """<BehaviorNetwork>
  <Behavior id="one" type="Hri.Constant"><Parameter name="parsed_value" value="1"/></Behavior>
  <Behavior id="half" type="Hri.Scale"><Parameter name="factor" value="0.5"/></Behavior>
  <Behavior id="end" type="Hri.InputCollector"/>
  <Link from="one.value" to="half.input"/>
  <Link from="half.scaled" to="end.input"/>
  <Link from="half.scaled" to="board.half"/>
</BehaviorNetwork>"""
NEW = """<BehaviorNetwork invocation_interval="0.05">
  <Behavior id="one" type="Hri.Constant"><Parameter name="parsed_value" value="2"/></Behavior>
  <Behavior id="half" type="Hri.Absolute"/>
  <Behavior id="more" type="Hri.Scale"/>
  <Link from="one.value" to="more.input"/>
</BehaviorNetwork>"""
TYPES = {"one": "Hri.Constant", "half": "Hri.Scale", "more": "Hri.Scale", "sum": "Hri.Addition"}
WIRES = [("one.value", "half.input"), ("half.scaled", "more.input"), ("more.scaled", "sum.input")]


def read(text):
    return read_network(text, Path("net.xml"))


def test_what_was_added_removed_and_changed_is_named():
    found = compare(read(OLD), read(NEW))
    assert found.attributes == ("interval 0.1 -> 0.05",)
    assert (found.added, found.removed) == (("more",), ("end",))
    assert found.changed == {
        "one": ("parsed_value 1 -> 2",),
        "half": ("type Hri.Scale -> Hri.Absolute", "factor 0.5 -> none"),
    }
    assert found.added_links == ("one.value -> more.input",)
    assert len(found.removed_links) == 3


def test_order_layout_and_comments_are_not_what_a_network_does():
    lines = OLD.splitlines()
    other = "\n".join([lines[0], "<!-- x -->", *reversed(lines[1:4]), *lines[4:7]])
    other += '<Layout><Box id="one" x="1" y="2"/></Layout></BehaviorNetwork>'
    assert compare(read(OLD), read(other)).is_empty


@st.composite
def networks(draw):
    ids = draw(st.lists(st.sampled_from(sorted(TYPES)), unique=True))
    values = {id: draw(st.integers(0, 2)) for id in ids}
    behaviors = [
        f'<Behavior id="{id}" type="{TYPES[id]}">'
        + (f'<Parameter name="parsed_value" value="{values[id]}"/>' if id == "one" else "")
        + "</Behavior>"
        for id in ids
    ]
    links = [
        f'<Link from="{source}" to="{target}"/>'
        for source, target in WIRES
        if {source.split(".")[0], target.split(".")[0]} <= set(ids) and draw(st.booleans())
    ]
    return read(f"<BehaviorNetwork>{''.join(behaviors + links)}</BehaviorNetwork>")


@given(networks(), networks())
def test_a_comparison_is_empty_with_itself_and_the_other_way_around_the_opposite(old, new):
    assert compare(old, old).is_empty
    there, back = compare(old, new), compare(new, old)
    assert (set(there.added), set(there.removed)) == (set(back.removed), set(back.added))
    assert there.changed.keys() == back.changed.keys()
    assert set(there.added_links) == set(back.removed_links)
    assert there.is_empty == (len(there.lines()) == 0)


@given(networks(), networks())
def test_the_picture_has_each_part_once_in_its_shade(old, new):
    difference = compare(old, new)
    layout = drawn_together(old, new, difference)
    shades = {box.behavior.id: box.shade for box in layout.boxes}
    assert shades.keys() == {one.id for one in (*old.behaviors, *new.behaviors)}
    assert {id for id, shade in shades.items() if shade == "added"} == set(difference.added)
    assert {id for id, shade in shades.items() if shade == "removed"} == set(difference.removed)
    wires = [str(wire.link) for wire in layout.wires if wire.shade == "removed"]
    assert sorted(wires) == sorted(difference.removed_links)
    assert to_svg(layout).count("<rect") == 1 + len(layout.boxes)


def test_links_that_together_run_in_a_circle_or_name_a_lost_port_are_drawn():
    assert drawn_together(read(OLD), read(NEW), compare(read(OLD), read(NEW))).wires
    there = '<Behavior id="{}" type="Hri.Scale"/>'
    both = there.format("a") + there.format("b")
    to = f'<BehaviorNetwork>{both}<Link from="a.scaled" to="b.input"/></BehaviorNetwork>'
    fro = f'<BehaviorNetwork>{both}<Link from="b.scaled" to="a.input"/></BehaviorNetwork>'
    layout = drawn_together(read(to), read(fro), compare(read(to), read(fro)))
    assert sorted(wire.shade for wire in layout.wires) == ["added", "removed"]


@pytest.mark.parametrize("name", ["out.svg", "out.png"])
def test_the_command_prints_and_draws_the_difference(tmp_path, capsys, name):
    old, new, out = tmp_path / "old.xml", tmp_path / "new.xml", tmp_path / name
    old.write_text(OLD)
    new.write_text(NEW)
    assert main(["network", "diff", str(old), str(new), "--out", str(out)]) == 1
    printed = capsys.readouterr().out
    assert "- end\n+ more\n~ one: parsed_value 1 -> 2\n" in printed
    assert out.stat().st_size > 1000
    if out.suffix == ".svg":
        assert all(SHADES[shade][1] in out.read_text() for shade in ("added", "removed", "changed"))
    assert main(["network", "diff", str(old), str(old)]) == 0
    assert capsys.readouterr().out.endswith(": the same\n")
    assert main(["network", "diff", str(old), str(tmp_path / "none.xml")]) == 2


def test_two_apps_are_compared_network_by_network(capsys):
    assert main(["network", "diff", "companion", "companion"]) == 0
    networks = (paths.house() / "apps" / "companion").glob("*.xml")
    assert len(capsys.readouterr().out.splitlines()) == len(list(networks))
