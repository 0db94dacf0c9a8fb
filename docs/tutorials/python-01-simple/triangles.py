"""Drive three triangles, and tell how far each has come."""

import math

from hri.task import get_task_manager
from hri.task.navigation import MoveRelative, TurnRelative
from hri.task.speech import Speak

LENGTH = 40  # cm
VELOCITY = 20  # cm/s
CORNER = 2 * math.pi / 3
TRIANGLES = 3


def say(text: str) -> None:
    """Tell it on the screen and aloud."""
    print(text, flush=True)
    Speak(text)


def side() -> None:
    """Turn left at a corner and drive to the next one."""
    TurnRelative(CORNER)
    MoveRelative(0.0, [LENGTH, 0, VELOCITY])


def triangle() -> None:
    """Drive once around."""
    say("Beginning the triangle.")
    side()
    say("One third complete.")
    side()
    say("Two thirds complete.")
    side()
    say("100% complete!")


def main() -> None:
    """Drive all triangles."""
    for number in range(1, TRIANGLES + 1):
        say(f"Triangle number {number}.")
        triangle()
    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
