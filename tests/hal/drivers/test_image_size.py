"""Pictures as files: written as asked, looked at before they are decoded."""

import struct
import zlib

import cv2
import numpy as np
import pytest
from PIL import Image as PillowImage

from hri.core.errors import HriError, NotAvailable
from hri.core.signals import Frame
from hri.hal.drivers.blank import BlankCamera
from hri.hal.drivers.image_size import picture_size, write_picture
from hri.hal.drivers.video_file import STILL_RATE, VideoFileCamera, check_video

RAMP = np.stack(np.broadcast_arrays(*np.ogrid[0:96, 0:128], 40), axis=2).astype(np.uint8)


@pytest.mark.proves("H24")
def test_a_frame_knows_its_size():
    frame = Frame(RAMP, 0.0, 0)
    assert (frame.width, frame.height) == (128, 96)


@pytest.mark.proves("H24")
@pytest.mark.parametrize("name", ["a.jpg", "a.jpeg", "a.png", "a.JPG", "a.webp"])
def test_what_is_written_is_seen_again_in_its_colors(tmp_path, name):
    write_picture(tmp_path / name, RAMP, 0.9)
    again = cv2.cvtColor(cv2.imread(str(tmp_path / name)), cv2.COLOR_BGR2RGB)
    assert np.abs(again.astype(int) - RAMP).mean() < 3
    assert picture_size(tmp_path / name) == (128, 96)


@pytest.mark.parametrize("name", ["a.png", "a.webp"])
def test_what_is_transparent_is_written_exactly(tmp_path, name):
    image = np.dstack([RAMP, np.tile(np.arange(128, dtype=np.uint8) + 1, (96, 1))])
    write_picture(tmp_path / name, image)
    again = cv2.imread(str(tmp_path / name), cv2.IMREAD_UNCHANGED)
    assert np.array_equal(again[..., [2, 1, 0, 3]], image)


@pytest.mark.proves("H24")
def test_quality_costs_bytes(tmp_path):
    noise = np.random.default_rng(1).integers(0, 255, (96, 128, 3), np.uint8)
    sizes = []
    for quality in (0, 0.5, 0.9, 1):
        write_picture(tmp_path / "a.jpg", noise, quality)
        sizes.append((tmp_path / "a.jpg").stat().st_size)
    assert sizes == sorted(sizes)
    assert sizes[-1] > 3 * sizes[0]


@pytest.mark.parametrize("quality", [-0.1, 1.1, 90, float("nan")])
def test_a_quality_out_of_range_is_refused(tmp_path, quality):
    with pytest.raises(ValueError, match="write 0 to 1"):
        write_picture(tmp_path / "a.jpg", RAMP, quality)


def test_what_cannot_be_written_is_one_line(tmp_path):
    with pytest.raises(HriError, match=r'of the kind "\.gif" - write \.jpg, \.png or \.webp'):
        write_picture(tmp_path / "a.gif", RAMP)
    with pytest.raises(HriError, match="cannot be written: No such file"):
        write_picture(tmp_path / "no" / "a.jpg", RAMP)


def png_header(width, height):
    size = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", size) + chunk(b"IDAT", b"")


def chunk(name, data):
    check = zlib.crc32(name + data)
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", check)


@pytest.mark.parametrize("size", [(8193, 10), (10, 8193), (12000, 12000), (60000, 60000)])
def test_a_giant_is_refused_before_it_is_decoded(tmp_path, size):
    path = tmp_path / "giant.png"
    path.write_bytes(png_header(*size))
    with pytest.raises(HriError, match="too large - keep it below 8192 pixels"):
        check_video(path)


@pytest.mark.parametrize("content", [b"", b"no picture", png_header(3, 3)[:20], b"\xff\xd8\xff"])
def test_what_is_no_picture_has_no_size(tmp_path, content):
    path = tmp_path / "x"
    path.write_bytes(content)
    assert picture_size(path) is None


@pytest.mark.proves("H24")
def test_a_script_takes_the_next_picture(tmp_path, open_driver, clock):
    write_picture(tmp_path / "a.png", RAMP)
    camera = open_driver(VideoFileCamera, file=tmp_path / "a.png")
    first, second = camera.take(), camera.take()
    assert second.time - first.time == pytest.approx(1 / STILL_RATE, abs=0.011)
    assert np.array_equal(second.image, RAMP)


@pytest.mark.proves("H24")
def test_a_picture_that_does_not_come_is_one_line(open_driver, clock):
    with pytest.raises(NotAvailable, match=r"BlankCamera: no picture within 0\.5 s - unplug it"):
        open_driver(BlankCamera).take(timeout=0.5)
    assert clock.now() == pytest.approx(0.5, abs=0.011)


def test_a_picture_of_too_many_pixels_is_refused_before_it_is_decoded(tmp_path):
    """In the memory three times it would take 600 MB."""
    file = tmp_path / "a.png"
    PillowImage.new("1", (8192, 8192)).save(file)
    with pytest.raises(HriError, match="8192 x 8192 pixels are too many"):
        picture_size(file)
