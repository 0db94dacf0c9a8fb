"""`hri color`: colors are taught, listed, shown, tested, checked, and removed."""

import json

import cv2
import numpy as np
import pytest

from hri.cli.main import main
from hri.vision.color.color_model import load_color, own_colors
from tests.vision.color.test_segmentation import BLUE, RED, drawn

IMAGE = drawn((RED, (80, 100), 30), (BLUE, (230, 60), 20))


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return tmp_path


@pytest.fixture
def balls(home):
    path = home / "balls.png"
    cv2.imwrite(str(path), IMAGE[..., ::-1])
    return str(path)


def hri_color(*words):
    return main(["color", *map(str, words)])


@pytest.mark.proves("R10")
def test_colors_that_were_taught_by_boxes_and_clicks_are_found(home, balls, capsys):
    assert hri_color("learn", "ball", "--images", balls, "--box", "65,85,30,30") == 0
    assert hri_color("learn", "cube", "--images", balls, "--click", "230,60") == 0
    other = home / "other.png"
    cv2.imwrite(str(other), drawn((RED, (200, 150), 30), seed=5)[..., ::-1])
    capsys.readouterr()
    words = ["watch", "--stills", balls, str(other), "--colors", "ball,cube", "--json"]
    assert main(words) == 0
    first, second = map(json.loads, capsys.readouterr().out.splitlines())
    assert [one["name"] for one in first["colors"]] == ["ball", "cube"]
    (ball,) = second["colors"]
    assert list(ball) == [*("name", "x", "y", "width", "height", "area", "confidence", "outline")]
    assert 0.9 < ball["confidence"] <= 1.0
    assert (ball["x"], ball["y"]) == pytest.approx((200, 150), abs=1.5)
    assert ball["width"] == pytest.approx(61, abs=3)
    assert hri_color("test", other, "--colors", "ball") == 0
    assert "ball at (20" in capsys.readouterr().out


def test_without_a_box_the_middle_is_learned(home, capsys):
    path = home / "middle.png"
    cv2.imwrite(str(path), drawn((BLUE, (160, 120), 50))[..., ::-1])
    assert hri_color("learn", "cube", "--images", path) == 0
    assert hri_color("test", path, "--colors", "cube") == 0
    told = capsys.readouterr().out
    assert "cube at (160, 120)" in told
    assert "replaces" not in told
    assert hri_color("learn", "cube", "--images", path) == 0
    assert capsys.readouterr().out.endswith("cube.color, which replaces the earlier one\n")


def test_colors_are_listed_shown_checked_and_removed(home, balls, capsys):
    hri_color("learn", "ball", "--images", balls, "--box", "65,85,30,30")
    capsys.readouterr()
    assert hri_color("list", "--json") == 0
    assert [one["name"] for one in json.loads(capsys.readouterr().out)] == ["ball", "red_ball"]
    assert hri_color("show", "ball", "--out", home / "ball.png") == 0
    assert "of all chroma has it" in capsys.readouterr().out
    assert cv2.imread(str(home / "ball.png")).shape == (256, 256, 3)
    assert hri_color("check", "ball") == 0
    assert hri_color("remove", "bal") == 2
    assert 'no color "bal" of your own - did you mean "ball"' in capsys.readouterr().err
    assert hri_color("remove", "ball") == 0
    assert not list(own_colors().glob("*"))


def test_two_that_are_the_same_and_one_that_is_damaged_are_reported(home, balls, capsys):
    for name in ("ball", "apple"):
        hri_color("learn", name, "--images", balls, "--box", "65,85,30,30")
    (own_colors() / "bad.color").write_text("{")
    capsys.readouterr()
    assert hri_color("check") == 1
    told = capsys.readouterr().out
    assert 'apple: "ball" is nearly the same color' in told
    assert "bad.color: this color is damaged" in told
    assert hri_color("list") == 1


@pytest.mark.parametrize("name", ["", "../evil", "a/b", "x" * 61])
def test_a_name_that_is_no_name_of_a_file_is_refused(balls, capsys, name):
    assert hri_color("learn", name, "--images", balls) == 2
    assert "is not a valid name for a color" in capsys.readouterr().err


@pytest.mark.parametrize("box", ["1,2,3", "a,b,c,d", "1,2,3,4,5"])
def test_a_box_that_is_not_four_numbers_is_refused(balls, capsys, box):
    with pytest.raises(SystemExit):
        hri_color("learn", "ball", "--images", balls, "--box", box)
    assert "4 whole numbers with commas between" in capsys.readouterr().err


