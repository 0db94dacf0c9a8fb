"""Tasks: cancellable coroutines on trio that wait for time and events.

from hri.task import Parallel, get_task_manager, navigation, speech

speech.Speak("Off we go.")                      # in a script: blocks until it is said
navigation.DriveMoveDelta(50, 20, 20)           # centimeters, unless set_default_units says else
get_task_manager().shutdown()

task            the decorators `@task` and `@immediate`, TaskType, find_task
parallel        Parallel: until the first is done, or until all are
patterns        with_timeout, retry, repeat
claims          who may use the drive and the voice
context         TaskContext: what a task may use
events          events as text; conditions: combinations; thresholds: events on values of ports
primitive       tasks that are a network
units           the units of the tasks
face, navigation, net, resource, speech, util, vision    all tasks of the library, by subject
"""

from hri.task.context import TaskContext
from hri.task.lane import Lane
from hri.task.order import said
from hri.task.parallel import Parallel
from hri.task.script import get_task_manager, use
from hri.task.task import ImmediateTask, TaskType, find_task, immediate
from hri.task.task_manager import TaskManager
from hri.task.task_run import Job, TaskStatus
from hri.task.units import (
    UNIT_ANGLE,
    UNIT_DISTANCE,
    UNIT_TIME,
    get_default_units,
    set_default_units,
)

__all__ = [
    "UNIT_ANGLE",
    "UNIT_DISTANCE",
    "UNIT_TIME",
    "ImmediateTask",
    "Job",
    "Lane",
    "Parallel",
    "TaskContext",
    "TaskManager",
    "TaskStatus",
    "TaskType",
    "find_task",
    "get_default_units",
    "get_task_manager",
    "immediate",
    "said",
    "set_default_units",
    "use",
]
