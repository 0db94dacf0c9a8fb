from __future__ import annotations

import time

import pytest

from hri.speech.grammar import load_grammar, read_grammar
from hri.speech.grammar.check import check

DICTIONARY = {
    "go": ("G", "OW"),
    "forward": ("F", "AO", "R", "W", "ER", "D"),
    "no": ("N", "OW"),
    "foot": ("F", "UH", "T"),
    "ball": ("B", "AO", "L"),
}


@pytest.mark.parametrize(
    ("rules", "place", "what", "remedy"),
    [
        ("public <a> = go forward;\n<b> = no;", "4:1", "<b> is not used", "use it"),
        ("public <a> = go forward | go forward;", "3:27", "stands twice", "take the second"),
        ("public <a> = go forward | /0/ forward;", "3:31", "weight 0", "raise"),
        ("public <a> = [go forward];", "3:1", "allows silence", "at least one word"),
        ("public <a> = go forwrd;", "3:17", '"forwrd" is not in', 'did you mean "forward"?'),
        ("public <a> = go football;", "3:17", '"football" is not', 'write "foot ball"?'),
        ("public <a> = go forward 10;", "3:25", '"10" is not', 'write numbers as words, "ten"'),
        ("public <a> = go forward | no;", "3:27", '"no" is very short', "longer"),
    ],
)
def test_warnings_have_their_place(write, rules, place, what, remedy):
    (finding,) = check(load_grammar(write(rules)), DICTIONARY)

    assert finding.severity == "warning"
    assert f"{finding.place.line}:{finding.place.column}" == place
    assert what in finding.what
    assert remedy in finding.remedy


def test_errors_hide_warnings(write):
    grammar, _ = read_grammar(write("public <a> = <b>;\n<c> = go;"))

    (finding,) = check(grammar, DICTIONARY)

    assert finding.severity == "error"
    assert "no rule <b>" in finding.what


def test_a_thousand_rules_are_checked_at_once(write):
    rules = "".join(f"<r{n}> = go <r{n + 1}> | no [<r{n + 1}>];\n" for n in range(1000))
    path = write(f"public <a> = <r0> forward;\n{rules}<r1000> = go;")

    start = time.perf_counter()
    grammar, errors = read_grammar(path)
    assert not errors
    check(grammar)
    assert time.perf_counter() - start < 2.0
