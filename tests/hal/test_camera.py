"""What all cameras have in common: bad frames, lost time, the switch, mirrors, and recordings."""

import math
from itertools import islice, pairwise

import cv2
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from hri.behavior.device_behaviors import CameraFrames
from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError, HriError, NotAvailable
from hri.core.origin import STUDIO, caused_by
from hri.core.signals import Frame
from hri.hal.camera import Camera
from hri.hal.drivers.blank import BlankCamera
from hri.hal.drivers.image_folder import ImageFolderCamera
from hri.hal.drivers.image_size import write_picture
from hri.hal.drivers.memory import MemoryCamera
from hri.hal.drivers.video_file import VideoFileCamera, check_video
from hri.hal.drivers.webcam import waits
from hri.hal.picture import as_picture, oriented
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.task import get_task_manager, use, vision
from hri.testing import context, run_for
from hri.testing.cameras import FAULTS, Fault, FaultyCamera

SIZE = (48, 64)
TICK = 0.01


def picture(time):
    """Each time has a color of its own; the left half is dark."""
    image = np.full((*SIZE, 3), 10 + round(time * 30) % 200, np.uint8)
    image[:, : SIZE[1] // 2] //= 4
    return image


class Stage:
    """A camera on fake time, and what it said to people."""

    def __init__(self, *faults, rate=30.0):
        self.notices = []
        self.clock = FakeClock()
        self.manager = ResourceManager((), self.clock, self.notices.append)
        self.camera = FaultyCamera(picture, faults, self.manager, rate)
        self.camera.activate()

    def film(self, seconds):
        frames = []
        for _ in range(round(seconds / TICK)):
            self.clock.advance(TICK)
            if (frame := self.camera.read(self.clock.now())) is not None:
                frames.append(frame)
        return frames


@pytest.mark.parametrize("kind", FAULTS)
def test_whatever_a_camera_does_pictures_stay_pictures_and_time_goes_on(kind):
    stage = Stage(Fault(kind, 1.0, 1.05))
    frames = stage.film(2.0)
    assert all(a.time < b.time for a, b in pairwise(frames))
    assert all(frame.time <= stage.clock.now() + 1e-6 for frame in frames)
    for frame in frames:
        assert frame.image.dtype == np.uint8
        assert frame.image.shape[2:] == (3,)
        assert frame.image.flags.c_contiguous
    assert 26 <= sum(frame.time > 1.0 for frame in frames) <= 31


@pytest.mark.parametrize(
    ("kind", "what"),
    [
        ("float", "gives pixels of the kind float64, not of 8 or 16 bits"),
        ("empty", "gives a picture of 64 x 0 pixels"),
        ("too large", "gives a picture of 8200 x 8 pixels"),
        ("nothing", "gives no picture but a NoneType"),
    ],
)
def test_what_is_no_picture_is_passed_over_and_told_once(kind, what):
    stage = Stage(Fault(kind, 0.5, 1.5))
    assert 28 <= len(stage.film(2.0)) <= 32
    remedy = "it is passed over; check the device and its settings"
    assert stage.notices == [f"camera: {what} - {remedy}"]
    assert stage.camera.footage().refused == 30


@pytest.mark.parametrize(("kind", "share"), [("gray", 1.0), ("16 bit", 1.0), ("pixel", 1.0)])
def test_gray_deep_and_tiny_pictures_are_made_the_usual_kind(kind, share):
    frame = Stage(Fault(kind)).film(0.1)[-1]
    expected = picture(frame.time)
    if kind == "pixel":
        assert frame.image.shape == (1, 1, 3)
    else:
        assert np.array_equal(frame.image, expected)


def test_a_camera_that_falls_silent_is_told_of_and_so_is_its_return():
    stage = Stage(Fault("stall", 1.0, 6.0))
    stage.film(3.9)
    assert not stage.camera.is_lost
    stage.film(0.2)
    assert stage.camera.is_lost
    stage.film(2.0)
    assert not stage.camera.is_lost
    silence = "camera: no picture for 3 s - waiting for it; see that it is plugged in"
    assert stage.notices == [silence, "camera: is back"]


def test_it_counts_what_it_gave_and_what_was_lost():
    stage = Stage(Fault("drop", 1.0, 2.0))
    stage.film(4.5)
    footage = stage.camera.footage()
    assert (footage.width, footage.height, footage.lost, footage.refused) == (64, 48, 15, 0)
    assert footage.rate == pytest.approx(30, abs=1)
    words = "Test.FaultyCamera 64 x 48, 60 degrees wide, 30 pictures a second, 15 lost"
    assert stage.camera.describe() == words


def test_off_lets_the_device_go_until_it_is_on_again_for_whoever_asks():
    stage = Stage()
    stage.film(0.5)
    stage.camera.switch(False)
    assert not stage.camera.is_held
    assert stage.film(5.0) == []
    stage.camera.deactivate()
    stage.camera.activate()
    assert not stage.camera.is_held
    with pytest.raises(NotAvailable, match="camera: switched off - switch it on"):
        stage.camera.take()
    assert "switched off" in stage.camera.describe()
    stage.camera.switch(True)
    assert stage.camera.is_held
    assert 14 <= len(stage.film(0.5)) <= 16
    assert stage.notices == []
    stage.camera.switch(True)
    stage.camera.deactivate()
    assert not stage.camera.is_held


def test_a_camera_that_does_not_open_again_stays_off():
    class Gone(FaultyCamera):
        is_gone = False

        def _open(self):
            if self.is_gone:
                raise self.not_available("unplugged", "plug it in")
            super()._open()

    camera = Gone(picture)
    camera.activate()
    camera.switch(False)
    camera.is_gone = True
    with pytest.raises(NotAvailable, match="unplugged"):
        camera.switch(True)
    assert not camera.is_on
    camera.is_gone = False
    camera.switch(True)
    assert camera.is_held
    camera.deactivate()


def test_the_network_tells_when_the_camera_is_switched_or_lost():
    lent = context(Description("camera", "Hri.MemoryCamera"))
    camera = FaultyCamera(picture, [Fault("stall", 2.0, 7.0)], lent.resources)
    lent.resources.substitute("camera", camera)

    def switch_off():
        with caused_by(STUDIO):
            camera.switch(False)

    lent.clock.call_at(8.0, switch_off)
    lent.clock.call_at(9.0, lambda: camera.switch(True))
    frames = CameraFrames("camera", camera_id="camera")
    events = run_for(10.0, [frames], lent, TICK)
    told = [(event.name, event.properties.get("on"), round(event.time)) for event in events]
    assert told == [
        ("camera.lost", None, 5),
        ("camera.found", None, 7),
        ("camera.switched", False, 8),
        ("camera.switched", True, 9),
    ]
    assert {event.properties["camera"] for event in events} == {"camera"}
    assert [event.origin for event in events] == ["", "", STUDIO, ""]


@pytest.mark.parametrize(
    ("rotate", "mirror", "dark"),
    [("0", "false", 0), ("0", "true", 1), ("180", "false", 1), ("180", "true", 0)],
)
def test_a_mirrored_or_hanging_camera_is_set_right(open_driver, clock, rotate, mirror, dark):
    camera = open_driver(MemoryCamera, rotate=rotate, mirror=mirror)
    camera.show(picture(5.0))
    clock.advance(0.1)
    image = camera.read(clock.now()).image
    halves = image[:, :32].mean(), image[:, 32:].mean()
    assert halves[dark] < halves[1 - dark]


@settings(max_examples=30, deadline=None)
@given(st.integers(1, 9), st.integers(1, 9), st.sampled_from(["0", "90", "180", "270"]))
def test_four_quarter_turns_and_two_mirrors_change_nothing(width, height, turn):
    image = np.random.default_rng(width * height).integers(0, 255, (height, width, 3), np.uint8)
    again = image
    for _ in range(4):
        again = oriented(again, turn, False)
    assert np.array_equal(again, image)
    assert np.array_equal(oriented(oriented(image, "0", True), "0", True), image)
    clockwise = oriented(image, "90", False)
    assert np.array_equal(clockwise[0, -1], image[0, 0])


def test_a_turned_camera_has_the_view_of_its_short_side(tmp_path, open_driver):
    write_picture(tmp_path / "a.png", picture(0))
    camera = open_driver(VideoFileCamera, file=tmp_path / "a.png", rotate="90", field_of_view="1.0")
    assert (camera.width, camera.height) == (48, 64)
    assert math.tan(camera.field_of_view / 2) == pytest.approx(math.tan(0.5) * 48 / 64)
    frame = camera.take()
    assert (frame.width, frame.height) == (48, 64)


@pytest.mark.parametrize(("name", "value"), [("rotate", "45"), ("mirror", "yes")])
def test_a_setting_nobody_knows_is_refused(name, value):
    device = Description("camera", "Hri.MemoryCamera", {name: value})
    with pytest.raises(AuthoringError, match=f'{name}: "{value}"'):
        MemoryCamera.check(device)


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from([np.uint8, np.uint16, np.int32, np.float32, bool]),
    st.lists(st.integers(0, 6), max_size=4),
)
def test_any_array_becomes_a_picture_or_is_refused_with_a_reason(kind, shape):
    array = np.ones(shape, kind)
    try:
        image = as_picture(array)
    except ValueError:
        is_picture = len(shape) in (2, 3) and 0 not in shape[:2]
        is_usual = kind in (np.uint8, np.uint16) and (*shape, 1, 1, 1)[2] in (1, 3, 4)
        assert not (is_picture and is_usual)
    else:
        assert image.shape == (*array.shape[:2], 3)
        assert image.dtype == np.uint8
        assert image.size


