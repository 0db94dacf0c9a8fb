"""The same grammar for hassil, the sentence matcher of Home Assistant."""

from __future__ import annotations

from collections.abc import Callable

import hassil

from hri.speech.grammar import Grammar


def finder(grammar: Grammar) -> Callable[[str], object]:
    """What hassil makes of a sentence; None when it is not of the grammar.

    Apart from tags, both write rules alike. Each public rule is an intent, which is how hassil is
    used and where it is at its fastest.
    """
    lines = grammar.flat_jsgf().replace(";", "").splitlines()
    rules = dict(line.split(" = ", 1) for line in lines if " = " in line)
    commands = rules["public <sentence>"].split(" | ")
    intents = hassil.Intents.from_dict(
        {
            "language": "en",
            "intents": {name: {"data": [{"sentences": [rules[name]]}]} for name in commands},
            "expansion_rules": {name.strip("<>"): body for name, body in rules.items()},
        }
    )
    return lambda sentence: hassil.recognize(sentence, intents)
