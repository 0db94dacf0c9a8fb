"""Every command explains itself."""

from importlib.metadata import entry_points

import pytest

from hri.cli import main
from hri.core.errors import HriError
from hri.robot import Robot

SCRIPTS = sorted(
    (entry for entry in entry_points(group="console_scripts") if entry.value.startswith("hri.")),
    key=lambda entry: entry.name,
)


@pytest.mark.proves("P10")
@pytest.mark.parametrize("entry", SCRIPTS, ids=lambda entry: entry.name)
def test_a_script_explains_itself(entry, capsys):
    try:
        status = entry.load()(["--help"])
    except SystemExit as end:
        status = end.code
    assert status == 0
    assert "usage" in capsys.readouterr().out.lower()


@pytest.mark.proves("P10")
@pytest.mark.parametrize("name", main.COMMANDS)
def test_a_command_explains_itself(name, capsys):
    with pytest.raises(SystemExit) as end:
        main.main([name, "--help"])
    assert end.value.code == 0
    shown = capsys.readouterr().out
    assert f"usage: hri {name}" in shown
    assert main.COMMANDS[name][1].split()[0] in shown


@pytest.mark.parametrize(
    "words", [("run", "companion", "--record", ""), ("bench", "inputs", "--keep", "")]
)
def test_an_empty_name_is_not_the_current_folder(words, capsys):
    with pytest.raises(SystemExit) as end:
        main.main(words)
    assert end.value.code == 2
    assert f"argument {words[2]}: an empty name - name a file" in capsys.readouterr().err


def test_a_robot_does_not_record_into_a_folder_without_a_name():
    with pytest.raises(HriError, match="an empty name of a folder"):
        Robot(record="")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("new ap x", 'no "ap" - did you mean "app"?'),
        ("face lst", 'no "lst" - did you mean "list"?'),
    ],
)
def test_a_mistyped_choice_is_suggested(words, message, capsys):
    with pytest.raises(SystemExit) as ended:
        main.main(words.split())
    assert ended.value.code == 2
    assert message in capsys.readouterr().err
