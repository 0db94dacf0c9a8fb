import numpy as np
import pytest

from hri.bench.face import frames, load_time
from hri.face.model import load_face

MODEL = load_face()


def test_the_face_of_the_bench_talks_and_moves() -> None:
    vectors = np.array(frames.talking(MODEL, 60))
    jaw = vectors[:, MODEL.channels.index("jawOpen")]
    assert np.ptp(jaw) > 0.1
    assert np.ptp(vectors[:, MODEL.channels.index("headRoll")]) > 0


def test_rows_of_frames_tell_what_was_missed() -> None:
    rows = list(frames.rows(MODEL, frames.talking(MODEL, 3), (160, 120)))
    assert [row["unit"] for row in rows] == ["ms"] * 4
    assert all(row["value"] > 0 and "passed" in row for row in rows)


def test_loading_is_measured_with_and_without_what_was_kept(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(load_time, "ROUNDS", 1)
    monkeypatch.setattr(load_time, "_DRAW", "print(0.5, 3.5)")
    baked, raw, first, compiled = load_time.rows()
    assert baked["value"] < raw["value"]
    assert first["value"] == 0.5
    assert compiled["value"] == 3.5
