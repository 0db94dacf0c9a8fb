"""A recording is announced, only its owner can read it, and rejected words are left out."""

import io
import json
import platform
import stat
from contextlib import ExitStack
from datetime import datetime
from importlib.metadata import version

import cv2
import pytest

from hri import Robot
from hri.cli.run.narrator import Narrator
from hri.core.clock import FakeClock
from hri.core.errors import HriError
from hri.core.event_log import read_events
from hri.core.growing_files import GrowingFile
from hri.core.recorded import ABOUT, FILES, STARTED
from hri.hal.drivers.wav_file import read_wav
from hri.robot.provenance import utc_now
from hri.robot.recording import ALOUD, Recording
from tests.devices import SMALL_SCREEN, live_microphone
from tests.disk import full_disk

APP = """networks = ["face.xml", "feeling.xml"]
"""
FACE = """<BehaviorNetwork name="face" invocation_interval="1/30">
  <Behavior id="voice" type="Hri.Voice"/>
  <Behavior id="face" type="Hri.Face"/>
  <Behavior id="renderer" type="Hri.FaceRenderer"/>
  <Link from="face.weights" to="renderer.weights"/>
</BehaviorNetwork>
"""
FEELING = """<BehaviorNetwork name="feeling" invocation_interval="0.1">
  <Behavior id="emotion" type="Hri.EmotionModel"/>
</BehaviorNetwork>
"""
SECRET = "water the plants"


@pytest.fixture
def record(tmp_path):
    """Records some seconds of a robot in which something is rejected; the robot."""
    (tmp_path / "app.toml").write_text(APP)
    (tmp_path / "face.xml").write_text(FACE)
    (tmp_path / "feeling.xml").write_text(FEELING)
    told = []

    def record(prepare=lambda robot: None, devices=(SMALL_SCREEN,), **options):
        robot = Robot(
            str(tmp_path), "simulated", clock=FakeClock(), notice=told.append,
            record=tmp_path / "out", devices=devices, **options,
        )  # fmt: skip
        robot.told = told
        prepare(robot)
        with robot:
            robot.wait(0.5)
            robot.events.raise_event("speech.partial", text=SECRET)
            robot.events.raise_event(
                "speech.rejected", reason="not in the grammar", text=SECRET,
                detail=f'"{SECRET}" is as likely', confidence=0.5, choices=[SECRET, "go"],
            )  # fmt: skip
            robot.wait(1.5)
        return robot

    return record


def mode(path):
    return stat.S_IMODE(path.stat().st_mode)


def test_a_recording_is_its_owners_alone(record, tmp_path):
    record()
    out = tmp_path / "out"
    assert {file.name for file in out.iterdir()} == set(FILES)
    assert {file.name: mode(file) for file in out.iterdir()} == dict.fromkeys(FILES, 0o600)
    assert mode(out) == 0o700


def contents(folder):
    return {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in folder.iterdir()}


def test_a_second_recording_gets_a_folder_of_its_own_and_says_so(record, tmp_path):
    record()
    before = contents(tmp_path / "out")
    robot = record()
    assert contents(tmp_path / "out") == before
    assert robot.recording.folder == tmp_path / "out-2"
    assert {file.name for file in (tmp_path / "out-2").iterdir()} == set(FILES)
    why = f"({tmp_path / 'out'}/ holds an earlier recording)"
    assert robot.told[-1].startswith(f"recording to {tmp_path / 'out-2'}/ {why}, which only")
    out = io.StringIO()
    Narrator(robot, out).summary()
    assert f"recorded in {tmp_path / 'out-2'}/ {why}: events.jsonl" in out.getvalue()


def test_a_folder_with_other_files_keeps_its_permissions_the_recording_in_it_is_private(
    record, tmp_path
):
    out = tmp_path / "out"
    out.mkdir()
    (out / "notes.txt").touch(mode=0o644)
    out.chmod(0o755)
    record()
    assert mode(out) == 0o755
    assert mode(out / "notes.txt") == 0o644
    assert {mode(out / name) for name in FILES} == {0o600}


def test_words_that_were_rejected_are_left_out_and_the_keys_stay(record, tmp_path):
    record()
    assert all(SECRET.encode() not in file.read_bytes() for file in (tmp_path / "out").iterdir())
    events = {event["event"]: event for event in read_events(tmp_path / "out" / "events.jsonl")}
    rejected = events["speech.rejected"]
    assert set(rejected) == {"t", "event", "reason", "detail", "text", "confidence", "choices"}
    assert rejected["reason"] == "not in the grammar"
    assert rejected["text"] == rejected["detail"] == events["speech.partial"]["text"] == ""


def test_words_that_were_rejected_are_written_when_it_is_asked_for(record, tmp_path):
    record(record_rejected=True)
    events = read_events(tmp_path / "out" / "events.jsonl")
    assert [e["text"] for e in events if e["event"].startswith("speech.")] == [SECRET, SECRET]


