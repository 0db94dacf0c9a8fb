"""The mouth of the robot as a behavior."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core.clock import Worker
from hri.core.signals import Prosody, Speech
from hri.hal.speaker import Speaker
from hri.hal.synthesizer import Synthesizer


@dataclass(eq=False)
class Saying:
    """Something that is to be said, and how far it has come."""

    text: str
    is_done: bool = False
    """True when it was said to its end, or cut."""
    was_cut: bool = False


class Voice(Behavior):
    """Says one thing after the other, and falls silent at once when it is told to.

    Raises `speech.said` (text) when a sound starts and `speech.finished` (text, cut) when it ends.
    """

    category = "speech"

    prosody = Input[Prosody]("prosody", "how it is said", is_optional=True)
    speech = Output[Speech]("speech", "what is being said")
    position = Output[float]("double", "seconds of it that have been heard")
    is_speaking = Output[bool]("boolean", "whether a sound is going on")
    voice_id = Param("voice", "resource that makes sound of text")
    speaker_id = Param("speaker", "resource that plays it")
    latency_s = Param(0.05, "time that making the sound takes on a fake clock", minimum=0.0)

    def start(self, context: Context) -> None:
        self._events = context.events
        self._clock = context.clock
        self._synthesizer = context.resources.obtain(self.voice_id, Synthesizer)
        self._speaker = context.resources.obtain(self.speaker_id, Speaker)
        self._worker: Worker[tuple[Saying, Speech]] = context.clock.worker(self.latency_s)
        self._queue: deque[Saying] = deque()
        self._playing: tuple[Saying, Speech] | None = None

    def say(self, text: str) -> Saying:
        """Queue a text; nothing but white space is done at once."""
        saying = Saying(text, is_done=not text.strip())
        if not saying.is_done:
            self._queue.append(saying)
        return saying

    def hush(self) -> None:
        """Forget what is queued and cut what is being said."""
        for saying in self._queue:
            saying.is_done = saying.was_cut = True
        self._queue.clear()
        if self._playing is not None:
            self._speaker.stop(self._clock.now())
            self._finish(was_cut=True)

    def cancel(self, saying: Saying) -> None:
        """Take back one thing: out of the queue, or cut it short; others are still said."""
        if saying.is_done:
            return
        saying.is_done = saying.was_cut = True
        if saying in self._queue:
            self._queue.remove(saying)
        elif self._playing is not None and self._playing[0] is saying:
            self._speaker.stop(self._clock.now())
            self._finish(was_cut=True)

    @property
    def is_idle(self) -> bool:
        """True when there is nothing to say."""
        return self._playing is None and not self._queue and not self._worker.is_busy

    def compute(self, now: float, dt: float) -> None:
        if self._playing is not None and self._speaker.position(now) is None:
            self._finish(was_cut=False)
        self._take_made(now)
        if self._queue and self._playing is None and not self._worker.is_busy:
            self._make(self._queue[0])
        if self._playing is not None:
            self.speech.send(self._playing[1])
            self.position.send(self._speaker.position(now) or 0.0)
        self.is_speaking.send(self._playing is not None)

    def _take_made(self, now: float) -> None:
        """Play what has been made; what cannot be made or played counts as cut."""
        try:
            for saying, speech in self._worker.poll():
                if not saying.is_done:
                    self._begin(saying, speech, now)
                    self._queue.popleft()
        except Exception:
            if self._queue:
                failed = self._queue.popleft()
                failed.is_done = failed.was_cut = True
            raise

    def _make(self, saying: Saying) -> None:
        prosody = self.prosody.value or Prosody()
        self._worker.submit(lambda: (saying, self._synthesizer.synthesize(saying.text, prosody)))

    def _begin(self, saying: Saying, speech: Speech, now: float) -> None:
        self._speaker.play(speech.samples, speech.rate, now)
        self._playing = saying, speech
        self._events.raise_event("speech.said", text=saying.text)

    def _finish(self, was_cut: bool) -> None:
        assert self._playing is not None
        saying, self._playing = self._playing[0], None
        saying.is_done, saying.was_cut = True, was_cut
        self._events.raise_event("speech.finished", text=saying.text, cut=was_cut)

    def stop(self) -> None:
        self.hush()
        self._worker.close()
