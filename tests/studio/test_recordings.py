"""Recordings in the studio: what lies in a folder is shown, and anything else refused in a line."""

import json
import os
import struct
import threading
from contextlib import suppress

import numpy as np
import psutil
import pytest
from hypothesis import given, strategies as st
from starlette.testclient import TestClient

from hri.core.errors import HriError
from hri.core.growing_files import GrowingFile
from hri.core.recorded import EVENTS, FACE, SOUND, STARTED
from hri.core.stored_data_index import note
from hri.core.token import own_token
from hri.hal.drivers.growing_movie import GrowingMovie
from hri.hal.drivers.wav_file import GrowingWav, write_wav
from hri.studio import films, recordings
from hri.studio.films import Film, Films
from hri.studio.hub import Hub
from hri.studio.recording_routes import span
from hri.studio.server import Settings, Studio
from tests.studio.recorded import RATE, SIZE, brightness, film, log

ALL = "/api/v1/recordings"
SECRET = "nobody may read this"


@pytest.fixture
def folder(tmp_path):
    """A recording of four seconds on a clock that had run for two before."""
    made = tmp_path / "out"
    made.mkdir()
    log(
        made,
        {"t": 2.0, "event": STARTED, "face": 2.0, "sound": 2.5},
        {"t": 3.5, "event": "speech.said", "text": "Hello."},
    )
    film(made / FACE, 120)
    write_wav(made / SOUND, np.arange(22050, dtype=np.int16), 22050)
    return made


@pytest.fixture
def stranger():
    studio = Studio(Hub(None), Settings(8311, "secret", allows_remote=False))
    with TestClient(studio.app(), "http://127.0.0.1:8311", backend="trio") as made:
        yield made


@pytest.fixture
def person(stranger):
    stranger.headers["authorization"] = f"Bearer {own_token()}"
    return stranger


def listed_in(place, person):
    """Recordings below a folder: other tests may have noted some, too."""
    told = person.get(ALL).json()["recordings"]
    return [one for one in told if one["folder"].startswith(f"{place}/")]


# --- what is there ---


def test_a_recording_is_described_on_one_clock(person, folder):
    told = person.get(f"{ALL}/about", params={"folder": folder}).json()
    assert (told["start"], told["end"], told["wrong"]) == (2.0, 6.0, [])
    assert told["face"] == {"start": 2.0, "length": 4.0, "rate": RATE}
    assert told["sound"] == {"start": 2.5, "length": 1.0, "bytes": 44 + 2 * 22050}
    assert told["words"]["fear"] == "scared"
    assert not told["is_growing"]


def test_the_picture_is_that_of_the_time(person, folder):
    for time in (2.0, 3.0, 3.05, 5.5, 2.5, 99.0, 0.0):
        answer = person.get(f"{ALL}/face", params={"folder": folder, "t": time})
        assert answer.headers["content-type"] == "image/jpeg"
        number = min(119, max(0, int((time - 2) * RATE + 0.01)))
        assert brightness(answer.content) == pytest.approx(number, abs=4)


@pytest.mark.parametrize("is_killed", [False, True])
def test_each_picture_is_found_in_any_order(folder, is_killed):
    (folder / FACE).unlink()
    film(folder / FACE, 200, is_killed)
    opened = Film(folder)
    for number in [
        *range(60),
        199,
        0,
        100,
        101,
        130,
        50,
        *np.random.default_rng(1).permutation(200),
    ]:
        assert brightness(opened.jpeg(2 + number / RATE)) == pytest.approx(number, abs=4)
    opened.close()


def test_events_come_in_parts_that_miss_and_repeat_nothing(person, folder, monkeypatch):
    monkeypatch.setattr(recordings, "PART", 100)
    log(folder, *({"t": number, "event": "é", "text": number % 40 * "x"} for number in range(50)))
    begin, found = 0, []
    while True:
        part = person.get(f"{ALL}/events", params={"folder": folder, "from": begin}).json()
        found += [event["t"] for event in part["events"]]
        assert part["skipped"] == 0
        if part["is_all"]:
            break
        begin = part["next"]
    assert found == list(range(50))


