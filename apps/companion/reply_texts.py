"""What a `[reply.RULE]` table may say, and when: `say` and the lists beside it.

    say = "Hi there!"                         # or a list: ["Hi there!", "Hello!"]
    again = ["Hello again!"]                  # it has answered the same within five minutes
    worn = ["You're exaggerating."]           # its stimulus has come so often that it wears off
    feeling.angry = ["Hello."]                # it is angry: instead of the others
    hour.morning = ["Good morning!"]          # in the morning: beside `say`
    personality.shy = ["Oh. Hi."]             # it is shy: beside `say`

Which one is said at a moment is decided in `hri.conversation.choosing`.
"""

from __future__ import annotations

from collections.abc import Collection

from hri.conversation import PARTS_OF_DAY, Texts, Wording, check_text
from hri.core import Table, did_you_mean
from hri.emotion import KNOWN_FEELINGS


def read_wording(entry: Table, braces: Collection[str], personalities: Collection[str]) -> Wording:
    """The texts of a reply; `braces` are the names that may stand in braces.

    Raises AuthoringError for a name that is not known, and for a text that cannot be filled in.
    """
    return Wording(
        _texts(entry, "say", braces),
        _texts(entry, "again", braces),
        _texts_by_name(entry, "feeling", KNOWN_FEELINGS, braces),
        _texts_by_name(entry, "hour", PARTS_OF_DAY, braces),
        _texts_by_name(entry, "personality", personalities, braces),
        _texts(entry, "worn", braces),
    )


def _texts(table: Table, key: str, braces: Collection[str]) -> Texts:
    """A text, or a list of texts; an empty one says nothing."""
    is_list = isinstance(table.data.get(key), list)
    texts = table.strings(key) if is_list else [table.string(key, "")]
    for text in texts:
        check_text(table, text, braces, key)
    return tuple(text for text in texts if text)


def _texts_by_name(
    entry: Table, key: str, known: Collection[str], braces: Collection[str]
) -> dict[str, Texts]:
    given = entry.table(key, optional=True)
    for name in given.keys():  # noqa: SIM118 - a Table is not a dictionary
        if name not in known:
            raise given.error(name, f'unknown {key} "{name}"', did_you_mean(name, known))
    return {name: _texts(given, name, braces) for name in given.data}
