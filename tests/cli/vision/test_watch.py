"""`hri watch`: a film or a window of what is seen, from any camera."""

import os
import signal
import stat
from argparse import ArgumentParser
from dataclasses import replace
from itertools import pairwise

import cv2
import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.cli.main import main
from hri.cli.vision.watch import Watcher, show, write
from hri.cli.vision.watching import add_source, frames_of, interruption, opened_camera, paced
from hri.core.clock import FakeClock
from hri.core.signals import (
    FaceBox,
    Frame,
    Hand,
    HandGesture,
    HeadGesture,
    HeadPose,
    People,
    Person,
)
from hri.hal.drivers.memory import OffscreenScreen
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.simulation.people.actors import Appearance, render_people
from hri.testing.cameras import Fault, FaultyCamera

GRAY = np.full((240, 320, 3), 90, np.uint8)


def see(frame):
    """Somebody in the middle, whatever the picture shows."""
    pose = HeadPose(frame.time, 0.0, 0.0, 0.0, FaceBox(120, 60, 80, 100))
    return People(frame.time, (Person("p1", pose),))


def nod_once_a_second(people):
    is_due = people.time % 1.0 < 1 / 30 - 1e-6
    return [HeadGesture("nod", people.time, 0.8, "p1")] if is_due else []


class Screen(OffscreenScreen):
    """Its keys are pressed at the pictures of a plan, by their number."""

    plan: dict = {}

    def pressed_keys(self):
        return self.plan.pop(self.count, [])


def stage(*faults, plan=None):
    manager = ResourceManager((), FakeClock(), lambda _: None)
    camera = FaultyCamera(lambda time: GRAY, faults, manager)
    camera.activate()
    screen = Screen(Description("screen", "Test"), manager)
    screen.plan = plan or {}
    screen.activate()
    return camera, screen


def test_hands_are_drawn_and_their_gestures_told(capsys):
    points = np.zeros((21, 3), np.float32)
    points[:, 0], points[:, 1] = np.linspace(220, 300, 21), np.linspace(60, 200, 21)
    hand = Hand("left", 1.0, points, "open")

    def with_hand(frame):
        (person,) = see(frame).persons
        return People(frame.time, (replace(person, hands=(hand,)),))

    def wave(people):
        return [HandGesture("wave", people.time, hand, "p1", 0.8)]

    plain, drawn, hidden = (
        Watcher(sees, told, has_landmarks).look(Frame(GRAY, 1.0, 0))
        for sees, told, has_landmarks in (
            (see, wave, True), (with_hand, wave, True), (with_hand, wave, False),
        )
    )  # fmt: skip
    changed = (plain != drawn).any(axis=2)
    assert all(changed[round(y), round(x)] for x, y, _ in points.tolist())
    assert (hidden == plain).all()
    assert capsys.readouterr().out.splitlines()[0] == "   1.00 s  p1  wave  left hand"


def test_a_window_shows_what_is_seen_until_escape_is_pressed(capsys):
    camera, screen = stage(plan={50: ["escape"]})
    show(Watcher(see, nod_once_a_second), camera, screen)
    assert screen.count == 50
    assert not np.array_equal(screen.image, GRAY)
    assert capsys.readouterr().out.splitlines()[1].split() == ["1.00", "s", "p1", "nod", "0.80"]


def test_the_keys_hold_the_picture_and_switch_the_camera_off(capsys):
    camera, screen = stage(plan={10: ["c"], 20: ["c"], 60: ["space"], 70: ["escape"]})
    switched = []
    turn = camera.switch
    camera.switch = lambda on: (switched.append((screen.count, on)), turn(on))
    show(Watcher(see, nod_once_a_second), camera, screen)
    assert switched == [(10, False), (20, True)]
    assert screen.count == 70


def test_while_the_camera_is_off_nothing_of_anybody_is_shown():
    camera, screen = stage(plan={10: ["c"]})
    show(Watcher(see, nod_once_a_second), camera, screen, seconds=5.0)
    assert screen.image[:200].max() == 0
    assert screen.image[200:].any()


def test_a_window_stays_alive_while_the_camera_is_silent():
    camera, screen = stage(Fault("stall", 1.0), plan={40: ["escape"]})
    show(Watcher(see, nod_once_a_second), camera, screen)
    assert camera.manager.clock.now() > 1.5


def test_pictures_end_with_the_time_that_was_asked_for():
    camera, _ = stage(Fault("stall", 2.0))
    assert [frame.sequence for frame in frames_of(camera, 1.0)] == list(range(31))
    assert 29 <= len(list(frames_of(camera, 3.0))) <= 31


@given(st.lists(st.floats(0.001, 0.5), min_size=1, max_size=40), st.sampled_from([10.0, 30.0]))
def test_a_film_keeps_the_time_whatever_the_pace_of_the_camera(gaps, rate):
    times = np.cumsum([0.0, *gaps])
    pictures = [(float(time), np.full((1, 1, 3), n, np.uint8)) for n, time in enumerate(times)]
    shown = [int(picture[0, 0, 0]) for picture in paced(pictures, rate)]
    assert abs(len(shown) - times[-1] * rate) <= 2
    assert all(a <= b for a, b in pairwise(shown))
    assert shown[-1] == len(times) - 1
    for number, index in enumerate(shown[:-1]):
        assert abs(times[index] - number / rate) <= max(gaps) + 1 / rate


