"""Drive 20 inches ahead and take a picture, both at once."""

from hri.task import (
    UNIT_DISTANCE,
    Parallel,
    TaskStatus,
    find_task,
    get_task_manager,
    set_default_units,
)


def main() -> None:
    """Start both tasks together and wait for both."""
    set_default_units(UNIT_DISTANCE, "inches")

    both = Parallel()
    driving = both.add_task(find_task("Evolution.DriveMoveDelta"), [20, 5, 20])
    looking = both.add_task(find_task("Evolution.GetImage"), ["camera"])
    both.wait_for_all_tasks()

    for task in (driving, looking):
        print(f"{task.name}: {task.status.value}")
    if looking.status is TaskStatus.SUCCESS:
        looking.result.write_file("image.jpg", 0.9)

    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
