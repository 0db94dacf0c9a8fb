"""What the dialogues on the pages of the companion's skills cannot show."""

import pytest

from apps.companion.skills.quiz.tasks import ANSWERS, QUESTIONS, read_questions
from hri.core.errors import AuthoringError, HriError
from hri.face import Face
from hri.robot.verbs import change_face
from hri.speech.behaviors import Listener, Voice
from hri.speech.grammar import load_grammar, parse
from tests.apps.test_companion import Visit
from tests.apps.test_manners import typed, typing

SKILLS = ANSWERS.parents[1]
TO_THINK = 1.0
"""Seconds."""


def quizzed(answer_of):
    """A visit with a quiz whose questions are answered by a function of each."""

    async def answer(context):
        with context.queue("question.asked") as queue:
            while True:
                text = (await queue.get()).properties["text"]
                question = next(one for one in QUESTIONS if text.startswith(one.ask))
                await context.clock.sleep(TO_THINK)
                context.behavior(Listener).type_line(answer_of(question))

    return Visit(40, {}, jobs=[typing({1.0: "quiz me"}), answer])


def test_the_grammar_of_the_quiz_hears_each_choice_as_it_is_written():
    grammar = load_grammar(ANSWERS)
    choices = [choice for one in QUESTIONS for choice in (one.answer, *one.wrong)]
    assert {choice: parse(grammar, choice).tags["answer"] for choice in choices} == {
        choice: choice for choice in choices
    }


@pytest.mark.parametrize(
    ("answer_of", "score"),
    [
        (lambda question: f"is it {question.answer}", "You got all 3 right."),
        (lambda question: question.wrong[-1], "You got none of them this time."),
    ],
)
def test_a_quiz_ends_with_the_score(answer_of, score):
    assert quizzed(answer_of).said()[-1].startswith(score)


def test_a_mistake_in_the_questions_has_its_place(tmp_path):
    file = tmp_path / "questions.toml"
    file.write_text('[[question]]\nask = "Who"\nanswer = "I"\nwrong = "you"\n')
    with pytest.raises(AuthoringError, match=r"questions\.toml:4:1: wrong is a text"):
        read_questions(file)
    file.write_text("")
    with pytest.raises(AuthoringError, match="there are 0 questions - write 3 or more"):
        read_questions(file)


def test_a_face_that_is_not_there_leaves_it_as_it_looks():
    told = []

    async def change(context):
        await context.clock.sleep(1.0)
        try:
            await change_face(context, "nobody")
        except HriError as error:
            told.append(str(error))
        told.append(context.behavior(Face).face)

    Visit(3, {}, jobs=[change])
    assert told == [told[0], "robot"]
    assert '"nobody"' in told[0]


def test_the_voice_gets_louder_and_faster_to_a_limit_and_is_its_own_again():
    lines = ["set your volume to ten", "speak up", *["talk faster"] * 4, "speak like a robot"]
    visit = typed(2.0 + 3 * len(lines), {1.0 + 3 * n: line for n, line in enumerate(lines)})
    voice = visit.robot.context.behavior(Voice)
    assert visit.said()[1] == "I can't talk any louder."
    assert visit.said()[5] == "I can't talk any faster."
    assert (voice.volume, voice.rate, voice.voice) == (2.0, 1.6, "robot")
    lines = ["use another voice", "use another voice", "use your usual voice"]
    visit = typed(11.0, {1.0 + 3 * n: line for n, line in enumerate(lines)})
    assert visit.robot.context.behavior(Voice).voice == ""


def test_orders_to_the_wheels_are_none_to_the_voice():
    grammar = load_grammar(SKILLS / "voice" / "grammar.jsgf")
    for line in ("faster", "slow down", "go a little faster", "louder music"):
        assert parse(grammar, line) is None