def test_pictures_that_nobody_reads_do_not_pile_up_in_the_memory(open_driver, clock):
    camera = open_driver(MemoryCamera)
    for number in range(100):
        camera.show(picture(number / 100))
        clock.advance(0.01)
    assert len(camera._frames) <= 2
    assert camera.read(clock.now()).sequence == 99
    assert camera.read(clock.now()) is None


@pytest.fixture(scope="module")
def film(tmp_path_factory):
    """Three seconds at 20 pictures a second, each of another gray."""
    path = tmp_path_factory.mktemp("film") / "film.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 20.0, (64, 48))
    for number in range(60):
        writer.write(np.full((48, 64, 3), 4 * number, np.uint8))
    writer.release()
    return path


def all_frames(camera):
    frames = []
    while not camera.has_ended:
        frames.append(camera.read(0.0))
    return frames


def test_all_pictures_of_a_film_come_with_the_times_of_the_film(film, open_driver):
    frames = all_frames(open_driver(VideoFileCamera, file=film, pace="fast"))
    assert [frame.sequence for frame in frames] == list(range(60))
    assert [frame.time for frame in frames] == pytest.approx([n / 20 for n in range(60)], abs=1e-3)
    assert frames[30].image.mean() == pytest.approx(120, abs=3)


def test_a_film_shows_at_its_own_pace_or_as_fast_as_it_is_read(film, open_driver, clock):
    real, fast = (open_driver(VideoFileCamera, file=film, pace=pace) for pace in ("real", "fast"))
    seen = {real: [], fast: []}
    for _ in range(10):
        for camera, frames in seen.items():
            frames.append(camera.read(clock.now()))
        clock.advance(0.1)
    assert [frame.sequence for frame in seen[fast]] == list(range(10))
    assert [frame.time for frame in seen[fast]] == pytest.approx([n / 20 for n in range(10)])
    assert [frame.sequence for frame in seen[real]] == list(range(0, 20, 2))
    assert real.footage().lost == 9
    assert fast.footage().lost == 0


