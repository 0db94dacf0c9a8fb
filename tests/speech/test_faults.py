"""What goes wrong with sound: hearing goes on, or says what to do."""

from __future__ import annotations

import importlib.util
import os
import signal

import numpy as np
import pytest

from hri.behavior.behavior import Context
from hri.core.clock import FakeClock
from hri.core.errors import HriError, NotAvailable
from hri.core.event_bus import EventBus
from hri.core.signals import Samples
from hri.hal.drivers.channels import OneChannel
from hri.hal.drivers.memory import MemoryMicrophone
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Hypothesis, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.behaviors import Listener
from hri.speech.grammar import load_grammar
from hri.speech.pronunciation.dictionary import cmu_dictionary
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.recognizers import pocketsphinx
from hri.speech.recognizers.automatic import AutomaticRecognizer
from hri.speech.recognizers.consensus import ConsensusRecognizer
from hri.speech.recognizers.pocketsphinx import PocketSphinxRecognizer
from hri.speech.recognizers.vosk import PARTS, VoskRecognizer
from hri.speech.synthesizers.espeak import EspeakVoice

TICK = 0.05


class LostMicrophone(MemoryMicrophone):
    """Gives nothing at all between two times, as a card does that was unplugged."""

    lost = (0.0, 0.0)

    def read(self, now: float) -> Samples:
        sound = super().read(now)
        return sound[:0] if self.lost[0] <= now < self.lost[1] else sound


class Room:
    """A listener that really decodes, on a fake clock; what is said is heard from now on."""

    def __init__(
        self, microphone: type[MemoryMicrophone] = MemoryMicrophone, rate=16000, **options
    ):
        self.clock = FakeClock()
        self.resources = ResourceManager((), self.clock)
        self.microphone = self._add("microphone", microphone, rate=str(rate))
        self.recognizer = self._add("recognizer", AutomaticRecognizer)
        self.voice = self._add("voice", EspeakVoice)
        self.events = []
        bus = EventBus(self.clock)
        bus.subscribe("speech.*", lambda event: self.events.append(event))
        self.listener = Listener(**options)
        self.listener.start(Context(self.clock, bus, self.resources))

    def _add(self, id, driver, **parameters):
        resource = driver(Description(id, driver.__name__, parameters), self.resources)
        resource.activate()
        self.resources.substitute(id, resource)
        return resource

    def say(self, text):
        speech = self.voice.synthesize(text)
        sound = resample(speech.samples, speech.rate, self.microphone.rate)
        self.microphone.hear((0.5 * sound).astype(np.int16))

    def run(self, seconds, tick=TICK):
        for _ in range(round(seconds / tick)):
            self.clock.advance(tick)
            self.listener.compute(self.clock.now(), tick)

    def close(self):
        self.listener.stop()
        self.resources.close()

    @property
    def heard(self):
        return [event.properties["text"] for event in self.named_heard]

    @property
    def named_heard(self):
        return [event for event in self.events if event.name == "speech.heard"]


@pytest.fixture
def room():
    rooms = []

    def open_room(*arguments, **options):
        rooms.append(Room(*arguments, **options))
        return rooms[-1]

    yield open_room
    for opened in rooms:
        opened.close()


def test_a_microphone_that_was_gone_is_heard_again(room):
    here = room(LostMicrophone)
    here.microphone.lost = (3.0, 6.0)
    here.run(1.0)
    here.say("show me a happy face")
    here.run(6.0)
    here.say("go forward ten meters")
    here.run(4.0)

    assert here.heard == ["show me a happy face", "go forward ten meters"]
    assert 7.0 < here.events[-1].properties["start"] < 7.5


def test_a_loop_that_stalls_loses_no_word(room):
    here = room()
    here.run(1.0)
    here.say("go forward ten meters")
    here.run(3.0, tick=1.5)
    here.run(1.0)

    assert here.heard == ["go forward ten meters"]


@pytest.mark.parametrize("rate", [8000, 48000])
def test_a_microphone_of_any_rate_is_understood(room, rate):
    here = room(rate=rate)
    here.run(0.5)
    here.say("go forward ten meters")
    here.run(4.0)

    assert [event.properties["tags"] for event in here.named_heard] == [{"distance": 10.0}]


@pytest.mark.slow
def test_an_hour_of_silence_is_nothing_and_then_it_hears(room):
    here = room()
    here.run(3600.0, tick=5.0)
    assert here.events == []
    here.say("show me a happy face")
    here.run(3.0)

    assert here.heard == ["show me a happy face"]


