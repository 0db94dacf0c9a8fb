"""Films and sounds that grow: good at any time, whatever happens to the program or the disk."""

import os
import subprocess
import sys

import cv2
import numpy as np
import pytest

from hri.core.writing import leftovers
from hri.hal.drivers.growing_movie import GrowingMovie
from hri.hal.drivers.mp4 import boxes, is_whole
from hri.hal.drivers.video_file import VideoFileScreen
from hri.hal.drivers.wav_file import WavSpeaker, read_wav
from hri.hal.tee import TeeSpeaker
from tests.disk import full_disk
from tests.hal.sounds import tone

RATE = 10.0
SIZE = 64, 48


def picture(number):
    """A picture that tells its number, by bars for its bits."""
    bits = [number >> bit & 1 for bit in range(8)]
    return np.repeat(np.tile(np.uint8(bits) * 200 + 20, (SIZE[1], 1)), 8, axis=1)[..., None].repeat(
        3, axis=2
    )


def numbers(path):
    """Which pictures are seen in a film."""
    capture = cv2.VideoCapture(str(path))
    seen = []
    while (found := capture.read())[0]:
        bars = found[1].reshape(SIZE[1], 8, 8, 3).mean(axis=(0, 2, 3))
        seen.append(sum(int(light > 120) << bit for bit, light in enumerate(bars)))
    capture.release()
    return seen


@pytest.fixture
def movie(tmp_path):
    return GrowingMovie(tmp_path / "face.mp4", SIZE, RATE)


def shoot(movie, count):
    for number in range(count):
        movie.write(picture(number))


def test_a_film_is_an_ordinary_one_when_it_is_closed(movie, tmp_path):
    shoot(movie, 45)
    movie.close()
    path = tmp_path / "face.mp4"
    assert numbers(path) == list(range(45))
    assert is_whole(path)
    assert [name for name, _ in boxes(path.read_bytes())] == ["ftyp", "mdat", "moov"]
    assert os.listdir(tmp_path) == ["face.mp4"]


def test_pictures_of_other_sizes_are_fitted_into_the_film(movie, tmp_path):
    for number in range(20):
        small = picture(number)
        large = small.repeat(3, axis=0).repeat(3, axis=1)
        movie.write((small, large, small[::2, ::2])[number % 3])
    movie.close()
    assert numbers(tmp_path / "face.mp4") == list(range(20))


def test_a_screen_that_films_takes_pictures_of_every_kind_and_refuses_what_is_none(
    open_driver, clock, tmp_path
):
    path = tmp_path / "face.mp4"
    screen = open_driver(VideoFileScreen, file=path, width=SIZE[0], height=SIZE[1], rate=RATE)
    shown = picture(5)
    wide = np.pad(shown, ((24, 24), (0, 0), (0, 0))).repeat(2, axis=0)
    for number, image in enumerate((shown, shown[..., 0], shown.astype(np.uint16) * 256, wide)):
        screen.show(image, number / RATE)
    for odd in (np.zeros((0, 64, 3), np.uint8), np.zeros((48, 64, 2), np.uint8), shown / 255):
        with pytest.raises(ValueError, match=r"a picture of|pixels of the kind"):
            screen.show(odd, 1.0)
    screen.show(shown, 0.4)
    screen.deactivate()
    found = numbers(path)
    assert len(found) == 5
    assert [found[0], found[1], found[2], found[4]] == [5] * 4


def test_a_film_whose_program_was_killed_is_seen_up_to_a_second_before(movie, tmp_path):
    shoot(movie, 45)
    assert numbers(tmp_path / "face.mp4") == list(range(41))


def test_a_film_of_nothing_shows_black(movie, tmp_path):
    movie.close()
    movie.close()
    assert numbers(tmp_path / "face.mp4") == [0]


def test_the_first_picture_is_there_at_once(movie, tmp_path):
    shoot(movie, 1)
    assert numbers(tmp_path / "face.mp4") == [0]


def states(movie, path):
    """The file after each single write, each of them also cut off in its middle."""
    found = []
    append, patch = movie._file.append, movie._file.patch

    def appended(record):
        before = path.read_bytes()
        is_there = append(record)
        found.extend(before + record[:cut] for cut in range(0, len(record), 23))
        found.append(path.read_bytes())
        return is_there

    def patched(place, record):
        patch(place, record)
        found.append(path.read_bytes())

    movie._file.append, movie._file.patch = appended, patched
    return found


def test_a_film_killed_at_any_write_is_seen_up_to_there(movie, tmp_path):
    shoot(movie, 1)
    found = states(movie, tmp_path / "face.mp4")
    for number in range(1, 32):
        movie.write(picture(number))
    movie.close()
    most = 1
    for state in found:
        (tmp_path / "killed.mp4").write_bytes(state)
        seen = numbers(tmp_path / "killed.mp4")
        assert seen == list(range(len(seen)))
        assert len(seen) >= most
        most = len(seen) if len(seen) % 10 == 1 else most
    assert most == 31
    assert len(found) > 60


