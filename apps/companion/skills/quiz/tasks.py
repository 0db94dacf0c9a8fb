"""A quiz: three questions of a file, whose answers a grammar hears."""

from dataclasses import dataclass
from pathlib import Path
from random import Random

from hri.core import Table, Utterance, load_toml
from hri.robot import verbs
from hri.task import TaskContext

FOLDER = Path(__file__).parent
ANSWERS = FOLDER / "answers.jsgf"
ASKED = 3
"""Questions of a quiz."""
PATIENCE = 10.0
"""Seconds for an answer."""
RIGHT = ("Yes, that's right!", "Right! Well done.", "Correct!")
WRONG = ("Not quite. The answer is {}.", "Good try, but the answer is {}.")
PASSED = "No problem. The answer is {}."


@dataclass(frozen=True)
class Question:
    """A question, and the choices that it offers aloud."""

    ask: str
    answer: str
    wrong: tuple[str, ...]

    def aloud(self, chance: Random) -> str:
        """The question with its choices in a new order."""
        *first, last = chance.sample((self.answer, *self.wrong), len(self.wrong) + 1)
        return f"{self.ask}: {', '.join(first)} or {last}?"


def read_questions(path: Path = FOLDER / "questions.toml") -> list[Question]:
    """The questions of a file. Raises AuthoringError for a mistake in it."""
    table = load_toml(path, "file of questions")
    questions = [_question(entry) for entry in table.array("question")]
    table.finish()
    if len(questions) < ASKED:
        raise table.error(None, f"there are {len(questions)} questions", f"write {ASKED} or more")
    return questions


def _question(entry: Table) -> Question:
    question = Question(entry.string("ask"), entry.string("answer"), tuple(entry.strings("wrong")))
    entry.finish()
    if not question.wrong:
        raise entry.error("wrong", "there is only one choice", "write wrong answers, too")
    return question


QUESTIONS = read_questions()


async def begin_quiz(context: TaskContext) -> str | None:
    """Ask some questions; what answers none of them ends the quiz."""
    right = 0
    for question in context.chance.sample(QUESTIONS, ASKED):
        asked = question.aloud(context.chance)
        heard = await verbs.ask(context, asked, PATIENCE, str(ANSWERS), retries=1)
        if not isinstance(heard, Utterance):
            return None
        given = heard.tags.get("answer", "")
        is_right = given == question.answer
        right += is_right
        words = PASSED if not given else context.chance.choice(RIGHT if is_right else WRONG)
        await verbs.say(context, words.format(question.answer))
    return _score(right)


def _score(right: int) -> str:
    if right == ASKED:
        return f"You got all {ASKED} right. That's a perfect score!"
    if right == 0:
        return (
            "You got none of them this time. Ask me to quiz you again, and you'll know three more."
        )
    return f"You got {right} of {ASKED} right. That was fun!"
