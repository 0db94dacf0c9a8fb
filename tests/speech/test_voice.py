from __future__ import annotations

import threading

import numpy as np
import pytest
import trio
from hypothesis import settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from hri.behavior.behavior import Context
from hri.behavior.ports import OutputPort
from hri.core.clock import FakeClock, RealClock
from hri.core.event_bus import EventBus
from hri.core.origin import STUDIO, caused_by
from hri.core.signals import Prosody, Speech
from hri.hal.drivers.memory import SilentSpeaker
from hri.hal.drivers.wav_file import write_wav
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.behaviors import Voice
from hri.speech.ssml import Ssml
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.silent import SilentVoice
from hri.speech.tasks import say
from hri.speech.voice import MOST_PRONOUNCED, MOST_QUEUED, Priority, Saying
from hri.task.task_manager import TaskManager

from .fakes import TICK, Stage


@pytest.mark.proves("R01")
def test_one_thing_is_said_after_the_other():
    stage = Stage(Voice())
    first, second = stage.behavior.say("hello"), stage.behavior.say("you")

    stage.run(0.3)
    assert stage.behavior.is_speaking.value
    assert stage.behavior.speech.value.text == "hello"
    assert 0.1 <= stage.behavior.position.value <= 0.3
    stage.run(0.4)
    assert (first.is_done, second.is_done) == (True, False)
    stage.run(0.6)

    assert (second.is_done, second.was_cut) == (True, False)
    assert stage.behavior.is_idle
    assert [(name, properties) for _, name, properties in stage.events] == [
        ("speech.said", {"text": "hello"}),
        ("speech.finished", {"text": "hello", "cut": False, "heard": "hello"}),
        ("speech.said", {"text": "you"}),
        ("speech.finished", {"text": "you", "cut": False, "heard": "you"}),
    ]


def test_whose_sentence_it_is_is_told_whoever_cuts_it():
    stage = Stage(Voice())
    heard = []
    stage.behavior._events.subscribe("*", lambda event: heard.append((event.name, event.origin)))
    with caused_by(STUDIO):
        stage.behavior.say("you")
    stage.run(1.0)
    stage.behavior.say("a long sentence")
    stage.run(0.3)
    with caused_by(STUDIO):
        stage.behavior.hush()
    assert heard == [
        ("speech.said", STUDIO),
        ("speech.finished", STUDIO),
        ("speech.said", ""),
        ("speech.finished", ""),
    ]


def test_hush_cuts_the_sound_and_empties_the_queue():
    stage = Stage(Voice())
    sayings = [stage.behavior.say(text) for text in ("a long sentence", "another", "third")]

    stage.run(0.5)
    stage.behavior.hush()

    assert all(saying.is_done and saying.was_cut for saying in sayings)
    assert stage.speaker.position(stage.clock.now()) is None
    assert stage.names() == ["speech.said", "speech.finished"]
    stage.run(1.0)
    assert stage.behavior.is_idle
    assert not stage.behavior.is_speaking.value


def test_hush_reaches_a_sound_in_the_making():
    stage = Stage(Voice())
    stage.behavior.say("hello")

    stage.behavior.hush()
    stage.behavior.say("new")
    stage.run(1.0)

    assert [properties["text"] for _, name, properties in stage.events] == ["new", "new"]


def test_one_thing_can_be_taken_back():
    stage = Stage(Voice())
    first, second, third = (stage.behavior.say(text) for text in ("one", "two", "three"))

    stage.run(0.2)
    stage.behavior.cancel(second)
    stage.behavior.cancel(first)
    stage.run(1.5)

    assert (first.was_cut, second.was_cut, third.was_cut) == (True, True, False)
    said = [properties["text"] for _, name, properties in stage.events if name == "speech.said"]
    assert said == ["one", "three"]


def test_nothing_to_say_is_done_at_once():
    assert Stage(Voice()).behavior.say("  ").is_done


def said_with(stage, text):
    """The sounds that the synthesizer was given for a text."""
    stage.behavior.say(text)
    stage.run(0.2 + 0.1 * len(str(getattr(text, "text", text))))
    return dict(stage.voice.sounds[-1])


def test_a_word_is_said_by_the_phones_that_were_heard():
    stage = Stage(Voice())
    assert said_with(stage, "Anna?") == {}
    stage.behavior.pronounce("Anna", ["AA", "N", "AH"])
    assert said_with(stage, "Anna?") == {"anna": ("AA", "N", "AH")}
    stage.behavior.pronounce("anna", ("AE", "N", "AH"))
    assert said_with(stage, "Anna?") == {"anna": ("AE", "N", "AH")}
    stage.behavior.pronounce("anna", ())
    assert said_with(stage, "Anna?") == {}


