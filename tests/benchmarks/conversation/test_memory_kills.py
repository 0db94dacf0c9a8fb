"""A robot, and `hri forget`, killed at any system call: nothing is lost, nothing comes back."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from benchmarks.conversation.memory_kills import measure
from benchmarks.interruption import run_interrupted
from hri.core.errors import HriError

pytestmark = pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")


@pytest.fixture(autouse=True)
def traced(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    try:
        run_interrupted(lambda: None)
    except HriError as error:
        pytest.skip(str(error))


def test_at_most_the_last_fact_is_lost_and_nothing_of_who_was_forgotten_is_left(
    tmp_path: Path,
) -> None:
    found = measure(12, tmp_path)
    assert found["is_safe"]
    assert sum(found["facts_lost"].values()) == sum(found["left_after_forgetting"].values()) == 6


def test_a_memory_that_is_written_in_its_place_is_found_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    @contextmanager
    def in_place(path: Path, mode: int) -> Iterator[Path]:
        path.unlink(missing_ok=True)
        path.touch(mode)
        yield path

    monkeypatch.setattr("hri.conversation.memory_file.replacing", in_place)
    assert not measure(24, tmp_path)["is_safe"]
