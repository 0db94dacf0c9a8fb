"""Tasks that reach other programs.

EventServer()    passes events to and from programs that connect over TCP
"""

from hri.task.library import tasks_by_name

__all__ = ["EventServer"]  # noqa: F822

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)
