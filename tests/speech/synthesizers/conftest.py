from __future__ import annotations

import pytest

from hri.speech.pronunciation.lexicon import load_lexicon


@pytest.fixture(scope="session")
def reader():
    """What the natural voice reads with."""
    pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    from hri.speech.synthesizers.natural import _loaded
    from hri.speech.synthesizers.natural_text import Reader

    _, _, pronouncer = _loaded("")
    return Reader(pronouncer, load_lexicon())