def test_a_recording_is_told_in_one_line_and_marked_on_the_face(record, tmp_path):
    robot = record(devices=())
    (line,) = robot.told
    assert line.startswith(f"recording to {tmp_path / 'out'}/")
    film = cv2.VideoCapture(str(tmp_path / "out" / "face.mp4"))
    film.set(cv2.CAP_PROP_POS_FRAMES, 30)
    _, picture = film.read()
    film.release()
    height, width = picture.shape[:2]
    blue, green, red = (picture[..., channel].astype(int) for channel in range(3))
    is_red = (red > 180) & (green < 140) & (blue < 140)
    rows, _ = is_red[: height // 10, : width // 10].nonzero()
    assert len(rows) > 20
    assert abs(rows.mean() / height - 0.045) < 0.01


@pytest.mark.parametrize(("prepare", "said"), [(live_microphone, [ALOUD]), (lambda robot: 0, [])])
def test_it_is_said_aloud_only_where_a_microphone_hears_people(record, tmp_path, prepare, said):
    record(prepare)
    events = read_events(tmp_path / "out" / "events.jsonl")
    assert [e["text"] for e in events if e["event"] == "speech.said"] == said
    assert not [e for e in events if e["event"].startswith("question.")]


def test_what_is_not_recorded_is_not_marked_or_told(record, tmp_path):
    def not_recorded(robot):
        robot.record = None

    robot = record(not_recorded)
    assert robot.told == []
    assert not (tmp_path / "out").exists()


def test_on_a_full_disk_the_robot_goes_on_and_each_file_ends_with_one_line(
    record, tmp_path, caplog
):
    with full_disk(after=30_000):
        robot = record(devices=())
    assert robot.lived >= 2.0
    out = tmp_path / "out"
    ended = [message.partition(" ends here: ")[0] for message in caplog.messages]
    assert {str(out / "face.mp4"), str(out / "robot.wav")} <= set(ended)
    assert len(ended) == len(set(ended))
    assert not any("\n" in message for message in caplog.messages)
    assert read_events(out / "events.jsonl")
    assert len(read_wav(out / "robot.wav")[0]) > 0


def test_two_robots_do_not_record_into_one_folder(record, tmp_path):
    (tmp_path / "out").mkdir()
    other = GrowingFile(tmp_path / "out" / "events.jsonl")
    other.append(b"{}\n")
    robot = record()
    assert (tmp_path / "out" / "events.jsonl").read_bytes() == b"{}\n"
    assert robot.recording.folder == tmp_path / "out-2"


def test_the_log_says_when_film_and_sound_begin(record, tmp_path):
    robot = record(lambda robot: robot.clock.advance(2.5))
    out = tmp_path / "out"
    first = read_events(out / "events.jsonl")[0]
    assert {**first, "t": 2.5, "event": STARTED, "face": 2.5, "sound": 2.5} == first
    sound, rate = read_wav(out / "robot.wav")
    film = cv2.VideoCapture(str(out / "face.mp4"))
    pictures = film.get(cv2.CAP_PROP_FRAME_COUNT)
    film.release()
    assert len(sound) / rate == pytest.approx(robot.lived - 2.5, abs=0.1)
    assert pictures / 30 == pytest.approx(len(sound) / rate, abs=0.1)


SETUP = {"seed": 3, "app": "APP", "personality": "neutral", "config": "simulated"}


def test_the_first_event_says_what_was_run_and_is_the_same_for_equal_runs(record, tmp_path):
    for _ in range(2):
        record(seed=3)
    first, second = (
        (tmp_path / name / "events.jsonl").read_text().splitlines()[0] for name in ("out", "out-2")
    )
    assert first == second
    told = json.loads(first)
    assert {**told, **SETUP, "app": tmp_path.name, "version": version("hri")} == told


def test_the_record_says_when_and_on_what_and_how_it_ended(record, tmp_path):
    before = utc_now()
    robot = record(lambda robot: robot.clock.advance(2.5), seed=3)
    told = json.loads((tmp_path / "out" / ABOUT).read_text())
    assert {**told, **SETUP, "app": tmp_path.name, "version": version("hri")} == told
    began, zero, ended = (
        datetime.fromisoformat(told[name].replace("Z", "+00:00"))
        for name in ("began", "zero", "ended")
    )
    assert before <= began <= ended <= utc_now()
    assert (began - zero).total_seconds() == pytest.approx(told["began_at"], abs=1e-3)
    assert (told["began_at"], told["ended_at"]) == (2.5, robot.lived)
    assert told["why"] == "the script ended"
    assert told["folder"] == str(tmp_path / "out")
    assert told["clock"] == "fake"
    assert told["python"] == platform.python_version()
    assert told["packages"]["numpy"] == version("numpy")
    assert str(tmp_path / "face.xml") in told["sources"]


def test_a_run_that_fails_says_so_in_its_record(record, tmp_path):
    def fail(robot):
        robot.wait = None  # what the script calls next

    with pytest.raises(TypeError):
        record(fail)
    told = json.loads((tmp_path / "out" / ABOUT).read_text())
    assert told["why"] == "the script failed: TypeError"


def test_a_robot_that_fails_says_so_in_its_record(record, tmp_path, monkeypatch):
    async def fail(self, context):
        raise HriError("no more - rest")

    monkeypatch.setattr(Recording, "announce", fail)
    robot = Robot(
        str(tmp_path), "simulated", clock=FakeClock(), record=tmp_path / "out", notice=print
    )
    with pytest.raises(HriError, match="no more"):
        robot.live_until_over()
    told = json.loads((tmp_path / "out" / ABOUT).read_text())
    assert told["why"] == "failed: HriError: no more - rest"


def test_a_record_that_cannot_be_completed_is_as_it_began(record, tmp_path, caplog):
    def fill(robot):
        robot.clock.call_at(1.9, lambda: disk.enter_context(full_disk(after=400)))

    with ExitStack() as disk:
        record(fill)
    told = json.loads((tmp_path / "out" / ABOUT).read_text())
    assert "began" in told
    assert "ended" not in told
    assert any(f"{ABOUT}: cannot be written: File too large" in line for line in caplog.messages)
