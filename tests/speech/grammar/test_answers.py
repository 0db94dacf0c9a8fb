"""Yes and no in the words that people use, and nothing else taken for one."""

import pytest

from hri.core.signals import Utterance
from hri.hal.recognizer import Hypothesis, Segment
from hri.speech.acceptance import judge
from hri.speech.grammar import load_grammar, parse
from hri.speech.turn import Turn

YES = """yes, yeah, yep, yes please, yes of course, of course i do, sure, sure why not, okay, ok,
i do, i am, yes i did, it is, why not, absolutely, definitely, certainly, that's right,
right, exactly, go ahead, please do, yes you may, you may, i think so, i guess so, i
would love to, yes that would be nice, sounds good, with pleasure, gladly, all right,
fine with me, if you like, by all means, you bet, oh yes very much, well yeah i suppose
so, yes thank you very much, no problem, great, cool, deal, everything is fine, hell yeah,
mm hmm, yep robot, why yes of course, i'd say so, i'd say the answer is yes, it's a yes from me,
one hundred percent, without a doubt, you bet, i certainly do, that'd be lovely thank you, let's
do it, sorry i mean yes, i don't see why not, that sounds like a plan, i'm all for it"""
NO = """no, nope, nah, no thanks, no thank you, not really, not now, not today, rather not, i'd
rather not, never, i don't, no i don't, i am not, i'm not, no it isn't, it is not, i
don't think so, i guess not, of course not, absolutely not, certainly not, no way, not
at all, never mind, forget it, please don't, don't bother, that's wrong, no not yet,
maybe later, another time, not at the moment, well not really no, i'm afraid not, no i
can't, i would rather not, i don't want to, not a chance, better not, sorry robot no, i'm sorry
but no, thanks but no thanks, no no never ever, most certainly not, uh uh, nuh uh, no way jose,
i have to say no, the answer is no, a big fat no, not in a million years, that's not for me, i
really don't think so, no it's fine, i doubt it, i'll pass, let's not, good heavens no"""
UNSURE = """maybe, perhaps, i don't know, i'm not sure, not sure, no idea, i have no idea, who
knows, it depends, hard to say, let me think, we'll see, sort of, hmm maybe, well i
don't know, i can't decide, i don't know robot, i'm sorry i don't know, yes and no, maybe maybe
not, maybe yes maybe no, i'm not so sure about that, i haven't made up my mind, i really couldn't
say, i'll have to think about it, i'm in two minds, it's hard to say, i don't mind either way"""
OTHER = """thanks, thank you, hello, what time is it, stop, i like pizza, tell me a story, you are
nice, good robot, what do you mean, yesterday, i know him, right turn ahead, not my cup,
the answer is forty two, know what, goodbye, please, sorry, i'm sorry, robot, really, do you know,
is that right, i'm home, it is cold, i know that song, nobody told me about that, no milk today,
thank you very much robot, yes no, i wouldn't say no, you are great"""


@pytest.fixture(scope="module")
def answers():
    return load_grammar("answers")


def listed(text):
    return [one.strip() for one in text.replace("\n", " ").split(",")]


@pytest.mark.parametrize(
    ("texts", "rule"), [(YES, "yes"), (NO, "no"), (UNSURE, "unsure"), (OTHER, None)]
)
def test_what_people_say_is_the_answer_that_they_mean(answers, texts, rule):
    found = {text: parse(answers, text) for text in listed(texts)}
    wrong = {text: one and one.rule for text, one in found.items() if (one and one.rule) != rule}
    assert wrong == {}


def heard(text, **turn):
    hypothesis = Hypothesis(text, 0.9)
    return judge(load_grammar("companion"), Segment(0, 1), hypothesis, turn=Turn(**turn))


def test_what_answers_an_open_question_is_no_order():
    assert heard("go ahead").rule == "move"
    assert heard("go ahead", is_question_open=True).rule == "yes"
    assert heard("go forward", is_question_open=True).rule == "move"


@pytest.mark.parametrize(
    "text",
    [
        "thanks",
        "good robot",
        "stop",
        "how are you",
        "hello robot",
        "see you later",
        "you are great",
    ],
)
def test_what_is_no_answer_is_not_taken_for_one(text):
    found = heard(text, is_question_open=True)
    assert isinstance(found, Utterance)
    assert found.rule not in ("yes", "no", "unsure")
