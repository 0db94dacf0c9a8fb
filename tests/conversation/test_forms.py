"""Forms as they are read, and what is understood while one is open."""

import pytest

from hri.conversation.form_grammar import form_grammar
from hri.conversation.forms import NOTHING, load_forms
from hri.core.errors import AuthoringError
from hri.speech.grammar import load_grammar, parse

GRAMMAR = """#JSGF V1.0;
grammar pizza;
public <pizza> = <size> [pizza | one] [with <toppings>] | [with] <toppings>;
public <size> = small {size=small} | large {size=large};
public <toppings> = <topping> {toppings+=$topping} ([and] <topping> {toppings+=$topping})*;
<topping> = olives {topping=olives} | bacon {topping=bacon};
"""
SLOTS = """
[[form.pizza.slot]]
name = "size"
ask = "Which size?"
[[form.pizza.slot]]
name = "toppings"
ask = "With which toppings?"
none = "nothing on it"
"""
FORM = '[form.pizza]\nconfirm = "A {size} pizza with {toppings}?"\n' + SLOTS


@pytest.fixture
def load(tmp_path):
    (tmp_path / "pizza.jsgf").write_text(GRAMMAR)

    def load(text):
        (tmp_path / "forms.toml").write_text(text)
        return load_forms([tmp_path / "forms.toml"])

    return load


@pytest.fixture
def pizza(load):
    return load(FORM)["pizza"]


def test_the_first_slot_that_is_empty_is_asked_for(pizza):
    assert pizza.next_slot({}).ask == "Which size?"
    assert pizza.next_slot({"size": "small"}).name == "toppings"
    assert pizza.next_slot({"size": "small", "toppings": NOTHING}) is None


@pytest.mark.parametrize(
    ("toppings", "said"),
    [
        (("olives",), "olives"),
        (("olives", "bacon"), "olives and bacon"),
        (("olives", "bacon", "corn"), "olives, bacon and corn"),
        (NOTHING, "nothing on it"),
        (2.0, "2"),
    ],
)
def test_slots_are_said_as_people_do(pizza, toppings, said):
    values = {"size": "small", "toppings": toppings}
    assert pizza.filled_in(pizza.confirm, values) == f"A small pizza with {said}?"


def test_a_value_is_in_a_list_once(pizza):
    taken = pizza.taken({"size": "small", "toppings": ("bacon", "olives", "bacon"), "other": 1})
    assert taken == {"size": "small", "toppings": ("bacon", "olives")}


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("[form.pizza]\n", "has no slot"),
        (FORM.replace('"size"', '"sizes"'), 'gives no tag "sizes" - did you mean "size"?'),
        (FORM.replace("{size}", "{sice}"), "sice"),
        (FORM.replace("confirm", "confrim"), 'did you mean "confirm"?'),
        (FORM.replace("form.pizza", "form.piza"), 'did you mean "pizza"?'),
        (FORM.replace("ask =", "aks ="), "ask"),
        (FORM.replace("[form.pizza]", '[form.pizza]\ngrammar = "../x"'), "../x"),
    ],
)
def test_a_mistake_has_its_place(load, text, what):
    with pytest.raises(AuthoringError) as error:
        load(text)
    assert what in str(error.value)
    assert "forms.toml:" in str(error.value)


@pytest.mark.parametrize(
    ("text", "rule", "tags"),
    [
        ("a large one please", "pizza", {"size": "large"}),
        ("no a small one", "pizza", {"size": "small"}),
        ("no wait make it small with olives", "pizza", {"size": "small", "toppings": ("olives",)}),
        ("sorry i meant bacon", "pizza", {"toppings": ("bacon",)}),
        ("actually large", "pizza", {"size": "large"}),
        ("medium no wait large", "pizza", {"size": "large"}),
        ("sorry medium no make it large please", "pizza", {"size": "large"}),
        ("the size should be large", "pizza", {"slot": "size", "size": "large"}),
        ("no the size it's small", "pizza", {"slot": "size", "size": "small"}),
        ("no toppings", "form.empty", {"toppings": ""}),
        ("nothing on it thanks", "form.empty", {"toppings": ""}),
        (
            "a small one dear with olives if you have them",
            "form.several",
            {"size": "small", "toppings": ("olives",)},
        ),
        ("add bacon", "form.more", {"toppings": ("bacon",)}),
        ("and bacon too", "form.more", {"toppings": ("bacon",)}),
        ("everything please", "form.all", {"toppings": ("olives", "bacon")}),
        ("yep go", "form.agreed", {}),
        ("no we already ate", "form.refused", {}),
        ("no olives", "form.less", {"toppings": ("olives",)}),
        ("nothing on it just plain", "form.several", {"toppings": ""}),
        ("change the size", "form.slot", {"slot": "size"}),
        ("the toppings please", "form.slot", {"slot": "toppings"}),
        ("yes please", "answers.yes", {}),
        ("no", "answers.no", {}),
        ("nothing", "answers.no", {}),
        ("never mind", "asking.cancel", {}),
        ("hmm you know what never mind", "asking.cancel", {}),
        ("oh never mind about the pizza we already ate", "asking.cancel", {}),
        ("what did you say", "asking.again", {}),
    ],
)
def test_people_answer_correct_and_cancel_in_their_words(pizza, text, rule, tags):
    found = parse(form_grammar(pizza, load_grammar(pizza.grammar)), text)
    assert (found.rule, found.tags) == (rule, tags)
