"""Spells words: a task that takes the words of a free slot."""

from hri.task import TaskContext, immediate


@immediate
def spell(context: TaskContext, word: str) -> str:
    """Say the letters one by one, and each word as a sentence."""
    words = ["".join(filter(str.isalpha, part)) for part in word.upper().split()]
    spelled = [f"{', '.join(letters)}." for letters in words if letters]
    return " ".join(spelled) or "Those aren't letters."
