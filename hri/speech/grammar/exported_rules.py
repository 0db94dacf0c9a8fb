"""The parts that other grammars offer: what an author may import instead of writing it."""

from __future__ import annotations

from contextlib import suppress

from hri.core import paths
from hri.core.errors import HriError
from hri.speech.grammar.encoding import read_source
from hri.speech.grammar.jsgf import read_jsgf

MOST_FILES = 100
"""Grammars that are looked into."""


def exported_rules() -> dict[str, str]:
    """The public rules with the mark "part", by name: "small" is "numbers.small".

    Those of the folders of HRI_PATH come before the built-in ones. Grammars that cannot be read
    offer nothing.
    """
    offered: dict[str, str] = {}
    suffixes = paths.suffixes("grammars")
    files = [name for name in paths.names("grammars") if name.endswith(suffixes)]
    for file in files[:MOST_FILES]:
        with suppress(HriError):
            path = paths.find("grammars", file)
            document = read_jsgf(read_source(path).text, path)
            for rule in document.rules:
                if rule.is_public and any(tag.name == "part" for tag in rule.doc.tags):
                    offered.setdefault(rule.name, f"{path.stem}.{rule.name}")
    return offered
