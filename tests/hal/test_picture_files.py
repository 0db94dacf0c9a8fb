"""Pictures and films as files: what would fill the memory is refused before it is decoded."""

import struct
import zlib
from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image as PillowImage

from hri.core.errors import HriError
from hri.hal.camera import _Log
from hri.hal.drivers.image_folder import ImageFolderCamera
from hri.hal.drivers.image_size import MOST_SCANS, picture_size
from hri.hal.drivers.still_image import read_still
from hri.hal.drivers.video_file import check_video


def png(side: int, bits: int = 1, kind: int = 0) -> bytes:
    """A black picture of one bit a pixel: few bytes, whatever its side. Of others the head alone
    is right.
    """
    head = struct.pack(">IIBBBBB", side, side, bits, kind, 0, 0, 0)
    data = zlib.compress(bytes((1 + (side + 7) // 8) * side), 9)
    parts = ((b"IHDR", head), (b"IDAT", data), (b"IEND", b""))
    chunks = (
        struct.pack(">I", len(body)) + name + body + struct.pack(">I", zlib.crc32(name + body))
        for name, body in parts
    )
    return b"\x89PNG\r\n\x1a\n" + b"".join(chunks)


def chunk(kind: bytes, body: bytes) -> bytes:
    return kind + struct.pack("<I", len(body)) + body + bytes(len(body) % 2)


def film(side: int) -> bytes:
    """An AVI with one such picture."""
    head = struct.pack("<14I", 100_000, 0, 0, 16, 1, 0, 1, 0, side, side, 0, 0, 0, 0)
    stream = b"vidsMPNG" + struct.pack("<IHHIIIIIIII4h", 0, 0, 0, 0, 1, 10, 0, 1, *[0] * 7)
    kind = struct.pack("<IiiHH4sIiiII", 40, side, side, 1, 24, b"MPNG", 0, 0, 0, 0, 0)
    streams = chunk(b"LIST", b"strl" + chunk(b"strh", stream) + chunk(b"strf", kind))
    body = chunk(b"LIST", b"hdrl" + chunk(b"avih", head) + streams)
    body += chunk(b"LIST", b"movi" + chunk(b"00dc", png(side)))
    return chunk(b"RIFF", b"AVI " + body)


def radiance(width: int, height: int) -> bytes:
    """A picture of a format that Pillow does not know and OpenCV does (Ward, 1991)."""
    runs = bytes([255, 1]) * (width // 127) + bytes([128 + width % 127, 1])
    row = bytes([2, 2, width >> 8, width & 255]) + runs * 4
    return b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width) + row * height


def put(path: Path, data: bytes) -> Path:
    path.write_bytes(data)
    return path


def test_a_film_of_giants_is_refused_by_what_it_says_of_itself(tmp_path: Path) -> None:
    check_video(put(tmp_path / "small.avi", film(200)))
    with pytest.raises(HriError, match="pictures of 9000 x 9000 pixels - keep them below 8192"):
        check_video(put(tmp_path / "giant.avi", film(9000)))


@pytest.mark.parametrize("name", ["a.hdr", "a.png"])
def test_a_giant_that_only_opencv_can_read_is_refused_unread(tmp_path: Path, name: str) -> None:
    path = put(tmp_path / name, radiance(30_000, 30))
    with pytest.raises(HriError, match=r"30000 x 30 pixels|not a readable"):
        check_video(path)
    assert picture_size(path) is None
    assert ImageFolderCamera._load(Unready(), path) is None


class Unready(ImageFolderCamera):
    """A camera that is not opened, and says nothing."""

    def __init__(self) -> None:
        self._log = _Log()

    def _tell(self, what: str) -> None:
        pass


def test_a_jpeg_of_very_many_scans_is_refused(tmp_path: Path) -> None:
    whole = cv2.imencode(".jpg", np.full((64, 64, 3), 99, np.uint8))[1].tobytes()
    start, end = whole.index(b"\xff\xda"), whole.rindex(b"\xff\xd9")
    put(tmp_path / "once.jpg", whole)
    again = whole[:start] + whole[start:end] * (MOST_SCANS + 1) + whole[end:]
    put(tmp_path / "again.jpg", again)
    assert read_still(tmp_path / "once.jpg").image.shape == (64, 64, 3)
    with pytest.raises(HriError, match="this JPEG has more than 40 scans"):
        read_still(tmp_path / "again.jpg")


@pytest.mark.parametrize("mode", ["1", "L", "LA", "P", "RGB", "RGBA", "I;16", "CMYK"])
def test_a_picture_is_the_same_however_its_strips_are_cut(
    tmp_path: Path, mode: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    colors = np.random.default_rng(1).integers(0, 256, (90, 70, 4), np.uint8)
    suffix = "tiff" if mode == "CMYK" else "png"
    path = tmp_path / f"a.{suffix}"
    PillowImage.fromarray(colors).convert("L" if mode == "I;16" else mode).convert(mode).save(path)
    monkeypatch.setattr("hri.hal.drivers.still_image.STRIP", 7)
    read = read_still(path)
    with PillowImage.open(path) as stored:
        over = PillowImage.new("RGBA", stored.size, "white")
        over.alpha_composite(stored.convert("RGBA"))
        assert np.abs(read.image - np.asarray(over, np.int16)[..., :3]).max() <= 1
        has_alpha = "A" in stored.getbands() or "transparency" in stored.info
    assert (read.alpha is not None) == has_alpha


def test_pictures_that_cost_more_have_fewer_pixels(tmp_path: Path) -> None:
    assert picture_size(put(tmp_path / "a.png", png(5000, 8, kind=2))) == (5000, 5000)
    with pytest.raises(HriError, match="keep it below 16,588,800"):
        picture_size(put(tmp_path / "b.png", png(5000, 8, kind=6)))
