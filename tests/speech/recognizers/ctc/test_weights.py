from __future__ import annotations

import contextlib
import subprocess
import sys
from importlib.metadata import distribution

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.errors import HriError, NotAvailable
from hri.speech.recognizers.ctc import weights
from hri.speech.recognizers.ctc.weights import find_weights, read_tensors, take
from tests.speech.recognizers.weight_file import some_tensors, write_weights


@pytest.fixture(autouse=True)
def no_choice(monkeypatch):
    monkeypatch.delenv(weights.VARIABLE, raising=False)


def test_the_file_of_the_package_is_found_without_running_the_package():
    program = "\n".join(
        [
            "import sys",
            "from hri.speech.recognizers.ctc.weights import find_weights",
            "print(find_weights().name, 'hama' in sys.modules)",
        ]
    )
    answer = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert answer.stdout.split() == ["asr_waveform.hama", "False"]


def test_the_checksum_is_the_one_the_package_was_published_with():
    import base64

    entry = next(f for f in distribution("hama").files or [] if f.name == "asr_waveform.hama")
    assert entry.hash is not None
    assert base64.urlsafe_b64decode(entry.hash.value + "=").hex() == weights.SHA256


def test_another_file_in_the_package_is_refused_with_the_remedy(monkeypatch):
    monkeypatch.setattr(weights, "SHA256", "0" * 64)
    with pytest.raises(NotAvailable, match=r"not the file of hama==1\.7\.0 - pip install"):
        find_weights()


def test_without_the_package_the_error_says_what_to_install(monkeypatch):
    monkeypatch.setattr(weights.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(NotAvailable, match="pip install hama"):
        find_weights()


def test_a_file_elsewhere_is_named_by_a_parameter_or_the_environment(tmp_path, monkeypatch):
    mine, other = tmp_path / "mine.hama", tmp_path / "other.hama"
    for file in (mine, other):
        write_weights(file, some_tensors())
    monkeypatch.setenv(weights.VARIABLE, str(other))
    assert find_weights() == other
    assert find_weights(str(mine)) == mine
    with pytest.raises(NotAvailable, match="no weight file"):
        find_weights(str(tmp_path / "none.hama"))


def test_tensors_come_back_as_they_were_written(tmp_path):
    tensors = read_tensors(write_weights(tmp_path / "w.hama", some_tensors()))
    assert tensors.keys() == some_tensors().keys()
    for name, tensor in some_tensors().items():
        assert tensors[name].dtype == np.float32
        assert np.array_equal(tensors[name], tensor)


@given(cut=st.integers(0, 10_000), at=st.integers(0, 10_000), byte=st.integers(0, 255))
def test_a_damaged_file_is_refused_or_read_but_never_crashes(tmp_path_factory, cut, at, byte):
    path = write_weights(tmp_path_factory.mktemp("weights") / "w.hama", some_tensors())
    raw = bytearray(path.read_bytes())
    raw[at % len(raw)] = byte
    path.write_bytes(bytes(raw[: cut % (len(raw) + 1)]))
    with contextlib.suppress(NotAvailable):
        assert all(np.isfinite(tensor).all() for tensor in read_tensors(path).values())


def test_a_header_that_promises_more_than_the_file_holds_is_refused(tmp_path):
    path = tmp_path / "w.hama"
    path.write_bytes(b"HAMAPK\x01\x02" + b"\xff\xff\xff\xff" + bytes(64))
    with pytest.raises(NotAvailable, match="no weight file"):
        read_tensors(path)


def test_a_tensor_of_another_network_is_refused_by_name():
    with pytest.raises(HriError, match=r"another network: a is of shape \(2, 3\)"):
        take(some_tensors(), "a", 3, 2)
    with pytest.raises(HriError, match="c is missing"):
        take(some_tensors(), "c", 3)
