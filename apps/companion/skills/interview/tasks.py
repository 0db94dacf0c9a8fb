"""An interview: what people tell is remembered as always, by the companion's own task for it."""

from hri.robot import App
from hri.task import TaskContext

QUESTIONS = {
    "likes": "What do you like most?",
    "dislikes": "And what don't you like?",
    "home": "Which town do you live in?",
    "origin": "Which country are you from?",
    "birthday": "When is your birthday?",
}
"""By relation of the companion's memory.toml."""


async def interview(context: TaskContext) -> str | None:
    """Ask for all that is not known yet of who talks; what answers none of it ends that."""
    ask_for = App.of(context).task("ask_for")
    ends = set()
    for relation, question in QUESTIONS.items():
        end = await ask_for(context, relation, question)
        if end == "stranger":
            return "First tell me who you are. Say: my name is, and your name."
        if end == "unanswered":
            return None
        ends.add(end)
    if "told" not in ends:
        return "You've already told me all I wanted to know."
    return "Thank you! Now I know you much better."