def test_phones_of_markup_go_before_those_that_were_heard():
    stage = Stage(Voice())
    stage.behavior.pronounce("anna", ("AE", "N", "AH"))
    markup = '<speak><phoneme alphabet="x-arpabet" ph="AA N AA">Anna</phoneme></speak>'
    assert said_with(stage, Ssml.parse(markup)) == {"anna": ("AA", "N", "AA")}


def test_several_words_are_said_as_they_are_written_and_the_oldest_is_dropped():
    stage = Stage(Voice())
    stage.behavior.pronounce("anna maria", ("AE", "N", "AH"))
    assert said_with(stage, "hi") == {}
    for number in range(MOST_PRONOUNCED + 1):
        stage.behavior.pronounce(f"n{number}", ("AE", "N"))
    known = said_with(stage, "hi")
    assert len(known) == MOST_PRONOUNCED
    assert "n0" not in known


def test_prosody_shapes_the_speech():
    voice = Voice()
    port: OutputPort[Prosody] = OutputPort()
    voice.prosody.sources.append(port)
    stage = Stage(voice)
    port.value = Prosody(rate=2.0)

    saying = voice.say("hello there")
    stage.run(0.8)

    assert saying.is_done

    its_own = voice.say("hello there", prosody=Prosody(rate=0.5))
    stage.run(0.8)
    assert not its_own.is_done
    stage.run(2.0)
    assert its_own.is_done


def test_pace_loudness_and_voice_may_be_set_while_it_runs():
    stage = Stage(Voice())
    for name, value in {"rate": 2.0, "volume": 0.5, "voice": "deep"}.items():
        stage.behavior.set_parameter(name, value)
    said = stage.behavior.say("hello there", prosody=Prosody(rate=0.5, volume=0.5))
    stage.run(0.1)
    assert stage.voice.prosody == Prosody(rate=1.0, volume=0.25, voice="deep")
    stage.run(1.5)
    assert said.is_done


def run_task(stage: Stage, seconds: float) -> None:
    """Let a task say something, cancelled after some seconds, while the behavior ticks."""
    lent = Context(stage.clock, EventBus(stage.clock), stage.resources)
    context = TaskManager(lent, {"net.voice": stage.behavior}).context

    async def tick() -> None:
        while True:
            await stage.clock.sleep(TICK)
            stage.behavior.compute(stage.clock.now(), TICK)

    async def main() -> None:
        async with trio.open_nursery() as nursery:
            nursery.start_soon(stage.clock.drive)
            nursery.start_soon(tick)
            with stage.clock.move_on_after(seconds):
                await say(context, "hello")
            nursery.cancel_scope.cancel()

    trio.run(main)


@pytest.mark.proves("R01")
@pytest.mark.parametrize(("seconds", "was_cut"), [(10.0, False), (0.3, True)])
def test_the_task_waits_and_its_end_cuts_the_speech(seconds, was_cut):
    stage = Stage(Voice())

    run_task(stage, seconds)

    heard = {"text": "hello", "cut": was_cut, "heard": "" if was_cut else "hello"}
    assert stage.events[-1][1:] == ("speech.finished", heard)
    assert stage.clock.now() == pytest.approx(0.3 if was_cut else 0.65, abs=0.1)


def said(stage: Stage) -> list[object]:
    return [properties["text"] for _, name, properties in stage.events if name == "speech.said"]


def test_what_is_urgent_goes_before_all_that_waits():
    stage = Stage(Voice())
    for text in ("one", "two", "three"):
        stage.behavior.say(text)
    stage.behavior.say("four", Priority.URGENT)
    stage.behavior.say("five", Priority.URGENT)

    stage.run(3.0)

    assert said(stage) == ["one", "four", "five", "two", "three"]


@pytest.mark.proves("T26")
def test_an_alarm_cuts_what_is_said_but_no_other_alarm():
    stage = Stage(Voice())
    long = stage.behavior.say("a long sentence about nothing")
    stage.behavior.say("later")
    stage.run(1.0)

    first = stage.behavior.say("fire", Priority.ALARM)
    second = stage.behavior.say("water", Priority.ALARM)
    stage.run(3.0)

    assert long.was_cut
    assert not first.was_cut
    assert not second.was_cut
    assert said(stage) == ["a long sentence about nothing", "fire", "water", "later"]


