"""Where turns end and who goes on, by an engine that hears numbers as words."""

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core import paths
from hri.core.signals import Rejection, Utterance
from hri.hal.recognizer import Hypothesis, Recognizer, Segment
from hri.hal.resource import Description
from hri.speech.grammar import load_grammar
from hri.speech.grammar.matching import parse, refusal
from hri.speech.turn import Turn
from hri.speech.turn_taking import COMPLETE, UNFINISHED, TurnTaking

SAID = (
    "go forward two meters turn left forty five degrees what is your name time it please banana no"
    " problem"
)
WORDS = ("", *dict.fromkeys(SAID.split()))
OPEN = Turn()


class NumberEars(Recognizer):
    """Each sample is a word, or a second without one."""

    rate = 1

    def listen(self, samples, end):
        return []

    def flush(self):
        return []

    def start(self, grammar):
        self.grammar = grammar

    def decode(self, segment, rules=None):
        text = " ".join(WORDS[number] for number in segment.samples if number)
        found = parse(self.grammar, text, rules)
        refused = refusal(self.grammar, text)
        begun = text if refused is not None and not refused.word else ""
        return Hypothesis(text, 1.0 if found else 0.0, begun=begun)


class Ears:
    """Pieces of speech one after the other; what is told of them."""

    def __init__(self, grammar):
        engine = NumberEars(Description("ears", "NumberEars"), None)
        engine.start(grammar)
        self.turns = TurnTaking(engine)
        self.grammar = grammar
        self.number = 0
        self.samples = np.zeros(0, np.int16)
        self.time = 0.0

    def say(self, text, turn=OPEN):
        """More words of the open piece, then a pause of it."""
        words = [WORDS.index(word) for word in text.split()]
        self.samples = np.concatenate([self.samples, np.array(words, np.int16)])
        self.time += len(words)
        return self.turns.read(self._segment(), self.grammar, 0.5, turn)

    def end(self, after=0.5, turn=OPEN):
        """The open piece is over; the next one begins some seconds later."""
        reading = self.turns.end(self._segment(), self.grammar, 0.5, turn)
        self.number, self.samples = self.number + 1, np.zeros(0, np.int16)
        self.time += after
        return reading

    def _segment(self):
        count = len(self.samples)
        return Segment(self.time - count, self.time, self.samples, number=self.number)


@pytest.fixture
def ears(companion):
    return Ears(companion)


def texts(reading):
    return [heard.text for heard in reading.heard if isinstance(heard, Utterance)]


@pytest.mark.parametrize(
    ("text", "pauses"),
    [
        ("go forward two meters", COMPLETE),
        ("what is your name", COMPLETE),
        ("go forward please", COMPLETE),
        ("go forward", 1.0),
        ("turn left", 1.0),
        ("what is", UNFINISHED),
        ("turn left forty five", UNFINISHED),
        ("banana", 1.0),
    ],
)
def test_the_grammar_says_how_long_the_pause_is_that_ends_a_turn(ears, text, pauses):
    assert ears.say(text).pauses == pauses


def test_who_goes_on_within_a_piece_says_one_sentence(ears):
    ears.say("go forward")
    ears.say("two meters")

    reading = ears.end()

    assert texts(reading) == ["go forward two meters"]
    assert not reading.continues


def test_who_goes_on_after_the_end_takes_back_what_was_understood(ears):
    ears.say("go forward")
    assert texts(ears.end()) == ["go forward"]
    ears.say("two meters")

    reading = ears.end()

    (heard,) = reading.heard
    assert (heard.text, heard.tags, heard.continues) == (
        "go forward two meters",
        {"distance": 2.0},
        True,
    )
    assert reading.continues


def test_words_that_change_nothing_are_not_told(ears):
    ears.say("what is your name")
    ears.end(after=0.3)
    ears.say("please")

    reading = ears.end()

    assert (reading.heard, reading.continues) == ((), True)


def test_words_that_fit_nothing_leave_what_was_understood(ears):
    ears.say("go forward")
    ears.end()
    ears.say("banana")

    reading = ears.end()

    assert reading.continues
    assert [heard.reason for heard in reading.heard] == ["not in grammar"]


def test_two_commands_in_one_piece_are_two(ears):
    ears.say("turn left")
    ears.say("go forward")
    ears.say("two meters")

    reading = ears.end()

    assert texts(reading) == ["turn left", "go forward two meters"]
    assert not reading.continues


def test_two_commands_soon_after_each_other_are_two(ears):
    ears.say("what is your name")
    assert texts(ears.end(after=0.25)) == ["what is your name"]
    ears.say("what time is it")

    reading = ears.end()

    assert texts(reading) == ["what time is it"]
    assert not reading.continues
    assert not reading.heard[0].continues


def test_a_sentence_that_means_as_much_alone_is_the_second_one(write):
    ears = Ears(load_grammar(write("public <go> = go; public <turn> = [go] turn left;")))
    ears.say("go")
    ears.end(after=0.25)
    ears.say("turn left")

    reading = ears.end()

    assert texts(reading) == ["turn left"]
    assert not reading.continues


def test_a_command_with_other_words_behind_it_in_one_piece_is_none(ears):
    ears.say("turn left")
    ears.say("banana")

    (heard,) = ears.end().heard

    assert isinstance(heard, Rejection)


@pytest.mark.parametrize(("after", "is_speaking"), [(1.0, False), (0.5, True)])
def test_who_begins_late_or_over_the_robot_begins_anew(ears, after, is_speaking):
    ears.say("go forward")
    ears.end(after=after)
    turn = Turn(is_speaking=is_speaking)
    ears.say("two meters", turn)

    reading = ears.end(turn=turn)

    assert not reading.continues
    assert isinstance(reading.heard[0], Rejection)


def test_a_sentence_is_not_kept_for_ever(write):
    ears = Ears(load_grammar(write("public <count> = (go {n+=1})+;")))
    heard = []
    for _ in range(40):
        ears.say("go")
        heard += ears.end(after=0.3).heard

    assert 15 < max(one.tags["n"] for one in heard) < 25


def test_an_answer_may_go_on_though_its_question_is_over(ears):
    asked = Turn(is_question_open=True)
    ears.say("no", asked)
    assert texts(ears.end(after=0.3, turn=asked)) == ["no"]
    ears.say("problem")

    (heard,) = ears.end().heard

    assert (heard.text, heard.rule, heard.continues) == ("no problem", "yes", True)


SENTENCES_OF = load_grammar(paths.find("grammars", "companion"))
SENTENCES = (
    "go forward",
    "go forward two meters",
    "turn left",
    "what is your name",
    "turn left please",
)


@given(
    st.lists(
        st.tuples(st.sampled_from(SENTENCES), st.booleans()),
        min_size=1,
        max_size=5,
    )
)
def test_sentences_that_do_not_fit_together_are_told_once_each_however_they_are_cut(said):
    ears = Ears(SENTENCES_OF)
    told = []
    for text, is_end in said:
        ears.say(text)
        if is_end:
            told += texts(ears.end(after=0.3))
    told += texts(ears.end()) if len(ears.samples) else []

    assert told == [text for text, _ in said]
