"""`hri skill`: what a maker meets."""

import json

import pytest

from hri.cli.main import main
from tests.robot.skills import skill, with_rule


@pytest.fixture(autouse=True)
def own(tmp_path, monkeypatch):
    """The folder of the user's own skills."""
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "settings"))
    monkeypatch.chdir(tmp_path)
    return tmp_path / "data" / "hri" / "skills"


def told(capsys, *words):
    """The exit status and the lines of a command."""
    status = main(["skill", *words])
    return status, capsys.readouterr().out.splitlines()


def listed(capsys):
    """The lines of the list, with one space between columns."""
    return [" ".join(line.split()) for line in told(capsys, "list")[1]]


def test_a_new_skill_is_plugged_in_passes_its_test_and_has_no_conflict(own, capsys):
    status, lines = told(capsys, "new", "magic")
    assert status == 0
    assert (
        lines[0] == f"{own / 'magic'}: a skill that draws cards so far; change what you like. Next:"
    )
    assert "magic on Draws cards." in listed(capsys)
    assert told(capsys, "test", "magic") == (0, ["magic: 1 dialogue as shown"])
    status, lines = told(capsys, "check", "magic")
    assert (status, lines[-1].startswith("magic: fine; 1 command")) == (0, True)


def test_a_new_skill_with_a_form_asks_and_keeps_its_timer(own, capsys):
    status, lines = told(capsys, "new", "brew", "--form")
    assert (status, lines[-1].endswith("say: make me some tea")) == (0, True)
    assert told(capsys, "test", "brew") == (0, ["brew: 1 dialogue as shown"])
    status, lines = told(capsys, "check", "brew")
    assert (status, lines[-1].startswith("brew: fine; 1 command")) == (0, True)


def test_a_skill_anywhere_is_tested_by_its_path(tmp_path, capsys):
    main(["skill", "new", "magic", "--to", "."])
    capsys.readouterr()
    assert "magic" not in "".join(told(capsys, "list")[1])
    assert told(capsys, "test", "./magic") == (0, ["magic: 1 dialogue as shown"])


def test_a_dialogue_that_goes_otherwise_is_told_with_its_place(own, capsys):
    main(["skill", "new", "magic"])
    page = own / "magic" / "README.md"
    page.write_text(page.read_text().replace("I draw up to five", "I draw up to six"))
    capsys.readouterr()
    status, lines = told(capsys, "test", "magic")
    assert status == 1
    assert lines == [
        f'magic: {page}:11:1: "I draw up to six cards." from robot: '
        '"I draw up to five cards." from robot instead'
    ]


def test_a_sentence_of_another_command_is_a_conflict(own, capsys):
    with_rule(own.parent, "halt", "own_stop", "stop | halt now", 'say = "I go on."')
    status, lines = told(capsys, "check", "halt")
    assert status == 1
    assert lines[0] == 'halt: "stop" counts as <stop>, not as <own_stop> - say it another way'


def test_a_broken_skill_is_listed_with_what_is_wrong(own, capsys):
    skill(own.parent, "bad", grammar="#JSGF V1.0;\ngrammar g;\npublic <x> = <y>;\n")
    status, lines = told(capsys, "check", "bad")
    assert status == 1
    assert lines[0].startswith(f"bad: {own / 'bad' / 'grammar.jsgf'}:3:14: ")
    skill(own.parent, "worse", skill="about")
    found = {one["name"]: one for one in json.loads("".join(told(capsys, "list", "--json")[1]))}
    assert found["worse"]["on"] is False
    assert "skill.toml" in found["worse"]["why"]
    assert found["dice"]["on"] is True


def test_a_skill_is_turned_off_and_on_again(capsys):
    assert told(capsys, "off", "dice")[0] == 0
    assert "dice off you turned it off" in listed(capsys)
    assert told(capsys, "test", "dice")[1] == ["dice: it is off - `hri skill on dice` turns it on"]
    assert told(capsys, "on", "dice")[0] == 0
    assert "dice on Rolls dice." in listed(capsys)


def test_an_unknown_skill_is_told_with_what_was_meant(capsys):
    assert main(["skill", "off", "dise"]) == 2
    assert 'companion has no skill "dise" - did you mean "dice"?' in capsys.readouterr().err
