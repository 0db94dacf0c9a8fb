"""`hri marker`: a card that is printed is found again, and wrong use is one line."""

import json
import math
import re

import cv2
import numpy as np
import pytest
from PIL import Image

from hri.cli.main import main
from hri.core.signals import Marker
from hri.vision.markers.families import FAMILIES


def on_a_table(card, tmp_path, scale=0.2):
    """A photograph of a card, from above."""
    page = np.asarray(Image.open(card).convert("L"))
    small = cv2.resize(page, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    table = np.full((480, 640), 120, np.uint8)
    table[20 : 20 + small.shape[0], 90 : 90 + small.shape[1]] = small
    path = tmp_path / "table.png"
    Image.fromarray(table).save(path)
    return path


@pytest.mark.parametrize("family", FAMILIES)
def test_a_printed_card_is_found_with_its_family_id_and_size(family, tmp_path, capsys):
    card = tmp_path / "card.png"
    assert main(["marker", "print", "7", "--family", family, "--out", str(card)]) == 0
    told = capsys.readouterr().out
    assert family in told
    assert "100 mm" in told
    with Image.open(card) as page:
        assert page.info["dpi"] == pytest.approx((300, 300), abs=0.1)
    assert main(["marker", "find", str(on_a_table(card, tmp_path)), "--json"]) == 0
    row = json.loads(capsys.readouterr().out)
    (one,) = row["markers"]
    assert (one["family"], one["id"], one["text"]) == (family, 7, None)
    (left, _), (right, _), _, _ = one["outline"]
    assert right - left == pytest.approx(100 / 25.4 * 300 * 0.2, abs=1)
    beside = math.hypot(one["bearing_deg"], one["elevation_deg"])  # it lies flat in the picture
    assert one["tilt_deg"] == pytest.approx(beside, abs=1.5)


def test_a_code_is_found_and_its_text_cannot_command_the_terminal(tmp_path, capsys):
    card = tmp_path / "card.png"
    assert main(["marker", "print", "--text", "good day", "--size", "80", "--out", str(card)]) == 0
    capsys.readouterr()
    assert main(["marker", "find", "--size", "80", str(on_a_table(card, tmp_path))]) == 0
    assert re.search(r"table\.png: qr good day, \d\.\d\d m", capsys.readouterr().out)


def test_a_pdf_has_the_size_that_is_told(tmp_path, capsys):
    card = tmp_path / "card.pdf"
    assert main(["marker", "print", "3", "--out", str(card)]) == 0
    width, height = map(int, re.findall(r"(\d+) x (\d+) mm", capsys.readouterr().out)[0])
    box = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", card.read_bytes())[0]
    assert [float(side) / 72 * 25.4 for side in box] == pytest.approx([width, height], abs=1)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["print"], "give the ID of a marker, or --text TEXT"),
        (["print", "7", "--text", "a"], "give the ID of a marker, or --text TEXT"),
        (["print", "587"], "choose one of 0 to 586"),
        (["print", "50", "--family", "aruco_4x4_50"], "choose one of 0 to 49"),
        (["print", "--text", "a\nb"], "printable"),
        (["print", "--text", "a" * 301], "1 to 300"),
        (["print", "7", "--out", "card.gif"], "write .pdf or .png"),
    ],
)
def test_wrong_use_is_one_line_and_nothing_is_written(words, message, tmp_path, capsys):
    before = list(tmp_path.iterdir())
    if "--out" not in words:
        words = [*words, "--out", str(tmp_path / "card.pdf")]
    assert main(["marker", *words]) != 0
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
    assert list(tmp_path.iterdir()) == before


def test_a_picture_that_cannot_be_read_is_named_and_the_others_count(tmp_path, capsys):
    card = tmp_path / "card.png"
    main(["marker", "print", "7", "--out", str(card)])
    capsys.readouterr()
    good = str(on_a_table(card, tmp_path))
    assert main(["marker", "find", str(tmp_path / "none.jpg"), good, "--json"]) == 1
    first, second = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    assert "error" in first
    assert second["markers"][0]["id"] == 7


def test_the_families_are_listed(capsys):
    assert main(["marker", "list"]) == 0
    assert "apriltag_36h11: 587 markers" in capsys.readouterr().out
    assert main(["marker", "list", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["families"]) == 4


def test_the_name_of_a_marker_says_its_family_and_id_or_its_text():
    def named(family, id, text=""):
        zero = (0.0, 0.0, 0.0)
        return Marker(family, id, (), 0, 0, 1, 0, 0, 0, zero, (-1.0, 0.0, 0.0), text=text).name

    assert named("apriltag_36h11", 7) == "apriltag_36h11:7"
    assert named("qr", -1, "hello") == "qr:hello"
