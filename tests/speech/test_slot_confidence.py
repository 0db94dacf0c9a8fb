from __future__ import annotations

import pytest
from hypothesis import given, strategies as st

from hri.core.signals import HeardWord
from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import Parse, parse
from hri.speech.grammar.tags import read_entries
from hri.speech.slot_confidence import REST, slot_confidences


@pytest.fixture
def grammar(write):
    return load_grammar(
        write(
            "public <bring> = bring me the (book {thing=book} | ball {thing=ball})\n"
            "  from the (desk {place=desk} | den {place=den}) please;\n"
            "public <find> = find the book {thing=book};\n"
            "public <stop> = stop;\n"
        )
    )


def words(text, sure=0.97, **others):
    return [HeardWord(word, 0.0, 1.0, others.get(word, sure)) for word in text.split()]


ENTRIES = (read_entries("who=anna"),)
ORDER = "bring me the book from the desk please"


def test_a_word_unlike_its_sound_makes_its_own_tag_unsure_and_no_other(grammar):
    found = parse(grammar, ORDER)

    sure = slot_confidences(found, words(ORDER), ())
    assert min(sure.values()) > 0.5
    unlike = slot_confidences(found, words(ORDER, desk=0.02), ())
    assert unlike["place"] < 0.5 < unlike["thing"]
    assert slot_confidences(found, words(ORDER, please=0.02), ())[REST] < 0.5


def test_a_rival_makes_the_tags_unsure_in_which_it_differs(grammar):
    found = parse(grammar, ORDER)
    other = parse(grammar, ORDER.replace("book", "ball"))

    near = slot_confidences(found, words(ORDER), [(other, 0.45)])
    far = slot_confidences(found, words(ORDER), [(other, 0.01)])
    assert near["thing"] < 0.5 < near["place"]
    assert far["thing"] > 0.5
    foreign = slot_confidences(found, words(ORDER), [(parse(grammar, "find the book"), 0.45)])
    assert foreign[REST] < 0.5 < foreign["thing"]


def test_only_what_gives_values_is_judged_and_only_by_engines_that_can(grammar):
    assert slot_confidences(parse(grammar, "stop"), words("stop", 0.01), ()) == {}
    unjudged = [HeardWord(word, 0.0, 1.0) for word in ORDER.split()]
    assert slot_confidences(parse(grammar, ORDER), unjudged, ()) == {}


@given(st.floats(0.0, 1.0), st.floats(0.0, 1.0), st.floats(0.0, 0.49), st.floats(0.0, 0.49))
def test_clearer_words_and_weaker_rivals_never_make_it_less_sure(one, other, share, more):
    found, rival = (
        Parse(f"call {who}", "call", {"who": who}, entries=ENTRIES, ends=(2,))
        for who in ("anna", "hanna")
    )
    low, high = sorted((one, other))
    weak, strong = sorted((share, more))

    def sure(chance, share):
        return slot_confidences(found, words("call anna", anna=chance), [(rival, share)])["who"]

    assert 0.0 <= sure(low, strong) <= sure(high, strong) <= sure(high, weak) <= 1.0
