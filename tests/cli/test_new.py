"""`hri new` writes what works at once."""

import io
import os
import subprocess
import sys
from pathlib import Path

import pytest

from hri.cli.main import main
from hri.cli.new import DRIVER_TEMPLATES, DRIVERS, FROM, KINDS, RANGE_SENSOR, TEMPLATES
from hri.core.python_file import load_class, load_module
from hri.core.signals import Twist
from hri.drive.supervisor.process import Settings

pytestmark = pytest.mark.proves("P15")


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def words_for(kind, name):
    """What is typed to begin one."""
    made_from = {made: [begun, name, "--from", base] for (begun, base), made in FROM.items()}
    made_from |= {kind: ["driver", name, "--kind", kind] for kind in OF_DRIVERS}
    return ["new", *made_from.get(kind, [kind, name])]


OF_DRIVERS = sorted(set(DRIVERS) - {RANGE_SENSOR})


@pytest.mark.slow
@pytest.mark.parametrize("kind", [*KINDS, *OF_DRIVERS])
def test_the_tests_of_what_is_new_pass_at_once(kind, folder, capsys):
    (folder / "mine").mkdir()
    assert main([*words_for(kind, f"wave_{kind}"), "--to", "mine"]) == 0
    assert f"cd mine/wave_{kind}\n  python -m pytest " in capsys.readouterr().out
    environment = {name: value for name, value in os.environ.items() if name != "HRI_PATH"}
    done = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-W", "error"],
        cwd=folder / "mine" / f"wave_{kind}",
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "1 passed" in done.stdout


@pytest.mark.parametrize("kind", [*KINDS, *OF_DRIVERS])
def test_nothing_is_left_of_the_name_of_the_template(kind, folder):
    main(words_for(kind, "parrot"))
    for path in (folder / "parrot").rglob("*"):
        assert "thing" not in path.name.lower()
        if path.is_file() and "faces" not in path.parts:
            assert "thing" not in path.read_text().lower()


def test_a_new_network_is_run_by_behave(folder, monkeypatch, capsys):
    from hri.cli.behave import main as behave

    main(["new", "behavior", "parrot"])
    monkeypatch.setenv("HRI_PATH", str(folder / "parrot"))
    assert (
        behave(["parrot/parrot.xml", "--fast", "--without-resources", "--invocation-count=1"]) == 0
    )
    assert "Input show  double: 15\n" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("base", "line", "words"),
    [
        ([], "count to two", "said      2"),
        (["--from", "companion"], "tell my fortune", "said      You will soon speak to a robot."),
    ],
)
def test_a_new_app_hears_answers_and_does_something(base, line, words, folder, monkeypatch, capsys):
    main(["new", "app", "parrot", *base])
    monkeypatch.chdir(folder / "parrot")
    monkeypatch.setattr("sys.stdin", io.StringIO(f"{line}\n"))
    assert main(["run", ".", "--config", "typed", "--fast", "--headless", "--camera", "none"]) == 0
    assert words in capsys.readouterr().out


def test_an_app_of_the_companion_has_its_visit(folder, capsys):
    main(["new", "app", "parrot", "--from", "companion"])
    options = ["--demo", "--fast", "--headless", "--duration", "0.5"]
    assert main(["run", "./parrot", *options]) == 0


@pytest.mark.parametrize("name", ["fortune", "timer"])
def test_an_app_of_the_companion_may_be_called_like_what_it_does(name, folder):
    assert main(["new", "app", name, "--from", "companion"]) == 0


def test_only_an_app_is_made_from_something(folder, capsys):
    assert main(["new", "task", "parrot", "--from", "companion"]) == 2
    assert "task does not accept --from" in capsys.readouterr().err


def test_a_new_driver_is_listed_by_hri_devices(folder, monkeypatch, capsys):
    main(["new", "driver", "parrot"])
    monkeypatch.setenv("HRI_PATH", "parrot")
    assert main(["devices", "--config", "parrot/devices.xml"]) == 0
    assert "My.Parrot" in capsys.readouterr().out


