"""A talk is played to the simulated companion; the transcript has what came of each turn."""

from dataclasses import replace
from itertools import pairwise

import pytest

from benchmarks.conversation import transcript
from benchmarks.conversation.playing import play_fresh
from benchmarks.conversation.talks import Turn
from benchmarks.conversation.visits import drawn, lived
from hri.core.errors import HriError
from tests.benchmarks.conversation.talks import TALK, line


@pytest.fixture(scope="module")
def played():
    return play_fresh(TALK)


def test_a_transcript_says_what_it_understood_said_and_did(played):
    greeted, drove, *_ = played
    assert [one.id for one in played] == [f"open/ann/1/{number}" for number in range(1, 5)]
    assert (greeted.rule, drove.rule) == ("greet", "move")
    assert drove.tags["distance"] == 1.0
    assert greeted.said[0].text
    assert not greeted.moved
    assert [leg for leg in drove.moved if leg.startswith("drove forward")]
    assert greeted.is_answered
    assert drove.is_answered


def test_what_it_does_not_understand_has_a_reason(played):
    unknown = played[2]
    assert unknown.rule == ""
    assert unknown.why_not.startswith("not in grammar")
    assert [one.is_for_it for one in played] == [True, True, True, False]


def test_a_motion_that_goes_on_is_no_answer_to_the_next_turn():
    turns = (Turn("go forward ten meters"), Turn("purple marmalade engines"))
    first, second = play_fresh(replace(TALK, turns=turns))
    assert first.moved[0].startswith("drove forward")
    assert second.moved[0].startswith("still drove forward")
    assert replace(second, said=()).is_answered is False


def test_people_wait_until_it_has_finished(played):
    for before, after in pairwise(played):
        assert after.time - before.time >= 7.99
        assert all(before.time + words.at < after.time for words in before.said)


def test_the_same_talk_gives_the_same_transcript(played):
    assert play_fresh(TALK) == played


def test_a_transcript_is_read_as_it_was_written(played, tmp_path):
    transcript.write(played, tmp_path / "new" / "open.jsonl")
    assert transcript.read(tmp_path / "new" / "open.jsonl") == played
    for wrong in ('{"id": 1}', "[]", "1", "{"):
        (tmp_path / "no.jsonl").write_text(wrong + "\n")
        with pytest.raises(HriError, match="is not a transcript"):
            transcript.read(tmp_path / "no.jsonl")
    with pytest.raises(HriError, match="has the turn open/ann/1/1 a second time"):
        transcript.read_all([tmp_path / "new" / "open.jsonl"] * 2)


def test_what_it_says_much_later_is_its_own_idea():
    late = line(1, "Did you sleep well?", at=7.2)
    assert not late.is_answered
    assert late.answered() == "(7 s later) Did you sleep well?"
    assert line(1, moved=("still drove forward 1.00 m",)).is_answered is False
    assert line(1, moved=("turned left 90 degrees",)).is_answered


def test_visits_are_drawn_by_a_seed_and_each_lasts_five_minutes():
    talks = [replace(TALK, id=f"open/ann/{number}", turns=TALK.turns * 5) for number in range(3)]
    one, other = drawn(talks, 2), drawn(talks, 2)
    assert one == other
    assert len(one[0].turns) == 38


def test_a_visit_ends_in_time_and_the_next_one_begins_hours_later(monkeypatch):
    monkeypatch.setattr("benchmarks.conversation.visits.SECONDS", 10.0)
    visits = [
        replace(TALK, id=f"visits/{number}", turns=(Turn("what time is it"),) * 4)
        for number in (1, 2)
    ]
    first, second = lived(visits)
    assert all(1 <= len(said) <= 2 for said in (first, second)), "it may ask in between"
    hour, later = (said[0].said[0].text.split(":")[0] for said in (first, second))
    assert hour != later
