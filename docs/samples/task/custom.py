"""A custom task, with arguments that are checked and a way to fail; called as a function."""

from hri.core import HriError
from hri.task import TaskContext, find_task, get_task_manager
from hri.task.speech import Speak
from hri.task.task import task


@task("Examples.Countdown")
async def countdown(context: TaskContext, start: int, pause: float = 0.5) -> int:
    """Say the numbers from `start` down to 1, `pause` seconds apart; how many were said."""
    if start < 1:
        context.fail(f"cannot count down from {start} - give 1 or more")
    for number in range(start, 0, -1):
        await Speak(context, str(number))
        await context.clock.sleep(pause)
    return start


def main() -> None:
    """Call it by its function and by its name, and see it refuse what it cannot do."""
    print("counted", countdown(3))
    print("counted", find_task("Examples.Countdown")(2, 0.1))
    for wrong in (0, "many"):
        try:
            countdown(wrong)
        except HriError as error:
            print("refused:", error)
    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
