"""Tasks of the face and of what it shows.

Show(label, seconds=4)    an expression
Gesture(name, strength=1, seconds=0)    such as "nod"
Feel(stimulus, intensity=1, person=None)
"""

from hri.task.library import tasks_by_name

__all__ = ["Feel", "Gesture", "Show"]  # noqa: F822

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)
