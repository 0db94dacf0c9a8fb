import sys

import pytest

from benchmarks.face import skia
from hri.bench.face import frames
from hri.core.errors import NotAvailable
from hri.face.model import load_face

MODEL = load_face()


def test_without_skia_its_rows_say_why(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "skia", None)
    with pytest.raises(NotAvailable, match="pip install skia-python"):
        list(skia.rows(MODEL, frames.talking(MODEL, 1), (160, 120)))


def test_skia_draws_the_same_picture() -> None:
    pytest.importorskip("skia")
    times, difference = skia.rows(MODEL, frames.talking(MODEL, skia.WARM + 2), (320, 240))
    assert times["value"] > 0
    assert difference["value"] < 1.5
