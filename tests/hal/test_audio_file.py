"""Files are played over a speaker and recorded from a microphone."""

import numpy as np
import pytest
import soundfile
import trio
from hypothesis import given, strategies as st

from hri.core.errors import AuthoringError, HriError, NotAvailable
from hri.hal.audio_file import AudioFilePlayer, AudioFileRecorder
from hri.hal.drivers import sound_decoder
from hri.hal.drivers.sound_files import MicrophoneFileRecorder, SpeakerFilePlayer
from hri.hal.drivers.wav_file import WavMicrophone, load_sound, read_wav, write_wav
from hri.hal.pending import Interrupted
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.speaker import Speaker

from .sounds import similarity, tone

pytestmark = pytest.mark.proves("H15")


@pytest.fixture
def files(tmp_path):
    write_wav(tmp_path / "tone.wav", tone(22050, 1.0), 22050)
    soundfile.write(tmp_path / "tone.mp3", tone(22050, 1.0), 22050)
    return tmp_path


@pytest.mark.parametrize("name", ["tone.wav", "tone.mp3"])
def test_a_file_is_decoded(files, name):
    samples, rate = load_sound(files / name)
    assert rate == 22050
    assert abs(len(samples) - 22050) < 2500
    assert similarity(samples, tone(22050, 0.8)) > 0.99


def test_both_channels_of_a_file_are_heard(tmp_path):
    left = np.stack([tone(22050), np.zeros(11025, np.int16)], axis=1)
    soundfile.write(tmp_path / "left.flac", left, 22050)
    samples, _ = load_sound(tmp_path / "left.flac")
    assert np.array_equal(samples, (tone(22050) / 2).astype(np.int16))


@pytest.mark.parametrize("subtype", ["PCM_U8", "PCM_24", "PCM_32", "FLOAT", "DOUBLE", "ULAW"])
def test_a_wav_of_any_numbers_is_as_loud_as_it_was(tmp_path, subtype):
    loud = tone(22050) / 32768.0
    soundfile.write(tmp_path / "tone.wav", loud, 22050, subtype=subtype)
    samples, _ = load_sound(tmp_path / "tone.wav")
    assert samples.max() == pytest.approx(tone(22050).max(), rel=0.05)
    assert similarity(samples, tone(22050)) > 0.99


def test_what_is_too_loud_is_clipped_and_what_is_no_number_is_silence(tmp_path):
    loud = np.array([3.0, -3e38, np.inf, -np.inf, np.nan, 0.5])
    soundfile.write(tmp_path / "loud.wav", loud, 22050, subtype="FLOAT")
    samples, _ = load_sound(tmp_path / "loud.wav")
    assert samples.tolist() == [32767, -32768, 32767, -32768, 0, 16384]


@pytest.mark.parametrize("name", ["float.wav", "tone.mp3", "tone.flac", "tone.ogg"])
def test_a_microphone_hears_files_of_every_format(tmp_path, clock, open_driver, name):
    subtype = "FLOAT" if name == "float.wav" else None
    stereo = np.stack([tone(44100, 1.0), np.zeros(44100, np.int16)], axis=1)
    soundfile.write(tmp_path / name, stereo / 32768.0, 44100, subtype=subtype)
    microphone = open_driver(WavMicrophone, file=tmp_path / name, channel="left")
    clock.advance(0.8)
    assert similarity(microphone.read(clock.now()), tone(microphone.rate, 0.8)) > 0.98


@pytest.mark.parametrize("name", ["bad.mp3", "bad.wav", "bad"])
@pytest.mark.parametrize("content", [None, b"", b"this is no sound", b"ID3" + b"\xff\xfb" * 500])
def test_what_cannot_be_played_is_one_line(tmp_path, name, content):
    path = tmp_path / name
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(HriError) as error:
        load_sound(path)
    assert str(error.value).startswith(f"{path}: ")
    assert "\n" not in str(error.value)
    assert " - " in str(error.value)


def test_a_file_that_would_fill_the_memory_is_refused(files, monkeypatch):
    monkeypatch.setattr(sound_decoder, "LONGEST", 0.5)
    with pytest.raises(HriError, match=r"longer than 0\.5 s"):
        load_sound(files / "tone.mp3")


