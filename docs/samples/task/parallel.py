"""Tasks at once: first until both are over, then until the first one is."""

from hri.task import Parallel, get_task_manager
from hri.task.navigation import DriveMoveDelta, DriveTurnDelta
from hri.task.speech import Speak
from hri.task.util import Wait


def main() -> None:
    """Speak while it drives; then turn for as long as a second lasts."""
    both = Parallel()
    drive = both.add_task(DriveMoveDelta, [20, 20])
    speech = both.add_task(Speak, ["I talk while I drive."])
    both.wait_for_all_tasks()
    print("drive:", drive.status.name, "speech:", speech.status.name)

    race = Parallel()
    turn = race.add_task(DriveTurnDelta, [3.14, 0.5])
    second = race.add_task(Wait, [1000])
    first = race.wait_for_first_task()
    print("over first:", "the second" if first is second else "the turn")
    print("turn:", turn.status.name)
    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
