"""A robot with timers, killed at any system call: none is lost, none is said twice as new."""

from pathlib import Path

import pytest

from benchmarks.conversation.timer_kills import TIMERS, measure
from benchmarks.interruption import run_interrupted
from hri.conversation.alarm_keeper import AlarmKeeper
from hri.core.errors import HriError

pytestmark = pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")


@pytest.fixture(autouse=True)
def traced(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    try:
        run_interrupted(lambda: None)
    except HriError as error:
        pytest.skip(str(error))


def test_none_is_lost_and_none_is_doubled(tmp_path: Path) -> None:
    found = measure(2, tmp_path)
    assert found["is_safe"]
    assert found["said"] == 2 * TIMERS


def test_a_keeper_that_does_not_wait_for_the_disk_is_found_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def kept(self: AlarmKeeper) -> bool:
        return True

    monkeypatch.setattr(AlarmKeeper, "kept", kept)
    monkeypatch.setattr(AlarmKeeper, "poll", lambda self: self.alarms.look(self.instant()))
    assert not measure(2, tmp_path)["is_safe"]
