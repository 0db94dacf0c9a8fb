from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image as Picture

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.face.renderers.movie import write_movie

COUNT, RATE = 8, 30.0
COLORS = np.linspace((20, 200, 60), (220, 40, 120), COUNT).round().astype(np.uint8)


def pictures() -> Iterator[Image]:
    """Each of another color, the left half dark."""
    for color in COLORS:
        picture = np.empty((48, 64, 3), np.uint8)
        picture[:] = color
        picture[:, :32] //= 4
        yield picture


@pytest.mark.parametrize(("suffix", "unit"), [(".webp", 1), (".gif", 10)])
def test_a_moving_picture_has_all_frames_in_their_colors_and_time(
    tmp_path: Path, suffix: str, unit: int
) -> None:
    path = tmp_path / f"clip{suffix}"
    write_movie(path, pictures(), RATE)
    milliseconds = 0
    with Picture.open(path) as clip:
        assert clip.n_frames == COUNT  # type: ignore[attr-defined]
        for number in range(COUNT):
            clip.seek(number)
            clip.load()
            frame = np.asarray(clip.convert("RGB")).astype(int)
            assert np.abs(frame[8:40, 40:60] - COLORS[number]).mean() < 8
            milliseconds += clip.info["duration"]
    assert milliseconds == pytest.approx(COUNT / RATE * 1000, abs=unit)


def test_a_video_has_all_frames_in_their_colors_and_time(tmp_path: Path) -> None:
    path = tmp_path / "clip.mp4"
    write_movie(path, pictures(), RATE)
    capture = cv2.VideoCapture(str(path))
    assert capture.get(cv2.CAP_PROP_FPS) == pytest.approx(RATE)
    for color in COLORS:
        _, frame = capture.read()
        found = frame[8:40, 40:60, ::-1].astype(int)
        assert np.abs(found - color).mean() < 12
    assert not capture.read()[0]
    capture.release()


@pytest.mark.parametrize(
    ("name", "rate", "what"),
    [
        ("clip.mov", 30.0, "no movie of this kind"),
        ("clip.gif", 60.0, "rate from 1 to 50"),
        ("clip.mp4", float("nan"), "rate from 1 to 120"),
        ("nowhere/clip.webp", 30.0, "cannot be written"),
    ],
)
def test_what_cannot_be_written_is_one_line_and_leaves_nothing(
    tmp_path: Path, name: str, rate: float, what: str
) -> None:
    with pytest.raises(HriError, match=what):
        write_movie(tmp_path / name, pictures(), rate)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("suffix", [".mp4", ".webp", ".gif"])
def test_a_movie_that_fails_on_the_way_leaves_the_one_before(tmp_path: Path, suffix: str) -> None:
    def failing() -> Iterator[Image]:
        yield from pictures()
        raise HriError("the drawing was lost")

    path = tmp_path / f"clip{suffix}"
    path.write_bytes(b"before")
    with pytest.raises(HriError, match="lost"):
        write_movie(path, failing(), RATE)
    assert path.read_bytes() == b"before"
    assert list(tmp_path.iterdir()) == [path]


def test_a_gif_that_would_fill_the_memory_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("hri.face.renderers.movie.MOST_HELD", 5 * 48 * 64)
    with pytest.raises(HriError, match="too long for a GIF"):
        write_movie(tmp_path / "clip.gif", pictures(), RATE)
    assert not list(tmp_path.iterdir())


def test_no_pictures_are_no_movie(tmp_path: Path) -> None:
    with pytest.raises(HriError, match="no pictures"):
        write_movie(tmp_path / "clip.mp4", [], RATE)
