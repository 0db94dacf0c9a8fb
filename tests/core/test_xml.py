import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.xml import load_xml


def load(tmp_path, text):
    path = tmp_path / "file.xml"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return load_xml(path)


def failure(tmp_path, text):
    with pytest.raises(AuthoringError) as error:
        load(tmp_path, text)
    return str(error.value).split("file.xml:")[1]


def test_elements_and_attributes_know_their_places(tmp_path):
    root = load(tmp_path, '<a>\n  <b id="1"\n     type="x"/>\n</a>')
    b = root.children[0]
    assert (b.place.line, b.place.column) == (2, 3)
    assert (b.places["type"].line, b.places["type"].column) == (3, 6)
    assert b.get("type") == "x"


def test_an_unclosed_tag_names_the_tag(tmp_path):
    assert failure(tmp_path, "<a>\n<b>\n</a>") == "3:3: mismatched tag - close <b> of line 2"


def test_a_doctype_is_refused_before_any_entity_counts(tmp_path):
    bomb = '<!DOCTYPE a [<!ENTITY x "xx"><!ENTITY y "&x;&x;">]><a>&y;</a>'
    assert failure(tmp_path, bomb).startswith("1:1: a DOCTYPE is not allowed")


def test_unknown_children_and_attributes_are_named(tmp_path):
    root = load(tmp_path, '<a idd="1"><bb/></a>')
    with pytest.raises(AuthoringError, match=r'no attribute "idd" - did you mean "id"\?'):
        root.check(("bb",), ("id",))
    with pytest.raises(AuthoringError, match=r'<bb> has no place in <a> - did you mean "b"\?'):
        root.check(("b",), ("idd",))


def test_latin_1_files_read_and_depth_is_bounded(tmp_path):
    text = '<?xml version="1.0" encoding="ISO-8859-1"?><a b="\xe9"/>'
    assert load(tmp_path, text.encode("latin-1")).get("b") == "\xe9"
    assert "too deep" in failure(tmp_path, "<a>" * 100 + "</a>" * 100)


@given(st.binary(max_size=300))
def test_any_bytes_read_or_give_one_clear_error(tmp_path_factory, data):
    path = tmp_path_factory.mktemp("xml") / "file.xml"
    path.write_bytes(data)
    with contextlib.suppress(HriError):
        assert load_xml(path).tag
