"""The photographer of task-04-event, now for other programs: orders come over TCP."""

from pathlib import Path

from hri.core.python_file import load_module
from hri.net.event_server import EventServer
from hri.task import Parallel, get_task_manager

photo_event = load_module(
    "photo_event", Path(__file__).parent.parent / "task-04-event" / "photo_event.py"
)


def main() -> None:
    """Run the photographer and the event server until both are over."""
    both = Parallel()
    both.add_task(EventServer)
    photos = both.add_task(photo_event.PhotoEvent)
    both.wait_for_all_tasks()
    print(f"{photos.result:g} photos taken.")

    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
