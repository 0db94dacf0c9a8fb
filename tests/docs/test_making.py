"""The page for makers: what it shows works when it is copied."""

import re
import shutil
import subprocess

import pytest

from hri.cli.main import main
from hri.core import paths
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.hal.configuration import load_configuration
from hri.hal.resource_manager import ResourceManager
from hri.robot import Robot
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for
from hri.testing.dialogues import played, read_dialogues
from tests.devices import TYPED

PAGE = (paths.house() / "docs" / "making.md").read_text()
FILES = re.findall(r"^`(\w+)/([\w.]+)`\n\n```\w*\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)


@pytest.fixture
def copied(tmp_path, monkeypatch):
    """The folders of the page."""
    for folder, file, text in FILES:
        (tmp_path / folder).mkdir(exist_ok=True)
        (tmp_path / folder / file).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def said_by(folder, lines, seconds):
    robot = Robot(str(folder), "simulated", clock=FakeClock(), devices=TYPED)
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    for time, line in lines.items():
        robot.clock.call_at(time, lambda line=line, time=time: keyboard.type_line(line, time))
    events = live_for(robot, seconds, *robot.app.load_tasks())
    names = {event.name for event in events}
    return [e.properties["text"] for e in events if e.name == "speech.said"], names


def test_the_fortune_of_the_page_is_told(copied):
    assert sum(text.count("\n") for folder, _, text in FILES if folder == "fortune") == 5
    said, _ = said_by(copied / "fortune", {1.0: "tell my fortune"}, 4)
    assert said == ["You will soon speak to a robot."]


@pytest.mark.slow
def test_the_timer_of_the_page_rings(copied):
    said, names = said_by(copied / "kitchen", {1.0: "set a timer for three seconds"}, 7)
    assert said == ["Okay, I'll let you know.", "3 seconds are over."]
    assert {"timer.ended", "gesture.ended"} <= names


TALKS = read_dialogues(paths.house() / "docs" / "making.md")


@pytest.mark.slow
@pytest.mark.parametrize("dialogue", TALKS, ids=lambda dialogue: str(dialogue.place.line))
def test_the_talks_of_the_page_go_as_shown(copied, dialogue):
    robot = Robot(str(copied / "pizza"), "simulated", clock=FakeClock(), devices=TYPED)
    assert dialogue.mistake(played(robot, dialogue)) == ""


def test_the_bell_of_the_page_rings_when_its_button_is_pressed(copied):
    robot = Robot(str(copied / "bell"), "simulated", clock=FakeClock(), devices=TYPED)
    robot.visitor.press(after=1.0)
    events = live_for(robot, 3.0, *robot.app.load_tasks())
    said = [event.properties["text"] for event in events if event.name == "speech.said"]
    assert said == ["Someone is at the door."]
    assert {"button.pressed", "button.released"} <= {event.name for event in events}


def test_the_devices_of_the_page_are_ones_that_a_configuration_takes(tmp_path):
    devices = re.findall(r'^<Device id="button".*$', PAGE, re.MULTILINE)
    assert len(devices) == 2
    for device in devices:
        path = tmp_path / "devices.xml"
        path.write_text(f"<Resources><Devices>{device}</Devices></Resources>")
        ResourceManager(load_configuration(path).devices, FakeClock()).check()


def test_what_a_sentence_means_is_as_shown(copied, capsys):
    main(["grammar", "parse", "kitchen/grammar.jsgf", "set a timer for two minutes"])
    shown = re.findall(r"^```text\n(.*?)^```", PAGE, re.DOTALL | re.MULTILINE)[0]
    assert capsys.readouterr().out.startswith(shown)


def test_the_message_of_the_page_is_what_is_said(copied):
    tasks = copied / "kitchen" / "tasks.py"
    tasks.write_text(tasks.read_text().replace("seconds", "second"))
    with pytest.raises(AuthoringError) as error:
        Robot("./kitchen", "simulated", clock=FakeClock())
    assert str(error.value).splitlines()[0] in PAGE


@pytest.mark.skipif(shutil.which("make") is None, reason="no make")
@pytest.mark.parametrize("target", [".venv/.run", ".venv/.dev"])
def test_setting_up_tells_what_is_fetched_and_from_where(target):
    words = ["make", "-n", "-W", "pyproject.toml", target]
    done = subprocess.run(words, cwd=paths.house(), capture_output=True, text=True, check=True)
    (told,) = (line for line in done.stdout.splitlines() if "fetching packages from" in line)
    installs = [line for line in done.stdout.splitlines() if " pip install " in line]
    assert "index-url" in told
    assert "--quiet" not in "".join(installs)
    *others, own = installs
    assert own.endswith("--editable .")
    assert all("--require-hashes" in line for line in others)
    assert all("--no-deps --no-build-isolation" in line for line in installs)
