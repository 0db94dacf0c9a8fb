"""Take photos every second for as long as it takes to drive 20 inches."""

from photo_shoot import PhotoShoot

from hri.task import UNIT_DISTANCE, Parallel, get_task_manager, set_default_units
from hri.task.navigation import DriveMoveDelta


def main() -> None:
    """Drive and take photos; when the drive is over, so are the photos."""
    set_default_units(UNIT_DISTANCE, "inches")

    race = Parallel()
    race.add_task(DriveMoveDelta, [20, 5, 20])
    photos = race.add_task(PhotoShoot, [1])
    race.wait_for_first_task()
    print(f"{photos.result} photos taken.")

    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
