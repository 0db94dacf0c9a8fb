import contextlib
import gc
import time
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.xml import Element, format_xml, load_xml


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


def test_attributes_on_other_lines_and_behind_brackets_are_found(tmp_path):
    root = load(tmp_path, '<a one="x > y"\n   two=\'3\' three = "4"/>')
    places = {name: (place.line, place.column) for name, place in root.places.items()}
    assert places == {"one": (1, 4), "two": (2, 4), "three": (2, 12)}


@pytest.mark.parametrize(
    "text",
    [
        "<a " + " ".join(f'name{n}="{n}"' for n in range(20_000)) + "/>",
        "<a>" + "".join(f'<b x="{n}" y="{n}"/>' for n in range(40_000)) + "</a>",
        "<a>" + "\n" * 2_000_000 + "</a>",
        "<a>" + "x &amp;" * 300_000 + "</a>",
        "<a>" + "<!-- c -->" * 200_000 + "</a>",
    ],
    ids=["attributes", "elements", "lines", "text", "comments"],
)
def test_large_files_take_time_in_proportion(tmp_path, text):
    gc.freeze()  # What other tests keep is not looked through for garbage meanwhile.
    try:
        begun = time.process_time()
        load(tmp_path, text)
        assert time.process_time() - begun < 5
    finally:
        gc.unfreeze()


def test_what_is_no_file_of_ours_is_not_read_for_ever(tmp_path):
    for path in (Path("/dev/zero"), tmp_path):
        with pytest.raises(HriError, match="not a regular file"):
            load_xml(path)
    large = tmp_path / "large.xml"
    large.write_bytes(b"<a>" + b" " * 5_000_000 + b"</a>")
    with pytest.raises(HriError, match="too large"):
        load_xml(large)
    with pytest.raises(HriError, match="check the path"):
        load_xml(Path("a\0b"))


def test_text_where_none_belongs_is_refused(tmp_path):
    with pytest.raises(AuthoringError, match='the text "hello" has no place'):
        load(tmp_path, "<a>hello</a>").check()


TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=("Cs", "Cc")), max_size=30)


@given(st.dictionaries(st.sampled_from(["a", "b", "c"]), TEXTS), TEXTS)
def test_what_is_written_is_read_again(tmp_path_factory, attributes, text):
    root = Element("root", {**attributes, "text": text + '\n\t"'})
    path = tmp_path_factory.mktemp("xml") / "file.xml"
    path.write_text(format_xml(root), encoding="utf-8")
    again = load_xml(path)
    assert again.attributes == root.attributes
    assert format_xml(again) == format_xml(root)
