"""The face interface of 2003, for programs that are ported: play-acting, which moves no feelings.

    face = FaceInterface(robot)
    face.set_emotion_value(5.0, "joy", 0.8)
    face.wait_for_emotional_change()

Durations are in seconds, values 0 to 1, emotions by name. `Robot` has the verbs for new programs.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from hri.behavior.runner import Runner
from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Phoneme, Speech
from hri.emotion.behaviors import EmotionDisplay
from hri.face.behaviors import Face
from hri.face.lips.phonemes import Alphabet, mnemonics
from hri.robot import Robot
from hri.task.context import TaskContext

PHONEME_S = 0.08
"""Seconds of a phoneme: about twelve a second, as people speak."""
MOST_PHONEMES = 1000
_PAUSE = re.compile(r"_[:!|]*|sil|SIL|pau|PAU")
_RATE = 1000
"""Samples a second of the silence that carries phonemes."""
_LOOK_EVERY = 0.05


class FaceInterface:
    """What the programs of 2003 asked of a face, done by a robot that is running."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot

    def action(self, name: str) -> None:
        """Play an animation of the face, such as "nod", instead of one that plays; does not wait.

        Raises HriError for one that the face does not know.
        """
        self._do(lambda context: context.behavior(Face).make(name))

    def set_emotion_value(self, duration: float, emotion: str, value: float) -> None:
        """Show an emotion at a value for so long, whatever is felt; the others stay as they are.

        Raises HriError for an unknown emotion, or a duration or a value out of range.
        """
        self._do(lambda context: context.behavior(EmotionDisplay).act({emotion: value}, duration))

    def set_emotion_increment(self, duration: float, emotion: str, value: float) -> None:
        """Show an emotion by `value` (-1 to 1) more than now for so long; never beyond 0 to 1.

        Raises HriError as `set_emotion_value` does.
        """
        self._do(
            lambda context: context.behavior(EmotionDisplay).act_more(emotion, value, duration)
        )

    def set_emotion_vector(
        self, duration: float, emotions: Mapping[str, float] | Sequence[float]
    ) -> None:
        """Show only these emotions for some time.

        By name, those left out being 0, or a value for each in the order of `hri emotion list`.
        Raises HriError as `set_emotion_value` does, and for a list of another length.
        """
        self._do(lambda context: context.behavior(EmotionDisplay).act_all(emotions, duration))

    def speak(self, phonemes: str | Sequence[str], alphabet: Alphabet | str | None = None) -> None:
        """Move the lips to phonemes without a sound, and wait until they are through.

        Mnemonics of espeak-ng, or ARPAbet ("arpabet"; found out where no `alphabet` is given),
        between spaces or one by one; "_" is a pause, "'" before a vowel stresses it. Each lasts
        PHONEME_S. Raises HriError for more than MOST_PHONEMES, and for another alphabet.
        """
        if alphabet is not None and alphabet not in list(Alphabet):
            remedy = did_you_mean(alphabet, list(Alphabet))
            raise HriError(f'"{alphabet}" is not an alphabet of phonemes - {remedy}')
        self._robot.run(_speak, phonemes, Alphabet(alphabet) if alphabet else None)

    def wait_for_emotional_change(self, timeout: float = float("inf")) -> bool:
        """Wait until all that was put on is over; whether that is so within `timeout` seconds."""
        is_over: bool = self._robot.run(_wait_for_emotional_change, timeout)
        return is_over

    def _do(self, deed: Callable[[TaskContext], object]) -> None:
        async def job(context: TaskContext) -> None:
            deed(context)

        self._robot.run(job)


async def _speak(
    context: TaskContext, phonemes: str | Sequence[str], alphabet: Alphabet | None
) -> None:
    names = phonemes.split() if isinstance(phonemes, str) else tuple(phonemes)
    speech = _mouthed(names, alphabet)
    runner, face = _face_of(context)
    async with context.claim("lips"):
        start = context.clock.now()
        while (position := context.clock.now() - start) < speech.duration:
            # Injected values come ahead of those of the voice, for one tick each.
            runner.inject(face.id, "speech", speech)
            runner.inject(face.id, "position", position)
            runner.inject(face.id, "is_speaking", True)
            await context.clock.sleep(runner.network.interval)


async def _wait_for_emotional_change(context: TaskContext, timeout: float) -> bool:
    display = context.behavior(EmotionDisplay)
    with context.clock.move_on_after(timeout):
        while display.is_acting:
            await context.clock.sleep(_LOOK_EVERY)
    return not display.is_acting


def _mouthed(names: Sequence[str], alphabet: Alphabet | None) -> Speech:
    """Phonemes one after the other, in silence."""
    if len(names) > MOST_PHONEMES:
        raise HriError(f"{len(names)} phonemes - speak at most {MOST_PHONEMES} at once")
    sounds = mnemonics([name.lstrip("',") for name in names], alphabet)
    phonemes = tuple(
        Phoneme("_" if _PAUSE.fullmatch(sound) else sound, i * PHONEME_S, PHONEME_S,
                stressed=name.startswith("'"))
        for i, (name, sound) in enumerate(zip(names, sounds, strict=True))
    )  # fmt: skip
    silence = np.zeros(round(len(names) * PHONEME_S * _RATE), np.int16)
    return Speech("", silence, _RATE, phonemes)


def _face_of(context: TaskContext) -> tuple[Runner, Face]:
    for runner in context.networks.runners.values():
        for behavior in runner.network.behaviors:
            if isinstance(behavior, Face):
                return runner, behavior
    raise HriError("no Face runs - add one to a network of the app")