def test_a_film_is_written_of_what_is_seen(tmp_path, capsys):
    camera, _ = stage()
    path = tmp_path / "seen.mp4"
    write(path, Watcher(see, nod_once_a_second), frames_of(camera, 2.0))
    film = cv2.VideoCapture(str(path))
    assert film.get(cv2.CAP_PROP_FRAME_COUNT) == 61
    assert stat.S_IMODE(path.stat().st_mode) == 0o600, "people are on it"
    assert f"wrote {path}" in capsys.readouterr().out


def test_a_film_that_is_interrupted_is_finished(tmp_path, capsys):
    camera, _ = stage()
    path = tmp_path / "seen.mp4"

    def see_until_interrupted(frame):
        if frame.sequence == 20:
            os.kill(os.getpid(), signal.SIGINT)
        return see(frame)

    with interruption() as is_over:
        watcher = Watcher(see_until_interrupted, nod_once_a_second)
        write(path, watcher, frames_of(camera, is_over=is_over))
    assert cv2.VideoCapture(str(path)).get(cv2.CAP_PROP_FRAME_COUNT) == 21
    assert f"wrote {path}" in capsys.readouterr().out


def test_a_second_interruption_ends_the_command():
    with interruption() as is_over:
        os.kill(os.getpid(), signal.SIGINT)
        assert is_over()
        with pytest.raises(KeyboardInterrupt):
            os.kill(os.getpid(), signal.SIGINT)


def test_of_a_video_a_film_is_written_without_a_screen(tmp_path, capsys):
    source, target = tmp_path / "source.avi", tmp_path / "seen.mp4"
    picture = render_people([Appearance(center=(160, 120), height=110)], (320, 240))
    writer = cv2.VideoWriter(str(source), cv2.VideoWriter.fourcc(*"MJPG"), 15.0, (320, 240))
    for _ in range(15):
        writer.write(picture[:, :, ::-1])
    writer.release()
    words = ["watch", "--video", str(source), "--out", str(target), "--detector", "haar"]
    assert main(words) == 0
    film = cv2.VideoCapture(str(target))
    last = None
    while (got := film.read())[0]:
        last = got[1]
    assert np.abs(last.astype(int) - picture[:, :, ::-1]).max() > 60  # a box is drawn
    assert "wrote" in capsys.readouterr().out


def test_the_view_of_the_camera_may_be_told(tmp_path):
    path = tmp_path / "still.png"
    cv2.imwrite(str(path), GRAY)
    parser = ArgumentParser()
    add_source(parser)
    options = parser.parse_args(["--video", str(path), "--view", "50"])
    with opened_camera(options, FakeClock()) as camera:
        assert np.degrees(camera.field_of_view) == pytest.approx(50, abs=0.01)


def refusal(capsys, *words):
    assert main(["watch", *map(str, words)]) != 0
    return capsys.readouterr().err


def test_what_cannot_be_watched_is_one_line(tmp_path, capsys):
    (tmp_path / "empty.mp4").write_bytes(b"")
    for words, what in (
        (["--video", tmp_path / "no.mp4"], "no.mp4: no such file - check the path"),
        (["--video", tmp_path / "empty.mp4"], "empty.mp4: not a readable video"),
        (["--images", tmp_path], "no pictures in it"),
        (["--video", tmp_path], "a folder - give it to --images"),
        (["--simulated", "--out", "film.txt"], "film.txt: no movie of this kind"),
        (["--camera", "63"], "no camera /dev/video63"),
    ):
        lines = refusal(capsys, *words).splitlines()
        # Of networks that were not fetched it tells beside that, as `hri watch` always does.
        lines = [line for line in lines if "hri models fetch face" not in line]
        assert len(lines) == 1, lines
        assert what in lines[0]


@pytest.mark.parametrize(
    "words",
    [["--seconds", "0"], ["--view", "nan"], ["--view", "300"], ["--video", "a", "--camera", "0"]],
)
def test_options_that_make_no_sense_are_refused(words, capsys):
    with pytest.raises(SystemExit):
        main(["watch", *words])
    assert "error" in capsys.readouterr().err


def test_frames_of_a_watcher_are_left_as_they_were():
    frame = Frame(GRAY.copy(), 0.0, 0)
    Watcher(see, nod_once_a_second).look(frame)
    assert np.array_equal(frame.image, GRAY)


MISSING = """<Resources><Devices>
  <DeviceBus id="world" type="Hri.SimulatedWorld">
    <Device id="simulated_camera" type="Hri.SimulatedCamera"/>
  </DeviceBus>
  <Device id="camera" type="Hri.Webcam">
    <Parameter name="device" value="/dev/no-such-camera"/>
    <Parameter name="stand_in" value="simulated_camera"/>
  </Device>
</Devices></Resources>"""


@pytest.mark.parametrize(
    "words",
    [
        ["object", "learn", "cup", "--camera"],
        ["object", "learn", "cup", "--camera", "/dev/no-such-camera"],
        ["color", "learn", "cup", "--camera"],
        ["color", "learn", "cup", "--camera", "/dev/no-such-camera"],
        ["gesture"],
        ["gesture", "--camera", "/dev/no-such-camera"],
        ["watch"],
        ["watch", "--out", "film.mp4"],
        ["watch", "--camera", "/dev/no-such-camera"],
    ],
)
def test_a_camera_that_is_missing_is_an_error_and_nothing_is_learned(
    tmp_path, monkeypatch, capsys, words
):
    for name in ("XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "missing.xml").write_text(MISSING)
    assert main([*words, "--config", "missing.xml", "--seconds", "0.5"]) == 2
    told = capsys.readouterr().err.splitlines()
    assert told == [
        "camera: no camera /dev/no-such-camera - plug one in, or `hri doctor --choose`;"
        " --simulated shows a simulated room"
    ]
    assert os.listdir(tmp_path) == ["missing.xml"]
