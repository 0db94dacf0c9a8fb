import json
from pathlib import Path

import cv2
import pytest

from hri.cli.main import main
from hri.face import load_face
from tests.face.small_face import write_face, write_target


def test_render_writes_a_picture_of_the_size(tmp_path: Path) -> None:
    out = tmp_path / "face.png"
    words = "face render --expression happy=0.5 --viseme aa=0.8 --gaze=-0.5,0.2 --time 3"
    assert main([*words.split(), "--size", "200x100", "--out", str(out)]) == 0
    assert cv2.imread(str(out)).shape == (100, 200, 3)


def test_render_in_bits_writes_black_and_white_alone(tmp_path: Path) -> None:
    out = tmp_path / "bits.png"
    words = "face render --face eyes --expression happy --size 128x64 --bits --out"
    assert main([*words.split(), str(out)]) == 0
    assert set(cv2.imread(str(out)).ravel().tolist()) == {0, 255}


@pytest.mark.parametrize("suffix", [".png", ".webp"])
def test_render_leaves_the_background_out(suffix: str, tmp_path: Path) -> None:
    out = tmp_path / f"face{suffix}"
    assert main(["face", "render", "--transparent", "--size", "96x64", "--out", str(out)]) == 0
    picture = cv2.imread(str(out), cv2.IMREAD_UNCHANGED)
    assert picture.shape == (64, 96, 4)
    assert picture[0, 0].tolist() == [0, 0, 0, 0]
    assert picture[32, 48, 3] == 255


def test_render_draws_some_layers_alone(tmp_path: Path) -> None:
    folder, out = write_face(tmp_path / "small"), tmp_path / "ink.png"
    with (folder / "face.toml").open("a") as file:
        file.write('[layers]\nink = ["eye*"]\n')
    words = ["face", "render", "--face", str(folder), "--layer", "ink", "--transparent"]
    assert main([*words, "--size", "100x100", "--out", str(out)]) == 0
    alpha = cv2.imread(str(out), cv2.IMREAD_UNCHANGED)[..., 3]
    assert alpha[45, 35] == 255
    assert alpha[60, 50] == 0


def test_sheet_shows_everything(tmp_path: Path) -> None:
    out = tmp_path / "sheet.png"
    assert main(["face", "sheet", "--out", str(out)]) == 0
    height, width, _ = cv2.imread(str(out)).shape
    assert width > 1000
    assert height > 1000


def test_all_faces_of_the_house_pass_the_check(capsys: pytest.CaptureFixture[str]) -> None:
    for face in ("robot", "astronaut", "person", "eyes"):
        assert main(["face", "check", face]) == 0, capsys.readouterr().out
    assert "warning" not in capsys.readouterr().out


def test_list_names_the_faces_and_tells_which_is_broken(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    assert main(["face", "list"]) == 0
    assert "robot        A lantern seed" in capsys.readouterr().out
    (tmp_path / "faces" / "broken").mkdir(parents=True)
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    assert main(["face", "list"]) == 1
    assert "broken       broken: " in capsys.readouterr().out


def test_a_new_face_is_a_copy_that_loads(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    source = write_face(tmp_path / "small")
    (source / "notes.txt").touch()
    monkeypatch.chdir(tmp_path)
    assert main(["face", "new", "mine", "--from", "./small"]) == 0
    told = capsys.readouterr().out
    assert "hri face show ./mine --watch" in told
    assert main(["face", "check", "./mine"]) == 0
    assert load_face(Path("mine")).channels == load_face(source).channels
    assert not (tmp_path / "mine" / "notes.txt").exists()
    assert main(["face", "new", "mine", "--from", "./small"]) == 2
    assert "already exists" in capsys.readouterr().err


def test_check_prints_findings_with_places_and_status_1(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    folder = write_face(tmp_path / "small")
    write_target(folder, "jawOpne", "")
    assert main(["face", "check", str(folder)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert (
        "jawOpne.svg:1:1: warning: neither face.toml nor a gesture uses jawOpne - did you mean"
        in lines[0]
    )
    assert lines[-1].endswith("2 warnings")


def test_check_tells_of_a_gesture_that_the_face_cannot_make(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    folder = write_face(tmp_path)
    gesture = "[nod]\nduration_s = 1\nat = [0.5]\nweights = { headPich = [1] }\n"
    (folder / "gestures.toml").write_text(gesture)
    assert main(["face", "check", str(folder)]) == 2
    assert 'did you mean "headPitch"' in capsys.readouterr().err


def test_export_writes_all_that_a_canvas_needs(tmp_path: Path) -> None:
    folder = write_face(tmp_path / "small")
    out = tmp_path / "face.json"
    assert main(["face", "export", str(folder), "--out", str(out)]) == 0
    face = json.loads(out.read_text())
    assert face["expressions"]["happy"] == {"mouthSmile": 0.075}
    assert "mouthSmileLeft*jawOpen" in face["display"]["rows"]
    assert face["motions"]["names"] == ["headX", "headY", "headRoll", "headSize"]


@pytest.mark.parametrize(
    "words",
    [
        "render --expression hapy --out x.png",
        "render --expression happy=much --out x.png",
        "render --weights jawOpen=nan --out x.png",
        "render --face nobody --out x.png",
        "render --out nowhere/at/all/x.png",
        "render --out x.bmp",
        "render --transparent --out x.jpg",
        "render --face eyes --layer body --out x.png",
        "check nobody",
        "new Mine",
        "new ../mine",
        "new mine --from nobody",
        "new mine --dir /dev/null/none",
        "export robot --out nowhere/face.json",
    ],
)
def test_mistakes_are_one_line_and_status_2(
    words: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["face", *words.split()]) == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not list(tmp_path.iterdir())
