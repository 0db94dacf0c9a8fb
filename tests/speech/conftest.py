from __future__ import annotations

from pathlib import Path

import pytest

from hri.core.clock import FakeClock
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar import Grammar, load_grammar, parse

HOUSE = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def companion() -> Grammar:
    grammar = load_grammar(HOUSE / "grammars" / "companion.jsgf")
    parse(grammar, "")  # Prepares it, so that no test that measures a time does.
    return grammar


@pytest.fixture
def write(tmp_path):
    """Writes the rules of a grammar file, the header before them; returns its path."""

    def write(rules: str, name: str = "test") -> Path:
        path = tmp_path / f"{name}.jsgf"
        path.write_text(f"#JSGF V1.0;\ngrammar {name};\n{rules}", encoding="utf-8")
        return path

    return write


@pytest.fixture
def resources():
    manager = ResourceManager((), FakeClock())
    yield manager
    manager.close()
