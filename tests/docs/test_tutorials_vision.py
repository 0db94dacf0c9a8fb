"""The tutorials of vision: what they say is what the commands do."""

import json

import pytest

from hri.cli import behave
from hri.cli.main import main
from hri.core import paths
from tests.docs.tutorial import Tutorial


@pytest.fixture
def objects():
    return Tutorial("vision-01-objects")


@pytest.fixture
def colors():
    return Tutorial("vision-02-colors")


@pytest.fixture
def run(tmp_path, monkeypatch):
    """Runs the commands of a block, as from the checkout, and writes their files elsewhere."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))

    def run(block):
        for line in block.splitlines():
            words = [
                str(paths.house() / word) if word.startswith("docs/") else word
                for word in line.split()
            ]
            words = [str(tmp_path / word) if word in MADE else word for word in words]
            assert main(words[1:]) == 0, line

    def printed(text):
        return text.replace(f"{paths.house()}/", "").replace(f"{tmp_path}/", "")

    return run, printed


MADE = ("cards.mdl", "my_ball.color")


@pytest.mark.proves("R08")
def test_two_cards_are_taught_and_recognized_as_the_page_shows(objects, run, capsys):
    do, printed = run
    teach, test, watch = objects.blocks("console")
    do(teach)
    assert objects.prints(printed(capsys.readouterr().out), 0)
    do(test)
    assert objects.prints(printed(capsys.readouterr().out), 1)
    do(watch)
    row = json.loads(capsys.readouterr().out)
    assert {one["name"] for one in row["objects"]} == {"coffee", "rocket"}
    assert all(0.3 < one["distance_m"] < 0.8 for one in row["objects"])


@pytest.mark.proves("R10")
def test_a_ball_is_taught_and_found_as_the_page_shows(colors, run, capsys):
    do, printed = run
    teach, test, _ = colors.blocks("console")
    do(teach)
    assert colors.prints(printed(capsys.readouterr().out), 0)
    do(test)
    assert colors.prints(printed(capsys.readouterr().out), 1)


def test_the_excerpts_stand_in_the_files(colors):
    assert colors.strangers("xml") == []


def test_the_robot_goes_to_the_red_ball(colors, capsys):
    words = [
        str(paths.house() / word) if word.startswith("docs/") else word
        for word in colors.blocks("console")[2].split()[1:]
    ]
    assert behave.main([*words, "--fast"]) == 0
    assert "no failures" in capsys.readouterr().err
