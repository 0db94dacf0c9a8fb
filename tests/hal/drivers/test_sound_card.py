"""The sound card, with a PortAudio that the test turns by hand."""

from dataclasses import replace
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
from tests.hal.sound_cards import ALSA_BUSY, BUSY, Card, PortAudio, PortAudioError
from tests.hal.sounds import similarity, tone


@pytest.fixture
def cards(monkeypatch):
    """Makes these cards the ones of the machine."""

    def plug_in(*cards):
        monkeypatch.setattr(sound_card, "load_sounddevice", lambda: PortAudio(*cards))
        return cards[0] if cards else None

    return plug_in


@pytest.fixture
def port_audio(cards):
    cards(Card())


def pull(speaker, frames):
    return speaker._stream.pull(frames)[:, 0]


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


def test_what_the_card_hears_is_read_once(cards, open_driver):
    cards(Card(), Card(rates=(48000,)))
    microphone = open_driver(SoundCardMicrophone, rate=48000, device=1)
    assert microphone._stream.settings["device"] == 1
    microphone._stream.push(tone(48000, 0.06))
    assert np.array_equal(microphone.read(0.0), tone(48000, 0.06))
    assert len(microphone.read(0.0)) == 0


LIMITED = [
    Card(rates=(44100,)),
    Card(rates=(44100, 48000)),
    Card(rates=(48000,), inputs=(2,), outputs=(2,)),
    Card(rates=(16000, 22050), inputs=(2,), outputs=(2,)),
    Card(rates=(96000,), inputs=(6,), outputs=(8,)),
    Card(rates=(32000,), inputs=(1,), outputs=(1,)),
    Card(rates=(8000,)),
    Card(rates=(37800,), inputs=(4,), outputs=(4,)),
]
"""Cards that take neither the rate nor the channels that are wanted, or only one of the two."""


@pytest.mark.parametrize("card", LIMITED, ids=str)
def test_a_microphone_of_any_rate_and_channels_is_heard_at_the_wanted_rate(
    card, cards, open_driver
):
    cards(replace(card, opened=[]))
    microphone = open_driver(SoundCardMicrophone)
    ear = microphone.listen(16000)
    stream = microphone._stream
    heard = []
    for part in np.array_split(tone(stream.rate, 3.0), 30):
        stream.push(part)
        heard.append(ear.read(0.0))

    whole = np.concatenate(heard)
    assert len(whole) == pytest.approx(3 * 16000, abs=1600), "less than 0.1 s late"
    assert similarity(whole, tone(16000, 3.0)) > 0.999, "no drift"
    assert str(stream.rate // 1000) in microphone.describe()


@pytest.mark.parametrize("card", LIMITED, ids=str)
def test_a_speaker_of_any_rate_and_channels_plays_what_it_is_given(card, cards, open_driver):
    cards(replace(card, opened=[]))
    speaker = open_driver(SoundCardSpeaker)
    whole = tone(24000, 1.0)
    speaker.play(whole[:5000], 24000, 0.0)
    for at in range(5000, len(whole), 1700):
        speaker.extend(whole[at : at + 1700], 0.0)
    stream = speaker._stream
    played = stream.pull(stream.rate // 2)
    assert speaker.position(0.0) == pytest.approx(0.5, abs=0.001)
    played = np.concatenate([played, stream.pull(stream.rate // 2 + 100)])

    assert (played == played[:, :1]).all(), "every channel"
    expected = tone(stream.rate, 1.0).astype(int)
    assert np.abs(played[100 : len(expected) - 100, 0] - expected[100:-100]).max() < 100
    assert not played[len(expected) + 1 :].any()
    assert speaker.position(0.0) is None
    assert f"{stream.rate / 1000:g} kHz" in speaker.describe()


def test_a_card_that_takes_what_is_wanted_is_asked_for_nothing_else(cards, open_driver):
    card = cards(Card())
    open_driver(SoundCardMicrophone)
    open_driver(SoundCardSpeaker)
    assert [(stream.rate, stream.channels) for stream in card.opened] == [(16000, 1), (22050, 1)]


def test_a_device_that_comes_back_as_another_is_heard_on(cards, open_driver, monkeypatch):
    monkeypatch.setattr(sound_card, "REOPEN_AFTER", 0.001)
    old, new = Card(rates=(16000,)), Card(rates=(44100,), inputs=(2,), outputs=(2,))
    plugged_in = [old]
    monkeypatch.setattr(sound_card, "load_sounddevice", lambda: PortAudio(*plugged_in))
    microphone = open_driver(SoundCardMicrophone)
    ear = microphone.listen()
    plugged_in[:] = [new]
    microphone._sounddevice.cards = (new,)
    microphone._stream.active = False
    assert not len(ear.read(0.0))
    while microphone._search is not None:
        pass
    for _ in range(3):
        microphone._stream.push(tone(44100, 1.0))
    assert similarity(ear.read(0.0)[:16000], tone(16000, 1.0)) > 0.99


@pytest.mark.parametrize("driver", [SoundCardMicrophone, SoundCardSpeaker])
@pytest.mark.parametrize(
    ("plugged_in", "device", "told"),
    [
        ([], "", "m: no device - plug one in, or `hri doctor --choose`"),
        ([Card()], "7", "m: no device 7 - plug one in, or `hri doctor --choose`"),
        ([Card()], "Jabra", "device matching 'Jabra' - choose one: `hri doctor --choose`"),
        ([Card(error=BUSY)], "", "m: it is busy - end the program that uses it"),
        ([Card(error=ALSA_BUSY)], "", "m: it is busy - end the program that uses it"),
        ([Card(error=BUSY, error_at_start=True)], "", "m: it is busy - end the program"),
        ([Card(rates=())], "", "m: it refuses every rate (8, 11.025, 16, "),
        ([Card(inputs=(), outputs=())], "", "- choose another: `hri doctor --choose`"),
        (
            [Card(error=PortAudioError("Internal PortAudio error", -9986))],
            "",
            "m: it does not open: Internal PortAudio error - end what else may use it",
        ),
        (
            [Card(error=PortAudioError("Unanticipated", -9999, (0, -13, "Permission denied")))],
            "",
            "m: it may not be used - add yourself to the group audio",
        ),
    ],
)
def test_a_device_that_cannot_be_used_says_why(cards, clock, driver, plugged_in, device, told):
    cards(*[replace(card, opened=[]) for card in plugged_in])
    manager = ResourceManager((), clock)
    with pytest.raises(NotAvailable) as error:
        driver(Description("m", "Test", {"device": device}), manager).activate()
    assert told in str(error.value)
    assert ("plug" in str(error.value)) == ("no device" in told), "it is plugged in"


def test_a_microphone_with_an_inverted_side_is_heard_and_told(cards, clock):
    cards(Card(rates=(48000,), inputs=(2,)))
    told = []
    manager = ResourceManager((), clock, notice=told.append)
    microphone = SoundCardMicrophone(Description("ears", "Hri.Microphone"), manager)
    microphone.activate()
    sound = tone(48000, 1.0)
    microphone._stream.push(np.stack([sound, -sound], axis=1))
    assert similarity(microphone.read(0.0), tone(16000, 1.0)) > 0.99
    microphone.read(0.0)
    microphone.deactivate()
    assert told == [
        "ears: a channel is the opposite of the other and is turned round - check its wires"
    ]


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
