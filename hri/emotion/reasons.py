"""Why the robot feels as it does, in words: "mostly because you scolded me 2 minutes ago"."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from hri.emotion.affect import Soothed
from hri.emotion.display import EmotionLook
from hri.emotion.ledger import TEMPERAMENT, Cause
from hri.emotion.relations import is_unnamed

WORTH_SAYING = 0.2
"""A cause with a smaller share is not mentioned."""
MOST_CAUSES = 2
EVEN_THOUGH = "even though"
"""What the words of a reason begin with that speaks against the feeling."""
MOSTLY = 0.6
"""From this share on the first cause outweighs the second."""
FORGIVEN_S = 300.0
"""Seconds for which it is worth saying that someone made up for what they did."""
GONE = 0.05
"""An emotion of less intensity is not felt any more."""
ALWAYS = {
    TEMPERAMENT: ("that is how I am", "that is how I am"),
    "drive.company": ("I have had company", "I have been alone"),
    "drive.play": ("I have had something to do", "I have had little to do"),
    "drive.rest": ("I am rested", "I have had no rest"),
    "drive.energy": ("my battery is full", "my battery runs down"),
}
"""Words for what always acts: where the need is stilled, and where it presses."""
PRESSING = 0.5
"""From this level on."""
JUST_NOW_S = 10.0
"""What is younger needs no time said."""

ALSO_CALLED = {"afraid": "scared"}
"""Words that people use, and their synonyms in the display file."""

_PERSON = re.compile(r"\{([^{}]*)\}")
"""In words of a stimulus, what gives way to a name."""
VERB_WITH_NAME = {"are": "is", "were": "was", "have": "has"}
"""Verbs that go with a name instead: "{you are} here" becomes "Anna is here"."""

_TIMELESS = re.compile(
    r"\b(am|is|are|has|have|ago|lately|recently|today|yesterday|since|always|never|"
    r"for (a while|a long time|some time|so long|ages|(\w+ )?(seconds|minutes|hours|days|weeks)))\b"
)
"""In words of a stimulus, what lasts or says its own time; "ago" goes with what is over."""

_AGES = (
    # (upper limit, to what it is rounded, unit, each in seconds; singular, plural): nobody says
    # "53 minutes ago"
    (60.0, 1.0, 1.0, "a moment ago", "a moment ago"),
    (720.0, 60.0, 60.0, "a minute ago", "{} minutes ago"),
    (1500.0, 300.0, 60.0, "", "{} minutes ago"),
    (2400.0, 300.0, 60.0, "", "half an hour ago"),
    (3600.0, 600.0, 60.0, "", "{} minutes ago"),
    (86400.0, 3600.0, 3600.0, "an hour ago", "{} hours ago"),
    (float("inf"), 86400.0, 86400.0, "a day ago", "{} days ago"),
)


def why_words(
    feeling: str, causes: Sequence[Cause], words: Mapping[str, str], needs: Mapping[str, float]
) -> str:
    """One sentence: the robot's feeling and its causes.

    `feeling` is what follows "I am"; `causes` come largest first; `needs` are 0, stilled, to 1;
    `words` say of each cause by name what happened: "{you} praised me", which is "Anna praised me"
    where it was Anna. It follows how long ago that was, unless the cause lasts ("my battery is
    low") or its words say a time themselves. A cause without words is not mentioned.
    """
    shares: dict[str, float] = {}
    for cause in causes:
        # What two people did may be one reason in words: "because you praised me".
        if reason := _reason(cause, words, needs):
            shares[reason] = shares.get(reason, 0.0) + cause.share
    largest = sorted(shares, key=lambda reason: -shares[reason])
    told = [(shares[r], r) for r in largest if shares[r] >= WORTH_SAYING][:MOST_CAUSES]
    if not told:
        return f"I am {feeling}, for no special reason."
    if told[0][1] == ALWAYS[TEMPERAMENT][0]:
        # That is how it is explains least, whatever its share.
        told.reverse()
    share, first = told[0]
    if len(told) == 1:
        return f"I am {feeling} {_clause(first, _joint(feeling))}."
    second = told[1][1]
    if share >= MOSTLY and not first.startswith(EVEN_THOUGH):
        return f"I am {feeling}, mostly because {first}, and a little {_clause(second)}."
    return f"I am {feeling} {_clause(first)}, and {_clause(second)}."


def _clause(reason: str, joint: str = "because") -> str:
    if reason.startswith(EVEN_THOUGH):
        return reason
    return f"because {reason}" if reason.startswith("of ") else f"{joint} {reason}"


def _joint(feeling: str) -> str:
    """What joins a feeling to its only reason: one is sorry that someone is sad."""
    return "that" if feeling.rpartition(" ")[2] in ("sorry", "glad") else "because"


def labels_called(word: str, looks: Mapping[str, EmotionLook]) -> list[str]:
    """The labels that people mean by a word such as "sad": it is their name, or says their look."""
    meant = ALSO_CALLED.get(word, word)
    return [
        label
        for label, look in looks.items()
        if meant not in ("", "neutral")
        and meant in (label, look.words, look.expression, look.faintly, look.strongly)
    ]


def age_words(age_s: float) -> str:
    """How long ago that is: "2 minutes ago"; empty for what happened just now."""
    if age_s < JUST_NOW_S:
        return ""
    for limit, step, unit, one, several in _AGES:
        # Rounded first, so that 59.7 minutes are an hour.
        rounded = max(round(age_s / step), 1) * step
        if rounded < limit:
            count = round(rounded / unit)
            return one if count == 1 else several.format(count)
    raise ValueError(f"an age of {age_s} s")


def forgiven_words(
    last: Soothed, words: Mapping[str, str], felt: str, intensity: float, asking: str | None
) -> str:
    """How someone made up for what they did: "I was angry because you kicked me. But then you
    said sorry, so I am less angry now.". Empty without words for it.

    `felt` is the feeling, after "I was", and `intensity` what is left of it; `asking` is the name
    of the person who hears it.
    """
    person = None if last.person == asking else last.person
    deed, amends = (_said(words.get(name, ""), person) for name in (last.deed, last.amends))
    if not deed or not amends:
        return ""
    now = f"am not {felt} anymore" if intensity < GONE else f"am less {felt} now"
    return f"I was {felt} because {deed}. But then {amends}, so I {now}."


def _said(words: str, person: str | None) -> str:
    if person is None or is_unnamed(person):
        return _PERSON.sub(lambda found: found[1], words)
    return _PERSON.sub(lambda found: _named(person, found[1]), words)


def _named(person: str, written: str) -> str:
    """A person in the place of "you", "your" or "you are"."""
    pronoun, _, verb = written.partition(" ")
    if verb:
        return f"{person} {VERB_WITH_NAME[verb]}"
    return f"{person}'s" if pronoun == "your" else person


def _reason(cause: Cause, words: Mapping[str, str], needs: Mapping[str, float]) -> str:
    """What follows "because"; empty for what cannot be said."""
    if cause.name in ALWAYS:
        stilled, pressing = ALWAYS[cause.name]
        level = needs.get(cause.name.removeprefix("drive."), 0.0)
        return pressing if level >= PRESSING else stilled
    what = _said(words.get(cause.name, ""), cause.person)
    if not what or cause.lasts or _TIMELESS.search(what):
        return what
    return f"{what} {age_words(cause.age_s)}".rstrip()
