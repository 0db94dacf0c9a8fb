"""`hri watch --stills`: one JSON object a picture, each picture by itself."""

import json

import cv2
import numpy as np
import pytest
from PIL import Image as PillowImage

from hri.cli.main import main
from hri.hal.drivers.still_image import ORIENTATION
from hri.vision.objects.model_file import save_models
from tests.recorded import HERE, SHARED, needs_shared
from tests.vision.objects.pictures import VIEW, learned, room, standing

DEGREES = str(np.degrees(VIEW.field_of_view))
KEYS = {"x", "y", "width", "height", "distance_m", "yaw_deg", "pitch_deg", "roll_deg", "confidence"}


@pytest.fixture
def models(tmp_path):
    save_models(tmp_path / "kitchen.mdl", learned("cup", "key"))
    return str(tmp_path / "kitchen.mdl")


def picture(path, image):
    cv2.imwrite(str(path), image[..., ::-1])
    return str(path)


def watched(capsys, *words, status=0):
    assert main(["watch", "--stills", *words, "--json"]) == status
    return [json.loads(line) for line in capsys.readouterr().out.splitlines()]


@pytest.mark.proves("R08")
def test_each_picture_has_its_objects_in_pixels_of_the_file(tmp_path, models, capsys):
    cup = picture(tmp_path / "cup.png", standing("cup", 0.8, 0.1))
    none = picture(tmp_path / "none.png", room())
    rows = watched(capsys, cup, none, "--objects", models, "--view", DEGREES)
    assert [row["file"] for row in rows] == [cup, none]
    assert [row.keys() for row in rows] == [{"file", "objects"}] * 2
    (found,), nothing = (row["objects"] for row in rows)
    assert nothing == []
    assert found.keys() == {"name", "x", "y", "outline", "distance_m", "confidence", "attributes"}
    assert found["name"] == "cup"
    assert found["x"] == pytest.approx(320 + VIEW.focal_length((640, 480)) / 8, abs=2)
    assert found["y"] == pytest.approx(240, abs=2)
    assert found["distance_m"] == pytest.approx(0.806, rel=0.02)
    assert len(found["outline"]) == 4


def test_a_picture_that_lies_on_its_side_is_reported_as_it_is_stored(tmp_path, models, capsys):
    upright = standing("cup", 0.8, 0.1)
    exif = PillowImage.Exif()
    exif[ORIENTATION] = 6
    lying = tmp_path / "lying.png"
    PillowImage.fromarray(np.rot90(upright).copy()).save(lying, exif=exif)
    plain = picture(tmp_path / "plain.png", upright)
    turned, straight = watched(capsys, str(lying), plain, "--objects", models)
    (one,), (other,) = turned["objects"], straight["objects"]
    assert (one["x"], one["y"]) == pytest.approx((other["y"], 640 - other["x"]), abs=0.2)


def test_errors_in_one_picture_do_not_end_the_others(tmp_path, models, capsys):
    junk = tmp_path / "junk.jpg"
    junk.write_bytes(b"\xff\xd8 not a picture")
    good = picture(tmp_path / "good.png", standing("key", 0.8))
    rows = watched(
        capsys, str(junk), good, str(tmp_path / "gone.png"), "--objects", models, status=1
    )
    assert ["error" in row for row in rows] == [True, False, True]
    assert rows[1]["objects"][0]["name"] == "key"


@pytest.mark.parametrize("command", [["object", "test", "--set"], ["color", "test", "--colors"]])
def test_a_refused_picture_is_a_row_of_each_command(tmp_path, models, capsys, command):
    (tmp_path / "junk.jpg").write_text("junk")
    good = picture(tmp_path / "good.png", standing("key", 0.8))
    chosen = models if command[0] == "object" else "red_ball"
    assert main([*command, chosen, str(tmp_path / "junk.jpg"), good, "--json"]) == 1
    bad, fine = map(json.loads, capsys.readouterr().out.splitlines())
    assert bad.keys() == {"file", "error"}
    assert fine.keys() == {"file", f"{command[0]}s"}


@pytest.mark.parametrize("size", [(1, 8192), (8192, 1), (3, 5000), (4096, 16)])
def test_the_longest_pictures_are_rows_like_others(tmp_path, models, capsys, size):
    dice = np.random.default_rng(1)
    long = picture(tmp_path / "long.png", dice.integers(0, 255, (*size, 3), np.uint8))
    words = ["--people", "--objects", models, "--colors", "red_ball"]
    first, second = watched(capsys, long, picture(tmp_path / "b.png", room()), *words)
    assert first.keys() == second.keys() == {"file", "people", "objects", "colors"}


def test_people_in_deep_gray_are_seen_and_those_in_hidden_colors_are_not(tmp_path, capsys):
    """As many as in the picture of 8 bits."""
    seen = cv2.imread(str(HERE / "pictures" / "obama.jpg"))
    gray = cv2.cvtColor(seen, cv2.COLOR_BGR2GRAY)
    deep, clear = tmp_path / "deep.png", tmp_path / "clear.png"
    cv2.imwrite(str(deep), gray.astype(np.uint16) << 4)
    cv2.imwrite(str(clear), np.dstack([seen, np.zeros_like(gray)]))
    cv2.imwrite(str(tmp_path / "gray.png"), gray)
    words = [str(tmp_path / "gray.png"), str(deep), str(clear), "--detector", "haar"]
    plain, again, hidden = watched(capsys, *words)
    assert len(plain["people"]) == len(again["people"]) > 0
    assert hidden["people"] == []


def test_black_and_tiny_pictures_show_nobody_and_nothing(tmp_path, models, capsys):
    paths = [
        picture(tmp_path / f"{height}x{width}.png", np.zeros((height, width, 3), np.uint8))
        for height, width in ((1, 1), (480, 640), (5, 2000))
    ]
    rows = watched(capsys, *paths, "--people", "--objects", models)
    assert [(row["people"], row["objects"]) for row in rows] == [([], [])] * 3


@pytest.mark.proves("R07")
@needs_shared("vision/stills/obama.jpg")
def test_people_are_reported_with_box_distance_and_pose(capsys):
    path = SHARED / "vision" / "stills" / "obama.jpg"
    (row,) = watched(capsys, str(path))
    (person,) = row["people"]
    assert person.keys() == KEYS
    height, width = cv2.imread(str(path)).shape[:2]
    assert 0 <= person["x"] < person["x"] + person["width"] <= width
    assert 0 <= person["y"] < person["y"] + person["height"] <= height
    assert 0.2 < person["distance_m"] < 5
    assert 0.5 < person["confidence"] <= 1


def test_for_people_a_line_a_picture_is_printed(tmp_path, models, capsys):
    path = picture(tmp_path / "cup.png", standing("cup", 0.8))
    assert main(["watch", "--stills", path, "--objects", models]) == 0
    assert capsys.readouterr().out == f"{path}: 1 objects (cup)\n"


def test_a_foreign_model_set_is_refused_before_any_picture(tmp_path, capsys):
    (tmp_path / "foreign.mdl").write_bytes(b"PK\x03\x04 and nothing else")
    path = picture(tmp_path / "a.png", room())
    assert main(["watch", "--stills", path, "--objects", str(tmp_path / "foreign.mdl")]) == 2
    assert "this model set is damaged" in capsys.readouterr().err


def test_a_camera_and_stills_are_not_watched_together(tmp_path, capsys):
    path = picture(tmp_path / "a.png", room())
    assert main(["watch", "--stills", path, "--camera", "0"]) == 2
    assert "--camera and --stills" in capsys.readouterr().err
