import json
import os
from pathlib import Path

import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError
from hri.core.event_bus import EventBus
from hri.core.event_log import EventLog, read_events
from hri.core.reading import parse_json, read_bytes, read_lines, read_text, require_file
from hri.core.toml import DEEPEST, LARGEST_TOML, load_toml

LONG = Path("a" * 300)


def test_what_is_not_a_file_of_ours_is_refused_at_once(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    strange = [tmp_path, Path("/dev/zero"), tmp_path / "pipe", LONG, Path("a\0b"), tmp_path / "no"]
    for path in strange:
        with pytest.raises(HriError, match=" - "):
            read_bytes(path, "file")
        with pytest.raises(HriError, match=" - "):
            require_file(path, "file")


def test_a_file_is_as_large_as_its_reader_allows(tmp_path: Path) -> None:
    file = tmp_path / "a"
    file.write_bytes(b"12345")
    assert read_bytes(file, "file", 5) == b"12345"
    with pytest.raises(HriError, match="this file is too large - keep it below 4 bytes"):
        read_bytes(file, "file", 4)
    with pytest.raises(HriError, match="too large"):  # has no size before it is read
        read_bytes(Path("/proc/self/status"), "file", 4)


def test_lines_are_read_within_limits(tmp_path: Path) -> None:
    file = tmp_path / "a"
    file.write_bytes(b"\xef\xbb\xbfab\r\ncd")
    with read_lines(file, "list", 100, 10) as lines:
        assert list(lines) == ["ab\r\n", "cd"]
    with (
        pytest.raises(HriError, match="a line that is too long"),
        read_lines(file, "", 9, 3) as lines,
    ):
        list(lines)
    file.write_bytes(b"ab\n\xff")
    with pytest.raises(HriError, match="not a text file"), read_lines(file, "", 9, 9) as lines:
        list(lines)


@pytest.mark.parametrize("text", ["[" * 100_000, "9" * 400, "-" + "9" * 5000, "{", "nope", ""])
def test_json_that_breaks_readers_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=r"\w"):
        parse_json(text)


@pytest.mark.parametrize("part", ["a", '"a b"', "'x'"])
def test_deep_keys_of_toml_are_refused_before_they_take_memory(part: str, tmp_path: Path) -> None:
    file = tmp_path / "a.toml"
    deep = ".".join([part] * 5000)
    for text in (f"[{deep}]\nb = 1\n" * 3, f"\n\n{deep} = 1", f"a = {{ {deep} = 1 }}"):
        file.write_text(text)
        with pytest.raises(AuthoringError, match=f"a key of more than {DEEPEST} parts"):
            load_toml(file)
    file.write_text(".".join([part] * DEEPEST) + ' = "a.b"')
    load_toml(file)


def test_long_words_and_large_files_of_toml_take_no_time(tmp_path: Path) -> None:
    file = tmp_path / "a.toml"
    file.write_text(f"a = {{ {'a' * 300_000} = 1 }}")  # took hours
    load_toml(file)
    file.write_text("#" * (LARGEST_TOML + 1))
    with pytest.raises(HriError, match="too large"):
        load_toml(file)


JSON_TEXT = st.text(st.characters())  # halves of letters and separators of lines, too
PLAIN = st.recursive(
    st.none()
    | st.booleans()
    | st.integers(-(10**18), 10**18)
    | st.floats(allow_nan=False, allow_infinity=False)
    | JSON_TEXT,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(JSON_TEXT, inner, max_size=3),
    max_leaves=8,
)


@given(events=st.lists(st.tuples(JSON_TEXT, st.dictionaries(JSON_TEXT, PLAIN, max_size=3))))
def test_every_event_survives_being_written_and_read(
    tmp_path_factory: pytest.TempPathFactory, events: list[tuple[str, dict[str, object]]]
) -> None:
    file = tmp_path_factory.mktemp("log") / "events.jsonl"
    bus = EventBus(FakeClock())
    log = EventLog(file, bus)
    for name, properties in events:
        bus.raise_event(name, **properties)
    log.close()
    expected = [{**properties, "t": 0.0, "event": name} for name, properties in events]
    assert read_events(file) == expected


def test_a_log_is_read_to_its_last_whole_line(tmp_path: Path) -> None:
    file = tmp_path / "events.jsonl"
    line = json.dumps({"t": 0.1, "event": "a"})
    file.write_text(f'{line}\n{line}\n{{"t": 0.2, "ev')
    assert [event["t"] for event in read_events(file)] == [0.1, 0.1]
    file.write_text(f"{line}\nnot JSON\n")
    with pytest.raises(AuthoringError, match=":2:1: not JSON"):
        read_events(file)
    assert read_text(file, "log").startswith(line)


@pytest.mark.parametrize("part", ["[],", "{},", '"a",', "1,"])
def test_a_long_text_of_json_that_would_fill_the_memory_is_refused(part: str) -> None:
    for text in (f"[{part * 3_100_000}1]", f"[{part * 3_100_000}1]".encode()):
        with pytest.raises(ValueError, match="too many lists, texts, or values"):
            parse_json(text)
    assert len(parse_json(f"[{part * 1000}1]")) == 1001