@pytest.mark.proves("T26")
def test_what_was_cut_tells_the_words_that_were_heard():
    stage = Stage(Voice())
    speak_silently(stage)
    saying = stage.behavior.say("go to the kitchen now")  # 2, 4, 7 letters end at 0.12, 0.24, 0.42

    stage.run(0.35)
    stage.behavior.hush()

    assert saying.heard == "go to"
    assert stage.events[-1][2] == {"text": saying.text, "cut": True, "heard": "go to"}


def test_each_word_is_told_when_it_begins():
    stage = Stage(Voice())
    speak_silently(stage)
    stage.behavior.say("go to it")
    words = []

    for _ in range(12):
        stage.run(TICK)
        words.append(stage.behavior.word.value)

    assert [word for word in words if word] == ["go", "to", "it"]


def test_a_sound_file_moves_the_lips_and_is_cut_like_a_text(tmp_path):
    sung = EspeakVoice(Description("v", "Hri.EspeakVoice"), ResourceManager((), FakeClock()))
    sung.activate()
    speech = sung.synthesize("Hello there, my friend.")
    write_wav(tmp_path / "song.wav", speech.samples, speech.rate)
    stage = Stage(Voice())
    whole = stage.behavior.play(tmp_path / "song.wav", "Hello there, my friend.")
    stage.run(0.5)
    names = [phoneme.name for phoneme in stage.behavior.speech.value.phonemes]
    assert {"h", "l", "D", "m", "f"} <= set(names)
    stage.run(speech.duration)
    assert (whole.is_done, whole.was_cut) == (True, False)
    second = stage.behavior.play(tmp_path / "song.wav")
    stage.run(0.5)
    stage.behavior.hush()
    assert (second.is_done, second.was_cut) == (True, True)
    assert stage.speaker.position(stage.clock.now()) is None


def test_a_sound_file_that_cannot_be_read_fails_alone(tmp_path):
    (tmp_path / "half.wav").write_bytes(b"RIFF")
    stage = Stage(Voice())
    lost = [stage.behavior.play(tmp_path / name) for name in ("none.wav", "half.wav")]
    after = stage.behavior.say("hello")
    stage.run(2.0)
    assert [saying.was_cut for saying in (*lost, after)] == [True, True, False]
    assert "none.wav" in str(lost[0].error)
    assert "half.wav" in str(lost[1].error)
    assert stage.names() == ["speech.said", "speech.finished"]


def test_the_queue_is_bounded():
    stage = Stage(Voice())
    sayings = [stage.behavior.say("x", Priority.URGENT) for _ in range(MOST_QUEUED + 1)]

    dropped = stage.behavior.say("one too many")

    assert dropped.was_cut
    assert not any(saying.is_done for saying in sayings)


def test_a_voice_that_fails_is_told_once_and_the_next_text_is_said():
    stage = Stage(Voice())
    speak_silently(stage)
    synthesize = stage.behavior._synthesizer.synthesize

    def fail_once(text: str, prosody: Prosody) -> Speech:
        stage.behavior._synthesizer.synthesize = synthesize
        raise OSError("no breath")

    stage.behavior._synthesizer.synthesize = fail_once
    first, second = stage.behavior.say("one"), stage.behavior.say("two")
    with pytest.raises(OSError, match="no breath"):
        stage.run(0.2)
    stage.run(0.5)

    assert first.was_cut
    assert not second.was_cut
    assert said(stage) == ["two"]
    assert stage.behavior.is_idle


def speak_silently(stage: Stage) -> None:
    """Give it a voice that knows the times of its words."""
    voice = SilentVoice(Description("voice", "Hri.SilentVoice"), stage.resources)
    voice.activate()
    stage.behavior._synthesizer = voice


