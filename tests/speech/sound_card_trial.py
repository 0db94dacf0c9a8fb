"""A program of its own: hears over PortAudio what it plays into a virtual sound card.

python sound_card_trial.py GRAMMAR FILE.wav WORDS START.pa

Plays the recording until the words are heard, takes the sound card away and brings it back, and
plays it again. Prints one line of JSON: what was heard, what was noticed, and when it last played.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hri.behavior.behavior import Context
from hri.core.clock import RealClock
from hri.core.event_bus import EventBus
from hri.hal.drivers.wav_file import read_wav
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.speaker import Speaker
from hri.speech.listener import Listener

TICK = 0.03
AGAIN = 6.0
"""Seconds after which it is played again: a machine with much to do drops blocks."""
PATIENCE = 30.0
"""Seconds for each step."""
START = ("pulseaudio", "--daemonize=yes", "--exit-idle-time=-1", "--log-level=error", "-n", "-F")
STOP = ("pulseaudio", "--kill")

DEVICES = (
    Description("microphone", "Hri.Microphone", {"device": "pulse"}),
    Description("speaker", "Hri.Speaker", {"device": "pulse", "rate": "16000"}),
    Description("recognizer", "Hri.Recognizer"),
)


class Trial:
    def __init__(self, grammar: str, recording: str, words: str) -> None:
        self.clock = RealClock()
        self.events: list[tuple[str, dict[str, Any]]] = []
        self.notices: list[str] = []
        self.resources = ResourceManager(DEVICES, self.clock, notice=self.notices.append)
        bus = EventBus(self.clock)
        bus.subscribe("speech.*", lambda event: self.events.append((event.name, event.properties)))
        self.samples, self.rate = read_wav(Path(recording))
        self.words = words
        self.begun = -AGAIN
        self.speaker = self.resources.obtain("speaker", Speaker)
        self.listener = Listener("listener", grammar=grammar)
        self.listener.start(Context(self.clock, bus, self.resources))

    def run_until(self, is_done: Callable[[], bool]) -> None:
        end = self.clock.now() + PATIENCE
        while self.clock.now() < end and not is_done():
            self.clock.advance(TICK)
            self.speaker.position(self.clock.now())
            self.listener.compute(self.clock.now(), TICK)
            for output in self.listener.outputs:
                getattr(self.listener, output).value = None

    def play_until_heard(self) -> None:
        count = len(self.events)

        def is_heard() -> bool:
            if self.clock.now() > self.begun + AGAIN:
                self.begun = self.clock.now()
                self.speaker.play(self.samples, self.rate, self.begun)
            heard = [what for name, what in self.events[count:] if name == "speech.heard"]
            return any(what["text"] == self.words for what in heard)

        self.run_until(is_heard)

    def wait_for_notices(self, what: str) -> None:
        """Of both ends of the sound card."""
        self.run_until(lambda: sum(what in notice for notice in self.notices) == 2)

    def close(self) -> None:
        self.listener.stop()
        self.resources.close()


def main(grammar: str, recording: str, words: str, script: str) -> None:
    trial = Trial(grammar, recording, words)
    try:
        trial.run_until(lambda: trial.clock.now() > 1.0)
        trial.play_until_heard()
        subprocess.run(STOP, check=True)
        trial.wait_for_notices("gone")
        subprocess.run((*START, script), check=True)
        trial.wait_for_notices("is back")
        trial.begun = -AGAIN
        trial.play_until_heard()
        length = len(trial.samples) / trial.rate
        told = {"events": trial.events, "notices": trial.notices}
        print(json.dumps({**told, "begun": trial.begun, "length": length}, default=dict))
    finally:
        trial.close()


if __name__ == "__main__":
    main(*sys.argv[1:])
