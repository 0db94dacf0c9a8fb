from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from hri.speech.grammar.tags import (
    LONGEST_VALUE,
    MOST_COLLECTED,
    evaluate,
    read_entries,
    spell_tags,
)


@pytest.mark.parametrize(
    ("text", "tags"),
    [
        ("distance=10", {"distance": 10.0}),
        ("a=1; b=-2.5  c=x", {"a": 1.0, "b": -2.5, "c": "x"}),
        ("polite", {"polite": True}),
        ("loud=false", {"loud": False}),
        ("light=on; loud", {"light": "on", "loud": True}),
        ("n=3 loud", {"n": 3.0, "loud": True}),
        ('light="very bright" loud', {"light": "very bright", "loud": True}),
        ('place="the kitchen"', {"place": "the kitchen"}),
        ("n+=20 n+=5", {"n": 25.0}),
        ("n=2 n*=100 n+=6", {"n": 206.0}),
        ("n*=100", {}),
        ("d=$n", {}),
        ("n=3 d=$n", {"d": 3.0}),
        ("n=3 a=$n b=$n", {"a": 3.0, "b": 3.0}),
        ("n=5 x=red x+=1", {"n": 5.0, "x": ("red", "1")}),
        ("t+=ham t+=olives", {"t": ("ham", "olives")}),
        ("a=ham t+=$a a=olives t+=$a t+=$a", {"t": ("ham", "olives")}),
        ("n+=5 n+=ham; loud loud+=quiet", {"n": ("5", "ham"), "loud": ("true", "quiet")}),
        ("t+=ham u+=olives u+=$t", {"u": ("olives", "ham")}),
        ('t+=ham t+=olives s="with $t"', {"s": "with ham, olives"}),
        ("t+=ham t*=2", {"t": ("ham",)}),
        ('h="07" m=5 t="$h:$m"', {"t": "07:5"}),
        ('h="07" t="$h:$m"', {"h": "07"}),
        ('t="" d=1 t="$t$d" d=2 t="$t$d"', {"t": "12"}),
        ('t="$5 or $$x"', {"t": "$5 or $x"}),
        ("n=3 a=2 a*=$n", {"a": 6.0}),
        ("n=0 n*=-1", {"n": 0.0}),
        ("n=1e308 n*=1e308", {"n": 1e308}),
    ],
)
def test_entries_mean_plain_data(text, tags):
    # One group for each entry, as if each stood behind a word of its own.
    groups = [(entry,) for entry in read_entries(text)]
    if text == "n=3 a=$n b=$n":
        groups = [read_entries("n=3"), read_entries("a=$n b=$n")]

    assert evaluate(groups) == tags


@pytest.mark.parametrize(
    "text",
    [
        "",
        " ; ",
        "=3",
        "a==3",
        'a="b c',
        "1x=3",
        "a*=red",
        "a=1e999",
        "a=$",
        "a=$1",
        "a=$b=c",
        "a=b c",
    ],
)
def test_what_is_no_tag_is_refused(text):
    with pytest.raises(ValueError, match=r"\w"):
        read_entries(text)


def test_a_text_that_doubles_for_ever_stops_growing():
    (double,) = read_entries('t="$t$t"')
    tags = evaluate([read_entries("t=xx"), *[(double,)] * 200])

    assert len(tags["t"]) <= LONGEST_VALUE


def test_a_list_that_doubles_for_ever_stops_growing():
    (double,) = read_entries("t+=$t")
    tags = evaluate([read_entries("t+=ham"), *[(double,)] * 200])

    assert len(tags["t"]) == MOST_COLLECTED


texts = st.text(st.characters(codec="ascii", exclude_categories=["Cc"], exclude_characters='"'))
values = st.one_of(
    texts,
    st.booleans(),
    st.floats(-1e9, 1e9).map(lambda number: round(number, 3) + 0.0),
    st.lists(texts, min_size=1, max_size=4).map(tuple),
)


@given(st.dictionaries(st.sampled_from(["a", "b.c", "size"]), values, min_size=1))
def test_what_a_sentence_means_can_be_written_down_and_read_again(tags):
    assert evaluate([read_entries(spell_tags(tags))]) == tags


def test_no_tag_ends_in_minus_zero():
    assert str(evaluate([read_entries("n=0"), read_entries("n*=-1")])["n"]) == "0.0"
