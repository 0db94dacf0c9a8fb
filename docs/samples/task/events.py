"""Two tasks that talk by events: one asks for the time of day, the other answers, until the end."""

from hri.task import Parallel, TaskContext, get_task_manager
from hri.task.events import event, write_event
from hri.task.task import task

ALL = "Examples.Clock.*"


@task("Examples.Clock")
async def clock(context: TaskContext) -> int:
    """Answer each Ask until End; how often."""
    answers = 0
    context.task.enable_event(ALL)
    while (heard := await context.task.wait_for_event(ALL)).name != "Examples.Clock.End":
        if heard.name == "Examples.Clock.Ask":
            answer = event("Examples.Clock.Answer")
            answer.set_property("number", heard.get_property("number", float))
            answer.set_property("seconds", context.clock.now())
            context.manager.raise_event(answer)
            answers += 1
    context.task.disable_event(ALL)
    return answers


@task("Examples.Asker")
async def asker(context: TaskContext, times: int) -> None:
    """Ask some times, a second apart."""
    for number in range(times):
        context.task.enable_event("Examples.Clock.Answer")
        context.manager.raise_event("Examples.Clock.Ask", number=number)
        answer = await context.task.wait_for_event("Examples.Clock.Answer", 5.0)
        print("received", write_event(answer) if answer else "nothing")
        context.task.disable_event("Examples.Clock.Answer")
        await context.clock.sleep(1.0)
    context.manager.raise_event("Examples.Clock.End")


def main() -> None:
    """Run both until both are over."""
    both = Parallel()
    answering = both.add_task(clock)
    both.add_task(asker, [3])
    both.wait_for_all_tasks()
    print("answers:", answering.result)
    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
