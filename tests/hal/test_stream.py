"""A file as a stream, as the tutorial of a driver of one's own has it."""

import io

import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.hal.configuration import load_configuration
from hri.hal.drivers.file_stream import FileStream
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.stream import Seek, Stream

pytestmark = pytest.mark.proves("H22")


def test_testing_is_written(tmp_path, open_driver):
    stream = open_driver(FileStream, file_path=tmp_path / "output.txt")
    stream.write(b"Testing")
    assert stream.position == 7
    stream.deactivate()
    assert (tmp_path / "output.txt").read_bytes() == b"Testing"


def test_a_text_is_written_as_in_2003(tmp_path, open_driver):
    stream = open_driver(FileStream, file_path=tmp_path / "output.txt")
    stream.write("Größe ")
    stream.write(bytearray(b"9"))
    with pytest.raises(HriError, match="cannot write 5 - give bytes or a text"):
        stream.write(5)
    stream.deactivate()
    assert (tmp_path / "output.txt").read_text(encoding="utf-8") == "Größe 9"


@pytest.mark.parametrize(("truncate", "after"), [("true", b"new"), ("false", b"old new")])
def test_truncate_says_whether_the_file_is_kept(tmp_path, open_driver, truncate, after):
    (tmp_path / "f").write_bytes(b"old ")
    stream = open_driver(FileStream, file_path=tmp_path / "f", truncate=truncate)
    assert stream.position == 0
    stream.write(b"new")
    stream.seek(Seek.ABSOLUTE, 0)
    assert stream.read(100) == after


def test_a_position_is_reached_from_three_sides(tmp_path, open_driver):
    (tmp_path / "f").write_bytes(b"0123456789")
    stream = open_driver(FileStream, file_path=tmp_path / "f")
    stream.seek(Seek.ABSOLUTE, 4)
    assert stream.read(2) == b"45"
    stream.seek(Seek.RELATIVE, -1)
    assert (stream.position, stream.read(1)) == (5, b"5")
    stream.seek(Seek.END, -3)
    assert stream.read(10) == b"789"
    with pytest.raises(ValueError, match="before the beginning"):
        stream.seek(Seek.ABSOLUTE, -1)
    with pytest.raises(ValueError, match="read 0 or more"):
        stream.read(-1)


steps = st.one_of(
    st.tuples(st.just("read"), st.integers(0, 20)),
    st.tuples(st.just("write"), st.binary(max_size=20)),
    st.tuples(st.just("seek"), st.integers(0, 30)),
)


@given(st.lists(steps, max_size=20))
def test_it_does_what_bytes_in_memory_do(tmp_path_factory, steps):
    path = tmp_path_factory.mktemp("stream") / "f"
    description = Description("s", "Hri.FileStream", {"file_path": str(path), "truncate": "true"})
    stream, model = FileStream(description, ResourceManager((), FakeClock())), io.BytesIO()
    stream.activate()
    for verb, value in steps:
        if verb == "read":
            assert stream.read(value) == model.read(value)
        elif verb == "write":
            stream.write(value)
            model.write(value)
        else:
            stream.seek(Seek.ABSOLUTE, value)
            model.seek(value)
        assert stream.position == model.tell()
    stream.deactivate()
    assert path.read_bytes() == model.getvalue()


def test_the_spec_gives_the_defaults(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "c.xml").write_text(
        '<Resources><Devices><Device id="stream" type="Examples.FileStream"/></Devices></Resources>'
    )
    manager = ResourceManager(load_configuration(tmp_path / "c.xml").devices, FakeClock())
    manager.check()
    manager.obtain("stream", Stream).write(b"Testing")
    manager.close()
    assert (tmp_path / "file_stream_output.txt").read_bytes() == b"Testing"


def test_a_file_that_cannot_be_opened_is_one_line(tmp_path, manager):
    stream = FileStream(Description("s", "T", {"file_path": str(tmp_path / "no" / "f")}), manager)
    with pytest.raises(HriError, match="cannot be opened: No such file or directory - check"):
        stream.activate()
