"""Every kind of picture shows what it shows elsewhere, whichever way it is read."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image as PillowImage

from hri.core.errors import HriError
from hri.core.quoting import message_line
from hri.hal.drivers.image_folder import ImageFolderCamera
from hri.hal.drivers.pixel_depth import as_bytes, white_of
from hri.hal.drivers.still_image import read_still
from hri.hal.drivers.video_file import VideoFileCamera
from tests.hal.odd_pictures import BEST, COLOR, KINDS, UPRIGHT, all_rows, refused, saved

ROWS, REFUSED = all_rows(), list(refused())


def in_colors(seen: np.ndarray) -> np.ndarray:
    return np.dstack([seen] * 3) if seen.ndim == 2 else seen


def test_there_are_many() -> None:
    assert len(ROWS) + len(REFUSED) > 180


@pytest.mark.parametrize("row", ROWS, ids=[row[0] for row in ROWS])
def test_a_picture_of_any_kind_is_seen_as_it_is(tmp_path: Path, row) -> None:
    name, data, seen, apart = row
    path = tmp_path / name
    path.write_bytes(data)
    still = read_still(path)
    assert still.image.shape == in_colors(seen).shape
    assert still.image.dtype == np.uint8
    assert np.abs(still.image.astype(int) - in_colors(seen)).max() <= apart


@pytest.mark.parametrize("row", REFUSED, ids=[row[0] for row in REFUSED])
def test_what_is_no_picture_is_named_as_what_it_is(tmp_path: Path, row, capfd) -> None:
    name, data, told = row
    path = tmp_path / name
    path.write_bytes(data)
    with pytest.raises(HriError) as refusal:
        read_still(path)
    message = str(refusal.value)
    assert message.startswith(f"{path}: ")
    assert told in message
    assert " - " in message
    assert message_line(message) == message
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("suffix", [suffix for suffix in KINDS if suffix != ".pbm"])
def test_a_picture_is_read_whole_or_not_at_all(tmp_path: Path, suffix: str) -> None:
    whole = saved(COLOR, KINDS[suffix], **BEST.get(suffix, {}))
    path = tmp_path / f"a{suffix}"
    path.write_bytes(whole)
    seen = read_still(path).image
    count = 0
    for size in np.linspace(len(whole), 0, 60, dtype=int):
        path.write_bytes(whole[:size])
        try:
            assert np.array_equal(read_still(path).image, seen)
        except HriError:
            count += 1
    assert count > 40


@pytest.mark.parametrize("orientation", UPRIGHT)
@pytest.mark.parametrize(
    "suffix", [".png", ".tif", ".webp", ".jpg", ", 16 bits.tif", ", 16 bits.png"]
)
def test_a_point_of_the_upright_picture_is_found_in_the_stored_one(
    tmp_path: Path, orientation: int, suffix: str
) -> None:
    data = next(row[1] for row in ROWS if row[0] == f"held {orientation}{suffix}")
    path = tmp_path / "a"
    path.write_bytes(data)
    still = read_still(path)
    assert still.stored_size == (64, 48)
    for row, column in ((5, 9), (30, 41)):
        across, down = still.stored(column + 0.5, row + 0.5)
        stored = COLOR[int(down), int(across)].astype(int)
        assert np.abs(still.image[row, column] - stored).max() <= 20


@pytest.mark.parametrize(
    "name", ["gray of 12 in 16 bits.png", "held 6.tif", "rgba.webp", "lab.tif"]
)
def test_all_cameras_read_as_stills_are_read(tmp_path: Path, name: str, open_driver) -> None:
    path = tmp_path / name
    path.write_bytes(next(row[1] for row in ROWS if row[0] == name))
    seen = read_still(path).image
    for camera in (
        open_driver(VideoFileCamera, file=path),
        open_driver(ImageFolderCamera, folder=tmp_path, pace="fast"),
    ):
        assert (camera.height, camera.width) == seen.shape[:2]
        assert np.array_equal(camera.take().image, seen)


def test_a_folder_says_what_it_leaves_out(tmp_path: Path, open_driver, capsys) -> None:
    for name in ("a.tif", "b.gif", "c.AVIF", "d.heic", "e.HEIC", "f.cr2", "notes.txt", "._a.jpg"):
        (tmp_path / name).write_bytes(saved(COLOR, "PNG"))
    camera = open_driver(ImageFolderCamera, folder=tmp_path, pace="fast")
    assert [camera.read(0.0) is not None for _ in range(4)] == [True, True, True, False]
    assert "left out 1 .cr2, 2 .heic - convert them to JPEG or PNG" in capsys.readouterr().out
    for name in "abc":
        next(tmp_path.glob(f"{name}.*")).unlink()
    with pytest.raises(
        HriError, match=r"that can be read, only 1 \.cr2, 2 \.heic - put JPEG or PNG"
    ):
        open_driver(ImageFolderCamera, folder=tmp_path)


@pytest.mark.parametrize("animation", ["GIF", "PNG"])
def test_an_animation_is_a_film_for_who_asks_for_films(
    tmp_path: Path, animation, open_driver
) -> None:
    pictures = [PillowImage.fromarray(COLOR // each) for each in (1, 2, 3)]
    path = tmp_path / "a"
    path.write_bytes(
        saved(pictures[0], animation, save_all=True, append_images=pictures[1:], duration=100)
    )
    camera = open_driver(VideoFileCamera, file=path, pace="fast")
    assert [camera.read(0.0) is not None for _ in range(4)] == [True, True, True, False]


@pytest.mark.parametrize(
    "dtype", [np.uint16, np.int16, np.uint32, np.int32, np.float32, np.float64]
)
def test_white_is_never_darker_than_a_sample(dtype) -> None:
    dice = np.random.default_rng(1)
    bits = 8 * np.dtype(dtype).itemsize - (np.dtype(dtype).kind == "i")
    for power in range(15):
        samples = (dice.random((20, 30)) * 2.0**power).astype(dtype)
        white = white_of(samples, bits)
        assert white >= (samples.max() if samples.dtype.kind != "f" else np.quantile(samples, 0.98))
        pixels = as_bytes(samples, white)
        assert (np.diff(pixels.ravel()[np.argsort(samples, axis=None)].astype(int)) >= 0).all()
