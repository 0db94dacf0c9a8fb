"""Which question the robot asks next."""

from dataclasses import dataclass
from datetime import datetime, timedelta

from hypothesis import given, strategies as st

from hri.conversation.curiosity import Curiosity

MORNING = datetime(2026, 5, 4, 9, 30)


@dataclass(frozen=True)
class Asked:
    ask: str
    hour: tuple[str, ...] = ()
    once: str = ""
    after: tuple[str, ...] = ()
    feeling: tuple[str, ...] = ()


SLEPT = Asked("Did you sleep well?", ("morning",), "day")
FACE = Asked("Do you like my face?")
QUICK = Asked("Was I quick enough?", after=("move", "turn"))
MUSIC = Asked("Do you like music?")
CHEER = Asked("Will you cheer me up?", feeling=("sad", "anger"))


def asked(curiosity, questions, heard, at, feeling="calm"):
    place = curiosity.choose(questions, heard, feeling, at)
    if place is None:
        return None
    curiosity.note(questions[place].ask, at)
    return questions[place]


def test_a_question_for_the_morning_is_asked_then_and_once_a_day():
    curiosity = Curiosity("x")
    assert curiosity.choose([SLEPT], [], "calm", MORNING + timedelta(hours=8)) is None
    assert asked(curiosity, [SLEPT], [], MORNING) is SLEPT
    assert curiosity.choose([SLEPT], [], "calm", MORNING + timedelta(hours=1)) is None
    assert curiosity.choose([SLEPT], [], "calm", MORNING + timedelta(days=1)) == 0


def test_what_people_said_gives_an_occasion_that_comes_first():
    curiosity = Curiosity("x")
    questions = [FACE, QUICK, SLEPT]
    assert curiosity.choose([QUICK], ["greet"], "calm", MORNING) is None
    order = [asked(curiosity, questions, ["turn", "greet"], MORNING) for _ in range(3)]
    assert order == [QUICK, SLEPT, FACE]


def test_what_it_feels_gives_an_occasion_too():
    questions = [FACE, CHEER, SLEPT]
    assert asked(Curiosity("x"), questions, [], MORNING, "disappointment") is CHEER
    assert asked(Curiosity("x"), questions, [], MORNING, "anger") is CHEER
    for feeling in ("calm", "joy", "reproach"):
        assert asked(Curiosity("x"), [CHEER], [], MORNING, feeling) is None


def test_no_run_begins_like_all_others():
    questions = [FACE, MUSIC, *(Asked(f"Question {n}?") for n in range(4))]
    first = {Curiosity(f"run {run}").choose(questions, [], "calm", MORNING) for run in range(30)}
    assert len(first) >= 4


@given(st.text(), st.integers(1, 6))
def test_all_are_asked_before_one_comes_again(seed, count):
    curiosity = Curiosity(seed)
    questions = [Asked(f"{number}?") for number in range(count)]
    order = [asked(curiosity, questions, [], MORNING) for _ in range(2 * count)]
    assert {*order[:count]} == {*questions}
    assert order[count:] == order[:count]
