"""Pictures from files are upright, and places in them are found again as they are stored."""

import cv2
import numpy as np
import pytest
from PIL import Image as PillowImage

from hri.core.errors import HriError
from hri.hal.drivers.still_image import ORIENTATION, read_still

MARK = (12, 7)
"""Column and row of a white pixel in a stored picture of 40 x 30."""


def stored(path, orientation=1, mode="RGB"):
    pixels = np.zeros((30, 40, 3), np.uint8)
    pixels[MARK[1], MARK[0]] = 255
    exif = PillowImage.Exif()
    exif[ORIENTATION] = orientation
    PillowImage.fromarray(pixels).convert(mode).save(path, exif=exif)
    return path


@pytest.mark.parametrize("orientation", range(1, 9))
def test_a_place_in_the_upright_picture_is_found_in_the_stored_one(tmp_path, orientation):
    still = read_still(stored(tmp_path / "a.png", orientation))
    assert still.image.shape[:2] == ((30, 40) if orientation < 5 else (40, 30))
    ((row, column),) = np.argwhere(still.image[..., 0] == 255)
    assert still.stored(column + 0.5, row + 0.5) == (MARK[0] + 0.5, MARK[1] + 0.5)


def test_an_orientation_that_nobody_knows_is_ignored(tmp_path):
    assert read_still(stored(tmp_path / "a.png", 77)).orientation == 1


def test_what_is_not_a_picture_is_refused_in_a_line(tmp_path):
    cut, text = tmp_path / "cut.png", tmp_path / "text.jpg"
    cv2.imwrite(str(cut), np.random.default_rng(0).integers(0, 255, (200, 200, 3)))
    cut.write_bytes(cut.read_bytes()[:5000])
    text.write_text("not a picture")
    for path in (cut, text, tmp_path, tmp_path / "none.png"):
        with pytest.raises(HriError, match=path.name):
            read_still(path)
