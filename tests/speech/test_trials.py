from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.statistics import told, wilson
from hri.hal.resource import Description
from hri.speech.acceptance import needed
from hri.speech.grammar import load_grammar
from hri.speech.grammar.lint.expectations import Meaning
from hri.speech.grammar.matching import parse
from hri.speech.trials import (
    QUESTION,
    Attempt,
    RecordedClip,
    Score,
    attempt,
    confusions,
    recommended,
    score,
)
from tests.speech.fakes import ScriptedEars


@pytest.fixture
def grammar(write):
    return load_grammar(
        write("public <a> = turn left | turn right {right};\n/** @careful */ public <b> = go on;")
    )


@pytest.fixture
def tried(grammar):
    """An attempt at a sentence that was taken for others, each with its confidence."""

    def tried(said: str, *taken: tuple[str, float]) -> Attempt:
        found = parse(grammar, said)
        meaning = None if found is None else Meaning(found.rule, found.tags)
        return Attempt("", said, meaning, tuple((parse(grammar, text), c) for text, c in taken))

    return tried


def test_a_clip_is_heard_as_it_would_be_live(grammar, resources):
    engine = ScriptedEars(Description("ears", "Test.Ears"), resources)
    engine.activate()
    engine.script = {1.0: ("turn left", 0.7), 2.0: ("turn up", 0.9)}
    clip = RecordedClip("x.wav", np.zeros(48000, np.int16), 16000, "turn left", Meaning("a"))

    found = attempt(clip, engine, grammar)

    assert [(reading.text, confidence) for reading, confidence in found.pieces] == [
        ("turn left", 0.7)
    ]
    assert found.is_right(grammar, 0.5)
    assert not found.is_right(grammar, 0.8)


def test_right_is_the_meaning_and_nothing_beside_it(grammar, tried):
    assert tried("turn left", ("turn left", 0.6)).is_right(grammar, 0.5)
    assert not tried("turn left", ("turn right", 0.6)).is_right(grammar, 0.5)
    assert not tried("turn left", ("turn left", 0.6), ("go on", 0.9)).is_right(grammar, 0.5)
    assert not tried("turn left").is_right(grammar, 0.5)
    assert tried("nice weather").is_right(grammar, 0.5)
    assert not tried("nice weather", ("turn left", 0.6)).is_right(grammar, 0.5)


def test_careful_rules_need_more(grammar, tried):
    least = needed(grammar, parse(grammar, "go on"), 0.5, QUESTION)
    assert least > needed(grammar, parse(grammar, "turn left"), 0.5, QUESTION)
    assert tried("go on", ("go on", least - 0.01)).accepted(grammar, 0.5) == []
    assert tried("go on", ("go on", least)).accepted(grammar, 0.5) != []


def test_attempts_are_counted_and_confusions_told(grammar, tried):
    attempts = [
        tried("turn left", ("turn left", 0.9)),
        tried("turn left", ("turn right", 0.9)),
        tried("turn right", ("turn right", 0.1)),
        tried("nice weather", ("turn left", 0.6)),
        tried("good soup"),
    ]
    assert score(attempts, grammar, 0.5) == Score(0.5, 3, 1, 1, 2, 1)
    assert confusions(attempts, grammar, 0.5) == {
        ("turn left", "turn right"): 1,
        ("nice weather", "turn left"): 1,
    }


def test_the_strictest_of_the_good_settings_is_recommended():
    scores = [
        Score(0.2, commands=100, right=99, wrong=1, foreign=50, foreign_accepted=9),
        Score(0.4, commands=100, right=98, wrong=1, foreign=50, foreign_accepted=1),
        Score(0.5, commands=100, right=97, wrong=0, foreign=50, foreign_accepted=0),
        Score(0.6, commands=100, right=90, wrong=0, foreign=50, foreign_accepted=0),
    ]
    assert recommended(scores, 0.02).strictness == 0.5
    assert recommended(scores, 1.0).strictness == 0.5
    assert recommended(scores[:2], 0.0).strictness == 0.4


@given(st.integers(0, 500), st.integers(1, 500))
def test_a_share_lies_in_its_interval(count, total):
    count = min(count, total)
    low, high = wilson(count, total)
    assert 0.0 <= low <= count / total <= high <= 1.0


def test_intervals_are_those_of_the_book():
    low, high = wilson(8, 10)
    assert (round(low, 3), round(high, 3)) == (0.490, 0.943)
    assert wilson(0, 0) == (0.0, 1.0)
    assert told(63, 65) == "63 of 65, 97 % (89 % to 99 %)"
    assert told(0, 0) == "none"