@pytest.mark.parametrize("name", ["tone.wav", "tone.mp3"])
def test_playing_takes_as_long_as_the_file(files, name, clock, open_driver):
    player = open_driver(SpeakerFilePlayer)
    assert player.position(clock.now()) is None
    pending = player.play(files / name)
    clock.advance(0.5)
    assert player.position(clock.now()) == pytest.approx(0.45, abs=0.03)
    assert not pending.is_done
    pending.wait(2.0)
    assert clock.now() == pytest.approx(1.1, abs=0.1)
    assert player.position(clock.now()) is None


def test_playing_can_be_awaited_in_a_loop(files, clock, open_driver):
    player = open_driver(SpeakerFilePlayer)

    async def main():
        async with trio.open_nursery() as nursery:
            nursery.start_soon(clock.drive)
            await player.play(files / "tone.wav")
            nursery.cancel_scope.cancel()

    trio.run(main)
    assert clock.now() == pytest.approx(1.07, abs=0.05)


def test_a_second_file_takes_the_place_of_the_first(files, clock, open_driver, manager):
    player = open_driver(SpeakerFilePlayer)
    first = player.play(files / "tone.wav")
    clock.advance(0.5)
    second = player.play(files / "tone.mp3")
    with pytest.raises(Interrupted, match="play it again"):
        first.result()
    second.wait(2.0)
    assert clock.now() == pytest.approx(1.6, abs=0.1)


@pytest.mark.parametrize("heard", [0.0, 0.3])
def test_stopping_is_silence_at_once(files, heard, clock, open_driver, manager):
    player = open_driver(SpeakerFilePlayer)
    pending = player.play(files / "tone.wav")
    clock.advance(heard)
    player.stop()
    player.stop()
    assert pending.is_done
    assert manager.obtain("speaker", Speaker).position(clock.now()) is None
    clock.advance(1.0)
    assert player.position(clock.now()) is None
    player.play(files / "tone.wav").wait(2.0)


def test_a_file_that_cannot_be_read_fails_the_call_alone(files, open_driver):
    player = open_driver(SpeakerFilePlayer)
    with pytest.raises(HriError, match="no such file"):
        player.play(files / "none.mp3").wait(1.0)
    with pytest.raises(HriError, match="this sound is not a regular file"):
        player.play(files).wait(1.0)
    player.play(files / "tone.mp3").wait(2.0)


def test_a_player_without_a_speaker_is_not_there(clock):
    manager = ResourceManager([Description("player", "Hri.AudioFilePlayer")], clock)
    with pytest.raises(NotAvailable, match="player: the configuration has no speaker - add one"):
        manager.obtain("player", AudioFilePlayer)


def test_the_types_of_2003_play_and_record(clock, files):
    types = {
        "speaker": "Hri.SilentSpeaker",
        "microphone": "Hri.MemoryMicrophone",
        "wav_file_audio_play": "Evolution.WmmeFileAudioPlay",
        "mp3_file_audio_play": "Evolution.DirectXMP3FileAudioPlay",
        "wav_file_audio_record": "Evolution.WmmeFileAudioRecord",
    }
    manager = ResourceManager([Description(id, type) for id, type in types.items()], clock)
    manager.obtain("wav_file_audio_play", AudioFilePlayer).play(files / "tone.wav").wait(2.0)
    manager.obtain("mp3_file_audio_play", AudioFilePlayer).play(files / "tone.mp3").wait(2.0)
    recorder = manager.obtain("wav_file_audio_record", AudioFileRecorder)
    assert recorder.record(files / "new.wav", 0.5).wait(2.0) == pytest.approx(0.5)
    manager.close()


def test_what_is_heard_is_recorded_until_it_is_stopped(tmp_path, clock, manager, open_driver):
    microphone = manager.obtain("microphone", object)
    clock.advance(1.0)
    recorder = open_driver(MicrophoneFileRecorder)
    pending = recorder.record(tmp_path / "r.wav")
    microphone.hear(tone(16000, 1.0))
    clock.advance(0.75)
    recorder.stop()
    recorder.stop()
    assert pending.result() == pytest.approx(0.75)
    samples, rate = read_wav(tmp_path / "r.wav")
    assert (len(samples), rate) == (12000, 16000)
    assert np.array_equal(samples, tone(16000, 1.0)[:12000])


