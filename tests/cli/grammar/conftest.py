from __future__ import annotations

from pathlib import Path

import pytest

from hri.cli.main import main
from hri.speech.pronunciation.lexicon import VARIABLE


@pytest.fixture(autouse=True)
def own_folders(tmp_path, monkeypatch):
    """Nobody's lexicon and nobody's cache."""
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def write(tmp_path):
    """Writes the rules of a grammar file, the header before them; returns its path."""

    def write(rules: str, name: str = "test") -> Path:
        path = tmp_path / f"{name}.jsgf"
        path.write_text(f"#JSGF V1.0;\ngrammar {name};\n{rules}", encoding="utf-8")
        return path

    return write


@pytest.fixture
def grammar():
    """Runs `hri grammar` with some words; returns its exit status."""
    return lambda *words: main(["grammar", *map(str, words)])


@pytest.fixture
def companion_path() -> Path:
    return Path(__file__).resolve().parents[3] / "grammars" / "companion.jsgf"