def test_a_grammar_that_is_replaced_within_an_utterance_costs_no_sound(room, write):
    here = room()
    here.run(0.5)
    here.say("open the red door")
    here.run(0.8)
    here.listener.use(write("public <door> = (open | close) the (red | green) door;", "doors"))
    here.run(3.0)

    assert here.heard == ["open the red door"]


@pytest.mark.parametrize(
    ("choice", "wanted"), [("left", 1), ("right", 3), ("mix", 2), ("loudest", 3)]
)
def test_one_channel_is_chosen_of_two(choice, wanted):
    block = np.tile(np.array([[100, 300]], np.int16), (320, 1))

    assert (OneChannel(choice).take(block) == 100 * wanted).all()


def test_the_loudest_channel_is_not_changed_by_a_click():
    quiet, loud = np.full(320, 100, np.int16), np.full(320, 1000, np.int16)
    channels = OneChannel("loudest")
    for _ in range(50):
        channels.take(np.stack([loud, quiet], axis=1))

    assert (channels.take(np.stack([quiet, 3 * loud], axis=1)) == quiet).all()


def test_a_model_directory_that_is_half_there_says_so(resources, companion, tmp_path):
    (tmp_path / "conf").mkdir()
    model = {"model": str(tmp_path)}
    vosk = VoskRecognizer(Description("ears", "Hri.Vosk", model), resources)
    with pytest.raises(NotAvailable, match=r"am/final\.mdl is missing - unpack the model again"):
        vosk.activate()
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    best = {**model, "weights": "/nowhere"}
    ears = AutomaticRecognizer(Description("ears", "Hri.Recognizer", best), resources)
    ears.activate()
    assert isinstance(ears.engine, PocketSphinxRecognizer)
    ears.deactivate()

    (tmp_path / "am").mkdir()
    for part in PARTS:
        (tmp_path / part).touch()
    vosk.activate()
    with pytest.raises(NotAvailable, match="unpack the model again"):
        vosk.start(companion)


def test_a_piece_on_which_the_decoder_hangs_is_given_up_and_the_next_is_heard(
    resources, monkeypatch, write
):
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    recognizer = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), resources)
    recognizer.activate()
    recognizer.start(load_grammar(write("public <turn> = turn left;")))
    piece = Segment(0.0, 1.0, np.zeros(16000, np.int16))
    monkeypatch.setattr(pocketsphinx, "PATIENCE", 0.5)
    hung = recognizer._process
    os.kill(hung.pid, signal.SIGSTOP)

    assert recognizer.decode(piece) == Hypothesis("", 0.0)
    assert hung.wait(5) != 0
    monkeypatch.setattr(pocketsphinx, "PATIENCE", 30.0)
    assert recognizer.decode(piece).text == ""
    recognizer.deactivate()


def test_a_decoder_that_died_is_replaced_and_asked_again(resources):
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    recognizer = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), resources)
    recognizer.activate()
    recognizer._process = pocketsphinx._new_process()
    recognizer._process.kill()

    assert recognizer._ask({"lookup": ["zorg"]}) == {"missing": ["zorg"]}
    recognizer.deactivate()


def test_a_python_without_pocketsphinx_hears_and_says_what_is_missing(resources, monkeypatch):
    find = importlib.util.find_spec
    hide = lambda name, *rest: None if name == "pocketsphinx" else find(name, *rest)  # noqa: E731
    monkeypatch.setattr(importlib.util, "find_spec", hide)

    sphinx = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), resources)
    with pytest.raises(NotAvailable, match=r"pocketsphinx is not installed .* another recognizer"):
        sphinx.activate()
    ears = AutomaticRecognizer(Description("ears", "Hri.Recognizer"), resources)
    ears.activate()
    ears.deactivate()
    assert "robot" in cmu_dictionary()


def test_pocketsphinx_says_words_as_the_user_s_lexicon_does():
    lexicon = Lexicon({"robot": (("Z", "AO", "R", "G"),)}, cmu_dictionary())

    told = pocketsphinx._pronunciations(lexicon, ["go", "robot", "zorg"], ["zorg"])

    assert told["robot(own1)"] == "Z AO R G"
    assert "zorg" in told
    assert not any(name.startswith("go") for name in told)


def test_two_recognizers_are_needed_for_a_veto():
    manager = ResourceManager((Description("both", "Hri.Veto", {"first": "both"}),), FakeClock())
    with pytest.raises(HriError, match="name another recognizer"):
        ConsensusRecognizer(manager.descriptions["both"], manager).activate()