def test_a_recording_ends_by_itself(tmp_path, clock, open_driver):
    recorder = open_driver(MicrophoneFileRecorder, microphone="high")
    assert recorder.record(tmp_path / "r.wav", 0.25).wait(1.0) == pytest.approx(0.25)
    samples, rate = read_wav(tmp_path / "r.wav")
    assert (len(samples), rate) == (12000, 48000)


def test_a_cancelled_recording_leaves_a_whole_file(tmp_path, clock, open_driver):
    recorder = open_driver(MicrophoneFileRecorder)
    pending = recorder.record(tmp_path / "r.wav")
    clock.advance(0.55)
    pending.cancel()
    recorder.stop()
    assert len(read_wav(tmp_path / "r.wav")[0]) == 8000


@pytest.mark.parametrize("seconds", [0, -1, float("nan"), float("inf"), 3601])
def test_a_recording_without_end_is_refused(tmp_path, open_driver, seconds):
    with pytest.raises(ValueError, match="at most 3600 s"):
        open_driver(MicrophoneFileRecorder).record(tmp_path / "r.wav", seconds)


def test_a_recording_that_cannot_be_written_is_one_line(tmp_path, open_driver):
    with pytest.raises(HriError, match="cannot be written: No such file"):
        open_driver(MicrophoneFileRecorder).record(tmp_path / "no" / "r.wav")


def test_a_wrong_rate_has_its_place(clock):
    description = Description("m", "Hri.MemoryMicrophone", {"rate": "16000.5"})
    manager = ResourceManager([description], clock)
    with pytest.raises(AuthoringError, match=r"rate: 16000\.5 - write a whole number"):
        manager.obtain("m", object)


FORMATS = ("wav", "mp3", "flac", "ogg")


@pytest.fixture(scope="module")
def encoded(tmp_path_factory):
    """The bytes of a tone in every format."""
    folder = tmp_path_factory.mktemp("encoded")
    for suffix in FORMATS:
        soundfile.write(folder / f"tone.{suffix}", tone(22050, 0.3), 22050)
    return folder, {suffix: (folder / f"tone.{suffix}").read_bytes() for suffix in FORMATS}


SPOTS = st.integers(0, 2**16)
"""Places in a file; where it is shorter they go around. What is drawn must not depend on the files:
an encoder need not write the same bytes each time."""


@given(
    st.sampled_from(FORMATS), st.lists(st.tuples(SPOTS, st.integers(0, 255)), max_size=30), SPOTS
)
def test_a_broken_file_is_played_as_far_as_it_goes_or_refused_in_one_line(
    encoded, suffix, wrong, end
):
    folder, formats = encoded
    content = bytearray(formats[suffix])
    for at, byte in wrong:
        content[at % len(content)] = byte
    path = folder / f"broken.{suffix}"
    path.write_bytes(content[: end % len(content)])
    refusal = refusal_of(path)
    assert refusal == "" or refusal.startswith(f"{path}: ")
    assert len(refusal.splitlines()) <= 1


def refusal_of(path):
    try:
        samples, rate = load_sound(path)
    except HriError as error:
        return str(error)
    assert samples.dtype == np.int16
    assert rate > 0
    return ""


def test_the_decoder_keeps_quiet(tmp_path, capfd):
    (tmp_path / "bad.mp3").write_bytes(b"\xff\xfb\x90\x00" + b"\x55" * 5000)
    with pytest.raises(HriError):
        load_sound(tmp_path / "bad.mp3")
    assert capfd.readouterr().err == ""


def test_a_sound_that_would_fill_the_memory_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(sound_decoder, "MOST_SAMPLES", 1000)
    file = tmp_path / "long.wav"
    write_wav(file, np.zeros(2000, np.int16), 16000)
    with pytest.raises(HriError, match="more than 1,000 samples - convert it to 16 kHz"):
        load_sound(file)
    assert len(load_sound(file, 8000)[0]) == 1000
