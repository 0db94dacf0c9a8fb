"""What holds for every page in docs/tutorials."""

import re

import pytest

from tests.docs.tutorial import FOLDER, Tutorial

NAMES = sorted(path.parent.name for path in FOLDER.glob("*/README.md"))
OURS = ("task-", "python-", "behavior-03-", "behavior-04-", "speech-")


@pytest.mark.parametrize("name", [name for name in NAMES if name.startswith(OURS)])
def test_excerpts_are_what_the_programs_say(name):
    tutorial = Tutorial(name)
    assert tutorial.strangers() == []
    assert 30 <= len(tutorial.page.splitlines()) <= 110


@pytest.mark.parametrize("name", NAMES)
def test_links_lead_somewhere(name):
    words = re.sub(r"^```.*?^```", "", Tutorial(name).page, flags=re.DOTALL | re.MULTILINE)
    for link in re.findall(r"\]\(([^)#]+)\)", words):
        if "://" not in link:
            assert (FOLDER / name / link).exists(), link


def test_the_index_leads_to_every_page():
    index = (FOLDER / "README.md").read_text()
    assert sorted(re.findall(r"\]\(([\w-]+)/README\.md\)", index)) == NAMES


@pytest.mark.parametrize("name", NAMES)
def test_commands_name_files_that_are_there(name):
    for command in "".join(Tutorial(name).blocks("console")).splitlines():
        for path in re.findall(r"docs/\S+", command):
            assert (FOLDER.parents[1] / path).exists(), command
