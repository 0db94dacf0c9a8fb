from hri.conversation import AlarmKeeper, AlarmKind
from hri.task import TaskContext

MINUTES = {"green": 2, "black": 4}


async def make_tea(context: TaskContext, kind: str, strength: str) -> str:
    """Promise to say when it is ready, also after a restart; the robot says what this returns."""
    keeper = AlarmKeeper.of(context)
    keeper.promise(AlarmKind.TIMER, f"in {60 * MINUTES[kind]}", f"{kind} tea")
    await keeper.kept()
    return f"Your {strength} {kind} tea will be ready in {MINUTES[kind]} minutes."
