"""What words say of a feeling."""

import pytest

from hri.conversation.sentiment import Sentiment, lexicon, sentiment_of


@pytest.mark.parametrize(
    ("text", "feeling"),
    [
        ("Our cat died.", Sentiment.SAD),
        ("i got the job", Sentiment.GLAD),
        ("they yelled at me", Sentiment.ANGRY),
        ("there is a spider in the tub", Sentiment.AFRAID),
        ("my head hurts", Sentiment.WEARY),
        ("you are so clever", Sentiment.KIND),
        ("you stupid toaster", Sentiment.UNKIND),
        ("it was not fun", Sentiment.SAD),
        ("you are not very smart", Sentiment.UNKIND),
        ("i am not sad", None),
        ("you are not ugly", None),
        ("the pan is on the stove", None),
        ("", None),
    ],
)
def test_words_say_it_and_a_denial_turns_what_is_good(text, feeling):
    assert sentiment_of(text) is feeling


def test_a_phrase_stands_in_one_list_only_and_lists_have_no_gaps():
    for phrases in lexicon().values():
        assert all(all(phrase) and phrase for phrase in phrases)
    written = [phrase for phrases in lexicon().values() for phrase in phrases]
    assert all(len(phrase) <= 5 for phrase in written)
