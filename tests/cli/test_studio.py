"""`hri studio NETWORK.xml` begins a network where there is none."""

import argparse

import pytest

from hri.behavior.network_file import load_network
from hri.cli import studio


@pytest.fixture
def ran(monkeypatch):
    """The options with which a robot would have been run."""
    found = []
    monkeypatch.setattr(studio.run_app, "run", lambda options: found.append(options) or 0)
    return found


def run(*words):
    parser = argparse.ArgumentParser()
    studio.add_arguments(parser)
    return studio.run(parser.parse_args(list(words)))


def test_a_network_that_is_not_there_is_begun_empty(tmp_path, ran, capsys):
    path = tmp_path / "new.xml"
    assert run(str(path)) == 0
    assert "a new network, still empty" in capsys.readouterr().out
    network = load_network(path)
    assert (network.name, network.behaviors) == ("new", [])
    (options,) = ran
    assert (options.app, options.headless) == (str(path), True)


def test_what_is_there_stays_as_it_is(tmp_path, ran, capsys):
    path = tmp_path / "old.xml"
    path.write_text("<BehaviorNetwork><!-- mine --></BehaviorNetwork>")
    run(str(path))
    run("networks/follow.xml")
    run(str(tmp_path / "nowhere" / "new.xml"))
    assert path.read_text() == "<BehaviorNetwork><!-- mine --></BehaviorNetwork>"
    assert capsys.readouterr().out == ""
    assert [entry.name for entry in tmp_path.iterdir()] == ["old.xml"]