class SlowVoice(SilentVoice):
    """Makes the first half of a sound, and the other when it may."""

    def _open(self) -> None:
        self.may_go_on = threading.Event()

    def stream(self, text, prosody, take, is_wanted):
        whole = self.synthesize(text, prosody)
        half = whole.samples[: len(whole.samples) // 2]
        take(Speech(text, half, whole.rate, whole.phonemes[: len(text) // 2]))
        self.may_go_on.wait(10.0)
        return super().stream(text, prosody, take, is_wanted)


class CollectingSpeaker(SilentSpeaker):
    """Keeps what it was given."""

    def _open(self) -> None:
        super()._open()
        self.samples = np.zeros(0, np.int16)

    def play(self, samples, rate, now):
        super().play(samples, rate, now)
        self.samples = samples

    def extend(self, samples, now):
        super().extend(samples, now)
        self.samples = np.concatenate([self.samples, samples])


def test_the_first_of_a_sound_is_played_before_the_last_is_made():
    clock = RealClock()
    resources = ResourceManager((), clock)
    voice = SlowVoice(Description("voice", "Hri.SilentVoice"), resources)
    speaker = CollectingSpeaker(Description("speaker", "Hri.SilentSpeaker"), resources)
    for device in (voice, speaker):
        device.activate()
        resources.substitute(device.id, device)
    behavior = Voice()
    behavior.start(Context(clock, EventBus(clock), resources))

    behavior.say("abcdefgh")
    assert clock.advance_until(lambda: len(speaker.samples) > 0, 5.0)
    half = len(speaker.samples)
    voice.may_go_on.set()
    # Not a tick has passed yet: what is made finds its way by itself.
    assert clock.advance_until(lambda: len(speaker.samples) > half, 5.0)
    behavior.stop()

    assert np.array_equal(speaker.samples, voice.synthesize("abcdefgh").samples)


class MouthMachine(RuleBasedStateMachine):
    """Whatever is asked of a voice in whatever order, each text is said once, or cut."""

    def __init__(self) -> None:
        super().__init__()
        self.stage = Stage(Voice())
        self.sayings: list[Saying] = []

    @rule(text=st.sampled_from(["a", "abc", "a b c d e", " "]), priority=st.sampled_from(Priority))
    def say(self, text, priority):
        self.sayings.append(self.stage.behavior.say(text, priority))

    @rule()
    def hush(self):
        self.stage.behavior.hush()
        assert all(saying.is_done for saying in self.sayings)

    @rule(number=st.integers(0, 20))
    def cancel(self, number):
        if number < len(self.sayings):
            self.stage.behavior.cancel(self.sayings[number])
            assert self.sayings[number].is_done

    @rule(ticks=st.integers(1, 20))
    def run(self, ticks):
        self.stage.run(ticks * TICK)

    @invariant()
    def sounds_come_one_after_the_other(self):
        names = self.stage.names()
        assert names[0::2] == ["speech.said"] * len(names[0::2])
        assert names[1::2] == ["speech.finished"] * len(names[1::2])

    def teardown(self):
        self.stage.run(0.3 + 0.7 * len(self.sayings))
        voice = self.stage.behavior
        assert voice.is_idle
        assert not voice.is_speaking.value
        assert all(saying.is_done for saying in self.sayings)
        whole = [
            saying.text for saying in self.sayings if not saying.was_cut and saying.text != " "
        ]
        ends = [fields for _, name, fields in self.stage.events if name == "speech.finished"]
        assert sorted(end["text"] for end in ends if not end["cut"]) == sorted(whole)
        assert all(end["heard"] == end["text"] for end in ends if not end["cut"])


TestMouth = MouthMachine.TestCase
TestMouth.settings = settings(max_examples=40, stateful_step_count=20, deadline=None)


def test_a_sound_among_the_words_is_made_unless_they_are_not_wanted():
    stage = Stage(Voice())
    whole = stage.behavior.say("[giggle] yes")
    stage.run(0.3)
    assert stage.behavior.speech.value.text == "[giggle] yes"
    stage.run(3.0)
    assert whole.is_done

    stage.behavior.makes_sounds = False
    words, nothing = stage.behavior.say("[giggle] yes"), stage.behavior.say("[giggle]")
    assert nothing.is_done
    stage.run(0.3)
    assert stage.behavior.speech.value.text == "yes"
    stage.run(3.0)
    assert words.is_done


def test_a_gesture_sounds_while_nothing_is_said_and_gives_way_to_words():
    stage = Stage(Voice())
    events = stage.behavior._events
    events.raise_event("gesture.started", name="yawn")
    stage.run(0.3)
    assert said(stage) == ["[yawn]"]
    words = stage.behavior.say("a rather long sentence")
    stage.run(0.3)
    assert stage.behavior.speech.value.text == "a rather long sentence"
    events.raise_event("gesture.started", name="laugh")
    stage.run(3.0)
    assert words.is_done
    assert said(stage) == ["[yawn]", "a rather long sentence"]

    events.raise_event("gesture.started", name="nod")
    stage.run(1.0)
    stage.behavior.quiet_until = 60.0
    events.raise_event("gesture.started", name="yawn")
    stage.run(1.0)
    assert said(stage) == ["[yawn]", "a rather long sentence"]
