import tracemalloc
import wave

import cv2
import numpy as np
import pytest

from hri.core.errors import HriError
from hri.hal.drivers.memory import MemoryMicrophone, SilentSpeaker
from hri.hal.drivers.video_file import VideoFileCamera, VideoFileScreen, check_video
from hri.hal.drivers.wav_file import WavMicrophone, WavSpeaker, read_wav, write_wav

from .sounds import tone


@pytest.mark.parametrize(
    ("rate", "channels", "width"), [(16000, 1, 2), (44100, 2, 2), (8000, 1, 1), (48000, 2, 3)]
)
def test_wav_files_of_every_kind_are_heard_at_16_khz(
    tmp_path, clock, open_driver, rate, channels, width
):
    sound = tone(rate)
    scaled = sound.astype(np.int32) * 65536
    raw = np.repeat(scaled[:, None], channels, 1).astype("<i4").view(np.uint8).reshape(-1, 4)
    data = raw[:, 4 - width :].copy()
    if width == 1:
        data = data + np.uint8(128)
    with wave.open(str(tmp_path / "tone.wav"), "wb") as file:
        file.setparams((channels, width, rate, 0, "NONE", ""))
        file.writeframes(data.tobytes())
    microphone = open_driver(WavMicrophone, file=tmp_path / "tone.wav")
    heard = []
    while not microphone.has_ended:
        clock.advance(0.03)
        heard.append(microphone.read(clock.now()))
    heard = np.concatenate(heard)[:8000].astype(float)
    expected = tone(16000).astype(float)
    similarity = heard @ expected / np.linalg.norm(heard) / np.linalg.norm(expected)
    assert similarity > 0.99
    assert clock.now() == pytest.approx(1.5, abs=0.04)


@pytest.mark.parametrize(
    "content", [b"", b"RIFF", b"hello world, this is no sound", b"RIFF\x00\x00\x00\x00WAVEfmt "]
)
def test_what_is_no_wav_is_refused_in_one_line(tmp_path, content):
    path = tmp_path / "bad.wav"
    path.write_bytes(content)
    with pytest.raises(HriError) as error:
        read_wav(path)
    assert str(error.value).startswith(f"{path}: not a readable WAV file")
    assert "\n" not in str(error.value)


def test_a_wav_without_sound_is_refused(tmp_path):
    write_wav(tmp_path / "empty.wav", np.zeros(0, np.int16), 16000)
    with pytest.raises(HriError, match="holds no sound"):
        read_wav(tmp_path / "empty.wav")


def test_what_is_played_is_written_with_its_pauses_and_cuts(tmp_path, clock, open_driver):
    speaker = open_driver(WavSpeaker, file=tmp_path / "out.wav", rate=16000)
    clock.advance(1.0)
    speaker.play(tone(16000), 16000, clock.now())
    clock.advance(0.2)
    assert speaker.position(clock.now()) == pytest.approx(0.2)
    speaker.stop(clock.now())
    assert speaker.position(clock.now()) is None
    clock.advance(0.8)
    speaker.deactivate()
    samples, rate = read_wav(tmp_path / "out.wav")
    assert (len(samples), rate) == (32000, 16000)
    assert not samples[:16000].any()
    assert np.array_equal(samples[16000:19200], tone(16000)[:3200])
    assert not samples[19200:].any()


def test_a_silent_speaker_takes_its_time(clock, open_driver):
    speaker = open_driver(SilentSpeaker)
    assert speaker.position(0.0) is None
    speaker.play(tone(16000), 16000, clock.now())
    clock.advance(0.3)
    assert speaker.position(clock.now()) == pytest.approx(0.3)
    clock.advance(0.3)
    assert speaker.position(clock.now()) is None


def test_a_microphone_in_memory_hears_in_real_time(clock, open_driver):
    microphone = open_driver(MemoryMicrophone)
    clock.advance(0.1)
    microphone.hear(tone(16000))
    clock.advance(0.1)
    assert not microphone.read(0.1).any()
    assert np.array_equal(microphone.read(clock.now()), tone(16000)[:1600])


