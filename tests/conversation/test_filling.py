"""A form that is filled by word, by nod, and where a value was unclear."""

import pytest

from hri.conversation.filling import fill
from hri.conversation.forms import load_forms
from hri.core import FakeClock
from hri.robot import Robot
from hri.speech.behaviors import Listener
from hri.testing import live_for
from tests.conversation.test_forms import FORM, GRAMMAR
from tests.devices import TYPED

BOTH = ("olives", "bacon")


@pytest.fixture
def filled(tmp_path):
    """What a form is filled with, and what was asked; `answers` are typed, or raised as events."""
    (tmp_path / "pizza.jsgf").write_text(GRAMMAR)
    (tmp_path / "forms.toml").write_text(FORM)
    form = load_forms([tmp_path / "forms.toml"])["pizza"]

    def run(answers, known):
        robot = Robot("companion", "simulated", clock=FakeClock(), devices=TYPED)
        left, asked, found = list(answers), [], []

        def respond(event):
            asked.append(event.properties["text"])
            answer = left.pop(0) if left else ""
            if isinstance(answer, str):
                robot.context.behavior(Listener).type_line(answer)
                return
            name, properties = answer
            later = event.time + 0.2
            robot.clock.call_at(later, lambda: robot.events.raise_event(name, **properties))

        async def job(context):
            await context.clock.sleep(0.5)
            found.append(await fill(context, form, known))
            robot.finish()

        robot.events.subscribe("question.asked", respond)
        live_for(robot, 60.0, job)
        return found[0], asked

    return run


def unsure(text, tag):
    return ("speech.rejected", {"text": text, "unsure": [tag], "sure": {}, "reason": ""})


def test_a_nod_confirms_and_a_shake_does_not(filled):
    known = {"size": "small", "toppings": ("olives",)}
    assert filled([("head.nodded", {})], known)[0] == known
    assert filled([("head.shaken", {})], known)[0] is None


def test_one_answer_by_two_rules_is_clear(filled):
    found, asked = filled(["could i have olives on it", "yes"], {"size": "small"})
    assert found == {"size": "small", "toppings": ("olives",)}
    assert len(asked) == 2


def test_what_was_unclear_is_asked_for_by_the_question_of_its_slot(filled):
    values, asked = filled([unsure("small", "size"), "large", "olives", "yes"], {})
    assert values == {"size": "large", "toppings": ("olives",)}
    assert asked[:3] == ["Which size?", "Which size?", "With which toppings?"]


def test_what_is_unclear_twice_and_the_same_counts(filled):
    values, asked = filled([unsure("small", "size"), unsure("small", "size"), "bacon", "yes"], {})
    assert values == {"size": "small", "toppings": ("bacon",)}
    assert asked[2] == "With which toppings?"


def test_who_does_not_know_hears_what_may_be_said(filled):
    values, asked = filled(["i don't know", "small", "olives", "um i'm not sure", "yes"], {})
    assert values == {"size": "small", "toppings": ("olives",)}
    assert asked[1] == 'You can say "small" or "large". Which size?'
    assert asked[-2] == asked[-1]


@pytest.mark.parametrize("answers", [["stop"], ["never mind"], ["", ""], ["no"]])
def test_a_form_is_given_up_by_word_and_by_silence(filled, answers):
    assert filled(answers, {})[0] is None


def test_who_never_decides_is_not_asked_forever(filled):
    values, asked = filled(["change the size"] * 99, {"size": "small"})
    assert values is None
    assert len(asked) == 9


@pytest.mark.parametrize(
    ("answers", "toppings"),
    [
        (["no olives", "yes"], ("bacon",)),
        (["no olives", "no bacon", "yes"], ""),
        (["add olives", "yes"], ("olives", "bacon")),
        (["no toppings", "add bacon", "yes"], ("bacon",)),
        (["bacon instead of olives", "yes"], ("bacon",)),
    ],
)
def test_a_list_gets_longer_and_shorter(filled, answers, toppings):
    known = {"size": "small", "toppings": ("olives", "bacon")}
    assert filled(answers, known)[0] == {"size": "small", "toppings": toppings}


def test_no_may_mean_another_answer_and_without_may_not(filled):
    values, asked = filled(["without olives", "no olives", "yes"], {"size": "small"})
    assert values == {"size": "small", "toppings": ("olives",)}
    assert asked[:2] == ["With which toppings?"] * 2


@pytest.mark.parametrize("answer", ["no the size", "no the size not now"])
def test_a_slot_that_is_named_with_a_no_is_asked_for_again(filled, answer):
    values, asked = filled([answer, "large", "yes"], {"size": "small", "toppings": ("olives",)})
    assert values == {"size": "large", "toppings": ("olives",)}
    assert asked[1] == "Which size?"


@pytest.mark.parametrize(
    ("answers", "values"),
    [
        (["yep go"], {"size": "small", "toppings": ("olives",)}),
        (["no make it large and add bacon", "yes"], {"size": "large", "toppings": BOTH}),
        (["yes but wait", "yes"], {"size": "small", "toppings": ("olives",)}),
        (["no we already ate", "nothing"], None),
    ],
)
def test_a_yes_and_a_no_may_have_more_behind_them(filled, answers, values):
    assert filled(answers, {"size": "small", "toppings": ("olives",)})[0] == values


def test_a_no_with_a_reason_answers_no_other_question(filled):
    values, asked = filled(["no you choose that", "large", "olives", "yes"], {})
    assert values == {"size": "large", "toppings": ("olives",)}
    assert asked[:2] == ["Which size?", "Which size?"]
