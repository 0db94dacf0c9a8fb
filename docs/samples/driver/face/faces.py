"""Shows each expression of the face on the screen for a second."""

from hri.core import Clock, RealClock
from hri.face import load_face, render_face
from hri.hal import ResourceManager, Screen


def main(clock: Clock) -> None:
    """Draw, show, wait; one expression after the other."""
    face = load_face("robot")
    with ResourceManager.load("resource-config", clock) as resources:
        screen = resources.obtain("screen", Screen)
        for expression in face.expressions:
            print(expression, flush=True)
            picture = render_face(face, expression, size=(screen.width, screen.height))
            screen.show(picture, clock.now())
            clock.advance(1.0)


if __name__ == "__main__":
    main(RealClock())
