"""Speak what is typed, for a second at most."""

from contextlib import suppress

from hri.task import Parallel, get_task_manager
from hri.task.speech import Speak
from hri.task.util import Wait

TIMEOUT = 1000  # milliseconds


def echo(text: str) -> bool:
    """Speak a text; whether there was time for all of it."""
    race = Parallel()
    speaking = race.add_task(Speak, [text])
    race.add_task(Wait, [TIMEOUT])
    return race.wait_for_first_task() is speaking


def main() -> None:
    """Echo line after line, until an empty one or Ctrl-D."""
    print("The text-to-speech echo system is ready.")
    print("Type a line of text and it will be spoken.")
    print("Press ENTER on an empty line to quit.")
    with suppress(EOFError):  # Ctrl-D
        while text := input("Text to speak: "):
            if not echo(text):
                print("(Oops, that took too long!)")
    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
