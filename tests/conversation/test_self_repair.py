"""What an answer says in the end that takes back, adds and leaves out as it goes."""

from datetime import datetime

import pytest
from hypothesis import given, strategies as st

from hri.conversation.alarms import completed, meant
from hri.conversation.form_grammar import SEVERAL, form_grammar
from hri.conversation.forms import load_forms
from hri.conversation.self_repair import change_of, own_words
from hri.core.paths import house
from hri.speech.grammar import load_grammar, parse
from tests.conversation.test_forms import FORM, GRAMMAR

TIMERS = house() / "apps" / "companion" / "skills" / "timers" / "forms.toml"
WORDS = ("no", "not", "olives", "bacon", "small", "large", "or", "and", "add", "wait", "but")
BOTH = ("olives", "bacon")


@pytest.fixture(scope="module")
def told(tmp_path_factory):
    """The slots of a form behind an answer, by what they were before; None for an unclear one."""
    folder = tmp_path_factory.mktemp("forms")
    (folder / "pizza.jsgf").write_text(GRAMMAR)
    (folder / "forms.toml").write_text(FORM)
    forms = load_forms([folder / "forms.toml", TIMERS])
    own = {
        name: own_words(form_grammar(form, load_grammar(form.grammar)))
        for name, form in forms.items()
    }

    def told(text, values=None, name="pizza"):
        change = change_of(own[name], forms[name], text, values or {})
        return None if change is None else change.told(values or {})

    return told


@pytest.mark.parametrize(
    ("text", "slots"),
    [
        ("a small one dear with olives if you have them", {"size": "small", "toppings": BOTH[:1]}),
        ("a small one but not with olives", {"size": "small", "toppings": None}),
        ("with bacon not olives please", {"toppings": ("bacon",)}),
        ("olives instead of bacon i guess", {"toppings": ("olives",)}),
        ("large not small and with olives", {"size": "large", "toppings": ("olives",)}),
        ("small don't forget the bacon", {"size": "small", "toppings": ("bacon",)}),
        ("small forget the bacon", {"size": "small", "toppings": None}),
        ("no wait a small one", {"size": "small"}),
        ("olives um no not olives bacon", {"toppings": ("bacon",)}),
        ("olives are yucky just bacon", {"toppings": ("bacon",)}),
        ("olives no bacon", {"toppings": ("bacon",)}),
        ("small with olives and bacon no olives", {"size": "small", "toppings": ("bacon",)}),
        ("bacon please and no yucky olives", {"toppings": ("bacon",)}),
        ("large no bacon", {"size": "large", "toppings": None}),
        ("everything except olives", {"toppings": ("bacon",)}),
        ("bacon and just one olive", {"toppings": ("bacon", "olives")}),
        ("a small one if you don't mind", {"size": "small"}),
        ("oh i don't eat so much any more a small one will do", {"size": "small"}),
        ("i don't know if small", None),
        ("small or large", None),
        ("large or no wait small", {"size": "small"}),
        ("oh you don't have that then bacon", {"toppings": ("bacon",)}),
        ("i'm not that hungry so small", {"size": "small"}),
        ("they'd rather have bacon", {"toppings": ("bacon",)}),
        ("small no", None),
        ("what can i have", {}),
    ],
)
def test_what_is_taken_back_does_not_count(told, text, slots):
    assert told(text) == slots


@pytest.mark.parametrize(
    ("text", "slots"),
    [
        ("large with bacon no wait small", {"size": "small", "toppings": ("bacon",)}),
        ("small no hang on there's four of us large", {"size": "large"}),
    ],
)
def test_a_repair_keeps_what_it_does_not_name(told, text, slots):
    assert told(text) == slots


@pytest.mark.parametrize(
    ("text", "toppings"),
    [
        ("no make it large and add bacon", BOTH),
        ("hang on can i still add bacon", BOTH),
        ("could you put bacon on as well", BOTH),
        ("hmm can you put some bacon on it too", BOTH),
        ("and leave off the olives", ""),
        ("could you take the olives off", ""),
        ("hang on my daughter hates olives leave them off", ""),
        ("bacon too please", BOTH),
        ("and bacon", BOTH),
        ("large please and no olives but bacon", ("bacon",)),
        ("bacon instead of olives", ("bacon",)),
        ("i don't want olives", ""),
        ("she's not eating with us put the bacon back on", BOTH),
    ],
)
def test_a_list_is_changed_among_other_words(told, text, toppings):
    assert told(text, {"size": "small", "toppings": ("olives",)})["toppings"] == toppings


