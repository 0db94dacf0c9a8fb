"""What the robot answers to a sentence that it does not understand."""

import pytest
from hypothesis import given, strategies as st

from hri.conversation.dialog_act import DialogAct
from hri.conversation.puzzlement import (
    MOST_TO_STRANGERS,
    OFFER_AT,
    Answer,
    Kind,
    Puzzle,
    Puzzlement,
    as_said,
    decide,
)
from hri.conversation.sentiment import Sentiment

COMMANDS = ["go forward", "turn left", "what time is it", "show me a happy face", "come here"]
TYPED = {"is_typed": True, "is_turned_to": True}


@pytest.mark.parametrize(
    ("puzzle", "row", "kind"),
    [
        (Puzzle("not in grammar", topic="turning", nearest="turn left", **TYPED), 1, Kind.CAUGHT),
        (Puzzle("not in grammar", nearest="turn left", **TYPED), 1, Kind.NEAR),
        (Puzzle("not in grammar", act=DialogAct.STATEMENT, **TYPED), 3, Kind.TOLD),
        (Puzzle("not in grammar", act=DialogAct.CORRECTION, **TYPED), 1, Kind.CORRECTED),
        (Puzzle("not in grammar", words=2, goes_on=True, **TYPED), 1, Kind.NOTED),
        (
            Puzzle("not in grammar", words=2, goes_on=True, strange=("glue", "zinc"), **TYPED),
            1,
            Kind.STRANGE,
        ),
        (Puzzle("not in grammar", meant="turn left", goes_on=True, **TYPED), 1, Kind.NEAR),
        (Puzzle("not in grammar", act=DialogAct.QUESTION, **TYPED), 1, Kind.ASKED),
        (Puzzle("not in grammar", act=DialogAct.QUESTION, **TYPED), OFFER_AT, Kind.ASKED),
        (Puzzle("not in grammar", act=DialogAct.DIRECTIVE, **TYPED), OFFER_AT, Kind.OFFER),
        (
            Puzzle("not in grammar", act=DialogAct.DIRECTIVE, deed="fly", **TYPED),
            1,
            Kind.ASKED_FOR_DEED,
        ),
        (
            Puzzle("not in grammar", act=DialogAct.STATEMENT, echo="you ran", **TYPED),
            1,
            Kind.TOLD_OF,
        ),
        (
            Puzzle(
                "not in grammar",
                act=DialogAct.STATEMENT,
                echo="you lost",
                sentiment=Sentiment.SAD,
                **TYPED,
            ),
            1,
            Kind.TOLD_SAD,
        ),
        (
            Puzzle(
                "not in grammar",
                act=DialogAct.STATEMENT_OF_ROBOT,
                sentiment=Sentiment.UNKIND,
                **TYPED,
            ),
            1,
            Kind.INSULTED,
        ),
        (
            Puzzle("not in grammar", act=DialogAct.REMARK, sentiment=Sentiment.GLAD, **TYPED),
            1,
            Kind.PRAISED,
        ),
        (Puzzle("not in grammar", sentiment=Sentiment.GLAD, **TYPED), 1, Kind.REPHRASE),
        (Puzzle("not in grammar", act=DialogAct.DIRECTIVE, **TYPED), 1, Kind.ASKED_FOR),
        (
            Puzzle("not in grammar", act=DialogAct.DIRECTIVE, topic="turning", **TYPED),
            1,
            Kind.CAUGHT,
        ),
        (Puzzle("not in grammar", strange=["moon"], **TYPED), 1, Kind.STRANGE_WORD),
        (Puzzle("not in grammar", strange=["my", "moon"], **TYPED), 2, Kind.STRANGE),
        (Puzzle("not in grammar", **TYPED), 1, Kind.REPHRASE),
        (Puzzle("not now", is_answer=True, **TYPED), 1, Kind.NO_QUESTION),
        (Puzzle("not in grammar", answers=["small", "large"], **TYPED), 3, Kind.ANSWERS),
        (Puzzle("low confidence"), 1, Kind.UNCLEAR),
        (Puzzle("low confidence", topic="turning"), 1, Kind.CAUGHT),
        (Puzzle("unlike the sound"), 1, Kind.UNCLEAR),
        (Puzzle("unlike the sound"), 2, Kind.STRANGE),
        (Puzzle("unlike the sound", is_quiet=True), 1, Kind.TOO_QUIET),
        (Puzzle("unlike the sound"), OFFER_AT, Kind.OFFER),
    ],
)
def test_how_it_answers_depends_on_what_is_known(puzzle, row, kind):
    answer = decide(puzzle, row, COMMANDS)
    assert answer is not None
    assert answer.kind is kind


