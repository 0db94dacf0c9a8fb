"""What people say around a command, and what the robot is called."""

import pytest

from hri.core.errors import AuthoringError
from hri.core.signals import Utterance
from hri.hal.recognizer import Hypothesis, Segment
from hri.speech.acceptance import judge
from hri.speech.grammar import load_grammar, parse
from hri.speech.grammar.loader import read_grammar
from hri.speech.turn import Turn


@pytest.fixture(scope="module")
def robin(companion):
    return companion.called("Robin")


def understood(grammar, text, **turn):
    found = judge(grammar, Segment(0, 1), Hypothesis(text, 0.99), turn=Turn(**turn))
    assert isinstance(found, Utterance), found
    return found


@pytest.mark.parametrize(
    ("text", "rule", "command"),
    [
        ("hey robin could you please turn left", "turn", "turn left"),
        ("could you tell me what time it is", "time", "what time it is"),
        ("robin go forward two meters please", "move", "go forward two meters"),
        ("um well i would like you to come here", "come", "come here"),
        ("excuse me what is your name", "name", "what is your name"),
        ("hi robin", "greet", "hi robin"),
        ("goodbye robin", "leave", "goodbye robin"),
        ("robin well i think see you later then", "leave", "see you later"),
        ("oh thank you robin that was kind of you", "thanks", "thank you"),
        ("i was wondering robin what time is it", "time", "what time is it"),
        ("robin stop", "stop", "stop"),
        ("please stop", "stop", "stop"),
        ("stop", "stop", "stop"),
    ],
)
def test_a_command_is_what_is_left_without_name_and_courtesies(robin, text, rule, command):
    found = understood(robin, text)
    assert (found.rule, found.command, found.text) == (rule, command, text)


@pytest.mark.parametrize("text", ["robin stop", "please stop", "hey robin be quiet please"])
def test_who_says_its_name_first_is_heard_over_its_voice(robin, text):
    assert understood(robin, text, is_speaking=True).rule in ("stop", "quiet")


def test_its_name_is_a_word_only_where_it_has_one(companion, robin):
    assert parse(companion, "robin stop") is None
    assert parse(companion, "robot stop") is not None
    assert parse(companion.called("Data"), "data stop") is not None
    assert companion.called("") is companion
    assert parse(robin, "robin") is None


@pytest.fixture
def framed(tmp_path):
    """Writes a grammar with a tag in the comment before its name; returns its path."""

    def write(tag, rules):
        path = tmp_path / "test.jsgf"
        path.write_text(f"#JSGF V1.0;\n/** {tag} */ grammar test;\n{rules}")
        return path

    return write


def test_answers_and_parts_have_no_frame(framed):
    rules = "/** @answer */ public <a> = sure; /** @part */ public <b> = left; public <c> = go;"
    grammar = load_grammar(framed("@before <nice>", f"{rules} <nice> = please;"))
    said = {text: parse(grammar, f"please {text}") is not None for text in ("sure", "left", "go")}
    assert said == {"sure": False, "left": False, "go": True}


@pytest.mark.parametrize("tag", ["@before", "@before nice", "@after <a> <b>"])
def test_a_frame_names_one_rule(framed, tag):
    _, errors = read_grammar(framed(tag, "public <go> = go;"))
    assert "needs the name of one rule" in str(errors[0])


def test_a_grammar_that_extends_another_has_its_frame(write):
    rules = "/** @extends companion */ grammar joke; public <joke> = tell me a joke;"
    path = write("")
    path.write_text(f"#JSGF V1.0; {rules}")
    grammar = load_grammar(path).called("Robin")
    assert understood(grammar, "robin could you tell me a joke please").command == "tell me a joke"


def test_a_frame_that_is_not_there_is_named(framed):
    with pytest.raises(AuthoringError, match="no rule <nice>"):
        load_grammar(framed("@before <nice>", "public <go> = go;"))
