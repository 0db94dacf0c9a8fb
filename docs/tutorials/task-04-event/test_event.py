"""Two tasks that talk by events: one orders photos, the other takes them."""

from photo_event import ALL, PhotoEvent

from hri.task import Parallel, TaskContext, get_task_manager
from hri.task.events import event, write_event
from hri.task.task import task


@task("Examples.PhotoEventTest")
async def PhotoEventTest(context: TaskContext) -> None:
    """Order three photos, wait until they are there, and end the photographer."""
    context.task.enable_event(ALL)
    shoot = event("Examples.PhotoEvent.Shoot", name="a_", count="3.0", delay="1.0")
    print("test_event - raising event:", write_event(shoot))
    context.manager.raise_event(shoot)

    done = await context.task.wait_for_event("Examples.PhotoEvent.Done")
    print("test_event - received event:", write_event(done))

    end = event("Examples.PhotoEvent.End")
    print("test_event - raising event:", write_event(end))
    context.manager.raise_event(end)
    context.task.disable_event(ALL)


def main() -> None:
    """Run both tasks until both are over."""
    both = Parallel()
    photos = both.add_task(PhotoEvent)
    both.add_task(PhotoEventTest)
    both.wait_for_all_tasks()
    print(f"{photos.result:g} photos taken.")

    get_task_manager().shutdown()


if __name__ == "__main__":
    main()
