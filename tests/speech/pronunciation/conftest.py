from __future__ import annotations

import pytest

from hri.speech.pronunciation.lexicon import VARIABLE


@pytest.fixture(autouse=True)
def own_folders(tmp_path, monkeypatch):
    """Nobody's lexicon and nobody's cache."""
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
