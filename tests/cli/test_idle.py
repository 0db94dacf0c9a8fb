"""`hri idle`: the list, the try, and its film."""

import json
from pathlib import Path

import pytest

from hri.cli.main import main


def test_the_list_has_every_act_with_what_it_is(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["idle"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 40
    assert "hums 2 after 60 s hums, and sways with it" in [" ".join(line.split()) for line in lines]
    assert any(line.startswith("notices_you") and "on person.entered" in line for line in lines)
    assert main(["idle", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)) == len(lines)


def test_an_evening_is_tried_and_the_same_seed_gives_the_same(
    capsys: pytest.CaptureFixture[str],
) -> None:
    told = []
    for seed in ("1", "1", "2"):
        assert main(["idle", "--try", "5", "--feeling", "joy", "--json", "--seed", seed]) == 0
        told.append([one["act"] for one in json.loads(capsys.readouterr().out)])
    assert told[0] == told[1] != told[2]
    assert len(set(told[0])) == len(told[0]) >= 4


def test_the_film_of_a_try_is_written(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    film = tmp_path / "idle.webp"
    assert main(["idle", "--try", "0.35", "--film", str(film)]) == 0
    assert film.stat().st_size > 1000


@pytest.mark.parametrize(
    ("words", "error"),
    [
        (["--feeling", "hapy"], 'no feeling "hapy"'),
        (["--film", "x.mp4"], "--film has nothing to film - add --try 10"),
        (["--face", "robbot"], 'did you mean "robot"'),
    ],
)
def test_what_cannot_be_done_is_said(
    words: list[str], error: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["idle", *words]) == 2
    assert error in capsys.readouterr().err


def test_a_broken_file_is_refused_with_its_place(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    file = tmp_path / "mine.toml"
    file.write_text('[act.a]\nabout = "x"\ngesture = "nodd"\n')
    assert main(["idle", "--file", str(file)]) == 2
    assert f'{file}:3:1: the face has no gesture "nodd" - did you mean' in capsys.readouterr().err
