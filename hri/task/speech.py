"""Tasks that speak and hear.

Speak(text)            says it; when cancelled, it is cut at once
Listen(timeout=inf)    the next utterance; None after `timeout` seconds
WaitForSpeech(rules="", timeout=inf)    the next utterance by one of these rules
Ask(question, timeout=6, grammar="", retries=0)    True, False, or None without an answer; with a
                       grammar, the utterance that answers
Say(text)              as Speak, in a network's own voice
"""

from hri.task.library import tasks_by_name

__all__ = ["Ask", "Listen", "Say", "Speak", "WaitForSpeech"]  # noqa: F822

__getattr__, __dir__ = tasks_by_name(__name__, *__all__)
