"""The companion as users start it: a process, its files, its exit status."""

import argparse
import json
import re
import shutil
import signal
import subprocess
import sys

import numpy as np
import pytest
import soundfile

from hri.cli.main import main
from hri.cli.run import add_options, check_files
from hri.core import paths
from hri.core.event_log import read_events
from tests.recorded import speech

SLOW = pytest.mark.slow


def hri(*arguments, folder=None, typed=None):
    command = [sys.executable, "-m", "hri.cli.main", *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, text=True, cwd=folder, input=typed, timeout=500
    )


def start(*arguments):
    command = [sys.executable, "-m", "hri.cli.main", *map(str, arguments)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


@pytest.fixture(scope="session")
def small(tmp_path_factory):
    """Everything simulated, with a screen of few pixels: their number is of no concern here."""
    screen = '<Device id="screen" type="Hri.OffscreenScreen"'
    size = '<Parameter name="width" value="160"/><Parameter name="height" value="120"/>'
    text = paths.find("config", "simulated").read_text()
    assert f"{screen}/>" in text
    path = tmp_path_factory.mktemp("config") / "small.xml"
    path.write_text(text.replace(f"{screen}/>", f"{screen}>{size}</Device>"))
    return path


@pytest.fixture(scope="module")
def demo(tmp_path_factory, small):
    """A whole one; what takes it is slow."""
    folder = tmp_path_factory.mktemp("demo")
    words = ("companion", "--demo", "--fast", "--seed", 7, "--config", small, "--record", "one")
    run = hri(*words, folder=folder)
    assert run.returncode == 0, run.stderr
    return folder / "one"


@pytest.fixture(scope="module")
def events(demo):
    return read_events(demo / "events.jsonl")


EVENTS = {
    "speech.heard": {"text", "rule", "tags", "confidence"},
    "speech.rejected": {"reason"},
    "speech.said": {"text"},
    "emotion.changed": {"label", "valence", "arousal", "dominance"},
    "head.nodded": set(),
    "head.shaken": set(),
    "drive.commanded": set(),
    "drive.stopped": set(),
    "odometry": {"x_cm", "y_cm", "heading_rad"},
}


@SLOW
def test_a_demo_is_repeated_from_its_record_byte_for_byte(demo, tmp_path):
    run = hri("companion", "--repeat", demo, "--record", "again", folder=tmp_path)
    assert run.returncode == 0, run.stderr
    assert "differ" not in run.stdout
    for name in ("events.jsonl", "face.mp4", "robot.wav"):
        assert (demo / name).read_bytes() == (tmp_path / "again" / name).read_bytes(), name


@SLOW
@pytest.mark.parametrize("name", EVENTS)
def test_the_demo_has_every_kind_of_event(events, name):
    found = [event for event in events if event["event"] == name]
    assert found
    assert EVENTS[name] <= set(found[0])


@SLOW
def test_events_are_in_order_of_time_and_odometry_comes_twice_a_second(events):
    times = [event["t"] for event in events]
    assert times == sorted(times)
    odometry = [event["t"] for event in events if event["event"] == "odometry"]
    assert len(odometry) == pytest.approx(2 * times[-1], rel=0.02)


@SLOW
def test_praise_lifts_and_scolding_lowers_the_mood(events):
    def valence_after(rule):
        at = next(e["t"] for e in events if e["event"] == "speech.heard" and e["rule"] == rule)
        changes = [e for e in events if e["event"] == "emotion.changed"]
        before = [e["valence"] for e in changes if e["t"] <= at]
        after = [e["valence"] for e in changes if at < e["t"] < at + 6]
        return before[-1], after[-1]

    before, after = valence_after("praise")
    assert after > before
    before, after = valence_after("scold")
    assert after < before


@SLOW
def test_stop_stops_a_long_way(events):
    stop = next(e["t"] for e in events if e["event"] == "speech.heard" and e["rule"] == "stop")
    stopped = [e for e in events if e["event"] == "drive.stopped" and stop <= e["t"] < stop + 1.5]
    assert stopped
    later = [e for e in events if e["event"] == "odometry" and e["t"] > stop + 1.5][:4]
    assert max(e["x_cm"] for e in later) - min(e["x_cm"] for e in later) < 1.0


@SLOW
def test_a_person_who_says_go_forward_ten_meters_is_obeyed(tmp_path, small):
    out = tmp_path / "out"
    run = hri(
        "companion", "--audio", speech("goforward"), "--camera", "none", "--fast",
        "--config", small, "--record", out,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    events = read_events(out / "events.jsonl")
    heard = [e for e in events if e["event"] == "speech.heard"]
    assert [e["text"] for e in heard] == ["go forward ten meters"]
    assert heard[0]["tags"]["distance"] == 10
    assert any("forward 10 meters" in e["text"] for e in events if e["event"] == "speech.said")
    odometry = [e for e in events if e["event"] == "odometry"]
    assert odometry[-1]["x_cm"] == pytest.approx(1000, rel=0.02)
    assert abs(odometry[-1]["y_cm"]) < 20


@SLOW
def test_what_is_typed_is_told_in_whole_lines_and_its_end_is_the_end(tmp_path):
    config = tmp_path / "typed.xml"
    text = paths.find("config", "typed").read_text()
    config.write_text(text.replace('"640"', '"160"').replace('"480"', '"120"'))
    run = hri(
        "companion", "--config", config, "--camera", "none", "--fast", "--headless",
        typed="what can i say\n",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert re.search(r"heard +what can i say", run.stdout)
    assert re.search(r'said +You could say ".*", or "stop"\.', run.stdout)


@SLOW
def test_a_timer_that_runs_is_waited_for_when_nothing_more_is_typed(tmp_path):
    (tmp_path / "app.toml").write_text('extends = "companion"\n')
    (tmp_path / "grammar.jsgf").write_text(
        "#JSGF V1.0; /** @extends companion */ grammar t; public <tea> = make some tea;\n"
    )
    (tmp_path / "replies.toml").write_text('[reply.tea]\nsay = "Okay."\naction = "tea"\n')
    (tmp_path / "tasks.py").write_text(
        "async def tea(context):\n    await context.clock.sleep(30)\n    return 'Tea is ready.'\n"
    )
    run = hri(
        "run", tmp_path, "--config", "typed", "--camera", "none", "--fast", "--headless",
        typed="make some tea\n",
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert re.search(r"said +Tea is ready\.", run.stdout)


@pytest.mark.parametrize("suffix", ["wav", "mp3", "flac", "ogg"])
def test_it_takes_sound_files_of_every_format(suffix, tmp_path):
    path = tmp_path / f"floats.{suffix}"
    subtype = "FLOAT" if suffix == "wav" else None
    soundfile.write(path, 0.1 * np.sin(np.arange(16000)), 16000, subtype=subtype)
    parser = argparse.ArgumentParser()
    add_options(parser)
    check_files(parser.parse_args([f"--audio={path}"], argparse.Namespace(app="companion")))


BAD = {
    "misspelt device": (
        "config",
        '<Resources><Devices><Device id="a" type="Hri.Sceen"/></Devices></Resources>',
    ),
    "unclosed tag": ("config", "<Resources><Devices></Resources>"),
    "doctype": ("config", "<!DOCTYPE x []><Resources/>"),
    "no wav": ("audio", "this is not a sound"),
    "empty wav": ("audio", ""),
    "no video": ("camera", "this is not a video"),
    "missing face": ("face", None),
    "missing personality": ("personality", None),
    "missing camera file": ("camera", None),
}


@pytest.mark.parametrize("case", BAD)
def test_bad_files_are_refused_before_anything_starts(case, tmp_path, capfd):
    option, content = BAD[case]
    path = tmp_path / f"bad.{ {'config': 'xml', 'audio': 'wav'}.get(option, 'mp4') }"
    if content is not None:
        path.write_text(content)
    out = tmp_path / "out"
    words = ["companion", f"--{option}", path, "--fast", "--headless", "--record", out]
    assert main(list(map(str, words))) == 2
    told = capfd.readouterr()
    assert "Traceback" not in told.err
    lines = told.err.strip().splitlines()
    assert 1 <= len(lines) <= 4
    assert " - " in told.err
    assert path.name in told.err
    assert told.out == ""
    assert not out.exists()


def test_a_mistake_in_the_visit_leaves_nothing_behind(tmp_path):
    app = tmp_path / "app"
    shutil.copytree(paths.find("apps", "companion"), app)
    (app / "demo.toml").write_text('[[step]]\nat = 1\nsya = "hello"\n')
    out = tmp_path / "out"
    run = hri("run", app, "--demo", "--fast", "--headless", "--record", out)
    assert run.returncode == 2
    assert "demo.toml:3:" in run.stderr
    assert not out.exists()


@SLOW
def test_a_small_app_needs_no_visit(tmp_path):
    (tmp_path / "app.toml").write_text('networks = ["face.xml"]\n')
    shutil.copy(paths.find("apps", "companion") / "face.xml", tmp_path)
    run = hri("run", tmp_path, "--fast", "--headless", "--duration", "1")
    assert run.returncode == 0, run.stderr
    assert "Traceback" not in run.stderr


@SLOW
def test_it_ends_when_nobody_reads():
    command = [sys.executable, "-m", "hri.cli.main", "companion", "--demo", "--fast", "--headless"]
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as run:
        run.stdout.readline()
        run.stdout.close()
        assert "Traceback" not in run.stderr.read()
    assert run.returncode == 0


@SLOW
def test_it_ends_with_a_summary_when_it_is_interrupted(tmp_path):
    out = tmp_path / "out"
    with start("companion", "--demo", "--fast", "--headless", "--record", out) as run:
        run.stdout.readline()
        run.send_signal(signal.SIGINT)
        told = run.communicate(timeout=200)[0]
    assert run.returncode == 0
    assert "Traceback" not in told
    assert "recorded in" in told
    assert (out / "timeline.png").exists()


def test_unknown_commands_and_help():
    run = hri("compannion")
    assert run.returncode == 2
    assert 'did you mean "companion"' in run.stderr
    assert "doctor" in hri("--help").stdout
    assert hri("--version").stdout.startswith("hri 0.")


@SLOW
def test_a_grammar_with_an_undefined_rule_exits_with_2(tmp_path):
    path = tmp_path / "bad.jsgf"
    path.write_text("#JSGF V1.0;\ngrammar bad;\npublic <go> = go <wheer>;\n<where> = home;\n")
    run = hri("grammar", "check", path)
    assert run.returncode == 2
    assert "bad.jsgf:3:" in run.stdout + run.stderr
    assert "where" in run.stdout + run.stderr
    assert hri("grammar", "check", "companion").returncode == 0


@SLOW
def test_doctor_reports_and_goes_on():
    run = hri("doctor", "--seconds", "0.2")
    assert run.returncode in (0, 1)
    assert "Traceback" not in run.stderr
    for part in ("microphone", "speaker", "camera", "screen", "base", "voice", "recognizer"):
        assert run.stdout.count(f"\n{part} ") + run.stdout.startswith(f"{part} ") == 1
        assert f"{part}: " not in run.stdout
    assert "`hri doctor`" not in run.stdout


def test_the_tags_of_a_sentence_as_json():
    run = hri("grammar", "parse", "companion", "go forward ten meters", "--json")
    answer = json.loads(run.stdout)
    assert answer["accepted"] is True
    assert answer["rule"] == "move"
    assert answer["tags"]["distance"] == 10
