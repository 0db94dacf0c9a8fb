"""What is said after "because" of goals, deeds and things, for which no author wrote words.

People stand in braces, for `hri.emotion.reasons` to name: "{you} kicked me".
"""

from __future__ import annotations

import re

from hri.emotion.appraisal import SELF, UNKNOWN, ActionEvent, GoalEvent, ObjectEvent, OccEvent

# fmt: off
_PAST = frozenset((
    "ate", "beat", "bit", "blew", "bought", "broke", "brought", "built", "came", "caught", "cut",
    "did", "drank", "drew", "drove", "fed", "fell", "felt", "forgave", "forgot", "fought", "found",
    "gave", "got", "grew", "had", "heard", "held", "hid", "hit", "hurt", "kept", "knew", "laid",
    "left", "lent", "let", "lied", "lit", "lost", "made", "meant", "met", "paid", "put", "ran",
    "read", "rode", "said", "sang", "sat", "saw", "sent", "set", "shook", "shot", "shut", "slept",
    "sold", "spent", "spilt", "spoke", "stole", "stood", "stuck", "swore", "swung", "taught",
    "thought", "threw", "told", "took", "tore", "understood", "was", "went", "were", "woke", "won",
    "wore", "wrote",
))
"""Pasts that do not end in -ed."""
_DETERMINERS = frozenset((
    "a", "all", "an", "any", "both", "every", "her", "his", "its", "my", "no", "our", "some",
    "that", "the", "their", "these", "this", "those", "your",
))
# fmt: on
_WORD = re.compile(r"[^\W_]+")


def words_of(event: OccEvent) -> str:
    """What follows "because" while the event is felt."""
    match event:
        case GoalEvent():
            return _goal(event)
        case ActionEvent(action=action, agent=agent):
            return _deed(_spoken(action), is_own=agent == SELF)
        case ObjectEvent(object=thing):
            return f"of {_noun(_spoken(thing))}"


def _goal(event: GoalEvent) -> str:
    if not event.is_decided:
        said = event.waiting
        if said and event.utility < 0 and event.likelihood_after < UNKNOWN:
            return f"even though {said}"
    else:
        said = event.fulfilled if event.likelihood_after == 1.0 else event.failed
    if said:
        return said
    name = _spoken(event.goal)
    if event.owner is not None:
        return f"of {{your}} {name}" if " " not in name else f'of {{your}} goal, "{name}"'
    return f"of {_noun(name)}" if " " not in name else f'of the goal "{name}"'


def _deed(name: str, is_own: bool) -> str:
    first = _WORD.match(name)
    verb = first[0].lower() if first else ""
    if verb in _PAST or verb.endswith("ed"):
        return f"I {name}" if is_own else f"{{you}} {name}"
    return f"of {'my' if is_own else '{your}'} {name}"


def _noun(name: str) -> str:
    """With an article, unless it has one or is the name of someone."""
    first = name.split(" ", 1)[0]
    return name if first.lower() in _DETERMINERS or first[:1].isupper() else f"the {name}"


def _spoken(name: str) -> str:
    return name.replace("_", " ").strip()
