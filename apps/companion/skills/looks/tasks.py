"""How it looks: another face while it lives, until the robot is started again."""

from hri.face import Face
from hri.robot import verbs
from hri.task import TaskContext

FACES = ("robot", "astronaut", "person")
"""In the order in which "another face" takes them."""
FIRST = "face.first"
"""Slot of the board with the face that it had before another was asked for."""


async def put_on_face(context: TaskContext, face: str) -> None:
    """Put on a face of this name, another one, or the usual one, and be happy with it."""
    now, first = context.behavior(Face).face, context.board.slot(FIRST)
    usual = str(first.value or now)
    first.set(usual, context.clock.now())
    place = FACES.index(now) + 1 if now in FACES else 0
    wanted = {"usual": usual, "other": FACES[place % len(FACES)]}.get(face, face)
    if wanted == now:
        await verbs.say(context, "I look like that already.")
        return
    await verbs.change_face(context, wanted)
    await verbs.say(context, "That's better. Hello again." if face == "usual" else "How do I look?")
    await verbs.show(context, "happy", 2.0)
