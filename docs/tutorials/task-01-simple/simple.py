"""Drive 20 inches ahead, then take a picture."""

from hri.task import (
    UNIT_ANGLE,
    UNIT_DISTANCE,
    UNIT_TIME,
    get_task_manager,
    navigation,
    set_default_units,
    vision,
)


def main() -> None:
    """Run the two tasks one after the other."""
    set_default_units(UNIT_DISTANCE, "inches")
    set_default_units(UNIT_ANGLE, "degrees")
    set_default_units(UNIT_TIME, "seconds")

    navigation.DriveMoveDelta(20, 5, 20)
    frame = vision.GetImage("camera")
    frame.write_file("image.jpg", 0.9)
    print(f"image.jpg: {frame.width} x {frame.height}")

    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
