"""The skills of docs/skills.md and docs/forms.md work as the pages show."""

import re

import pytest

from hri.core.clock import FakeClock
from hri.core.paths import house
from hri.robot import Robot
from hri.testing.dialogues import TYPED, played, read_dialogues, write_shown_files

PAGE = house() / "docs" / "skills.md"
FORMS = house() / "docs" / "forms.md"


@pytest.fixture
def plugged_in(tmp_path, monkeypatch):
    """Plugs in the skills of a page; their folder."""
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    monkeypatch.chdir(tmp_path)

    def plug_in(page):
        write_shown_files(page, tmp_path / "skills")
        return tmp_path / "skills"

    return plug_in


@pytest.fixture
def folder(plugged_in):
    """The skill of docs/skills.md."""
    return plugged_in(PAGE) / "fortune"


def robot(notice=print):
    return Robot("companion", "simulated", clock=FakeClock(), devices=TYPED, notice=notice)


def test_the_dialogue_of_the_page_goes_as_shown(folder):
    assert {path.name for path in folder.iterdir()} == {
        *("skill.toml", "grammar.jsgf", "replies.toml", "tasks.py")
    }
    (dialogue,) = read_dialogues(PAGE)
    assert dialogue.mistake(played(robot(), dialogue)) == ""


def test_the_line_about_a_broken_skill_is_as_shown(folder):
    replies = folder / "replies.toml"
    replies.write_text(replies.read_text().replace("tell_fortune", "tell_fortun"))
    lines = []
    robot(lines.append)
    (line,) = [one for one in lines if one.startswith("the skill")]
    assert line.replace(f"{folder.parents[1]}/", "") in PAGE.read_text()


def test_the_table_lists_the_skills_that_are_shipped():
    shipped = {path.parent.name for path in house().glob("apps/companion/skills/*/skill.toml")}
    assert set(re.findall(r"^\| `(\w+)` \| \"", PAGE.read_text(), re.MULTILINE)) == shipped


@pytest.mark.parametrize(
    "dialogue", read_dialogues(FORMS), ids=lambda dialogue: str(dialogue.place.line)
)
def test_the_dialogues_with_forms_go_as_shown(plugged_in, dialogue):
    assert {place.name for place in plugged_in(FORMS).iterdir()} == {"pizza", "meeting", "tea"}
    assert dialogue.mistake(played(robot(), dialogue)) == ""