def write_video(path, count=20, rate=10.0):
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), rate, (64, 48))
    for i in range(count):
        writer.write(np.full((48, 64, 3), 10 * i, np.uint8))
    writer.release()


def test_a_video_is_seen_at_its_own_pace(tmp_path, clock, open_driver):
    write_video(tmp_path / "v.avi")
    camera = open_driver(VideoFileCamera, file=tmp_path / "v.avi")
    assert (camera.width, camera.height) == (64, 48)
    first = camera.read(clock.now())
    assert first.sequence == 0
    assert camera.read(clock.now()) is None
    clock.advance(1.0)
    later = camera.read(clock.now())
    assert later.sequence == 10
    assert later.time == pytest.approx(1.0)
    assert abs(float(later.image.mean()) - 100) < 4
    clock.advance(5.0)
    assert camera.read(clock.now()) is None
    assert camera.has_ended


def test_an_image_stands_still(tmp_path, clock, open_driver):
    cv2.imwrite(str(tmp_path / "i.png"), np.full((48, 64, 3), (255, 0, 0), np.uint8))
    camera = open_driver(VideoFileCamera, file=tmp_path / "i.png")
    for _ in range(3):
        frame = camera.read(clock.now())
        assert tuple(frame.image[0, 0]) == (0, 0, 255)  # RGB
        clock.advance(0.1)
    assert camera.has_ended


@pytest.mark.parametrize("content", [b"", b"not a video at all", b"\x00" * 5000])
def test_what_is_no_video_is_refused_in_one_line(tmp_path, content, capfd):
    path = tmp_path / "bad.mp4"
    path.write_bytes(content)
    with pytest.raises(HriError, match="not a readable video or image"):
        check_video(path)
    with pytest.raises(HriError, match="no such file"):
        check_video(tmp_path / "none.mp4")
    assert capfd.readouterr().err == ""


def test_a_video_begins_when_it_is_opened_as_sound_and_events_do(tmp_path, clock, open_driver):
    screen = open_driver(VideoFileScreen, file=tmp_path / "o.mp4", width=64, height=48, rate=30)
    screen.show(np.full((48, 64, 3), 200, np.uint8), 0.5)
    screen.deactivate()
    assert cv2.VideoCapture(str(tmp_path / "o.mp4")).get(cv2.CAP_PROP_FRAME_COUNT) == 16


def test_a_written_video_has_a_constant_rate(tmp_path, clock, open_driver):
    screen = open_driver(VideoFileScreen, file=tmp_path / "o.mp4", width=64, height=48, rate=30)
    for i in (0, 1, 2, 6, 7):  # three pictures are missing
        screen.show(np.full((48, 64, 3), 30 * i, np.uint8), i / 30)
    screen.deactivate()
    capture = cv2.VideoCapture(str(tmp_path / "o.mp4"))
    means = []
    while (picture := capture.read())[0]:
        means.append(float(picture[1].mean()))
    assert len(means) == 8
    assert means[3] == pytest.approx(180, abs=8)
    assert means[7] == pytest.approx(210, abs=8)


def test_hours_of_silence_do_not_fill_the_memory(tmp_path, clock, open_driver):
    speaker = open_driver(WavSpeaker, file=tmp_path / "out.wav", rate=8000)
    clock.advance(3 * 3600.0)
    tracemalloc.start()
    speaker.play(tone(8000), 8000, clock.now())
    clock.advance(1.0)
    speaker.deactivate()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4_000_000
    with wave.open(str(tmp_path / "out.wav")) as file:
        assert file.getnframes() == 8000 * (3 * 3600 + 1)


def test_reading_a_long_file_needs_little_beside_its_samples(tmp_path):
    write_wav(tmp_path / "long.wav", np.zeros(48000 * 300, np.int16), 48000)
    tracemalloc.start()
    samples, rate = read_wav(tmp_path / "long.wav", 16000)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert rate == 16000
    assert len(samples) == pytest.approx(16000 * 300, abs=2)
    assert peak < 2.5 * samples.nbytes + 8_000_000
