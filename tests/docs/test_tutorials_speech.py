"""The tutorials of speech, run on the robot's own voice and on fake time."""

import pytest

from hri.cli.main import main
from hri.core.clock import FakeClock
from tests.docs.tutorial import Tutorial

GRAMMAR = "speech-01-grammar"
HEARING = "speech-02-hearing"


def test_the_meanings_are_those_of_the_page(capsys):
    tutorial = Tutorial(GRAMMAR)
    tutorial.load("lamp.py").main()
    assert tutorial.prints(capsys.readouterr().out)


@pytest.mark.parametrize("command", ["check", "expand", "test"])
def test_the_tools_find_nothing_wrong_with_the_lamp(command, capsys):
    name = "lamp.txt" if command == "test" else "lamp.jsgf"
    assert main(["grammar", command, str(Tutorial(GRAMMAR).folder / name)]) == 0
    assert capsys.readouterr().out


def test_excerpts_of_the_grammar_are_what_its_file_says():
    tutorial = Tutorial(GRAMMAR)
    source = (tutorial.folder / "lamp.jsgf").read_text()
    assert all(excerpt in source for excerpt in tutorial.blocks("jsgf"))


def test_what_is_heard_is_what_the_page_shows(capsys):
    tutorial = Tutorial(HEARING)
    tutorial.load("hearing.py").main(FakeClock())
    assert tutorial.prints(capsys.readouterr().out)


def test_the_network_of_the_page_is_the_one_of_the_file():
    assert Tutorial(HEARING).strangers("xml") == []
