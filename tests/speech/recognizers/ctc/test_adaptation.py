"""The changes that were learned fit the network, and nothing else is taken for them."""

from __future__ import annotations

import numpy as np
import pytest

from hri.core.errors import HriError
from hri.speech.recognizers.ctc.adaptation import FILE, adapted
from hri.speech.recognizers.ctc.weights import find_weights, read_tensors


def test_changes_are_added_and_the_rest_stays(tmp_path):
    tensors = {
        "matrix": np.ones((3, 2, 1), np.float32),
        "bias": np.zeros(2, np.float32),
        "other": np.ones(4, np.float32),
    }
    np.savez(
        tmp_path / "changes.npz",
        **{
            "matrix.tall": np.array([[1], [2], [3]], np.float16),
            "matrix.wide": np.array([[10, 20]], np.float16),
            "bias": np.array([1, 2], np.float16),
        },
    )
    changed = adapted(tensors, tmp_path / "changes.npz")
    assert changed["matrix"][:, :, 0].tolist() == [[11, 21], [21, 41], [31, 61]]
    assert changed["bias"].tolist() == [1, 2]
    assert changed["other"] is tensors["other"]


def test_the_changes_that_come_with_the_house_fit_the_network():
    tensors = read_tensors(find_weights())
    changed = adapted(tensors)
    assert changed.keys() == tensors.keys()
    assert all(changed[name].shape == tensor.shape for name, tensor in tensors.items())
    assert all(np.isfinite(tensor).all() for tensor in changed.values())
    assert any((changed[name] != tensor).any() for name, tensor in tensors.items())
    assert FILE.stat().st_size < 2_000_000


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "no adaptation"),
        (b"no archive", "no adaptation"),
        (None, "cannot read this adaptation: No such file or directory - check the path"),
    ],
)
def test_a_file_that_is_none_is_refused(tmp_path, content, why):
    if content is not None:
        (tmp_path / "changes.npz").write_bytes(content)
    with pytest.raises(HriError, match=why):
        adapted({}, tmp_path / "changes.npz")


def test_changes_of_another_network_are_refused(tmp_path):
    np.savez(tmp_path / "changes.npz", bias=np.zeros(3, np.float16))
    with pytest.raises(HriError, match="no adaptation"):
        adapted({"bias": np.zeros(2, np.float32)}, tmp_path / "changes.npz")
    with pytest.raises(HriError, match="no adaptation"):
        adapted({}, tmp_path / "changes.npz")
