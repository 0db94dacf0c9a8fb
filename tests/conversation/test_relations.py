"""`memory.toml`, and the rules that give its facts."""

from pathlib import Path

import pytest

from hri.conversation.relations import Relation, load_relations, remembered_by, source_of
from hri.core.errors import AuthoringError, HriError
from hri.speech.grammar import load_grammar

GOOD = """\
[relation.likes]
several = true
tell = "You like {value}."
ask = "Do you like {value}, {name}?"
ask_for = ["What do you like?", "What else do you do?"]
follow_up = ["How was your {value} evening?"]

[relation.birthday]
tell = "Your birthday is {value}."
"""


def written(folder: Path, text: str, name: str = "memory.toml") -> Path:
    file = folder / name
    file.write_text(text)
    return file


def test_relations_are_read(tmp_path: Path) -> None:
    found = load_relations([written(tmp_path, GOOD)])
    assert found == {
        "likes": Relation(
            "likes",
            "You like {value}.",
            several=True,
            ask=("Do you like {value}, {name}?",),
            ask_for=("What do you like?", "What else do you do?"),
            follow_up=("How was your {value} evening?",),
        ),
        "birthday": Relation("birthday", "Your birthday is {value}."),
    }
    assert load_relations([]) == {}


def test_a_later_file_adds_and_replaces(tmp_path: Path) -> None:
    own = '[relation.birthday]\ntell = "It is {value}."\n[relation.home]\ntell = "In {value}."\n'
    found = load_relations([written(tmp_path, GOOD), written(tmp_path, own, "own.toml")])
    assert list(found) == ["likes", "birthday", "home"]
    assert found["birthday"].tell == "It is {value}."


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ('tell = "You like it."', r":8:1: .*does not say the value - write \{value\} in it"),
        ("several = true", ':7:1: "tell" is missing'),
        ('tell = "{vlaue}"', r':8:1: nothing fills in \{vlaue\} - did you mean "value"\?'),
        ('tell = "{value:>9999}"', ":8:1: .*has a format"),
        ('tell = "{value"', ":8:1: .*close every"),
        ('tell = "{value}"\nask_for = "Is it {value}?"', ":9:1: ask_for .*or use ask"),
        ('tell = "{value}"\nfolow_up = "{value}?"', ':9:1: unknown key "folow_up" - did you'),
        ('tell = "{value}"\nseveral = 3', ":9:1: several is a number"),
        ('tell = "{value}"\nask = [1]', ":9:1: ask holds something"),
        ('tell = "{value} [snroe]"', ":8:1: "),
    ],
)
def test_a_mistake_is_told_with_its_place(tmp_path: Path, line: str, told: str) -> None:
    head = "\n" * 6
    with pytest.raises(AuthoringError, match=told):
        load_relations([written(tmp_path, f"{head}[relation.home]\n{line}\n")])


def test_all_mistakes_of_a_file_are_told(tmp_path: Path) -> None:
    text = '[relation.a]\ntell = "x"\n[relation."b c"]\ntell = "{value}"\n[relatoin.c]\n'
    with pytest.raises(HriError) as error:
        load_relations([written(tmp_path, text)])
    assert len(str(error.value).splitlines()) == 3


def a_grammar(folder: Path, mark: str) -> Path:
    text = (
        f"#JSGF V1.0;\ngrammar g;\n/** They like it. {mark} */\npublic <l> = i like (jazz | tea);\n"
    )
    return written(folder, text, "g.jsgf")


def test_a_rule_says_what_it_is_remembered_as(tmp_path: Path) -> None:
    relations = load_relations([written(tmp_path, GOOD)])
    grammar = load_grammar(a_grammar(tmp_path, "@remember likes"))
    assert remembered_by(grammar.rules, relations) == {"l": "likes"}


@pytest.mark.parametrize(
    ("mark", "told"),
    [
        ("@remember lieks", r'g\.jsgf:3:19: .*"lieks".* did you mean "likes"'),
        ("@remember shoe", r"g\.jsgf:3:19: .*add \[relation.shoe\]"),
        ("@remember", r"g\.jsgf:3:19: .*add \[relation.NAME\]"),
    ],
)
def test_a_mark_of_no_relation_is_told_with_its_place(tmp_path: Path, mark: str, told: str) -> None:
    relations = load_relations([written(tmp_path, GOOD)])
    grammar = load_grammar(a_grammar(tmp_path, mark))
    with pytest.raises(AuthoringError, match=told):
        remembered_by(grammar.rules, relations)


def test_the_rule_that_gives_a_fact_is_found_with_its_tag(tmp_path: Path) -> None:
    file = tmp_path / "g.jsgf"
    rules = """
/** @remember likes */
public <likes> = i like <likes.spoken 1-3> [a lot {degree=high}];
/** @remember birthday */
public <birthday> = my birthday is on may third {day="May third"};
/** @remember home */
public <home> = i live in ohio {state=Ohio} usa {country=USA};
"""
    file.write_text(f"#JSGF V1.0;\ngrammar g;\n{rules}")
    grammar = load_grammar(file)
    relations = ("likes", "birthday", "home", "cat")
    assert source_of("likes", grammar, relations) == ("likes", "likes")
    assert source_of("birthday", grammar, relations) == ("birthday", "day")
    assert source_of("home", grammar, relations) is None, "either tag may be the words"
    assert source_of("cat", grammar, relations) is None
