import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError, HriError
from hri.core.toml import load_toml, locate_keys

TEXT = """\
name = "optimist"

[baseline]
pleasure = 0.35
"quoted key" = 1

[[step]]
at = 1
[[step]]
at = 2
say = { text = "hi", loud = true }
"""


@pytest.fixture
def table(tmp_path):
    path = tmp_path / "file.toml"
    path.write_text(TEXT)
    return load_toml(path)


def test_values_and_their_places(table):
    assert table.string("name") == "optimist"
    baseline = table.table("baseline")
    assert baseline.number("pleasure") == 0.35
    assert (baseline.place("pleasure").line, baseline.place("pleasure").column) == (4, 1)
    steps = table.array("step")
    assert [step.number("at") for step in steps] == [1, 2]
    assert steps[1].place("at").line == 10
    say = steps[1].table("say")
    assert (say.place("loud").line, say.place("loud").column) == (11, 22)


def message(error):
    return str(error.value).split("file.toml:")[1]


def test_an_unknown_key_is_named_with_what_was_meant(table):
    table.string("nam", "")
    table.table("baseline")
    table.array("step")
    with pytest.raises(AuthoringError) as error:
        table.finish()
    assert message(error) == '1:1: unknown key "name" - did you mean "nam"?'


def test_wrong_kind_range_and_missing(table):
    with pytest.raises(AuthoringError) as error:
        table.number("name")
    assert message(error) == "1:1: name is a text - write a number"
    with pytest.raises(AuthoringError) as error:
        table.table("baseline").number("pleasure", minimum=0.5, maximum=1)
    assert message(error) == "4:1: pleasure is 0.35 - write a number from 0.5 to 1"
    with pytest.raises(AuthoringError) as error:
        table.table("baseline").number("plesure")
    assert message(error) == '3:1: "plesure" is missing in [baseline] - rename "pleasure"'


def test_numbers_beyond_reason_and_strange_arrays_have_a_place(tmp_path):
    path = tmp_path / "file.toml"
    path.write_text(f"big = {'9' * 400}\nlist = [1, inf]\n\n[[stepp]]\nat = 1\n")
    table = load_toml(path)
    with pytest.raises(AuthoringError, match=r":1:1: big is 999"):
        table.number("big")
    with pytest.raises(AuthoringError, match=r":2:1: list holds something that is not a number"):
        table.numbers("list")
    table.array("step")
    with pytest.raises(AuthoringError, match=r':4:1: unknown key "stepp" - did you mean "step"\?'):
        table.finish()


def test_syntax_errors_have_a_place(tmp_path):
    path = tmp_path / "file.toml"
    path.write_text("good = 1\nbad = .05\n")
    with pytest.raises(AuthoringError) as error:
        load_toml(path)
    assert (error.value.place.line, error.value.place.column) == (2, 7)


def test_unreadable_and_not_utf8(tmp_path):
    with pytest.raises(HriError, match="cannot read"):
        load_toml(tmp_path / "none.toml")
    path = tmp_path / "file.toml"
    path.write_bytes(b'a = 1\nb = "\xff"\n')
    with pytest.raises(AuthoringError) as error:
        load_toml(path)
    assert (error.value.place.line, error.value.place.column) == (2, 6)


@given(st.text(max_size=200))
def test_locating_keys_never_fails(text):
    for place in locate_keys(text).values():
        assert place.line >= 1
        assert place.column >= 1
