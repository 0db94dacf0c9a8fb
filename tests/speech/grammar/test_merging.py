"""Interrupting rules of one grammar that count under another, whatever the other says."""

import pytest
from hypothesis import given, strategies as st

from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.merging import with_interrupts_of

BASE = """
/** @interrupts */
public <stop> = <halt> [now] | <please> stop;
/** @interrupts */
public <quiet> = be quiet;
public <go> = <please> go;
<halt> = halt | stop;
<please> = [please];
"""


def merged(write, rules):
    own = load_grammar(write(rules, "own"))
    return own, with_interrupts_of(own, load_grammar(write(BASE, "base")))


@pytest.mark.parametrize(
    "rules",
    [
        "public <drink> = red wine;",
        "public <answer> = yes | no | stop;",
        "public <stop> = next stop {where=next};",
        "public <where> = <stop>; <stop> = next station;",
        "public <please> = if you please; public <halt> = <please> | halting <halt>;",
        "public <stop> = <quiet> | whoa; <quiet> = hush;",
    ],
)
def test_what_interrupts_counts_by_its_name_and_all_else_stays(write, rules):
    own, both = merged(write, rules)
    expected = {"stop": "stop", "halt now": "stop", "please stop": "stop", "be quiet": "quiet"}
    for words, rule in expected.items():
        assert parse(both, words).rule == rule
        assert rule in both.marked("interrupts")
    assert parse(both, "please go") is None
    for sentence in own.sentences(50):
        before, now = parse(own, sentence), parse(both, sentence)
        assert now is not None
        if sentence not in expected:
            assert (now.rule, now.tags) == (before.rule, before.tags)


def test_a_grammar_that_extends_the_other_has_them_already(write):
    base = load_grammar(write(BASE, "base"))
    write("public <drink> = red wine;", "more").write_text(
        "#JSGF V1.0;\n/** @extends base */\ngrammar more;\npublic <drink> = red wine;\n"
    )
    more = load_grammar(base.path.with_name("more.jsgf"))
    assert with_interrupts_of(more, base) is more
    assert with_interrupts_of(base, base) is base


NAMES = st.sampled_from(["stop", "quiet", "halt", "please", "halt'", "other"])
WORDS = st.lists(st.sampled_from(["stop", "halt", "next", "be", "quiet"]), min_size=1, max_size=3)


@given(st.lists(st.tuples(NAMES, st.booleans(), WORDS), min_size=1, unique_by=lambda rule: rule[0]))
def test_no_names_of_rules_hide_what_interrupts(tmp_path_factory, rules):
    folder = tmp_path_factory.mktemp("grammars")

    def write(text, name):
        path = folder / f"{name}.jsgf"
        path.write_text(f"#JSGF V1.0;\ngrammar {name};\n{text}")
        return path

    written = [
        f"{'public ' * is_public}<{name}> = {' '.join(words)};" for name, is_public, words in rules
    ]
    _, both = merged(write, "\n".join([*written, "public <always> = fine;"]))
    for words, rule in {"stop now": "stop", "please stop": "stop", "be quiet": "quiet"}.items():
        assert parse(both, words).rule == rule
    public = [" ".join(words) for name, is_public, words in rules if is_public]
    assert all(parse(both, sentence) for sentence in [*public, "fine"])
