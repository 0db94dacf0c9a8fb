"""What a plain script says to a robot: each verb waits until it is done."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable
from pathlib import Path
from typing import Any

from hri.core.errors import HriError, did_you_mean
from hri.core.signals import Event, Utterance
from hri.emotion.appraisal import OccEvent
from hri.robot import callbacks, verbs
from hri.speech.listener import Listener
from hri.speech.ssml import Ssml
from hri.task.context import TaskContext
from hri.task.task_manager import TaskManager
from hri.task.task_run import Job, Task


class BlockingVerbs(ABC):
    """The verbs of `Robot`; those of tasks are in `hri.robot.verbs`."""

    tasks: TaskManager

    @abstractmethod
    def run(self, job: Job, *arguments: Any) -> Any:
        """Run a coroutine function with the robot's TaskContext and wait for what it returns."""

    def say(self, text: str | Ssml) -> None:
        """Say something and wait until it is said."""
        self.run(verbs.say, text)

    def play(self, path: Path | str, text: str = "") -> None:
        """Play a sound file with moving lips and wait until it is heard; `text` is what it says.

        Raises HriError for a file that cannot be read.
        """
        self.run(verbs.play, path, text)

    def ask(
        self, question: str, timeout: float = 6.0, grammar: str = "", retries: int = 0
    ) -> bool | Utterance | None:
        """Ask a yes/no question; yes, no, a nod and a shake count. None without an answer.

        With a `grammar`, looked for in the app's folder first, its utterance is the answer. Asked
        again up to `retries` times.
        """
        answer: bool | Utterance | None = self.run(verbs.ask, question, timeout, grammar, retries)
        return answer

    def listen(self, timeout: float = float("inf"), grammar: str = "") -> Utterance | None:
        """The next thing heard, by a grammar (name or path) that is in force meanwhile."""
        heard: Utterance | None = self.run(verbs.listen, timeout, grammar)
        return heard

    def show(self, expression: str, seconds: float = 4.0) -> None:
        """Show an expression for some seconds; 0 is as long as the face holds it by itself."""
        self.run(verbs.show, expression, seconds)

    def gesture(self, name: str, strength: float = 1.0, seconds: float = 0.0) -> None:
        """Make a gesture such as "nod" with the face and wait until it is made.

        `strength` is 0 to 1.5; 0 `seconds` is the gesture's own duration.
        """
        self.run(verbs.gesture, name, strength, seconds)

    def feel(self, stimulus: str, intensity: float = 1.0, person: str | None = None) -> None:
        """Let a stimulus such as "praise", perhaps by a person, move the emotions."""
        self.run(verbs.feel, stimulus, intensity, person)

    def appraise(self, event: OccEvent) -> None:
        """Let a goal that became likelier, a deed or a thing move the emotions.

        `robot.appraise(GoalEvent("charger", utility=1.0, likelihood_after=0.8))` gives hope.
        """
        self.run(verbs.appraise, event)

    def why(self, about: str = "") -> str:
        """What it feels and why, in a sentence; `about` is a feeling such as "sad"."""
        words: str = self.run(verbs.why, about)
        return words

    def move(self, distance: float, speed: float | None = None) -> float:
        """Drive straight ahead by meters, back when negative; the meters really traveled.

        `speed` is in meters a second, above 0; without one, 0.3.
        """
        moved: float = self.run(verbs.move, distance, speed)
        return moved

    def turn(self, angle: float, rate: float | None = None) -> float:
        """Turn by radians, left when positive; the radians really turned.

        `rate` is in radians a second, above 0; without one, 1.
        """
        turned: float = self.run(verbs.turn, angle, rate)
        return turned

    def stop(self) -> None:
        """End whatever motion goes on, and wait until the base stands, two seconds at most."""
        self.run(verbs.stop)

    def on(self, event: str, handler: Callable[[Event], object]) -> Task:
        """Call `handler(event)` at each event of that name, in which `*` stands for any characters.

        It runs beside the program, one call after the other, and may use all verbs; what it raises
        is reported, and it is called again at the next event. `cancel()` of the task that this
        returns ends it.
        """
        task: Task = self.tasks.install(callbacks.at_event, event, handler)
        return task

    def when_heard(self, rule: str, handler: Callable[..., object]) -> Task:
        """Call `handler(**tags)` whenever a sentence of that rule is heard; see `on`.

        Raises HriError for a rule that the grammar does not have.
        """
        rules = self.tasks.context.behavior(Listener).loaded_grammar.public_rules
        if rule not in rules:
            raise HriError(f'no rule "{rule}" in the grammar - {did_you_mean(rule, rules)}')
        task: Task = self.tasks.install(callbacks.when_heard, rule, handler)
        return task

    def wait(self, seconds: float) -> None:
        """Live on for some seconds."""

        async def wait(context: TaskContext) -> None:
            await context.clock.sleep(seconds)

        self.run(wait)
