"""Skills plug into an app by being there; a broken one is off, and the app goes on."""

import sys

import pytest

from hri.core.errors import AuthoringError
from hri.robot.app import load_app
from hri.robot.skills import TURNED_OFF, turn, turned_off
from tests.robot.skills import skill, with_rule

WANDER = 'networks = ["networks/wander"]\n'


@pytest.fixture
def app(tmp_path):
    """The folder of an app that takes skills."""
    folder = tmp_path / "app"
    (folder / "skills").mkdir(parents=True)
    (folder / "app.toml").write_text(WANDER)
    (folder / "__init__.py").touch()
    (folder / "tasks.py").write_text("async def own(context): ...\nasync def wave(context): ...\n")
    return folder


def names(app, **off):
    return [one.name for one in load_app(str(app), off).all_skills()]


def test_a_folder_of_skills_is_plugged_in_in_the_order_of_names(app):
    skill(app, "b")
    skill(app, "a")
    (app / "skills" / "no_skill").mkdir()
    assert names(app) == ["a", "b"]


def test_an_app_that_extends_has_the_skills_of_its_base(app, tmp_path):
    skill(app, "a")
    above = tmp_path / "above"
    above.mkdir()
    (above / "app.toml").write_text(f'extends = "{app}"\n')
    assert names(above) == ["a"]


def test_skills_come_from_the_users_folder_and_from_hri_path(app, tmp_path, monkeypatch):
    for place in ("data/hri", "path"):
        skill(tmp_path / place, place[0])
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("HRI_PATH", str(tmp_path / "path"))
    assert names(app) == ["d", "p"]


def test_skills_come_from_installed_packages_that_are_not_imported(app, tmp_path, monkeypatch):
    site = tmp_path / "site"
    folder = skill(site / "spoons", "spoons")
    package = folder.rename(site / "spoons_skill")
    (package / "__init__.py").write_text("raise RuntimeError\n")
    about = site / "spoons-1.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Name: spoons\nVersion: 1\n")
    lines = "spoons = spoons_skill\nmissing = no_such_package\nodd = .\n"
    (about / "entry_points.txt").write_text(f"[hri.skills]\n{lines}")
    monkeypatch.syspath_prepend(str(site))
    assert names(app) == ["spoons_skill"]
    assert "spoons_skill" not in sys.modules


def test_an_app_without_such_a_folder_takes_those_it_names(tmp_path):
    skill(tmp_path, "a")
    folder = tmp_path / "other"
    folder.mkdir()
    (folder / "app.toml").write_text(f'{WANDER}skills = ["../skills/a"]\n')
    assert names(folder) == ["a"]


def test_an_app_leaves_some_out(app):
    skill(app, "a")
    skill(app, "b")
    (app / "app.toml").write_text(WANDER + 'without_skills = ["a"]\n')
    assert names(app) == ["b"]
    (app / "app.toml").write_text(WANDER + 'without_skills = ["bb"]\n')
    with pytest.raises(AuthoringError, match='did you mean "b"'):
        load_app(str(app))


def test_a_name_of_a_task_means_the_skills_own_first_and_that_of_no_other_skill(app):
    tasks = "async def live(context): ...\nasync def wave(context): ...\n"
    text = 'about = "A."\ntasks = ["live"]\n[on]\n"bumper.pressed" = "wave"\n'
    skill(app, "a", skill=text, tasks=tasks)
    skill(app, "b", tasks=tasks)
    found = load_app(str(app))
    first, second = found.all_skills()
    live, on_bump = found.load_tasks()
    assert live is first.module.live
    assert [job.function.__module__ for job in on_bump.args[1]] == ["hri_skill_a_tasks"]
    assert found.task("wave").__module__ == "hri_app_app.tasks"
    assert found.task("wave", second).__module__ == "hri_skill_b_tasks"
    assert found.task("own", second).__module__ == "hri_app_app.tasks"


def test_what_is_turned_off_is_off_until_it_is_turned_on(app, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "settings"))
    skill(app, "a")
    assert turned_off() == {}
    turn("a", on=False)
    found = load_app(str(app), turned_off())
    assert [(one.name, one.why, one.is_broken) for one in found.off] == [("a", TURNED_OFF, False)]
    assert found.all_skills() == ()
    turn("a", on=True)
    assert turned_off() == {}


BROKEN = {
    "no_toml": {"skill": "about ="},
    "unknown_key": {"skill": 'abuot = "A."'},
    "wrong_type": {"skill": "about = 3"},
    "no_network": {"skill": 'networks = ["nowhere.xml"]'},
    "syntax": {"tasks": "def x(:\n"},
    "import_fails": {"tasks": "import no_such_module\n"},
    "raises": {"tasks": "1 / 0\n"},
    "exits": {"tasks": "raise SystemExit(3)\n"},
    "wrong_reaction": {"skill": "[on]\n3 = 4"},
}


def test_each_broken_skill_is_off_with_one_line_and_the_others_are_on(app):
    for name, files in BROKEN.items():
        skill(app, name, **files)
    skill(app, "whole")
    found = load_app(str(app))
    assert [one.name for one in found.all_skills()] == ["whole"]
    assert {one.name for one in found.off} == {*BROKEN}
    for one in found.off:
        assert str(one.folder) in one.why
        assert "\n" not in one.why
        assert one.is_broken


def test_the_grammar_of_a_skill_has_its_place(app):
    place = with_rule(app, "a", "wave_hello", "wave", "")
    found = load_app(str(app))
    assert found.grammars_of_skills() == [place / "grammar.jsgf"]
    assert found.skill_at(place / "grammar.jsgf").name == "a"
    assert found.skill_at(app / "app.toml") is None


def test_the_hours_of_an_app_and_of_those_that_extend_it(app):
    assert load_app(str(app)).quiet_hours is None
    (app / "app.toml").write_text(WANDER + "[hours]\nquiet = [21, 7]\n")
    assert load_app(str(app)).quiet_hours == (21, 7)
    above = app.with_name("above")
    above.mkdir()
    (above / "app.toml").write_text(f'extends = "{app}"\n')
    assert load_app(str(above)).quiet_hours == (21, 7)


@pytest.mark.parametrize("quiet", ["[22]", "[22, 24]", "[6.5, 7]", "22", '["a", "b"]'])
def test_hours_that_are_none_are_refused(app, quiet):
    (app / "app.toml").write_text(WANDER + f"[hours]\nquiet = {quiet}\n")
    with pytest.raises(AuthoringError, match="quiet"):
        load_app(str(app))