def cut(film, tmp_path, share):
    broken = tmp_path / "broken.avi"
    data = film.read_bytes()
    broken.write_bytes(data[: int(share * len(data))])
    return broken


def test_a_film_that_breaks_off_gives_what_is_there(film, tmp_path, open_driver):
    camera = open_driver(VideoFileCamera, file=cut(film, tmp_path, 0.5), pace="fast")
    assert 10 < len(all_frames(camera)) < 50


def test_a_film_that_does_not_say_how_long_it_is_is_no_image(tmp_path, open_driver):
    pictures = (np.full((48, 64, 3), 4 * number, np.uint8) for number in range(20))
    codes = (cv2.imencode(".jpg", picture)[1].tobytes() for picture in pictures)
    endless = tmp_path / "film.mjpeg"
    endless.write_bytes(b"".join(codes))
    frames = all_frames(open_driver(VideoFileCamera, file=endless, pace="fast"))
    assert len([frame for frame in frames if frame is not None]) == 20


def test_who_was_away_for_long_catches_up_bit_by_bit(film, open_driver, clock, monkeypatch):
    monkeypatch.setattr("hri.hal.drivers.video_file.MOST_AT_ONCE", 20)
    camera = open_driver(VideoFileCamera, file=film)
    clock.advance(2.5)
    reads = [camera.read(clock.now()) for _ in range(4)]
    assert [frame and frame.sequence for frame in reads] == [None, None, 50, None]


