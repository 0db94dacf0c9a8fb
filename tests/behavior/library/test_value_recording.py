import contextlib
import json
import math

import pytest
from hypothesis import given, settings, strategies as st

from hri.behavior.library.value_recording import ValuePlayer, ValueRecorder
from hri.core.errors import AuthoringError, HriError
from hri.testing import context
from tests.behavior.library.ticking import Links, tick

VALUES = st.one_of(
    st.floats(allow_nan=False, allow_infinity=False),
    st.text(max_size=9),
    st.booleans(),
    st.lists(st.floats(-9, 9), max_size=3).map(tuple),
)


def recorded(path, values, **parameters):
    recorder = ValueRecorder("rec", file=str(path), **parameters)
    recorder.start(context())
    try:
        for k, value in enumerate(values):
            tick(recorder, now=k * 0.1, input=value)
    finally:
        recorder.stop()
    return path.read_text()


def played(path, ticks, interval=0.1):
    player = ValuePlayer("play", file=str(path))
    player.check()
    player.start(context())
    return [tick(player, now=k * interval).get("value") for k in range(ticks)]


@settings(max_examples=50)
@given(values=st.lists(st.none() | VALUES, max_size=20))
def test_what_was_recorded_is_played_at_the_same_ticks(values, tmp_path_factory):
    path = tmp_path_factory.mktemp("recording") / "values.jsonl"
    recorded(path, values)
    again = played(path, len(values) + 3)
    assert again == [*values, None, None, None]
    assert [type(value) for value in again[: len(values)]] == [type(value) for value in values]


def test_a_slow_player_sends_the_newest_value_and_a_fast_one_keeps_the_times(tmp_path):
    path = tmp_path / "values.jsonl"
    recorded(path, [1.0, 2.0, 3.0, 4.0])
    assert played(path, 2, interval=0.25) == [1.0, 3.0]
    assert played(path, 5, interval=0.05) == [1.0, None, 2.0, None, 3.0]


def test_a_line_holds_time_and_value(tmp_path):
    lines = recorded(tmp_path / "v", [Links([0.5, "cup"]), math.inf]).splitlines()
    assert [json.loads(line) for line in lines] == [
        {"t": 0.0, "value": 0.5},
        {"t": 0.0, "value": "cup"},
        {"t": 0.1, "value": 1.7976931348623157e308},
    ]


def test_a_recording_has_a_bound_and_says_so_once(tmp_path, caplog):
    assert len(recorded(tmp_path / "v", [1.0] * 9, max_lines=3).splitlines()) == 3
    assert caplog.text.count("raise max_lines") == 1


def test_what_no_file_can_hold_is_refused(tmp_path):
    with pytest.raises(HriError, match="no value of type object can"):
        recorded(tmp_path / "v", [object()])
    with pytest.raises(HriError, match="cannot be written"):
        recorded(tmp_path / "none" / "v", [])


@pytest.mark.parametrize(
    "line",
    [
        "",
        "x",
        "[1]",
        '{"t": 0}',
        '{"t": "0", "value": 1}',
        '{"t": 0, "value": null}',
        '{"t": 0, "value": ["x"]}',
        '{"t": 0, "value": 1, "extra": 2}',
    ],
)
def test_a_line_that_is_no_value_is_found_before_it_starts(line, tmp_path):
    path = tmp_path / "values.jsonl"
    path.write_text(f'{{"t": 0, "value": 1}}\n{line}\n{{"t": 0, "value": 1}}\n')
    with pytest.raises(AuthoringError, match=r"values\.jsonl:2:1: .+ - write"):
        played(path, 1)


@given(text=st.text())
def test_no_text_makes_the_player_stumble(text, tmp_path_factory):
    path = tmp_path_factory.mktemp("fuzz") / "values.jsonl"
    path.write_text(text, encoding="utf-8", errors="replace")
    with contextlib.suppress(AuthoringError):
        ValuePlayer(file=str(path)).check()
