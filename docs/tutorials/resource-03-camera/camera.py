"""Takes one picture and writes it to a file: the use of a resource, from beginning to end."""

from hri.core import Clock, RealClock
from hri.hal import Camera, ResourceManager

FILE = "camera_image.jpg"
QUALITY = 0.9


def main(clock: Clock) -> None:
    """Take the picture, then give the camera back."""
    with ResourceManager.load("resource-config", clock) as resources:
        camera = resources.obtain("camera", Camera)
        frame = camera.take()
        frame.write_file(FILE, QUALITY)
        print(f"Wrote image {FILE}.")
        resources.release(camera)


if __name__ == "__main__":
    main(RealClock())
