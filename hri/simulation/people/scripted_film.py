"""Films of simulated people by a script, for tests and figures: every angle in them is known."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from hri.core.signals import Frame
from hri.simulation.people.actors import Optics, render_people
from hri.simulation.people.appearance import DEFAULT_ACTOR
from hri.simulation.people.body_motion import Posture, idle_angles, still
from hri.simulation.people.lens import Lens


@dataclass(frozen=True, slots=True)
class Role:
    """What one person does in a film."""

    motion: Callable[[float], Posture | None] = still
    """What they do at a time, over the sway of rest; None while they are not there."""
    actor: str = DEFAULT_ACTOR
    distance: float = 1.3
    """Meters from the camera."""
    right: float = 0.0
    """Meters to the right as the camera sees them."""
    seed: int = 0

    def posture(self, time: float) -> Posture | None:
        """How they hold themselves: what the film shows; None while they are not there."""
        held = self.motion(time)
        return held and held + Posture(*idle_angles(time, self.seed))


@dataclass(frozen=True, slots=True)
class Film:
    """A film of some people."""

    roles: Sequence[Role]
    duration: float
    """Seconds."""
    rate: float = 30.0
    """Pictures a second."""
    optics: Optics = field(default_factory=Optics)
    lens: Lens = field(default_factory=Lens)
    scene: int = 0
    """Number of the room."""

    def frames(self) -> Iterator[Frame]:
        """All pictures in order; the same each time."""
        for index in range(round(self.duration * self.rate)):
            time = index / self.rate
            shown = [
                self.optics.show(role.actor, held, role.right, role.distance)
                for role in self.roles
                if (held := role.posture(time)) is not None
            ]
            image = render_people(shown, self.optics.size, self.scene)
            yield Frame(self.lens.take(image, index), time, index)
