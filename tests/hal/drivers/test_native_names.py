"""No name of a file reaches a library written in C before it is one that the library can read."""

import ast
import os
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import hri
from hri.core.errors import HriError
from hri.core.native_path import native_path
from hri.core.picture_writer import write_picture
from hri.face.renderers.movie import write_movie
from hri.hal.drivers.growing_movie import GrowingMovie
from hri.hal.drivers.image_folder import ImageFolderCamera
from hri.hal.drivers.still_image import read_still
from hri.hal.drivers.video_file import VideoFileCamera
from hri.hal.drivers.wav_file import load_sound, write_wav
from hri.testing.golden import Golden
from hri.vision.objects.embedding import Embedding

ODD = [
    b"caf\xe9",
    b"\xff",
    b"a\xed\xa0\x80b",
    "ü \U0001f600".encode(),
    b"a%02db",
    b"-dash",
    b"a\nb",
]
"""Latin-1, no letter at all, half of a surrogate pair, and names that others have stumbled over."""
PICTURE = np.full((64, 80, 3), 90, np.uint8)

names = pytest.mark.parametrize("raw", ODD, ids=repr)


def odd(folder: Path, raw: bytes, suffix: str) -> Path:
    (folder / os.fsdecode(raw)).mkdir()
    return folder / os.fsdecode(raw) / os.fsdecode(raw + suffix.encode())


@names
def test_a_name_is_handed_over_as_text_that_leads_to_the_file(tmp_path: Path, raw: bytes) -> None:
    path = odd(tmp_path, raw, ".png")
    path.write_bytes(b"content")
    with native_path(path) as name:
        name.encode()
        assert name.endswith(".png")
        assert Path(name).read_bytes() == b"content"
        Path(name).write_bytes(b"new")
    assert path.read_bytes() == b"new"
    assert list(path.parent.iterdir()) == [path]


@pytest.mark.parametrize("name", ["http:x", "-", "pipe:0", "concat:a|b"])
def test_no_name_is_taken_for_an_address(name: str) -> None:
    with native_path(name) as given:
        assert given == f"./{name}"


def test_a_temporary_folder_that_cannot_help_is_one_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    odd(tmp_path, b"\xe9", "")
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / os.fsdecode(b"\xe9")))
    with (
        pytest.raises(HriError, match=r"nor is \$TMPDIR - rename"),
        native_path(os.fsdecode(b"\xe9")),
    ):
        pass


@names
def test_films_are_written_and_read_by_any_name(tmp_path: Path, raw: bytes, open_driver) -> None:
    path = odd(tmp_path, raw, ".mp4")
    write_movie(path, [PICTURE] * 3, 10)
    camera = open_driver(VideoFileCamera, file=path, pace="fast")
    assert camera.read(0.0).image.shape == PICTURE.shape
    grown = GrowingMovie(path, (80, 64), 10)
    grown.write(PICTURE)
    grown.close()
    assert open_driver(VideoFileCamera, file=path, pace="fast").read(0.0) is not None


@names
def test_pictures_are_written_and_read_by_any_name(tmp_path: Path, raw: bytes, open_driver) -> None:
    path = odd(tmp_path, raw, ".png")
    write_picture(path, PICTURE)
    assert np.array_equal(read_still(path).image, PICTURE)
    for camera in (
        open_driver(VideoFileCamera, file=path),
        open_driver(ImageFolderCamera, folder=path.parent, pace="fast"),
    ):
        assert np.array_equal(camera.take().image, PICTURE)
    golden = Golden(path.parent, path.parent, is_updating=True)
    golden.check("seen", PICTURE)
    Golden(path.parent, path.parent).check("seen", PICTURE)


@names
def test_sounds_are_read_by_any_name(tmp_path: Path, raw: bytes) -> None:
    wav, flac = odd(tmp_path, raw, ".wav"), tmp_path / os.fsdecode(raw + b".ogg")
    write_wav(wav, np.arange(1600, dtype=np.int16), 16000)
    assert len(load_sound(wav)[0]) == 1600
    flac.write_bytes(b"OggS, and no sound")
    with pytest.raises(HriError, match="not a readable sound file"):
        load_sound(flac)


@names
def test_a_network_of_any_name_is_read(tmp_path: Path, raw: bytes) -> None:
    path = odd(tmp_path, raw, ".onnx")
    path.write_bytes(b"no network")
    with pytest.raises(HriError, match="not a network for pictures"):
        Embedding(path)


CALLS = {
    *("VideoCapture", "VideoWriter", "imread", "imreadmulti", "imwrite", "FileStorage"),
    *("CascadeClassifier", "readNet", "readNetFromONNX", "SoundFile", "InferenceSession", "Model"),
}
"""Those that open a file by the name that is their first argument."""


def opening(tree: ast.AST) -> Iterator[tuple[ast.Call, ast.expr]]:
    """The calls that open a file in a library, and what they are given."""
    for call in ast.walk(tree):
        if isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute):
            given = call.args or [keyword.value for keyword in call.keywords]
            if call.func.attr in CALLS and given:
                yield call, given[0]


def test_every_call_is_given_a_name_that_was_made_for_it() -> None:
    unsafe = []
    for file in Path(hri.__file__).parent.rglob("*.py"):
        text = file.read_text()
        if file.name == "films.py" or not any(f".{name}(" in text for name in CALLS):
            continue  # films of recordings are opened by the number of the open file
        tree = ast.parse(text)
        made = {
            item.optional_vars.id
            for block in ast.walk(tree)
            if isinstance(block, ast.With)
            for item in block.items
            if isinstance(item.optional_vars, ast.Name)
            and ast.unparse(item.context_expr).startswith("native_path(")
        }
        if file.name == "sound_decoder.py":
            made.add("source")  # of unfinished_wav.finished, which gives such a name
        unsafe += [
            f"{file}:{call.lineno}: {ast.unparse(given)}"
            for call, given in opening(tree)
            if not (isinstance(given, ast.Name) and given.id in made)
            and not ast.unparse(given).startswith(("int(", "onnx_of("))  # no names
        ]
    assert unsafe == []
