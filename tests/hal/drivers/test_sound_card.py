"""The sound card, with a PortAudio that the test turns by hand."""

from types import SimpleNamespace

import numpy as np
import pytest

from hri.core.clock import RealClock
from hri.core.errors import NotAvailable
from hri.hal.drivers import sound_card
from hri.hal.drivers.sound_card import SoundCardMicrophone, SoundCardSpeaker
from hri.hal.microphone import Microphone
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from tests.hal.sounds import tone


class FakePortAudio:
    """As much of the sounddevice module as the drivers use."""

    class PortAudioError(Exception):
        pass

    class Stream:
        latency = 0.0
        active = True

        def __init__(self, callback, **settings):
            self.callback, self.settings = callback, settings

        def start(self):
            """Runs already."""

        def close(self):
            self.active = False

    InputStream = OutputStream = Stream


@pytest.fixture
def port_audio(monkeypatch):
    monkeypatch.setattr(sound_card, "load_sounddevice", lambda: FakePortAudio)


def pull(speaker, frames):
    out = np.full((frames, 1), 99, np.int16)
    speaker._stream.callback(out, frames, None, None)
    return out[:, 0]


def test_a_sound_is_played_block_by_block_and_cut_by_a_stop(port_audio, open_driver):
    speaker = open_driver(SoundCardSpeaker, rate=16000)
    speaker.play(tone(16000, 0.1), 16000, 0.0)
    assert np.array_equal(pull(speaker, 800), tone(16000, 0.1)[:800])
    assert speaker.position(0.0) == pytest.approx(0.05)
    speaker.stop(0.0)
    assert speaker.position(0.0) is None
    rest = np.abs(pull(speaker, 800))
    assert rest[: sound_card.FADE].max() < tone(16000, 0.1).max(), "dies away without a click"
    assert not rest[sound_card.FADE :].any()


def test_a_sound_goes_on_without_a_seam_while_it_is_made(port_audio, open_driver):
    speaker = open_driver(SoundCardSpeaker, rate=44100)
    whole = tone(22050, 0.2)
    speaker.play(whole[:1000], 22050, 0.0)
    begun = pull(speaker, 1500)
    speaker.extend(whole[1000:], 0.0)

    heard = np.concatenate([begun, pull(speaker, 7320)])

    expected = tone(44100, 0.2)
    assert np.abs(heard[500:-500].astype(int) - expected[500:-500]).max() < 0.02 * expected.max()
    assert speaker.position(0.0) is None
    speaker.extend(whole, 0.0)
    assert pull(speaker, 100).any(), "it ran out, and goes on"
    speaker.stop(0.0)
    speaker.extend(whole, 0.0)
    assert not pull(speaker, 5000)[sound_card.FADE :].any(), "what was stopped does not"


def test_a_speaker_that_goes_away_keeps_time_in_silence(port_audio, open_driver):
    speaker = open_driver(SoundCardSpeaker, rate=16000)
    speaker.play(tone(16000, 1.0), 16000, 5.0)
    pull(speaker, 1600)
    speaker._stream.active = False

    assert speaker.position(5.2) == pytest.approx(0.2)
    speaker.extend(tone(16000, 1.0), 5.5)
    assert speaker.position(6.9) == pytest.approx(1.9)
    assert speaker.position(7.1) is None
    speaker.play(tone(16000, 1.0), 16000, 8.0)
    assert speaker.position(8.5) == pytest.approx(0.5)
    assert not pull(speaker, 8000)[sound_card.FADE :].any(), "nothing sounds later"
    assert speaker.position(9.1) is None


def test_what_the_card_hears_is_read_once(port_audio, open_driver):
    microphone = open_driver(SoundCardMicrophone, rate=48000, device=3)
    assert microphone._stream.settings["samplerate"] == 48000
    assert microphone._stream.settings["device"] == 3
    for block in np.split(tone(48000, 0.02), 3):
        microphone._stream.callback(block[:, None], len(block), None, None)
    assert np.array_equal(microphone.read(0.0), tone(48000, 0.02))
    assert len(microphone.read(0.0)) == 0


def test_sound_that_the_card_lost_is_told_now_and_then(port_audio, clock):
    told = []
    manager = ResourceManager((), clock, notice=told.append)
    microphone = SoundCardMicrophone(Description("ears", "Hri.Microphone"), manager)
    microphone.activate()
    lost, kept = SimpleNamespace(input_overflow=True), SimpleNamespace(input_overflow=False)
    for status in [kept] * 5 + [lost] * 100:
        microphone._stream.callback(np.zeros((320, 1), np.int16), 320, None, status)
        microphone.read(0.0)
    microphone.deactivate()

    assert told[0] == "ears: sound was lost, once by now - the machine is too busy"
    assert [line.split()[4] for line in told[1:]] == ["3", "7", "15", "31", "63"]


def test_a_card_that_is_not_there_is_one_line(monkeypatch):
    def no_library():
        raise NotAvailable(f"sound card: PortAudio is missing - {sound_card.INSTALL}")

    monkeypatch.setattr(sound_card, "load_sounddevice", no_library)
    manager = ResourceManager([Description("m", "Evolution.WmmeAudioRecord")], RealClock())
    with pytest.raises(NotAvailable, match="PortAudio is missing - apt install libportaudio2"):
        manager.obtain("m", Microphone)


def test_a_card_without_a_device_is_one_line(monkeypatch, manager):
    class NoDevice(FakePortAudio):
        @staticmethod
        def InputStream(**settings):
            raise FakePortAudio.PortAudioError("Error querying device -1")

    monkeypatch.setattr(sound_card, "load_sounddevice", lambda: NoDevice)
    microphone = SoundCardMicrophone(Description("m", "Hri.Microphone"), manager)
    with pytest.raises(NotAvailable, match="m: no device - plug one in, or `hri doctor --choose`"):
        microphone.activate()