def test_what_is_not_to_be_added_is_not(told):
    assert told("i don't want you to add bacon", {"size": "small", "toppings": BOTH[:1]}) is None


def test_what_is_not_wanted_any_more_is_asked_for_again(told):
    assert told("not small", {"size": "small"}) == {"size": None}
    assert told("not small", {"size": "large"}) == {}


@pytest.mark.parametrize(
    ("text", "minutes"),
    [
        ("seven minutes no make that eight", 8),
        ("an hour and ten minutes no twenty", 80),
        ("five no seven minutes please", 7),
        ("two eggs so six minutes", 6),
        ("ten hours no twelve", 720),
        ("ten minutes no an hour", 60),
        ("thirty no forty minutes", 40),
        ("five", 5),
    ],
)
def test_a_part_of_an_answer_is_replaced(told, text, minutes):
    assert told(text, name="timer") == {"duration": 60.0 * minutes}


def test_a_short_answer_is_heard_behind_other_words():
    form = load_forms([TIMERS])["timer"]
    found = parse(form_grammar(form, load_grammar(form.grammar)), "ha ha good okay five then")
    assert (found.rule, found.tags) == (SEVERAL, {"duration": 300.0})


@pytest.mark.parametrize(
    ("text", "when"),
    [
        ("seven in the morning oh no make it nine", "09:00am"),
        ("seven in the evening no eight", "08:00pm"),
        ("tomorrow at seven no eight", "+1 08:00?"),
        ("at seven tomorrow no friday", "friday 07:00?"),
        ("seven in the morning no in ten minutes", "in 600"),
        ("half past six no seven", "07:00?"),
        ("in thirty no forty minutes", "in 2400"),
        ("in an hour no wait two hours", "in 7200"),
        ("seven in the morning no better half past six", "06:30am"),
    ],
)
def test_a_time_keeps_its_half_of_the_day_and_its_day(told, text, when):
    assert told(text, name="alarm") == {"when": when}


@pytest.mark.parametrize(
    ("value", "before", "found"),
    [
        ("09:00?", "07:00", "09:00am"),
        ("12:00?", "19:00", "12:00pm"),
        ("13:00?", "07:00", "13:00?"),
        ("friday", "+1 07:00?", "friday 07:00?"),
        ("06:30?", "+1 09:00~", "+1 06:30am"),
        ("07:00?", "+0 19:00~", "+0 07:00pm"),
        ("+1 09:00~", "07:00?", "+1 07:00am"),
        ("+1 19:00~", "+1 09:00~", "+1 19:00~"),
        ("friday", "+1 09:00~", "friday 09:00~"),
        ("09:00?", "+1", "+1 09:00?"),
        ("09:00?", None, "09:00?"),
        ("Monday", "Tuesday", "Monday"),
        ("feed the cat", "call mom at 12:00", "feed the cat"),
        (10.0, 9.0, 10.0),
        ("", "07:00", ""),
    ],
)
def test_a_time_is_completed_by_the_one_before(value, before, found):
    assert completed(value, before) == found


CLOCKS = st.times().map(lambda time: f"{time:%H:%M}")
DAYS = st.sampled_from(["", "+1 ", "friday ", "next monday "])


@given(DAYS, CLOCKS, DAYS, CLOCKS, st.sampled_from(["", "?", "~", "am", "pm"]))
def test_a_completed_time_is_one(day, clock, day_before, clock_before, half):
    found = completed(f"{day}{clock}?", f"{day_before}{clock_before}{half}")
    meant(found, datetime(2026, 5, 1, 10, 0))


@given(st.lists(st.sampled_from(WORDS)))
def test_any_words_are_read(told, words):
    told(" ".join(words), {"size": "small", "toppings": ("olives",)})
