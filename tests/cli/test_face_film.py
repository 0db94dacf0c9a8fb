"""The commands that film a face: `hri face animate` and `hri say --face-video`."""

import json
import os
from pathlib import Path

import cv2
import numpy as np
import pytest

from hri.cli.main import main
from hri.face.vocabulary import VISEMES
from hri.hal.drivers.wav_file import read_wav

SCRIPT = """
duration = 0.8
[[step]]
express = "happy"
[[step]]
at = 0.1
say = "Hi."
"""
SMALL = ["--size", "96x72", "--fps", "15"]


@pytest.fixture
def script(tmp_path: Path) -> Path:
    path = tmp_path / "hello.toml"
    path.write_text(SCRIPT)
    return path


def frames_of(path: Path) -> list[np.ndarray]:
    capture, frames = cv2.VideoCapture(str(path)), []
    while (frame := capture.read()[1]) is not None:
        frames.append(frame)
    capture.release()
    return frames


def test_a_script_becomes_a_movie_and_its_sound(
    script: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    movie, wav = tmp_path / "a.mp4", tmp_path / "a.wav"
    words = ["face", "animate", str(script), "--out", str(movie), "--wav", str(wav), *SMALL]
    assert main(words) == 0
    frames = frames_of(movie)
    assert len(frames) == 12
    assert frames[0].shape == (72, 96, 3)
    assert not np.array_equal(frames[2], frames[5])
    samples, rate = read_wav(wav)
    assert len(samples) / rate == pytest.approx(0.8, abs=0.01)
    assert samples.astype("<i2").tobytes() in movie.read_bytes()
    assert capsys.readouterr().out == ""


def test_the_same_script_gives_the_same_bytes(script: Path, tmp_path: Path) -> None:
    for name in ("a.webp", "b.webp"):
        assert main(["face", "animate", str(script), "--out", str(tmp_path / name), *SMALL]) == 0
    assert (tmp_path / "a.webp").read_bytes() == (tmp_path / "b.webp").read_bytes()


def test_the_weights_of_a_movie_can_be_written_and_played_again(
    script: Path, tmp_path: Path
) -> None:
    first, again = tmp_path / "a.mp4", tmp_path / "b.mp4"
    words = ["face", "animate", str(script), "--csv", str(tmp_path / "take.csv")]
    assert main([*words, "--out", str(first), *SMALL]) == 0
    replay = tmp_path / "replay.toml"
    replay.write_text('duration = 0.8\n[[step]]\nplay = "take.csv"\n')
    assert main(["face", "animate", str(replay), "--out", str(again), *SMALL]) == 0
    one, other = frames_of(first)[7].astype(int), frames_of(again)[7]
    still = frames_of(again)[0]
    assert np.abs(one - other).mean() < 0.7 * np.abs(one - still).mean(), "but for idle life"


def test_captions_are_written_while_it_speaks(script: Path, tmp_path: Path) -> None:
    for name, options in (("plain.mp4", []), ("written.mp4", ["--captions"])):
        words = ["face", "animate", str(script), "--out", str(tmp_path / name), *SMALL, *options]
        assert main(words) == 0
    plain, written = frames_of(tmp_path / "plain.mp4")[4], frames_of(tmp_path / "written.mp4")[4]
    assert written[-12:].mean() < plain[-12:].mean() - 10


def test_a_webp_is_silent_and_says_what_to_do(
    script: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    movie = tmp_path / "a.webp"
    assert main(["face", "animate", str(script), "--out", str(movie), *SMALL]) == 0
    assert capsys.readouterr().out == (
        f"{movie} is silent - add --wav FILE; an .mp4 holds its sound\n"
    )


@pytest.mark.parametrize(
    ("options", "what"),
    [
        (["--out", "a.mov"], "no movie of this kind"),
        (["--out", "a.mp4", "--fps", "1000"], "rate from 1 to 120"),
        (["--out", "a.mp4", "--face", "nobody"], "nobody"),
        (["--out", "a.mp4", "--voice", "xx"], 'no voice "xx"'),
        (["--out", "a.mp4", "--size", "9x9"], "picture of 9x9"),
        (["--out", "no/a.mp4"], "cannot be written"),
    ],
)
def test_mistakes_are_one_line_and_leave_nothing(
    script: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    options: list[str],
    what: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["face", "animate", str(script), *options]) == 2
    told = capsys.readouterr().err
    assert what in told
    assert len(told.splitlines()) == 1
    assert os.listdir(tmp_path) == ["hello.toml"]


def test_a_text_is_said_by_a_face_and_its_visemes_are_written(tmp_path: Path) -> None:
    movie, file = tmp_path / "a.mp4", tmp_path / "a.json"
    words = ["say", "Bob.", "--emotion", "joy", "--face-video", str(movie), "--visemes", str(file)]
    assert main(words) == 0
    told = json.loads(file.read_text())
    shapes = told["visemes"]
    assert [shape["viseme"] for shape in shapes] == ["PP", "aa", "PP"]
    assert {shape["viseme"] for shape in shapes} <= set(VISEMES)
    frames = told["frames"]
    closed = [frame["lips"].get("PP", 0.0) > 0.9 for frame in frames]
    first, vowel, last = (
        [c for c, f in zip(closed, frames, strict=True) if s["start"] <= f["time"] < s["end"]]
        for s in shapes
    )
    assert any(first)
    assert not all(vowel)
    assert any(last)
    assert max(frame["jaw"].get("aa", 0.0) for frame in frames) > 0.4
    assert len(frames_of(movie)) == pytest.approx((told["duration"] + 1) * told["rate"], abs=2)
