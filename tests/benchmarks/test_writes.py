import random

import pytest

from benchmarks.interruption import run_interrupted
from benchmarks.writers import WRITERS, content
from benchmarks.writes import Site
from hri.core.errors import HriError
from hri.core.writing import write_bytes
from tests.disk import full_disk

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning"),
]


@pytest.fixture(autouse=True)
def traced():
    try:
        run_interrupted(lambda: None)
    except HriError as error:
        pytest.skip(str(error))


def site(tmp_path, write):
    return Site(tmp_path / "site", "file", lambda path, edition: write(path, bytes([edition]) * 9))


def left_by_kills(of):
    stops = range(1, of.stops + 1)
    return {of.interrupt(lambda w, at=at: run_interrupted(w, at), is_there=True) for at in stops}


def test_a_writer_killed_at_any_system_call_leaves_the_old_or_the_new_file(tmp_path):
    assert left_by_kills(site(tmp_path, write_bytes)) == {"old", "new"}


def test_a_writer_in_place_is_found_out(tmp_path):
    in_place = site(tmp_path, lambda path, data: path.write_bytes(data))
    assert "half" in left_by_kills(in_place)


def test_what_a_writer_leaves_behind_is_found_out(tmp_path):
    def write(path, data):
        new = path.with_name(f"new-{random.random()}")
        new.write_bytes(data)
        new.replace(path)

    assert "litter" in left_by_kills(site(tmp_path, write))


@pytest.mark.parametrize("name", WRITERS)
def test_every_writer_leaves_the_old_file_on_a_full_disk_and_says_so(tmp_path, monkeypatch, name):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    path = tmp_path / name
    WRITERS[name](path, 0)
    old = content(path)
    with full_disk(after=5), pytest.raises(HriError, match="make room") as error:
        WRITERS[name](path, 1)
    assert "\n" not in str(error.value)
    assert content(path) == old
    WRITERS[name](path, 1)
    assert content(path) != old
    assert not [entry for entry in path.parent.iterdir() if entry.name.startswith(".")]
