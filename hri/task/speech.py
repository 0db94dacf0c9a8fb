"""Tasks that speak and hear.

Speak(text)            says it; when cancelled, it is cut at once
Listen(timeout=inf)    the next utterance; None after `timeout` seconds
Ask(question, timeout=6)    True, False, or None without an answer
"""

from hri.task.library import tasks_by_name

__all__ = ["Ask", "Listen", "Speak"]  # noqa: F822

__getattr__ = tasks_by_name(__name__, *__all__)
