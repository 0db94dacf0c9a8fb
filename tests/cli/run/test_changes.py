"""Files of an app that are saved while it runs and taken only when it starts."""

from functools import partial

import pytest

from hri.cli.run.changes import announce_changes
from hri.robot import load_app
from hri.task.context import TaskContext
from tests.task.stage import Stage


@pytest.fixture
def app(tmp_path):
    folder = tmp_path / "kitchen"
    folder.mkdir()
    (folder / "app.toml").write_text('extends = "companion"\n')
    (folder / "tasks.py").write_text("")
    return load_app(str(folder))


def told_of(app, *deeds, has_studio=False):
    """The lines that are told while these things are done, two seconds apart."""
    lines = []

    async def job(context: TaskContext) -> None:
        context.manager.install(partial(announce_changes, app, lines.append, has_studio))
        for deed in deeds:
            await context.clock.sleep(2.0)
            deed()
        await context.clock.sleep(2.0)

    Stage().run(job)
    return lines


def test_each_file_that_needs_a_new_start_is_told_once(app) -> None:
    def save(name, text):
        return lambda: (app.folder / name).write_text(text)

    assert told_of(
        app,
        save("tasks.py", "x = 1\n"),
        save("tasks.py", "x = 12\n"),
        save("app.toml", 'extends = "companion"\nabout = "new"\n'),
        save("more.py", "y = 1\n"),
        save("replies.toml", ""),
    ) == [
        f"{app.folder / name} was saved - restart the robot to load it"
        for name in ("tasks.py", "app.toml", "more.py")
    ]


def test_a_folder_that_goes_away_is_no_change(app) -> None:
    def take_away():
        for path in app.folder.iterdir():
            path.unlink()
        app.folder.rmdir()

    assert told_of(app, take_away) == []


def test_a_network_alone_is_started_again_on_the_page(tmp_path) -> None:
    file = tmp_path / "alone.xml"
    file.write_text('<BehaviorNetwork><Behavior id="a" type="Hri.Constant"/></BehaviorNetwork>')
    app = load_app(str(file))

    def save():
        file.write_text(file.read_text() + "\n")

    (line,) = told_of(app, save, has_studio=True)
    assert line.endswith("was saved - press Start again on the page to load it")
    (line,) = told_of(app, save)
    assert line.endswith("was saved - restart the robot to load it")
