from pathlib import Path

from hri.cli.behave import main

FOLDER = Path(__file__).parent


def test_three_becomes_fifteen(monkeypatch, capsys):
    monkeypatch.setenv("HRI_PATH", str(FOLDER))
    network = str(FOLDER / "thing.xml")
    assert main([network, "--fast", "--without-resources", "--invocation-count=2"]) == 0
    assert capsys.readouterr().out.count("Input show  double: 15\n") == 2
