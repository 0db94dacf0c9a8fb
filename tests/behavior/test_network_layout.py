import xml.etree.ElementTree as ElementTree

from hypothesis import given, strategies as st

from hri.behavior.library.arithmetic import Addition
from hri.behavior.network import Network
from hri.behavior.network_file import load_network
from hri.behavior.network_layout import lay_out
from hri.behavior.network_svg import to_svg
from hri.core import paths

SVG = "{http://www.w3.org/2000/svg}"


@st.composite
def networks(draw):
    network = Network("net")
    count = draw(st.integers(0, 12))
    for number in range(count):
        network.add(Addition(f"b{number}"))
    for target in range(1, count):
        for source in draw(st.lists(st.integers(0, target - 1), max_size=3, unique=True)):
            network.connect(f"b{source}.sum", f"b{target}.input")
    return network


@given(networks())
def test_boxes_never_overlap_and_links_run_to_the_right(network):
    layout = lay_out(network, lambda behavior: type(behavior).__name__)
    boxes = layout.boxes
    for box in boxes:
        assert box.x >= 0
        assert box.y >= 0
        assert box.x + box.width <= layout.width
        assert box.y + box.height <= layout.height
    for first in boxes:
        for second in boxes:
            if first is not second:
                assert (
                    first.x + first.width <= second.x
                    or second.x + second.width <= first.x
                    or first.y + first.height <= second.y
                    or second.y + second.height <= first.y
                )
    for wire in layout.wires:
        xs = [x for x, _ in wire.points]
        assert xs == sorted(xs)


@given(networks())
def test_a_wire_crosses_no_box_where_it_passes_a_layer(network):
    layout = lay_out(network, lambda behavior: type(behavior).__name__)
    for wire in layout.wires:
        for bend in wire.bends:
            for box in layout.boxes:
                if box.layer == bend.layer:
                    assert not box.y < bend.middle < box.y + box.height


def test_the_drawing_names_every_behavior_and_each_link():
    network = load_network(paths.house() / "apps/companion/face.xml")
    root = ElementTree.fromstring(
        to_svg(lay_out(network, lambda behavior: type(behavior).__name__))
    )
    texts = [text.text for text in root.iter(f"{SVG}text")]
    assert {behavior.id for behavior in network.behaviors} <= set(texts)
    titles = [title.text for title in root.iter(f"{SVG}title")]
    assert titles == [str(link) for link in network.links]


def test_names_of_authors_cannot_break_the_drawing():
    network = Network("net")
    network.add(Addition("<script>&"))
    root = ElementTree.fromstring(
        to_svg(lay_out(network, lambda behavior: type(behavior).__name__))
    )
    assert "<script>&" in [text.text for text in root.iter(f"{SVG}text")]
