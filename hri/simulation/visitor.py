"""The simulated person as a script speaks of them: `robot.visitor.say("yes", after=2)`."""

from __future__ import annotations

from hri.core.clock import Clock
from hri.simulation.world import SimulatedWorld


class Visitor:
    """The person of this name in a simulated world, or the first; `after` counts seconds from now.

    Raises HriError where nobody has the name, or the world is a bare room.
    """

    def __init__(self, world: SimulatedWorld, clock: Clock, name: str = "") -> None:
        self._world, self._clock = world, clock
        self._person = world.find_person(name)

    def say(self, text: str, after: float = 0.0) -> None:
        """Say something; it gets quieter with the distance to the robot."""
        self._world.say(text, self._clock.now() + after, self._person)

    def nod(self, after: float = 0.0) -> None:
        """Nod the head."""
        self._person.nod(self._clock.now() + after)

    def shake(self, after: float = 0.0) -> None:
        """Shake the head."""
        self._person.shake(self._clock.now() + after)

    def smile(self, after: float = 0.0) -> None:
        """Smile for a while."""
        self._person.move("smile", self._clock.now() + after)

    def go(self, x: float, y: float, after: float = 0.0) -> None:
        """Walk to a place of the room, in meters."""
        self._person.go(x, y, self._clock.now() + after)

    def bump(self, after: float = 0.0) -> None:
        """Push against the base, so that its bumper is pressed."""
        self._world.bump(self._clock.now() + after)

    def press(self, button: str = "button", after: float = 0.0, seconds: float = 0.3) -> None:
        """Hold the button of that id down for some seconds."""
        self._world.press(button, self._clock.now() + after, seconds)

    def enter(self, after: float = 0.0) -> None:
        """Come in."""
        self._person.enter(self._clock.now() + after)

    def leave(self, after: float = 0.0) -> None:
        """Go out of the room."""
        self._person.leave(self._clock.now() + after)