@pytest.mark.parametrize("kind", OF_DRIVERS)
def test_a_new_driver_of_each_kind_passes_its_own_test(kind, folder, monkeypatch, request):
    """What the slow test runs as its user does, run in this process."""
    main(words_for(kind, f"my_{kind}"))
    made = folder / f"my_{kind}"
    monkeypatch.syspath_prepend(made)
    test = load_module(f"test_my_{kind}_once", made / f"test_my_{kind}.py")
    request.addfinalizer(lambda: sys.modules.pop(f"my_{kind}", None))
    (check,) = (value for name, value in vars(test).items() if name.startswith("test_"))
    check(monkeypatch)


@pytest.mark.parametrize("kind", OF_DRIVERS)
def test_a_new_driver_of_each_kind_is_listed_by_hri_devices(kind, folder, monkeypatch, capsys):
    main(words_for(kind, "parrot"))
    monkeypatch.setenv("HRI_PATH", "parrot")
    assert main(["devices", "--config", "parrot/devices.xml"]) == 0
    out = capsys.readouterr().out
    assert "My.Parrot" in out
    assert "unknown" not in out


def test_a_driver_is_of_a_range_sensor_unless_told_otherwise(folder):
    main(["new", "driver", "one"])
    main(["new", "driver", "two", "--kind", "range_sensor"])
    assert (folder / "one/one.py").read_text().replace("One", "Two") == (
        folder / "two/two.py"
    ).read_text()


def test_only_a_driver_is_of_a_kind(folder, capsys):
    assert main(["new", "task", "parrot", "--kind", "camera"]) == 2
    assert "task does not accept --kind" in capsys.readouterr().err


def test_the_supervisor_finds_a_base_that_is_in_a_file(folder):
    main(["new", "driver", "robin", "--kind", "base"])
    bus = load_class(folder / "robin/robin.py", "Robin")
    named = f"{bus.protocol.__module__}:{bus.protocol.__qualname__}"
    for name in [name for name in sys.modules if name.endswith("robin.py")]:
        del sys.modules[name]  # as in the process of the supervisor
    made = Settings(named, "/dev/ttyUSB0", -1).make()
    assert made.velocity(Twist(0.1, 0.0)) == b"v 100 100\n"


def test_a_new_face_passes_the_check(folder, capsys):
    main(["new", "face", "parrot"])
    assert main(["face", "check", "parrot/faces/parrot"]) == 0
    assert "points: ok" in capsys.readouterr().out


def test_nothing_is_overwritten(folder, capsys):
    (folder / "parrot").mkdir()
    (folder / "parrot" / "mine.txt").write_text("mine")
    assert main(["new", "behavior", "parrot"]) == 2
    assert "parrot: already exists - choose another name" in capsys.readouterr().err
    assert [path.name for path in (folder / "parrot").iterdir()] == ["mine.txt"]


@pytest.mark.parametrize(
    "name", ["", "Random", "wave-hand", "../parrot", "1wave", "w" * 41, "class", "random", "numpy"]
)
def test_a_name_that_cannot_be_a_module_is_refused(name, folder, capsys):
    assert main(["new", "task", name]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not list(folder.iterdir())


@pytest.mark.parametrize(
    ("kind", "name"), [("task", "task"), ("task", "context"), ("behavior", "behavior")]
)
def test_a_name_that_the_code_itself_uses_is_refused(kind, name, folder, capsys):
    assert main(["new", kind, name]) == 2
    assert f"is a word of the new {kind} itself" in capsys.readouterr().err


def test_a_name_may_be_written_as_a_class(folder):
    assert main(["new", "behavior", "WaveHand"]) == 0
    assert "class WaveHand(Behavior)" in (folder / "wave_hand" / "wave_hand.py").read_text()


@pytest.mark.parametrize("where", ["file", "missing"])
def test_a_folder_that_is_not_there_is_one_line(where, folder, capsys):
    (folder / "file").write_text("")
    assert main(["new", "task", "parrot", "--to", where]) == 2
    assert f"{where}: no such folder - make it" in capsys.readouterr().err
    assert not (folder / "missing").exists()


def test_every_kind_has_its_template():
    assert {path.name for path in Path(TEMPLATES).iterdir()} == {*KINDS, "skill", "form_skill"}
    assert {path.name for path in Path(DRIVER_TEMPLATES).iterdir()} == set(OF_DRIVERS)
