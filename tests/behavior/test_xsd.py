"""The XSDs say what the loaders say: editors and programs agree on what a file may hold."""

import contextlib
from pathlib import Path
from xml.etree import ElementTree

import pytest
import xmlschema
from hypothesis import given, strategies as st

from hri.behavior.catalog import find_behavior
from hri.behavior.network_file import load_network
from hri.behavior.ports import DATATYPES
from hri.behavior.schema import TYPES, load_schema, schema_of, write_schema
from hri.core import paths, registry
from hri.core.errors import HriError
from hri.core.xml import load_xml
from hri.hal.configuration import load_configuration
from tests.recorded import SHARED, needs_shared

XSD = paths.house() / "config" / "xsd"
FILES = {
    "BehaviorNetwork": "behavior-network.xsd",
    "BehaviorSchema": "behavior-schema.xsd",
    "Resources": "resource-config.xsd",
    "ResourceSpec": "resource-spec.xsd",
}
SCHEMAS = {tag: xmlschema.XMLSchema(XSD / file) for tag, file in FILES.items()}
SHIPPED = sorted(
    path
    for folder in ("apps", "config", "docs")
    for path in (paths.house() / folder).rglob("*.xml")
)


@pytest.mark.proves("E15")
@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.name)
def test_every_shipped_file_is_valid(path):
    SCHEMAS[load_xml(path).tag].validate(path)


@needs_shared("guide/resource-config.xml")
@pytest.mark.proves("H01")
def test_the_configuration_of_the_guide_is_valid():
    SCHEMAS["Resources"].validate(SHARED / "guide" / "resource-config.xml")


def test_every_exported_schema_is_valid():
    for type_name in registry.known("hri.behaviors"):
        SCHEMAS["BehaviorSchema"].validate(write_schema(schema_of(find_behavior(type_name))))


def test_the_words_of_the_xsd_are_those_of_the_code():
    def words(attribute):
        tree = ElementTree.parse(XSD / FILES["BehaviorSchema"])
        path = f".//{{*}}attribute[@name='{attribute}']//{{*}}enumeration"
        return [found.get("value") for found in tree.iterfind(path)]

    assert words("datatype") == list(DATATYPES)
    assert words("type") == list(TYPES)


TAGS = (
    "Behavior Link Parameter Port Inputs Outputs Device DeviceBus Group Member Shape"
    " Dimensions Devices Groups Other"
)
NAMES = st.sampled_from(TAGS.split())
ATTRIBUTES = st.dictionaries(
    st.sampled_from(
        ["id", "type", "name", "value", "from", "to", "member_id", "datatype", "default", "x"]
    ),
    st.sampled_from(["Hri.Constant", "a", "a.value", "double", "number", "1", ""]),
    max_size=4,
)


@st.composite
def elements(draw, depth=3):
    element = ElementTree.Element(draw(NAMES), draw(ATTRIBUTES))
    if depth:
        element.extend(draw(st.lists(elements(depth - 1), max_size=2)))
    return element


LOADERS = {
    "BehaviorNetwork": load_network,
    "BehaviorSchema": load_schema,
    "Resources": load_configuration,
}
ROOT_ATTRIBUTES = {"BehaviorSchema": {"type": "A.B", "driver": "Hri.Constant"}}


@given(st.sampled_from(sorted(LOADERS)), st.lists(elements(), max_size=3))
def test_what_the_xsd_refuses_the_loader_refuses(tmp_path_factory, tag, children):
    root = ElementTree.Element(tag, ROOT_ATTRIBUTES.get(tag, {}))
    root.extend(children)
    path = tmp_path_factory.mktemp("xsd") / "file.xml"
    path.write_bytes(ElementTree.tostring(root))
    if SCHEMAS[tag].is_valid(path):
        with contextlib.suppress(HriError):
            LOADERS[tag](path)
    else:
        with pytest.raises(HriError):
            LOADERS[tag](path)


def test_an_editor_may_be_told_where_the_xsd_is(tmp_path):
    path = tmp_path / "net.xml"
    where = Path(XSD / "behavior-network.xsd").as_uri()
    path.write_text(
        '<BehaviorNetwork xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
        f' xsi:noNamespaceSchemaLocation="{where}"/>'
    )
    assert load_network(path).behaviors == []
    SCHEMAS["BehaviorNetwork"].validate(path)
