from pathlib import Path

import cv2
import pytest

from hri.cli.main import main


def test_render_writes_a_picture_of_the_size(tmp_path: Path) -> None:
    out = tmp_path / "face.png"
    words = "face render --expression happy=0.5 --viseme aa=0.8 --gaze=-0.5,0.2 --time 3"
    assert main([*words.split(), "--size", "200x100", "--out", str(out)]) == 0
    assert cv2.imread(str(out)).shape == (100, 200, 3)


def test_sheet_shows_everything(tmp_path: Path) -> None:
    out = tmp_path / "sheet.png"
    assert main(["face", "sheet", "--out", str(out)]) == 0
    height, width, _ = cv2.imread(str(out)).shape
    assert width > 1000
    assert height > 1000


def test_check_and_list_name_the_default_face(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["face", "check", "robot"]) == 0
    assert main(["face", "list"]) == 0
    out = capsys.readouterr().out
    assert "robot: fine" in out
    assert "warning" not in out


@pytest.mark.parametrize(
    "words",
    [
        "render --expression hapy --out x.png",
        "render --expression happy=much --out x.png",
        "render --weights jawOpen=nan --out x.png",
        "render --face nobody --out x.png",
        "render --out nowhere/at/all/x.png",
        "render --out x.jpg",
        "check nobody",
    ],
)
def test_mistakes_are_one_line_and_status_2(
    words: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["face", *words.split()]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not list(tmp_path.iterdir())
