"""Sound in a film: a second track of an MP4, which the pictures do not notice."""

import struct
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri.core.errors import HriError
from hri.hal.drivers.mp4 import boxes, inner, is_whole
from hri.hal.drivers.mp4_sound import add_sound

RATE = 8000
TONE = (9000 * np.sin(np.arange(20_000) / 5)).astype(np.int16)


@pytest.fixture
def film(tmp_path: Path) -> Path:
    """Sixty pictures in two seconds."""
    path = tmp_path / "film.mp4"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"mp4v"), 30.0, (64, 48))
    for number in range(60):
        writer.write(np.full((48, 64, 3), 4 * number, np.uint8))
    writer.release()
    return path


def frames_of(path: Path) -> list[np.ndarray]:
    capture, frames = cv2.VideoCapture(str(path)), []
    while (frame := capture.read()[1]) is not None:
        frames.append(frame)
    capture.release()
    return frames


def sound_of(path: Path) -> tuple[np.ndarray, int]:
    """What the table of contents says about the second track, read from its places."""
    data = path.read_bytes()
    tracks = [content for name, content in boxes(inner(data, "moov")) if name == "trak"]
    assert len(tracks) == 2
    media = inner(tracks[1], "mdia")
    assert inner(media, "hdlr")[8:12] == b"soun"
    rate, count = struct.unpack_from(">II", inner(media, "mdhd"), 12)
    tables = dict(boxes(inner(media, "minf", "stbl")))
    assert tables["stsd"][12:16] == b"sowt"
    size, samples = struct.unpack_from(">II", tables["stsz"], 4)
    assert (size, samples) == (2, count)
    (runs,) = struct.unpack_from(">I", tables["stsc"], 4)
    entries = [struct.unpack_from(">III", tables["stsc"], 8 + 12 * n) for n in range(runs)]
    (chunks,) = struct.unpack_from(">I", tables["co64"], 4)
    places = struct.unpack_from(f">{chunks}Q", tables["co64"], 8)
    found = b""
    for number, place in enumerate(places, start=1):
        length = next(entry[1] for entry in reversed(entries) if entry[0] <= number)
        found += data[place : place + 2 * length]
    return np.frombuffer(found, "<i2"), rate


def test_every_sample_is_found_by_the_table_of_contents(film: Path) -> None:
    add_sound(film, TONE, RATE)
    samples, rate = sound_of(film)
    assert rate == RATE
    assert np.array_equal(samples, TONE)
    assert is_whole(film)


@pytest.mark.parametrize("count", [0, 1, RATE, RATE + 1, 2 * RATE])
def test_a_sound_may_have_any_length(film: Path, count: int) -> None:
    add_sound(film, TONE[:count], RATE)
    assert np.array_equal(sound_of(film)[0], TONE[:count])


def test_all_pictures_are_still_there(film: Path) -> None:
    before = frames_of(film)
    add_sound(film, TONE, RATE)
    after = frames_of(film)
    assert len(after) == 60
    assert np.array_equal(after, before)


def test_the_film_lasts_as_long_as_its_longer_track(film: Path) -> None:
    add_sound(film, TONE, RATE)  # 2.5 s
    scale, duration = struct.unpack_from(">II", inner(film.read_bytes(), "moov", "mvhd"), 12)
    assert duration / scale == pytest.approx(2.5)


def test_a_film_with_sound_or_none_at_all_is_refused_and_stays_as_it_is(
    film: Path, tmp_path: Path
) -> None:
    add_sound(film, TONE, RATE)
    whole = film.read_bytes()
    with pytest.raises(HriError, match="not one track"):
        add_sound(film, TONE, RATE)
    assert film.read_bytes() == whole
    film.write_bytes(whole + whole[:40])
    with pytest.raises(HriError, match="something follows"):
        add_sound(film, TONE, RATE)
    other = tmp_path / "other.mp4"
    other.write_bytes(b"no film at all, but some text")
    with pytest.raises(HriError, match="no table of contents"):
        add_sound(other, TONE, RATE)
