from __future__ import annotations

import time

import pytest
from hypothesis import given, strategies as st

from hri.speech.grammar import load_grammar
from hri.speech.grammar.lint.confusion import differing, sound_alikes
from hri.speech.grammar.matching import Parse, parse
from hri.speech.pronunciation.lexicon import load_lexicon

words = st.lists(st.sampled_from(["go", "to", "the", "left", "right"]), max_size=6)


def readings(*texts):
    return [Parse(text, text) for text in texts]


def differences(*texts, farthest=0.25):
    found = sound_alikes(readings(*texts), load_lexicon(), farthest)
    return [frozenset(pair.difference) for pair in found]


def test_words_that_sound_alike_are_found_and_others_are_not():
    found = differences(
        "go to the bedroom", "go to the bathroom", "what time is it", "play some music"
    )
    assert found == [frozenset(("bedroom", "bathroom"))]


def test_the_nearest_comes_first():
    found = differences("turn fifteen", "turn fifty", "turn five", "turn nine", farthest=0.6)
    assert found[0] == frozenset(("fifteen", "fifty"))


def test_sentences_of_one_meaning_are_no_confusion():
    same = [Parse("go to the bedroom", "a"), Parse("go to the bathroom", "a")]
    assert sound_alikes(same, load_lexicon()) == []


def test_a_difference_is_told_once():
    texts = [f"{verb} {number} meters" for verb in ("go", "move") for number in ("fifty", "sixty")]
    assert differences(*texts) == [frozenset(("fifty", "sixty"))]


def test_words_in_another_order_do_not_sound_the_same():
    found = sound_alikes(
        readings("coffee with some milk and sugar", "coffee with milk and some sugar"),
        load_lexicon(),
        farthest=1.0,
    )
    assert found[0].distance == pytest.approx(0.5)


def test_words_that_sound_the_same_have_no_distance():
    (pair,) = sound_alikes(readings("write it", "right it"), load_lexicon())
    assert pair.distance == 0.0
    assert pair.difference == ("write", "right")


def test_one_sentence_and_none_have_no_pairs():
    assert sound_alikes([], load_lexicon()) == []
    assert sound_alikes(readings("hello"), load_lexicon()) == []


@given(words, words)
def test_what_differs_is_taken_from_both_in_order(one, other):
    changes = differing(one, other)

    for side, whole in enumerate((one, other)):
        left = iter(whole)
        assert all(word in left for change in changes for word in change[side])
    if one != other:
        assert any(first != second for first, second in changes)


@pytest.mark.slow
def test_thousands_of_sentences_take_seconds(companion):
    rules = companion.spoken_rules
    found = [parse(companion, text, rules) for text in companion.sample(1500, rules)]
    spoken = [reading for reading in found if reading]
    assert len(spoken) == 1500
    begun = time.process_time()
    assert sound_alikes(spoken, load_lexicon())
    assert time.process_time() - begun < 10.0


def test_a_sample_is_the_same_each_time(companion, write):
    assert companion.sample(100) == companion.sample(100)
    assert len(set(companion.sample(100))) > 90  # A follow-up may be a command, too.
    assert sorted(load_grammar(write("public <a> = [hello] [you];")).sample(100)) == [
        "hello",
        "hello you",
        "you",
    ]
