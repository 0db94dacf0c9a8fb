"""The mouth of the robot as a behavior."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from enum import IntEnum
from pathlib import Path

import numpy as np

from hri.behavior.behavior import Behavior, Context
from hri.behavior.effects import Effect
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.origin import caused_by, origin
from hri.core.signals import Event, Prosody, Speech
from hri.hal.drivers.wav_file import load_sound
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import Synthesizer
from hri.speech.ssml import Ssml, spoken
from hri.speech.vocalizations.in_text import has_sounds
from hri.speech.vocalizations.vocalization import load_sounds

INTERRUPTED = "speech.interrupted"
"""The event at which it falls silent: someone spoke up while it spoke."""
PLAIN_RATE = 16000
"""Samples a second of a sound that is not there."""
MOST_QUEUED = 100
"""Things to say; when there are more, the last of those that matter least is dropped."""


MOST_PRONOUNCED = 1000
"""Words that are said by given phones."""


class Priority(IntEnum):
    """What comes first when there are several things to say."""

    IDLE = -1
    """Cut by all that is to be said."""
    NORMAL = 0
    URGENT = 1
    """Before all that waits."""
    ALARM = 2
    """Cuts what is being said, unless that is an alarm as well."""


@dataclass(eq=False)
class Saying:
    """Something that is to be said, and how far it has come."""

    text: str
    priority: Priority = Priority.NORMAL
    prosody: Prosody | None = None
    """How it is said; None: as the input of the voice says."""
    markup: Ssml | None = None
    """The text with markup, where it has some."""
    sound: Path | None = None
    """A sound file that is played, in which the text is said."""
    error: HriError | None = None
    """Why the sound file could not be played."""
    is_done: bool = False
    """True when it was said to its end, or cut."""
    was_cut: bool = False
    heard: str = ""
    """The words of it that were heard to their end; known when it is done."""
    origin: str = field(default_factory=origin)
    """Who had it said, as `hri.core.origin` has it; empty for the robot itself."""

    def drop(self) -> None:
        """It is done, and nothing of it was heard."""
        self.is_done = self.was_cut = True


@dataclass
class _Playing:
    """What is being said, as far as its sound has been made."""

    saying: Saying
    speech: Speech
    is_whole: bool = False
    position: float = 0.0
    word: int = -1
    """Number of the word that was begun last."""
    marks: int = 0
    """Marks that have been reached."""


class Voice(Behavior):
    """Says one thing after the other, and falls silent at once when it is told to.

    Raises `speech.said` (text) when a sound starts and `speech.finished` (text, cut, heard) when it
    ends, `heard` being the words that were said to their end; `speech.marked` (name, text) when it
    reaches a mark of its markup. "[giggle]" in a text makes a sound that is not a word, and so does
    a gesture of the face that has one, while nothing is said. The sound starts as soon as the
    first of it is made, and before the next tick.
    """

    category = "speech"

    may_do = frozenset({Effect.SPEAKS})
    prosody = Input[Prosody]("prosody", "how it is said", is_optional=True)
    speech = Output[Speech]("speech", "what is being said, as far as it is made")
    position = Output[float]("double", "seconds of it that have been heard")
    word = Output[str]("string", "the word that is being said, when it begins")
    is_speaking = Output[bool]("boolean", "whether a sound is going on")
    voice_id = Param("voice", "resource that makes sound of text")
    voice = Param("", "whose voice: a name, a language or a character (`hri voices`)")
    rate = Param(1.0, "factor on the pace of all that it says", minimum=0.5, maximum=2.0)
    volume = Param(1.0, "factor on the loudness of all that it says", minimum=0.1, maximum=4.0)
    speaker_id = Param("speaker", "resource that plays it")
    latency_s = Param(0.05, "time that making the sound takes on a fake clock", minimum=0.0)

    makes_sounds = True
    """Whether it makes sounds that are not words; else they are left out of what it says."""
    quiet_until = -math.inf
    """Seconds of the clock until which it was asked to be quiet; for whoever speaks unasked."""

    def check(self) -> None:
        load_sounds()

    def start(self, context: Context) -> None:
        self._events = context.events
        self._interruption = self._events.subscribe(INTERRUPTED, lambda event: self.hush())
        self._gestures = self._events.subscribe("gesture.started", self._note_gesture)
        self._gesture = ""
        """The gesture that the face makes since the last tick."""
        self._clock = context.clock
        self._synthesizer = context.resources.obtain(self.voice_id, Synthesizer)
        self._speaker = context.resources.obtain(self.speaker_id, Speaker)
        self._worker: Worker[tuple[Saying, Speech]] = context.clock.worker(self.latency_s)
        self._made: deque[tuple[Saying, Speech]] = deque()
        self._failure: Exception | None = None
        self._prosody = Prosody()
        self._pronounced: dict[str, tuple[str, ...]] = {}
        self._queue: list[Saying] = []
        self._making: Saying | None = None
        self._playing: _Playing | None = None

    def say(
        self,
        text: str | Ssml,
        priority: Priority = Priority.NORMAL,
        prosody: Prosody | None = None,
    ) -> Saying:
        """Queue a text, behind all that matters as much; blank text is done at once.

        `prosody` is how this one is said, and by which voice; None: as the input says.
        """
        if isinstance(text, str) and has_sounds(text):
            text = Ssml.of_text(text)
        if isinstance(text, Ssml) and not self.makes_sounds:
            text = text.without_sounds()
        markup = text if isinstance(text, Ssml) else None
        text = text.text if isinstance(text, Ssml) else text
        saying = Saying(text, priority, prosody, markup)
        if not text.strip():
            saying.is_done = True
            return saying
        return self._queued(saying)

    def pronounce(self, word: str, phones: Sequence[str]) -> None:
        """Say a word by phones of the CMU dictionary from now on, as it was heard; by none, as it
        is written. Phones of markup go before. Nothing is kept when the program ends.

        Several words are said as they are written. Of MOST_PRONOUNCED words the oldest is dropped.
        """
        key = word.casefold()
        self._pronounced.pop(key, None)
        if phones and len(word.split()) == 1:
            self._pronounced[key] = tuple(phones)
            if len(self._pronounced) > MOST_PRONOUNCED:
                del self._pronounced[next(iter(self._pronounced))]

    def play(
        self, path: Path | str, text: str = "", priority: Priority = Priority.NORMAL
    ) -> Saying:
        """Queue a WAV, MP3, FLAC or Ogg file like a text; the lips move to it.

        They follow the words of `text` where it is what the sound says, else the sounds or the
        loudness that are heard. A file that cannot be read sets the `error` of the saying.
        """
        return self._queued(Saying(text, priority, sound=Path(path)))

    def _queued(self, saying: Saying) -> Saying:
        priority = saying.priority
        waiting = [other.priority >= priority for other in self._queue]
        self._queue.insert(sum(waiting), saying)
        if len(self._queue) > MOST_QUEUED:
            self._queue.pop().drop()
        current = self._current()
        if current is not None and current.priority < priority and _gives_way(current, priority):
            self.cancel(current)
        self._make_next()
        return saying

    def hush(self) -> None:
        """Clear the queue and cut the current saying."""
        for saying in self._queue:
            saying.drop()
        self._queue.clear()
        if (current := self._current()) is not None:
            self.cancel(current)

    def cancel(self, saying: Saying) -> None:
        """Take back one thing: out of the queue, or cut it short; others are still said."""
        if saying.is_done:
            return
        if self._playing is not None and self._playing.saying is saying:
            now = self._clock.now()
            self._playing.position = self._speaker.position(now) or self._playing.position
            try:
                self._speaker.stop(now)
            finally:
                self._finish(was_cut=True)
            return
        saying.drop()
        if saying in self._queue:
            self._queue.remove(saying)

    @property
    def is_idle(self) -> bool:
        """True when there is nothing to say."""
        return not self._queue and self._current() is None and not self._worker.is_busy

    def compute(self, now: float, dt: float) -> None:
        self._prosody = self.prosody.value or Prosody()
        self._follow(now)
        self._take_whole()
        self._sound_gesture(now)
        self._make_next()
        playing = self._playing
        if playing is not None:
            playing.position = self._speaker.position(now) or playing.position
            self.speech.send(playing.speech)
            self.position.send(playing.position)
            self._tell_word(playing)
            self._tell_marks(playing)
        self.is_speaking.send(playing is not None)

    def _note_gesture(self, event: Event) -> None:
        self._gesture = str(event.properties.get("name", ""))

    def _sound_gesture(self, now: float) -> None:
        """Make the sound of a gesture, where nothing is said with it."""
        gesture, self._gesture = self._gesture, ""
        if gesture and self.makes_sounds and self.is_idle and now >= self.quiet_until:
            for name, sound in load_sounds().items():
                if sound.gesture == gesture:
                    self.say(f"[{name}]", Priority.IDLE)
                    return

    def _current(self) -> Saying | None:
        """The saying that is playing, else the one being made."""
        return self._making if self._playing is None else self._playing.saying

    def _make_next(self) -> None:
        """Have the next thing made, when nothing else is made or said."""
        if self._playing is not None or self._worker.is_busy or not self._queue:
            return
        saying = self._making = self._queue.pop(0)
        prosody = saying.prosody or self.prosody.value or self._prosody
        prosody = replace(
            prosody,
            rate=prosody.rate * self.rate,
            volume=prosody.volume * self.volume,
            voice=prosody.voice or self.voice,
        )
        if self._pronounced:
            sounds = (*self._pronounced.items(), *prosody.sounds)
            prosody = replace(prosody, sounds=sounds)
        take = self._taker(saying)

        def is_wanted() -> bool:
            return not saying.is_done

        def make() -> tuple[Saying, Speech]:
            if saying.sound is not None:
                return saying, _loaded(saying, saying.sound)
            voice = self._synthesizer
            if saying.markup is not None:
                return saying, spoken(saying.markup, voice, prosody, take, is_wanted)
            return saying, voice.stream(saying.text, prosody, take, is_wanted)

        self._worker.submit(make)

    def _taker(self, saying: Saying) -> Callable[[Speech], object]:
        """What takes the parts of a speech in the worker, and has them played in the loop."""

        def take(speech: Speech) -> None:
            self._made.append((saying, speech))
            self._clock.soon(self._take_early)

        # In fake time all of it is there at once, when the latency of the worker is over.
        return (lambda speech: None) if self._clock.is_fake else take

    def _take_early(self) -> None:
        """Take parts between two ticks; what goes wrong there is told at the next."""
        try:
            self._take_parts()
        except Exception as error:
            self._failure = error

    def _take_parts(self) -> None:
        while self._made:
            saying, speech = self._made.popleft()
            self._hear(saying, speech)

    def _take_whole(self) -> None:
        """What has been made to its end; what cannot be made or played counts as cut."""
        try:
            if (failure := self._failure) is not None:
                self._failure = None
                raise failure
            self._take_parts()
            for saying, speech in self._worker.poll():
                self._making = None
                self._hear(saying, speech)
                if self._playing is not None and self._playing.saying is saying:
                    self._playing.is_whole = True
        except Exception:
            if (current := self._current()) is not None:
                self.cancel(current)
            self._making = None
            raise

    def _hear(self, saying: Saying, speech: Speech) -> None:
        """Play what there is of a speech now; a part of it may already be playing."""
        if saying.error is not None:
            saying.drop()
        if saying.is_done:
            return
        now = self._clock.now()
        playing = self._playing
        if playing is None:
            self._speaker.play(speech.samples, speech.rate, now)
            self._playing = _Playing(saying, speech)
            self._tell(saying, "speech.said")
        elif len(speech.samples) > len(playing.speech.samples):
            self._speaker.extend(speech.samples[len(playing.speech.samples) :], now)
            playing.speech = speech

    def _follow(self, now: float) -> None:
        """Check whether the current speech has been played to its end."""
        playing = self._playing
        if playing is not None and playing.is_whole and self._speaker.position(now) is None:
            self._finish(was_cut=False)

    def _tell_word(self, playing: _Playing) -> None:
        words = playing.speech.words
        begun = playing.word
        while begun + 1 < len(words) and words[begun + 1].start <= playing.position:
            begun += 1
        if begun != playing.word:
            playing.word = begun
            self.word.send(words[begun].text)

    def _tell_marks(self, playing: _Playing) -> None:
        for name, time in playing.speech.marks[playing.marks :]:
            if time > playing.position:
                return
            playing.marks += 1
            self._tell(playing.saying, "speech.marked", name=name)

    def _finish(self, was_cut: bool) -> None:
        assert self._playing is not None
        playing, self._playing = self._playing, None
        if not was_cut:
            playing.position = playing.speech.duration
            self._tell_marks(playing)
        saying = playing.saying
        saying.is_done, saying.was_cut = True, was_cut
        saying.heard = playing.speech.heard(playing.position) if was_cut else saying.text
        self._tell(saying, "speech.finished", cut=was_cut, heard=saying.heard)

    def _tell(self, saying: Saying, event: str, **properties: object) -> None:
        """Raise an event about a saying; its originator is the cause, even if another cuts it."""
        with caused_by(saying.origin):
            self._events.raise_event(event, text=saying.text, **properties)

    def stop(self) -> None:
        self._interruption.cancel()
        self._gestures.cancel()
        self.hush()
        self._worker.close()


def _gives_way(current: Saying, priority: Priority) -> bool:
    """Whether it is cut by something that matters more, instead of being waited for."""
    return priority == Priority.ALARM or current.priority == Priority.IDLE


def _loaded(saying: Saying, path: Path) -> Speech:
    """A sound file with the times that its lips need."""
    from hri.speech.aligner import with_times

    try:
        samples, rate = load_sound(path)
    except HriError as error:
        saying.error = error
        return Speech(saying.text, np.zeros(0, np.int16), PLAIN_RATE)
    for text in dict.fromkeys((saying.text, "")):
        try:
            return replace(with_times(Speech(text, samples, rate)), text=saying.text)
        except HriError:  # it says something else, or is too long: its loudness is left
            continue
    return Speech(saying.text, samples, rate)
