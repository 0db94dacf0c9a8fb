"""The drive base interfaces: commands down, pose up. SI units and radians."""

import math
from abc import abstractmethod
from enum import Enum

from hri.core.errors import HriError
from hri.core.signals import Pose2D, Twist
from hri.hal.manner import FREELY, Manner
from hri.hal.pending import Pending
from hri.hal.rank import PROGRAM, Writer
from hri.hal.resource import Description, Resource

LONGEST_MOVE = (20.0, 0.01, 10_000.0)
"""Default, least and most of the parameter `longest_move`, meters: farther than across a hall, and
less than a distance in centimeters that was taken for meters."""

PATIENCE = 0.2
"""Seconds that the word of whoever steers counts for; then the base stands still. The command
timeout that create_robot has too (`latch_cmd_duration`)."""


class Stop(Enum):
    """How a base comes to rest."""

    SMOOTH = "smooth"
    """Quickly, but gently enough for what stands on the robot."""
    ABRUPT = "abrupt"
    """As fast as the hardware can."""


class DriveSystem(Resource):
    """A base that follows velocities, and rests when no command comes for PATIENCE.

    A network sends velocities, tick by tick. A program asks for whole motions: these repeat their
    commands by themselves, need the clock to run, and replace each other. A motion that another
    command ends fails with Interrupted, once that command was given; a callback may then ask for
    the next motion, but not in answer to `stop` or `halt`. A motion whose hardware fails ends with
    HriError, and the base brakes. Commands of several writers are arbitrated by their ranks, see
    `hri.hal.rank`: a command is refused with Outranked while someone steers who is not less
    important. A stop is everyone's, and always wins.

    Ways and angles may be negative, velocities of `move_delta` and `turn_delta` and all
    accelerations must be above 0; velocities and accelerations beyond the base's limits are cut to
    them. HriError is raised for anything else, and by a drive that is closed; `stop` then does
    nothing.
    """

    max_linear: float = 0.5
    """Meters a second."""
    max_angular: float = 1.5
    """Radians a second."""
    max_acceleration: float = 0.5
    """Meters a second squared; motions are cut to it."""
    max_angular_acceleration: float = 2.0
    """Radians a second squared; motions are cut to it."""

    @property
    def longest_move(self) -> float:
        """Meters; a longer move is refused. Raises AuthoringError."""
        return longest_move(self.description)

    @abstractmethod
    def claim(self, writer: Writer) -> None:
        """Let nobody else of the same rank steer by a claim, until `leave`. Raises HriError."""

    @abstractmethod
    def leave(self, writer: Writer, now: float) -> None:
        """Give up a claim, and let go."""

    @abstractmethod
    def let_go(self, writer: Writer, now: float) -> None:
        """Steer no more: the base stops, unless someone else steers it."""

    @abstractmethod
    def set_velocity(
        self,
        twist: Twist,
        now: float,
        until: float = math.inf,
        by: Writer = PROGRAM,
        manner: Manner = FREELY,
    ) -> None:
        """Go on with this velocity until the next command, for PATIENCE or until a time before.

        Raises Outranked while someone else steers who is not less important than `by`.
        """

    @abstractmethod
    def stop(self, now: float) -> None:
        """Stand still as fast as the hardware can."""

    @abstractmethod
    def set_idle_power(self, percent: float) -> Pending[None]:
        """Force with which the base holds its place while it stands, 0 (rolls free) to 100."""

    @abstractmethod
    def set_move_power(self, percent: float) -> Pending[None]:
        """Force for motions, above 0 to 100: that much of the greatest acceleration."""

    @abstractmethod
    def move_delta(self, distance: float, velocity: float, acceleration: float) -> Pending[None]:
        """Drive straight on: meters, m/s, m/s². Raises HriError beyond `longest_move`."""

    @abstractmethod
    def turn_delta(self, angle: float, velocity: float, acceleration: float) -> Pending[None]:
        """Turn on the spot, left when positive: radians, rad/s, rad/s²."""

    @abstractmethod
    def move_and_turn(
        self,
        linear: float,
        linear_acceleration: float,
        angular: float,
        angular_acceleration: float,
    ) -> None:
        """Go for these velocities and keep them until another command comes."""

    @abstractmethod
    def halt(self, how: Stop = Stop.SMOOTH) -> Pending[None]:
        """Come to rest; done when the base stands."""


class Odometry(Resource):
    """Where the base is, by its own wheels."""

    @abstractmethod
    def pose(self, now: float) -> Pose2D:
        """Pose in the frame in which the base was switched on."""

    @abstractmethod
    def velocity(self, now: float) -> Twist:
        """Measured velocity."""


def longest_move(description: Description) -> float:
    """What a configuration says of a drive, meters. Raises AuthoringError."""
    return description.number_within("longest_move", *LONGEST_MOVE)


def too_long(drive: str, given: str, longest: float, remedy: str) -> HriError:
    """The refusal of a move: `given` is how far, with its unit."""
    return HriError(
        f"{drive}: a move of {given} is longer than longest_move ({longest:g} m) - {remedy}; "
        "if you mean it, raise longest_move in the configuration of the drive"
    )
