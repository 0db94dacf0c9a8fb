"""Results name files and quote texts in lines that cannot command a terminal."""

import ast
import json
from pathlib import Path

import numpy as np
import pytest

import hri.cli
from hri.cli.main import main
from hri.core.picture_writer import write_picture
from hri.core.quoting import escaped
from hri.hal.drivers.wav_file import write_wav
from hri.vision.objects.printed_label import printed_label

ODD = "esc\x1b[31m turned\u202e tab\t two\nlines back\x08 bell\x07"
"""Of a folder."""
PICTURE = printed_label("cup")


def heard(capsys) -> list[str]:
    """What was printed, of which no character but the ends of lines is invisible."""
    told = capsys.readouterr()
    for line in (told.out + told.err).split("\n"):
        assert line.isprintable(), repr(line)
    return told.out.splitlines()


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    folder = tmp_path / ODD
    folder.mkdir()
    return folder


def test_pictures_and_what_is_learned_of_them(folder, capsys):
    good, bad, models, color = (folder / name for name in ("a.png", "b.jpg", "a.mdl", "a.color"))
    write_picture(good, PICTURE)
    bad.write_text("junk")
    assert main(["watch", "--stills", str(good), str(bad), "--detector", "haar"]) == 1
    assert heard(capsys)[0].startswith(escaped(str(good)))
    words = [
        "object",
        "learn",
        "it",
        "--whole",
        "--set",
        str(models),
        "--images",
        str(good),
        str(bad),
    ]
    assert main(words) == 1
    learned, total = heard(capsys)
    assert learned.startswith(f"{escaped(str(good))}: view 1")
    assert total.endswith(escaped(str(models)))
    assert main(["object", "show", "it", "--set", str(models), "--out", str(folder / "c.png")]) == 0
    assert main(["color", "learn", "it", "--images", str(good), "--out", str(color)]) == 0
    assert main(["color", "show", str(color), "--out", str(folder / "d.png")]) == 0
    assert len(heard(capsys)) == 6


def test_films_and_folders(folder, capsys):
    write_picture(folder / "b.png", PICTURE[:16, :16])
    (folder / "c.heic").write_text("")
    film = str(folder / "d.gif")
    words = ["watch", "--images", str(folder), "--out", film, "--detector", "haar"]
    assert main(words) == 0
    assert heard(capsys) == [escaped(f"wrote {film}")]
    assert main(["gesture", "--video", str(folder / "b.png"), "--detector", "haar"]) == 0
    heard(capsys)


def test_grammars_networks_and_sounds(folder, capsys):
    grammar, network, sound = (folder / name for name in ("a.jsgf", "a.xml", "a.wav"))
    grammar.write_text("#JSGF V1.0;\ngrammar a;\npublic <a> = go | stop\u200b now;\n")
    network.write_text('<BehaviorNetwork name="a" invocation_interval="0.1"></BehaviorNetwork>')
    write_wav(sound, np.zeros(8000, np.int16), 16000)
    for words in (
        ["grammar", "check", grammar],
        ["grammar", "expand", grammar],
        ["grammar", "parse", grammar, "go back\x1b[1m"],
        ["grammar", "listen", grammar, "--wav", sound],
        ["network", "check", network],
        ["network", "show", network],
        ["network", "draw", network, "--out", folder / "a.svg"],
        ["schema", "export", "Hri.Constant", "--to", folder],
        ["face", "render", "--out", folder / "face.png", "--size", "64x48"],
        ["face", "export", "robot", "--out", folder / "face.json"],
    ):
        main([str(word) for word in words])
        heard(capsys)


def test_json_has_the_names_as_they_are(folder, capsys):
    write_picture(folder / "a.png", PICTURE)
    words = [str(folder / "a.png"), str(folder / "none.png"), "--detector", "haar", "--json"]
    assert main(["watch", "--stills", *words]) == 1
    rows = [json.loads(line) for line in heard(capsys)]
    assert [row["file"] for row in rows] == words[:2]


KEPT = {
    "calibrate.py",
    "doctor.py",
    "drive_system.py",
    "list.py",
    "models.py",
    "token.py",
    "watch.py",
}
"""Modules that print numbers and words of ours alone, or escape what they write over a line."""


def test_no_command_prints_what_may_come_from_anyone_as_it_is():
    raw = [
        f"{file}:{call.lineno}: {ast.unparse(call)} - print it with `report`"
        for file in Path(hri.cli.__file__).parent.rglob("*.py")
        if file.name not in KEPT and "templates" not in file.parts
        for call in ast.walk(ast.parse(file.read_text()))
        if isinstance(call, ast.Call) and ast.unparse(call.func) == "print"
        for given in call.args
        if isinstance(given, ast.JoinedStr) and not ast.unparse(call).endswith("file=sys.stderr)")
    ]
    assert raw == []
