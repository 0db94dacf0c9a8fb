"""Baked faces on disk: a shortcut that is never out of date and never in the way."""

import json
from pathlib import Path

import numpy as np
import pytest

from hri.face.drawing import cache
from hri.face.drawing.baking import DisplayList
from hri.face.drawing.cache import baked
from hri.face.drawing.serialization import UNIT, exported, restored, structure
from hri.face.settings import HeadSettings
from tests.face.small_face import write_face

HEAD = HeadSettings((50, 50), (40, 40), 40, 25, 15, ("neck",), {})


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    return write_face(tmp_path / "mine")


def load(folder: Path, head: HeadSettings | None = HEAD) -> DisplayList:
    return baked(folder / "neutral.svg", sorted((folder / "targets").iterdir()), head)


def kept() -> list[Path]:
    return sorted(cache.folder().iterdir())


def same(one: DisplayList, other: DisplayList) -> bool:
    return (
        structure(one) == structure(other)
        and np.array_equal(one.neutral, other.neutral)
        and np.array_equal(one.rows, other.rows)
    )


def test_what_is_kept_is_what_was_baked(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    first = load(folder)
    monkeypatch.setattr(cache, "bake", None)
    assert same(load(folder), first)


def test_any_change_of_a_file_or_of_the_head_is_baked_anew(folder: Path) -> None:
    first = load(folder)
    assert not same(load(folder, None), first)
    file = folder / "neutral.svg"
    file.write_text(file.read_text().replace('r="6"', 'r="7"'))
    assert not same(load(folder), first)
    (folder / "targets" / "tear.svg").rename(folder / "targets" / "drop.svg")
    assert "drop" in load(folder).channels
    assert len(kept()) == 4


@pytest.mark.parametrize("damage", [b"", b"damaged", None, "half", "folder"])
def test_a_damaged_file_is_baked_anew(folder: Path, damage: object) -> None:
    first = load(folder)
    (file,) = kept()
    raw = file.read_bytes()
    if damage == "folder":
        file.unlink()
        file.mkdir()
    elif damage == "half":
        file.write_bytes(raw[: len(raw) // 2])
    elif damage is None:
        file.write_bytes(raw[:-1] + bytes([raw[-1] ^ 1]))
    else:
        assert isinstance(damage, bytes)
        file.write_bytes(damage)
    assert same(load(folder), first)


def test_a_file_of_another_program_is_baked_anew(folder: Path) -> None:
    first = load(folder)
    (file,) = kept()
    rest = b'{"length": 3}\n' + bytes(24)
    file.write_bytes(cache.hashlib.blake2b(rest, digest_size=32).digest() + rest)
    assert same(load(folder), first)


def test_a_cache_that_cannot_be_written_is_done_without(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    assert load(folder).channels


def test_the_cache_keeps_few_files(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "MOST_FILES", 3)
    for degrees in range(5):
        load(folder, HeadSettings((50, 50), (40, 40), 40, degrees, 15, (), {}))
    assert len(kept()) == 3
    assert not [file for file in kept() if file.suffix != ".face"]


def test_the_cache_keeps_few_bytes(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    load(folder)
    (file,) = kept()
    monkeypatch.setattr(cache, "MOST_BYTES", file.stat().st_size * 5)
    for degrees in range(8):
        load(folder, HeadSettings((50, 50), (40, 40), 40, degrees, 15, (), {}))
    assert sum(file.stat().st_size for file in kept()) <= cache.MOST_BYTES
    monkeypatch.setattr(cache, "MOST_BYTES", 1000)
    assert load(folder, None).channels


def test_what_is_exported_draws_the_same(folder: Path) -> None:
    display = load(folder)
    plain = json.loads(json.dumps(exported(display)))
    rows = np.zeros((len(plain["rows"]), len(plain["neutral"])), np.float32)
    for row, name in zip(rows, plain["rows"], strict=True):
        row[plain["rows"][name]["at"]] = plain["rows"][name]["by"]
    neutral = np.array(plain["neutral"], np.float32) * UNIT
    again = restored(plain, neutral, rows * UNIT)
    assert structure(again) == structure(display)
    assert np.allclose(again.rows, display.rows, atol=UNIT)
    assert np.allclose(again.neutral, display.neutral, atol=UNIT)
