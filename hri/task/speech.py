"""Tasks that speak and hear.

Speak(text)            says it; when cancelled, it is cut at once
Listen(timeout=inf, grammar="")    the next utterance; None after `timeout` seconds
WaitForSpeech(rules="", timeout=inf, grammar="")    the next utterance by one of these rules
Ask(question, timeout=6, grammar="", retries=0)    True, False, or None without an answer; with a
                       grammar, the utterance that answers
Say(text)              as Speak

A grammar is a name, also of a file in the app's folder, or a path; without one, that of the
listener counts.
"""

from hri.task.library import tasks_by_name

__all__ = ["Ask", "Listen", "Say", "Speak", "WaitForSpeech"]  # noqa: F822

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)
