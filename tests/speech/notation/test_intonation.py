"""The tone at the end of each phrase, as the words and signs of a sentence ask for it."""

import pytest
from hypothesis import given, strategies as st

from hri.speech.notation.intonation import (
    LAST_S,
    PARAGRAPH_S,
    PAUSES,
    Tone,
    boundaries,
    pause_between,
)

FALL, STRONG, RISE, ON, LEVEL = (
    Tone.FALL, Tone.STRONG_FALL, Tone.RISE, Tone.CONTINUE, Tone.LEVEL,
)  # fmt: skip


@pytest.mark.parametrize(
    ("sentence", "tones"),
    [
        ("It is cold outside.", [FALL]),
        ("It is cold outside", []),
        ("Well, it is cold outside", [FALL]),
        ("It is cold outside!", [STRONG]),
        ("It is cold outside?", [RISE]),
        ("Are you happy?", [RISE]),
        ("Did you sleep well, Anna?", [ON, RISE]),
        ("Anna, did you sleep well?", [ON, RISE]),
        ("Where do you live?", [FALL]),
        ("So what's your name?", [FALL]),
        ("What do you want to do, Anna?", [ON, FALL]),
        ("After dinner, where do we go?", [ON, FALL]),
        ("When it rains, do you stay inside?", [ON, RISE]),
        ("Do you know where she is?", [RISE]),
        ("You did what?", [RISE]),
        ("It's cold, isn't it?", [ON, RISE]),
        ("Do you want tea or coffee?", [RISE, FALL]),
        ("Would you like tea, coffee, or milk?", [RISE, RISE, FALL]),
        ("Would you like tea or something?", [RISE]),
        ("I bought bread, milk, and eggs.", [ON, ON, FALL]),
        ("Yes, I will.", [FALL, FALL]),
        ("Wait... who is there?", [LEVEL, FALL]),
        ("Wait…", [LEVEL]),
        ("I said no: go away; now.", [FALL, FALL, FALL]),
        ("The dog — a big one — ran.", [ON, ON, FALL]),
        ('"Are you sure?" she asked.', [RISE, FALL]),
        ("Dr. Smith came at 5:30 p.m. with 3,000 eggs.", [FALL]),
        ("He lives in 5 Main St.", [FALL]),
        ("Go.; now.", [FALL, FALL]),
        ("Go;: now.", [FALL, FALL]),
        ("Well,, go,. now.", [FALL, ON, FALL]),
        ("?!", []),
        ("", []),
    ],
)
def test_a_sentence_has_the_tones_that_a_speaker_would_give_it(sentence, tones):
    assert [boundary.tone for boundary in boundaries(sentence)] == tones


def test_pauses_come_by_rank():
    comma, _, question = (
        boundaries(text)[0].pause_s for text in ("Well now, go.", "Go.", "Shall we go?")
    )
    assert comma < PAUSES["."] < question < PAUSES["…"] < PARAGRAPH_S


@pytest.mark.parametrize(
    ("sentence", "rest", "pause"),
    [
        ("Go.", "", LAST_S),
        ("Go.", "  \n", LAST_S),
        ("Go.", " Now.", PAUSES["."]),
        ("Shall we go?", " Yes.", PAUSES["?"]),
        ("Go.", "\n\nThe next day it rained.", PARAGRAPH_S),
        ('"Go!"', ' "No."', PARAGRAPH_S),
        ('"Go!"', " She went.", PAUSES["!"]),
        ("Go", " on", PAUSES["."]),
    ],
)
def test_the_pause_after_a_sentence_depends_on_what_follows(sentence, rest, pause):
    assert pause_between(sentence, rest) == pause


@given(st.text(alphabet="ab What or,;:.!?…—-\"' \n", max_size=80))
def test_phrases_follow_each_other_whatever_is_written(sentence):
    ends = [boundary.end for boundary in boundaries(sentence)]
    assert ends == sorted(ends)
    assert all(0 < end <= len(sentence) for end in ends)
