"""How loud it is, measured against closed form."""

import math

import numpy as np
import pytest

from hri.hal.audio_level import AudioLevel
from hri.hal.drivers.memory import MemoryMicrophone
from hri.hal.drivers.microphone_level import MicrophoneLevel
from hri.hal.microphone import Microphone
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager

from .sounds import tone

pytestmark = [pytest.mark.proves("H13"), pytest.mark.proves("R03")]


@pytest.mark.parametrize("amplitude", [30, 300, 3000, 32000])
def test_a_tone_has_the_level_of_its_root_mean_square(amplitude, manager, clock, open_driver):
    level = open_driver(MicrophoneLevel)
    manager.obtain("microphone", Microphone).hear(tone(16000, 1.0, amplitude=amplitude))
    clock.advance(0.5)
    expected = 20 * math.log10(amplitude / math.sqrt(2) / 32768)
    assert level.level_dbfs(clock.now()) == pytest.approx(expected, abs=0.3)
    assert level.level(clock.now()) == pytest.approx(max(0, 1 + expected / 60), abs=0.01)


def test_silence_is_nothing(clock, open_driver):
    level = open_driver(MicrophoneLevel)
    assert level.level_dbfs(clock.now()) == -120
    assert level.level(clock.now()) == 0


def test_it_forgets_what_is_longer_ago_than_a_tenth_of_a_second(manager, clock, open_driver):
    level = open_driver(MicrophoneLevel)
    manager.obtain("microphone", Microphone).hear(tone(16000, 0.5))
    clock.advance(0.5)
    assert level.level(clock.now()) > 0.5
    clock.advance(0.11)
    assert level.level(clock.now()) == 0


class Lost(MemoryMicrophone):
    """Gives nothing any more once it is gone."""

    is_gone = False

    def read(self, now):
        heard = super().read(now)
        return heard[:0] if self.is_gone else heard


def test_a_microphone_that_is_gone_is_silent(manager, clock, open_driver):
    microphone = open_driver(Lost)
    manager.substitute("microphone", microphone)
    level = open_driver(MicrophoneLevel)
    microphone.hear(tone(16000, 5.0))
    clock.advance(0.5)
    assert level.level(clock.now()) > 0.5
    microphone.is_gone = True
    clock.advance(0.05)
    assert level.level(clock.now()) > 0.5, "no block has come since, that is all"
    clock.advance(1.0)
    assert level.level_dbfs(clock.now()) == -120


def test_it_takes_nothing_from_who_else_listens(manager, clock, open_driver):
    microphone = manager.obtain("microphone", Microphone)
    level, ear = open_driver(MicrophoneLevel), microphone.listen()
    microphone.hear(tone(16000, 0.5))
    heard = []
    for _ in range(10):
        clock.advance(0.05)
        level.level(clock.now())
        heard.append(ear.read(clock.now()))
    assert np.array_equal(np.concatenate(heard), tone(16000, 0.5))


def test_the_type_of_2003_hears_the_microphone_it_is_told_to(clock):
    devices = [
        Description("deaf", "Hri.MemoryMicrophone"),
        Description("audio_in", "Hri.MemoryMicrophone", {"rate": "48000"}),
        Description("level", "Evolution.WinVoiceAudioLevel", {"microphone": "audio_in"}),
    ]
    manager = ResourceManager(devices, clock)
    level = manager.obtain("level", AudioLevel)
    manager.obtain("audio_in", Microphone).hear(tone(48000))
    clock.advance(0.2)
    assert level.level(clock.now()) > 0.5
    manager.close()