@pytest.mark.parametrize("room", [0, 100, 1500, 2500])
def test_a_film_on_a_full_disk_ends_in_one_line_and_is_seen_up_to_there(tmp_path, caplog, room):
    path = tmp_path / "face.mp4"
    with full_disk(after=room):
        movie = GrowingMovie(path, SIZE, RATE)
        shoot(movie, 50)
        movie.close()
    seen = numbers(path)
    assert seen == list(range(len(seen)))
    assert len(seen) < 50
    assert len(caplog.messages) == 1
    assert caplog.messages[0].startswith(f"{path} ends here: ")
    assert os.listdir(tmp_path) == ["face.mp4"]


def test_a_screen_goes_on_when_its_film_has_ended(tmp_path, clock, open_driver, caplog):
    with full_disk(after=1000):
        screen = open_driver(VideoFileScreen, file=tmp_path / "f.mp4", width=64, height=48, rate=30)
        for number in range(90):
            screen.show(picture(number % 40), number / 30)
        screen.deactivate()
    assert len(caplog.messages) == 1


def test_a_sound_is_heard_up_to_half_a_second_before(tmp_path, clock, open_driver):
    path = tmp_path / "out.wav"
    speaker = open_driver(WavSpeaker, file=path, rate=16000)
    clock.advance(1.0)
    speaker.play(tone(16000, 2.0), 16000, clock.now())
    clock.advance(1.4)
    samples, _ = read_wav(path)
    assert 16000 * 1.9 <= len(samples) <= 16000 * 2.4
    assert not samples[:16000].any()
    assert np.array_equal(samples[16000:], tone(16000, 2.0)[: len(samples) - 16000])


def test_a_sound_that_comes_in_pieces_is_written_as_it_was_heard(tmp_path, clock, open_driver):
    path = tmp_path / "out.wav"
    speaker = open_driver(WavSpeaker, file=path, rate=16000)
    speaker.play(tone(16000, 1.0), 16000, clock.now())
    clock.advance(0.7)
    speaker.extend(tone(16000, 1.0), clock.now())
    clock.advance(1.8)  # it has been silent for half a second
    speaker.extend(tone(16000, 1.0), clock.now())
    clock.advance(1.0)
    speaker.deactivate()
    samples, _ = read_wav(path)
    silence = np.zeros(8000, np.int16)
    assert np.array_equal(
        samples, np.concatenate([tone(16000, 1.0), tone(16000, 1.0), silence, tone(16000, 1.0)])
    )


def test_what_should_be_said_is_said_when_the_recording_cannot_be_written(
    tmp_path, clock, open_driver, manager, caplog
):
    copy = open_driver(WavSpeaker, file=tmp_path / "out.wav", rate=16000)
    real = open_driver(WavSpeaker, file=tmp_path / "real.wav", rate=8000)
    with full_disk(after=20_000):
        speaker = TeeSpeaker(real, copy)
        for _ in range(3):
            speaker.play(tone(8000, 0.3), 8000, clock.now())
            clock.advance(0.3)
            speaker.stop(clock.now())
        copy.deactivate()
    real.deactivate()
    assert len(read_wav(tmp_path / "real.wav")[0]) == 7200
    assert len(read_wav(tmp_path / "out.wav")[0]) * 2 + 44 <= 20_000
    assert len(caplog.messages) == 1


DIES = """
import os, pathlib, sys
import numpy as np
from hri.core.clock import FakeClock
from hri.core.event_bus import EventBus
from hri.core.event_log import EventLog
from hri.hal.drivers.video_file import VideoFileScreen
from hri.hal.drivers.wav_file import WavSpeaker
from hri.hal.resource_manager import ResourceManager
from hri.hal.resource import Description
folder = pathlib.Path(sys.argv[1])
clock = FakeClock()
manager, bus = ResourceManager((), clock), EventBus(clock)
log = EventLog(folder / "events.jsonl", bus)
film = {"file": str(folder / "face.mp4"), "width": "64", "height": "48", "rate": "10"}
screen = VideoFileScreen(Description("face", "Test", film), manager)
speaker = WavSpeaker(Description("robot", "Test", {"file": str(folder / "robot.wav")}), manager)
screen.activate(), speaker.activate()
speaker.play(np.full(22050 * 9, 1000, np.int16), 22050, 0.0)
for number in range(60):
    screen.show(np.full((48, 64, 3), 100, np.uint8), number / 10)
    bus.raise_event("speech.said", text="One.")
    clock.advance(0.1)
while screen._pictures.qsize(): pass
os.kill(os.getpid(), 9)
"""


def test_all_of_a_recording_survives_kill_9(tmp_path):
    done = subprocess.run([sys.executable, "-c", DIES, tmp_path], timeout=120)
    assert done.returncode == -9
    assert leftovers(tmp_path / "face.mp4")
    assert len(numbers(tmp_path / "face.mp4")) >= 45
    samples, rate = read_wav(tmp_path / "robot.wav")
    assert len(samples) / rate >= 5.4
    assert (samples == 1000).all()
    assert (tmp_path / "events.jsonl").read_text().count('"speech.said"') == 60
    GrowingMovie(tmp_path / "face.mp4", SIZE, RATE).close()
    assert not leftovers(tmp_path / "face.mp4")