def test_a_bad_picture_among_good_ones_is_named_and_the_others_are_learned(home, balls, capsys):
    (home / "junk.png").write_text("junk")
    small = home / "small.png"
    cv2.imwrite(str(small), IMAGE[:40, :40])
    words = ["--images", balls, home / "junk.png", small, "--box", "65,85,30,30"]
    assert hri_color("learn", "ball", *words) == 1
    told = capsys.readouterr()
    assert 'learned "ball" from 1 picture' in told.out
    junk, outside = told.err.splitlines()
    assert "junk.png: not a readable picture" in junk
    assert "small.png: the box 65,85,30,30 is outside of a picture of 40 x 40" in outside


@pytest.mark.parametrize("click", ["0,0", "3,2", "319,239"])
def test_a_click_at_the_edge_takes_what_is_in_the_picture(home, capsys, click):
    image = drawn()
    image[:12, :12] = image[-12:, -12:] = RED
    cv2.imwrite(str(home / "corner.png"), image[..., ::-1])
    words = ["--images", home / "corner.png", "--click", click]
    assert hri_color("learn", "corner", *words) == 0, capsys.readouterr().err
    assert hri_color("learn", "corner", *words[:2], "--click", "320,5") == 2
    assert "the click 320,5 is outside of a picture of 320 x 240" in capsys.readouterr().err


def test_a_color_keeps_its_name_in_a_file_of_another(home, balls, capsys):
    out = home / "rb.color"
    assert hri_color("learn", "ball", "--images", balls, "--box", "65,85,30,30", "--out", out) == 0
    capsys.readouterr()
    assert hri_color("test", balls, "--colors", out, "--json") == 0
    (found,) = json.loads(capsys.readouterr().out)["colors"]
    assert found["name"] == "ball"


def test_what_is_transparent_has_no_color(home):
    image = np.dstack([IMAGE[..., ::-1], np.full((240, 320), 255, np.uint8)])
    opaque, clear = home / "opaque.png", home / "clear.png"
    cv2.imwrite(str(opaque), image)
    image[85:115, 65:80] = (0, 255, 0, 0)
    cv2.imwrite(str(clear), image)
    means = []
    for path in (opaque, clear):
        assert hri_color("learn", "ball", "--images", path, "--box", "65,85,30,30") == 0
        model = load_color(own_colors() / "ball.color")
        means.append(model.color.weights @ model.color.means)
    assert means[0] == pytest.approx(means[1], abs=1)


def test_a_folder_of_junk_is_refused(home, capsys):
    (home / "junk").mkdir()
    (home / "junk" / "a.png").write_text("junk")
    assert hri_color("learn", "ball", "--images", home / "junk") == 2
    assert "a.png: not a readable picture" in capsys.readouterr().err


def test_a_film_shows_the_colors_and_what_moves(home, capsys):
    film = home / "film.mp4"
    writer = cv2.VideoWriter(str(film), cv2.VideoWriter.fourcc(*"mp4v"), 10, (320, 240))
    for number in range(10):
        image = drawn((RED, (80 + 8 * number, 100), 30), seed=number)
        writer.write(np.ascontiguousarray(image[..., ::-1]))
    writer.release()
    out = home / "seen.mp4"
    words = [
        "--video",
        film,
        "--out",
        out,
        "--colors",
        "red_ball",
        "--motion",
        "--detector",
        "haar",
    ]
    assert main(["watch", *map(str, words)]) == 0
    assert out.stat().st_size > 1000


def half(path):
    """Cut a file in half."""
    path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
    return path


def test_files_that_were_cut_in_half_are_refused_in_a_line(home, balls, capsys):
    hri_color("learn", "ball", "--images", balls, "--box", "65,85,30,30")
    cut = half(own_colors() / "ball.color")
    capsys.readouterr()
    assert hri_color("test", balls, "--colors", "ball") == 2
    assert f"{cut}: this color is damaged" in capsys.readouterr().err
    film = home / "film.mp4"
    writer = cv2.VideoWriter(str(film), cv2.VideoWriter.fourcc(*"mp4v"), 10, (320, 240))
    for seed in range(10):
        writer.write(np.ascontiguousarray(drawn((RED, (80, 100), 30), seed=seed)[..., ::-1]))
    writer.release()
    assert hri_color("learn", "cup", "--video", half(film)) == 2
    told = capsys.readouterr().err.strip().splitlines()
    assert str(film) in told[-1]


@pytest.mark.parametrize("shape", [(1, 1), (1, 7), (3, 5)])
def test_a_picture_of_a_few_pixels_teaches_nothing(home, capsys, shape):
    path = home / "tiny.png"
    cv2.imwrite(str(path), np.full((*shape, 3), 90, np.uint8))
    assert hri_color("learn", "ball", "--images", path) == 2
    assert "too few for a color" in capsys.readouterr().err
    assert hri_color("test", path, "--colors", "red_ball") == 0
    assert "none of the colors" in capsys.readouterr().out