@pytest.mark.parametrize("share", [0.0, 0.01])
def test_a_film_without_a_picture_is_one_line(film, tmp_path, share, open_driver):
    broken = cut(film, tmp_path, share)
    for read in (check_video, lambda path: open_driver(VideoFileCamera, file=path)):
        with pytest.raises(
            HriError, match=r"broken\.avi: not a readable video or image - try an MP4"
        ):
            read(broken)


def test_a_folder_of_pictures_is_shown_in_the_order_of_its_numbers(tmp_path, open_driver, clock):
    for number in (10, 9, 100):
        write_picture(tmp_path / f"{number}.png", np.full((6, 8, 3), number, np.uint8))
    (tmp_path / "notes.txt").write_text("no picture")
    (tmp_path / "11.png").write_bytes(b"no picture either")
    camera = open_driver(ImageFolderCamera, folder=tmp_path, rate=10, pace="fast")
    assert (camera.width, camera.height) == (8, 6)
    frames = [frame for _ in range(6) if (frame := camera.read(clock.now())) is not None]
    assert [int(frame.image[0, 0, 0]) for frame in frames] == [9, 10, 100]
    assert [frame.time for frame in frames] == pytest.approx([0, 0.1, 0.3])
    assert camera.has_ended
    assert camera.footage().refused == 1


def test_a_folder_at_its_own_pace_passes_over_what_nobody_read(tmp_path, open_driver, clock):
    for number in range(10):
        write_picture(tmp_path / f"{number}.png", np.full((6, 8, 3), number, np.uint8))
    camera = open_driver(ImageFolderCamera, folder=tmp_path, rate=10)
    clock.advance(0.45)
    assert camera.read(clock.now()).sequence == 4
    assert camera.read(clock.now()) is None
    clock.advance(5.0)
    assert camera.read(clock.now()).sequence == 9
    assert camera.has_ended


def test_a_folder_without_pictures_is_one_line(tmp_path, open_driver):
    with pytest.raises(HriError, match="no pictures in it - put"):
        open_driver(ImageFolderCamera, folder=tmp_path)
    with pytest.raises(HriError, match="no such folder - check the path"):
        open_driver(ImageFolderCamera, folder=tmp_path / "no")


def test_the_newest_picture_that_is_due_wins(open_driver, clock):
    camera = open_driver(MemoryCamera)
    for number in range(5):
        camera.show(np.full((4, 4, 3), number, np.uint8), number / 10)
    clock.advance(0.25)
    frame = camera.read(clock.now())
    assert (frame.sequence, frame.time, camera.footage().lost) == (2, 0.2, 0)
    clock.advance(0.25)
    assert camera.read(clock.now()).sequence == 4
    assert camera.footage().lost == 1


def test_a_lost_camera_is_looked_for_less_and_less_often():
    pauses = list(islice(waits(), 9))
    assert pauses[0] == 0.5
    assert all(a <= b for a, b in pairwise(pauses))
    assert pauses[-1] == 30.0


def test_a_fault_nobody_knows_is_refused():
    with pytest.raises(HriError, match='no fault "stal" - did you mean "stall"'):
        Fault("stal")


def test_a_task_switches_the_camera_off_for_all_tasks(clock):
    use(config="simulated", clock=clock)
    try:
        camera = get_task_manager().context.resources.obtain("camera", Camera)
        vision.SwitchCamera(False)
        assert not camera.is_on
        with pytest.raises(HriError, match="camera is switched off - switch it on"):
            vision.GetImage("camera")
        assert clock.now() < 1.0
        vision.SwitchCamera(True)
        assert isinstance(vision.GetImage("camera"), Frame)
    finally:
        get_task_manager().shutdown()
        use()


def test_a_moment_of_reading_tells_the_rate():
    stage = Stage(rate=20.0)
    stage.camera.try_out(1.0)
    assert stage.camera.footage().rate == pytest.approx(20, abs=1)


def test_it_watches_while_pictures_of_the_world_come(open_driver, clock):
    stage = Stage(Fault("stall", 1.0, 6.0))
    seen = [stage.camera.is_watching]
    for seconds in (0.5, 5.0, 1.0):
        stage.film(seconds)
        seen.append(stage.camera.is_watching)
    stage.camera.switch(False)
    assert [*seen, stage.camera.is_watching] == [False, True, False, True, False]
    assert not open_driver(BlankCamera).is_watching
