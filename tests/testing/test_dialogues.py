"""Dialogues of a page: how they are read, and when they went as shown."""

import pytest

from hri.core.errors import AuthoringError
from hri.testing.dialogues import read_dialogues

PAGE = """# Dice

```dialogue
you: roll [two] dice?
robot: I rolled * and *.
```

    you: not this

```dialogue
you: hello
```
"""


@pytest.fixture
def dialogue(tmp_path):
    (tmp_path / "page.md").write_text(PAGE)
    first, second = read_dialogues(tmp_path / "page.md")
    assert second.lines == (("you", "hello"),)
    assert first.place.line == 4
    return first


ROLL = ("you", "roll [two] dice?")


@pytest.mark.parametrize(
    ("happened", "mistake"),
    [
        ([ROLL, ("robot", "I rolled 5 and 2.")], ""),
        ([ROLL, ("robot", "I rolled 5 and 2."), ("robot", "Again?")], ""),
        ([ROLL], "nothing more instead"),
        ([ROLL, ("robot", "No.")], '"No." from robot instead'),
        ([ROLL, ROLL], "from you instead"),
        ([], "nothing more instead"),
    ],
)
def test_a_star_stands_for_any_words_and_nothing_else_does(dialogue, happened, mistake):
    told = dialogue.mistake(happened)
    assert bool(told) is bool(mistake)
    assert mistake in told


def test_a_mistake_has_its_place(dialogue):
    assert dialogue.mistake([ROLL]).partition(": ")[0].endswith("page.md:5:1")


@pytest.mark.parametrize("wait", ["a while", "2 hours", "3 weeks", "-1 minutes", "nan seconds"])
def test_a_wait_is_a_time_up_to_an_hour(tmp_path, wait):
    page = tmp_path / "page.md"
    page.write_text(f"```dialogue\nyou: hello\nwait: {wait}\n```\n")
    with pytest.raises(AuthoringError, match=r"page\.md:3:1: .* is not a time up to an hour"):
        read_dialogues(page)


def test_a_line_that_nobody_says_has_its_place(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("\n```dialogue\nyou: hello\nRobot: hi\n```\n")
    with pytest.raises(AuthoringError, match=r"page\.md:4:1: nobody says the line"):
        read_dialogues(page)