@pytest.mark.parametrize(
    "puzzle",
    [
        Puzzle("unlike the sound", is_addressed=False),
        Puzzle("not in grammar", is_addressed=False),
        Puzzle("no speech"),
        Puzzle("robot speaking"),
        Puzzle("not now", is_answer=True),
    ],
)
def test_what_was_hardly_said_to_it_gets_no_answer(puzzle):
    assert decide(puzzle, 1, COMMANDS) is None


def test_a_radio_in_an_open_talk_is_answered_a_few_times_and_who_looks_at_it_always():
    radio = [decide(Puzzle("unlike the sound"), row, COMMANDS) for row in range(1, 10)]
    assert [answer is not None for answer in radio] == [True] * 3 + [False] * 6
    assert MOST_TO_STRANGERS == 3
    looks = [Puzzle("unlike the sound", is_turned_to=True)] * 9
    assert all(decide(one, row + 1, COMMANDS) for row, one in enumerate(looks))


def test_what_was_offered_is_not_offered_again_while_another_is_left():
    puzzlement = Puzzlement()
    answers = [puzzlement.answer(Puzzle("x", **TYPED), COMMANDS, float(n)) for n in range(12)]
    offered = [answer.offered for answer in answers if answer.kind is Kind.OFFER]
    assert len(offered) == 4
    assert {*offered[0]}.isdisjoint(offered[1])


def test_the_row_ends_when_something_is_understood_or_a_minute_is_over():
    puzzlement = Puzzlement()
    kinds = []
    for time in (0.0, 5.0, 10.0, 90.0):
        kinds.append(puzzlement.answer(Puzzle("x", **TYPED), COMMANDS, time).kind)
    assert kinds == [Kind.REPHRASE, Kind.REPHRASE, Kind.OFFER, Kind.REPHRASE]
    puzzlement.answer(Puzzle("x", **TYPED), COMMANDS, 91.0)
    puzzlement.understand()
    assert puzzlement.answer(Puzzle("x", **TYPED), COMMANDS, 92.0).kind is Kind.REPHRASE


def test_i_is_written_large_and_nothing_else():
    assert as_said("can i see what i'm shown in it") == "can I see what I'm shown in it"


puzzles = st.builds(
    Puzzle,
    reason=st.sampled_from(
        ["no speech", "not in grammar", "unlike the sound", "not now", "low confidence"]
    ),
    is_typed=st.booleans(),
    is_addressed=st.booleans(),
    is_turned_to=st.booleans(),
    is_quiet=st.booleans(),
    topic=st.sampled_from(["", "turning"]),
    nearest=st.sampled_from(["", "turn left"]),
    strange=st.lists(st.sampled_from(["moon", "fly"]), unique=True),
    is_answer=st.booleans(),
)


@given(puzzles, st.integers(1, 20), st.lists(st.sampled_from(COMMANDS), unique=True))
def test_what_is_typed_is_always_answered_and_who_talks_to_others_never(puzzle, row, commands):
    answer = decide(puzzle, row, commands)
    if not puzzle.is_addressed:
        assert answer is None
    elif puzzle.is_typed and puzzle.is_turned_to and puzzle.reason != "no speech":
        assert answer is not None
        assert all(answer.facts.values())
        assert answer == decide(puzzle, row, commands)


@pytest.mark.parametrize(
    ("answers", "one", "other"),
    [
        (["small"], "small", "small"),
        (["small", "large"], "small", "large"),
        (["small", "medium", "large"], 'small", "medium', "large"),
    ],
)
def test_all_that_would_answer_is_named(answers, one, other):
    answer = decide(Puzzle("not in grammar", answers=answers, is_typed=True), 1, [])
    assert answer == Answer(Kind.ANSWERS, {"one": one, "other": other})
