from __future__ import annotations

from contextlib import suppress

import pytest
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError, Place
from hri.speech.grammar.lint.expectations import (
    Meaning,
    failures,
    meaning_of,
    read_expectations,
    read_meaning,
)
from hri.speech.grammar.matching import Parse, parse

PLACE = Place("here")


@pytest.fixture
def expect(tmp_path, companion):
    """Failures of some lines, without their file."""

    def expect(lines: str) -> list[str]:
        path = tmp_path / "test.txt"
        path.write_text(lines)
        found = failures(companion, read_expectations(path))
        return [str(failure).removeprefix(f"{path}:") for failure in found]

    return expect


def test_what_is_as_expected_is_not_told(expect):
    lines = """# comments
        // of both kinds

        + go back one meter => distance=-1
        + go back one meter => move: distance=-1   # behind a line, too
        + Hello, robot!
        + hello robot =>
        + stop => stop:
        - fly to the moon
    """
    assert expect(lines) == []


@pytest.mark.parametrize(
    ("line", "came", "expected"),
    [
        ("+ fly to the moon", "is not understood", "any rule"),
        ("+ turn left and fly", 'is not understood beyond "turn left"', "any rule"),
        ("- hello robot", "is understood as greet: {}", "not to be understood"),
        ("+ turn left => angle=91", "is understood as turn: angle=90", "any rule: angle=91"),
        ("+ turn left => move:", "is understood as turn: angle=90", "move:"),
        ("+ turn left =>", "is understood as turn: angle=90", "any rule: {}"),
        ("+ turn left => angle=90 x=1", "is understood as turn", "any rule: angle=90 x=1"),
        (
            "+ turn left => turn",
            '(a rule is written with a colon, "=> turn:")',
            "any rule: turn=true",
        ),
    ],
)
def test_each_failure_says_what_was_expected_and_what_came(expect, line, came, expected):
    (failure,) = expect("\n" + line)
    assert failure.startswith("2:1: ")
    assert came in failure
    assert failure.endswith(f"expected {expected}")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("hello robot", "1:1: a line of another kind - begin it with"),
        ("+", "1:1: no sentence"),
        ("+ => x=1", "1:1: no sentence"),
        ("  - hello => x=1", '1:3: what is not understood means nothing - leave "=>" out'),
        ("+ hello => x==", "1:1: cannot read the tag"),
        ("+ hello => x+=1", "1:1: only values can be expected"),
        ("+ hello => x=$y", "1:1: only values can be expected"),
        ("grammar", "1:1: no name of a grammar"),
        ("", "1:1: no sentence in this file - write one"),
        ("grammar companion\n# nothing", "1:1: no sentence in this file"),
        ("#JSGF V1.0;\ngrammar a;\npublic <a> = go on;", "1:1: this is a grammar - name a file"),
        ("+ hello\ngrammar late", "2:1: a line of another kind"),
    ],
)
def test_a_line_that_cannot_be_read_has_its_place(tmp_path, line, message):
    path = tmp_path / "test.txt"
    path.write_text(line)
    with pytest.raises(AuthoringError) as error:
        read_expectations(path)
    assert str(error.value).removeprefix(f"{path}:").startswith(message)


def test_the_first_line_may_name_the_grammar(tmp_path):
    path = tmp_path / "test.txt"
    path.write_text("# for the house\ngrammar companion;\n+ hello robot\n")
    assert read_expectations(path).grammar == "companion"


@given(
    st.dictionaries(
        st.from_regex(r"[a-z]{1,5}", fullmatch=True),
        st.booleans()
        | st.floats(-1e6, 1e6).map(lambda value: round(value, 3) + 0.0)
        | st.text("abc d=;\u00e9#$", min_size=1, max_size=8),
        max_size=3,
    ),
    st.sampled_from([None, "move"]),
)
def test_a_meaning_that_is_written_is_read_again(tags, rule):
    meaning = Meaning(rule, tags)
    assert read_meaning(str(meaning).removeprefix("any rule: "), PLACE) == meaning


@given(st.text(max_size=40))
def test_any_text_is_a_meaning_or_a_mistake(text):
    with suppress(AuthoringError):
        assert read_meaning(text, PLACE) == read_meaning(text, PLACE)


def test_a_million_spaces_are_read_at_once(expect):
    assert expect(f"+ stop {' ' * 1_000_000} now => stop:") == []


def test_one_is_not_the_same_as_true():
    found = Parse("x", "a", {"x": True})
    assert Meaning("a", {"x": True}).fits(found)
    assert not Meaning("a", {"x": 1.0}).fits(found)


def test_what_was_understood_fits_itself(companion):
    found = parse(companion, "go back ten centimeters")
    assert found is not None
    assert meaning_of(found).fits(found)