def test_a_recording_that_grows_is_shown_as_far_as_it_is(person, tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    events, movie = GrowingFile(out / EVENTS), GrowingMovie(out / FACE, SIZE, RATE)
    sound = GrowingWav(out / SOUND, 22050)
    begin = 0
    for second in range(3):
        events.append(b'{"t": %d, "event": "x"}\n{"t": %d, "ev' % (second, second))
        sound.append(np.zeros(22050, np.int16))
        for _ in range(31 if second == 0 else 30):  # the very first is a fragment by itself
            movie.write(np.full((*SIZE[::-1], 3), 50 * second, np.uint8))
        told = person.get(f"{ALL}/about", params={"folder": out}).json()
        assert told["is_growing"]
        assert told["end"] == pytest.approx(second + 1, abs=0.1)
        part = person.get(f"{ALL}/events", params={"folder": out, "from": begin}).json()
        assert [event["t"] for event in part["events"]] == [second - 1, second][
            -min(second + 1, 2) :
        ]
        begin = part["next"]
        seen = person.get(f"{ALL}/face", params={"folder": out, "t": 99}).content
        assert brightness(seen) == pytest.approx(50 * second, abs=4)
        events.append(b'ent": "y"}\n')
    for file in (events, movie, sound):
        file.close()
    assert not person.get(f"{ALL}/about", params={"folder": out}).json()["is_growing"]


@pytest.mark.parametrize("missing", [{FACE}, {SOUND}, {FACE, SOUND}])
def test_what_is_missing_is_said_and_the_rest_is_shown(person, folder, missing):
    for name in missing:
        (folder / name).unlink()
    told = person.get(f"{ALL}/about", params={"folder": folder}).json()
    assert [told["face"] is None, told["sound"] is None] == [
        name in missing for name in (FACE, SOUND)
    ]
    assert len(told["wrong"]) == len(missing)
    for name, path in ((FACE, "face?t=3"), (SOUND, "sound?")):
        answer = person.get(f"{ALL}/{path}&folder={folder}")
        assert answer.is_error == (name in missing)


def test_the_list_has_noted_ones_and_those_here_the_newest_first(
    person, folder, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    for age, name in enumerate(("new", "old")):
        here = tmp_path / "recordings" / name
        here.mkdir(parents=True)
        log(here, {"t": 7.5, "event": "x"})
        os.utime(here / EVENTS, (1e9 - age, 1e9 - age))
    (tmp_path / "recordings" / "empty").mkdir()
    note("recording", folder)
    note("recording", tmp_path / "recordings" / "new")
    told = listed_in(tmp_path, person)
    assert [one["name"] for one in told] == ["out", "new", "old"]
    assert [one["length"] for one in told] == [1.5, 7.5, 7.5]
    assert told[0]["bytes"] == sum(file.stat().st_size for file in folder.iterdir())


# --- sound, in parts ---


@pytest.mark.parametrize(
    ("wish", "status", "part"),
    [
        ("", 200, slice(None)),
        ("bytes=0-", 206, slice(None)),
        ("bytes=10-19", 206, slice(10, 20)),
        ("bytes=44000-99999999", 206, slice(44000, None)),
        ("bytes=-5", 206, slice(-5, None)),
        ("bytes=99999999-", 416, slice(0, 0)),
        ("bytes=5-4", 416, slice(0, 0)),
        ("bytes=-", 416, slice(0, 0)),
        ("bytes=0-1,5-9", 200, slice(None)),
        ("lines=1-2", 200, slice(None)),
        ("bytes=9999999999999999999999-", 200, slice(None)),
    ],
)
def test_a_player_gets_the_part_of_the_sound_that_it_asks_for(person, folder, wish, status, part):
    sound = (folder / SOUND).read_bytes()
    answer = person.get(f"{ALL}/sound", params={"folder": folder}, headers={"range": wish})
    assert (answer.status_code, answer.content) == (status, sound[part])
    if status == 206:
        begin, end, _ = part.indices(len(sound))
        assert answer.headers["content-range"] == f"bytes {begin}-{end - 1}/{len(sound)}"


def test_a_sound_that_grows_keeps_the_length_that_it_had(person, folder):
    told = person.get(f"{ALL}/sound", params={"folder": folder, "bytes": 1044})
    assert len(told.content) == 1044
    assert (
        person.head(f"{ALL}/sound", params={"folder": folder}).headers["content-length"] == "44144"
    )


@given(st.text(alphabet="bytes=-,0123456789 ", max_size=20), st.integers(0, 1000))
def test_no_wish_leads_out_of_the_file(wish, size):
    begin, end = span(wish, size)
    assert 0 <= begin <= end <= size


# --- who may see it, and what ---


@pytest.mark.parametrize("name", ["", "/about", "/events", "/face", "/sound"])
def test_strangers_learn_nothing(stranger, folder, name):
    answer = stranger.get(f"{ALL}{name}", params={"folder": folder, "t": 3})
    assert answer.status_code == 401
    assert str(folder) not in answer.text


def test_the_interface_is_described(stranger):
    paths = stranger.get("/api/v1/openapi.json").json()["paths"]
    names = {route.path for route in Studio(Hub(None), Settings(1, "", False)).app()._app.routes}
    assert {name for name in names if name.startswith(ALL)} == {
        path for path in paths if path.startswith(ALL)
    }


@pytest.mark.parametrize("place", ["", "/", "/missing", "\0", "x" * 5000, "~nobody_there/x"])
def test_a_folder_without_a_log_is_not_opened(person, place):
    for name in ("about", "events", "face", "sound"):
        answer = person.get(f"{ALL}/{name}", params={"folder": place, "t": 0})
        assert answer.status_code == 404
        assert len(answer.json()["error"]) < 400


def test_a_folder_whose_name_no_page_can_show_is_left_out(person, folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    odd = tmp_path / "recordings" / "\udcff"
    odd.parent.mkdir()
    folder.rename(odd)
    assert listed_in(tmp_path, person) == []
    with pytest.raises(HriError, match="not the name of a folder"):
        recordings.folder_of(str(odd))


@pytest.mark.parametrize(
    "query", ["face?", "face?t=nan", "face?t=-1", "face?t=1e999", "events?from=x", "sound?bytes=-1"]
)
def test_numbers_that_make_no_sense_are_refused(person, folder, query):
    assert person.get(f"{ALL}/{query}&folder={folder}").status_code == 400


@pytest.mark.parametrize("name", [EVENTS, FACE, SOUND])
@pytest.mark.parametrize("kind", ["link", "fifo", "folder", "device", "secret"])
def test_only_files_of_a_recording_are_read_and_nothing_hangs(person, folder, tmp_path, name, kind):
    (tmp_path / "secret").write_text(SECRET)
    (folder / name).unlink()
    {
        "link": lambda place: place.symlink_to(tmp_path / "secret"),
        "fifo": os.mkfifo,
        "folder": os.mkdir,
        "device": lambda place: place.symlink_to("/dev/zero"),
        "secret": lambda place: place.write_text(SECRET),
    }[kind](folder / name)
    for path in ("about?", "events?", "face?t=3", "sound?"):
        answer = person.get(f"{ALL}/{path}&folder={folder}")
        assert answer.status_code in (200, 404)
        assert SECRET not in answer.text


# --- files that someone has damaged ---

LINES = st.one_of(
    st.binary(max_size=60),
    st.builds(
        lambda t, more: json.dumps({"t": t, "event": "x", **more}).encode(),
        st.one_of(st.floats(), st.integers(), st.none(), st.booleans(), st.text(max_size=3)),
        st.dictionaries(
            st.text(max_size=5),
            st.one_of(st.floats(), st.text(max_size=5), st.integers()),
            max_size=3,
        ),
    ),
    st.sampled_from(
        [b'{"t": 1, "event": "\\ud800"}', b'{"t": 1e999, "event": "x"}', b"[" * 9999,
         b'{"t": NaN, "event": "x"}', b'{"t": 1, "event": "x", "a": ' + b"9" * 5000 + b"}",
         b"\xff\xfe{}", b"null"]
    ),
)  # fmt: skip


@given(st.lists(LINES, max_size=8), st.integers(0, 300), st.booleans())
def test_whatever_a_log_holds_the_page_gets_json(tmp_path_factory, lines, begin, is_torn):
    folder = tmp_path_factory.mktemp("out")
    data = b"\n".join(lines) + b"\n" * (not is_torn)
    (folder / EVENTS).write_bytes(data)
    recordings.summary(folder)
    if begin > len(data):
        with pytest.raises(HriError, match="begin again at 0"):
            recordings.events_of(folder, begin)
        return
    told = json.loads(
        recordings.events_of(folder, begin), parse_constant=lambda name: pytest.fail(name)
    )
    assert told["is_all"]
    assert begin <= told["next"] <= len(data)
    for event in told["events"]:
        assert 0 <= event["t"] <= recordings.LONGEST
        assert isinstance(event["event"], str)


@given(st.data())
def test_a_damaged_film_is_refused_in_a_line(tmp_path_factory, data):
    folder = tmp_path_factory.mktemp("out")
    log(folder, {"t": 0, "event": "x"})
    film(folder / FACE, 35)
    raw = bytearray((folder / FACE).read_bytes())
    for _ in range(data.draw(st.integers(0, 20))):
        place = data.draw(st.integers(8, len(raw) - 4))
        raw[place : place + 4] = struct.pack(">I", data.draw(st.integers(0, 2**32 - 1)))
    (folder / FACE).write_bytes(raw[: data.draw(st.integers(0, len(raw)))])
    known = Films()
    for time in (0.0, 0.5, 1.1, 99.0):
        with suppress(HriError):  # a line, and no other error
            assert known.film(folder).jpeg(time).startswith(b"\xff\xd8")
    known.close_unused()
    known.close_unused()


def test_a_film_that_is_a_giant_is_refused(folder, monkeypatch):
    monkeypatch.setattr(films, "LARGEST_SIDE", SIZE[0] - 1)
    with pytest.raises(HriError, match="the film is damaged"):
        Film(folder)


@pytest.mark.parametrize(
    "head", [b"", b"RIFF", b"RIFF" + bytes(40), b"\xff" * 60, b"OggS" + bytes(99)]
)
def test_a_sound_that_we_have_not_written_is_refused(person, folder, head):
    (folder / SOUND).write_bytes(head)
    answer = person.get(f"{ALL}/sound", params={"folder": folder})
    assert answer.status_code == 404
    assert "not a sound of a recording" in answer.json()["error"]


def test_a_log_of_two_gigabytes_takes_neither_time_nor_memory(person, folder):
    with (folder / EVENTS).open("ab") as file:
        file.truncate(2_000_000_000)  # zeros, which no disk keeps
        file.seek(0, os.SEEK_END)
        file.write(b'\n{"t": 60.0, "event": "x"}\n')
    before = psutil.Process().memory_info().rss
    told = person.get(f"{ALL}/about", params={"folder": folder}).json()
    assert told["end"] == 60.0
    begin, parts = 0, 0
    while parts < 5:
        part = person.get(f"{ALL}/events", params={"folder": folder, "from": begin}).json()
        assert part["next"] > begin
        begin, parts = part["next"], parts + 1
    last = person.get(f"{ALL}/events", params={"folder": folder, "from": 1_999_999_990}).json()
    assert [event["t"] for event in last["events"]] == [60.0]
    assert psutil.Process().memory_info().rss - before < 50e6


def test_films_that_no_one_looks_at_are_closed(folder, tmp_path):
    def is_open(place):
        return str(place / FACE) in {file.path for file in psutil.Process().open_files()}

    known = Films()
    known.film(folder).jpeg(2.0)
    known.close_unused()
    assert is_open(folder)
    known.close_unused()
    assert not is_open(folder)
    others = []
    for number in range(3):
        other = tmp_path / str(number)
        other.mkdir()
        log(other, {"t": 0, "event": "x"})
        film(other / FACE, 2)
        known.film(other)
        others.append(other)
    assert [is_open(other) for other in others] == [False, True, True]
    known.close_unused()
    known.close_unused()


def test_pages_that_scrub_at_once_get_each_its_picture(person, folder):
    wrong = []

    def scrub(seed):
        for number in np.random.default_rng(seed).integers(0, 120, 15):
            answer = person.get(f"{ALL}/face", params={"folder": folder, "t": 2 + number / RATE})
            if abs(brightness(answer.content) - number) > 4:
                wrong.append(number)

    pages = [threading.Thread(target=scrub, args=(seed,)) for seed in range(3)]
    for page in pages:
        page.start()
    for page in pages:
        page.join()
    assert wrong == []
