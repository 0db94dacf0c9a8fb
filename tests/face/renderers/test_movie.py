from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest
from PIL import Image as Picture

from hri.core.errors import HriError
from hri.core.signals import Image
from hri.face.renderers.movie import write_movie
from hri.hal.drivers.growing_movie import GrowingMovie

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


def test_an_mp4_holds_its_sound(tmp_path: Path) -> None:
    sound = np.arange(-4000, 4000, dtype=np.int16), 8000
    write_movie(tmp_path / "clip.mp4", pictures(), RATE, sound=sound)
    assert len(frames_of(tmp_path / "clip.mp4")) == COUNT
    assert sound[0].astype("<i2").tobytes() in (tmp_path / "clip.mp4").read_bytes()
    write_movie(tmp_path / "clip.webp", pictures(), RATE, sound=sound)


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


def frames_of(path: Path) -> list[Image]:
    """The pictures of a film, RGB."""
    if path.suffix == ".mp4":
        capture, found = cv2.VideoCapture(str(path)), []
        while (read := capture.read())[0]:
            found.append(read[1][..., ::-1])
        capture.release()
        return found
    with Picture.open(path) as clip:
        count = clip.n_frames  # type: ignore[attr-defined]
        found = []
        for number in range(count):
            clip.seek(number)
            found.append(np.asarray(clip.convert("RGB")))
        return found


@pytest.mark.parametrize("suffix", [".mp4", ".webp", ".gif"])
@pytest.mark.parametrize("other", [(96, 128), (24, 32), (64, 48), (48, 640), (480, 16), (47, 65)])
def test_pictures_of_other_sizes_are_fitted_into_the_first(
    tmp_path: Path, suffix: str, other: tuple[int, int]
) -> None:
    path = tmp_path / f"clip{suffix}"
    sizes, lights = [(48, 64)] * 2 + [other] * 3 + [(48, 64)] * 2, range(60, 200, 20)
    shown = zip(sizes, lights, strict=True)
    write_movie(path, (np.full((*size, 3), light, np.uint8) for size, light in shown), 10.0)
    found = frames_of(path)
    assert len(found) == len(sizes)
    for frame, light in zip(found, lights, strict=True):
        assert frame.shape == (48, 64, 3)
        assert np.abs(frame[24, 31:33].astype(int) - light).max() < 40
    scale = min(48 / other[0], 64 / other[1])
    lit = (found[3][..., 0] > 50).sum()
    assert lit == pytest.approx(other[0] * scale * other[1] * scale, rel=0.2, abs=100)


@pytest.mark.parametrize("size", [(1, 1), (1, 50), (50, 1), (2, 8192)])
def test_a_size_that_an_mp4_cannot_have_is_the_reason(
    tmp_path: Path, size: tuple[int, int]
) -> None:
    path, picture = tmp_path / "clip.mp4", np.zeros((*size, 3), np.uint8)
    what = (
        f"clip.mp4: pictures of {size[1]} x {size[0]} pixels make no MP4 - take sides of 2 to 8191"
    )
    with pytest.raises(HriError, match=what):
        write_movie(path, [picture], RATE)
    with pytest.raises(HriError, match=what):
        GrowingMovie(path, (size[1], size[0]), RATE)
    assert not list(tmp_path.iterdir())
