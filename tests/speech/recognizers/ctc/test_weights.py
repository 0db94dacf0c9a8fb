from __future__ import annotations

import contextlib
import zipfile

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError, NotAvailable
from hri.speech.recognizers.ctc import weights
from hri.speech.recognizers.ctc.weights import FILE, find_weights, read_tensors, take


@pytest.fixture(autouse=True)
def no_choice(monkeypatch):
    monkeypatch.delenv(weights.VARIABLE, raising=False)


def some_tensors():
    return {
        "a": np.arange(6, dtype=np.float32).reshape(2, 3),
        "b.bias": np.full(4, 0.5, np.float32),
    }


def write_weights(path, tensors):
    np.savez_compressed(path, **{name: one.astype(np.float16) for name, one in tensors.items()})
    return path


def test_the_weights_that_come_with_it_are_small():
    assert find_weights() == FILE
    assert FILE.stat().st_size < 12_000_000


def test_a_file_elsewhere_is_named_by_a_parameter_or_the_environment(tmp_path, monkeypatch):
    mine, other = tmp_path / "mine.npz", tmp_path / "other.npz"
    for file in (mine, other):
        write_weights(file, some_tensors())
    monkeypatch.setenv(weights.VARIABLE, str(other))
    assert find_weights() == other
    assert find_weights(str(mine)) == mine
    with pytest.raises(NotAvailable, match="no weight file"):
        find_weights(str(tmp_path / "none.npz"))


def test_tensors_come_back_as_they_were_written(tmp_path):
    tensors = read_tensors(write_weights(tmp_path / "w.npz", some_tensors()))
    assert tensors.keys() == some_tensors().keys()
    for name, tensor in some_tensors().items():
        assert tensors[name].dtype == np.float32
        assert np.array_equal(tensors[name], tensor)


@given(cut=st.integers(0, 10_000), at=st.integers(0, 10_000), byte=st.integers(0, 255))
def test_a_damaged_file_is_refused_or_read_but_never_crashes(tmp_path_factory, cut, at, byte):
    path = write_weights(tmp_path_factory.mktemp("weights") / "w.npz", some_tensors())
    raw = bytearray(path.read_bytes())
    raw[at % len(raw)] = byte
    path.write_bytes(bytes(raw[: cut % (len(raw) + 1)]))
    with contextlib.suppress(NotAvailable):
        assert all(np.isfinite(tensor).all() for tensor in read_tensors(path).values())


@pytest.mark.parametrize("content", [b"", b"no archive"])
def test_another_kind_of_file_is_refused(tmp_path, content):
    path = tmp_path / "w.npz"
    path.write_bytes(content)
    with pytest.raises(NotAvailable, match="not a weight file"):
        read_tensors(path)


def test_what_would_unpack_to_too_much_is_refused(tmp_path):
    path = tmp_path / "w.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("a.npy", bytes(2 * weights.LARGEST))
    with pytest.raises(NotAvailable):
        read_tensors(path)


def test_numbers_that_are_not_finite_are_refused(tmp_path):
    path = write_weights(tmp_path / "w.npz", {"a": np.array([1.0, np.inf])})
    with pytest.raises(NotAvailable, match="a is not finite"):
        read_tensors(path)


def test_a_tensor_of_another_network_is_refused_by_name():
    with pytest.raises(HriError, match=r"another network: a is of shape \(2, 3\)"):
        take(some_tensors(), "a", 3, 2)
    with pytest.raises(HriError, match="c is missing"):
        take(some_tensors(), "c", 3)
