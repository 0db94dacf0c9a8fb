"""Which models the engines of speech take."""

import pytest

from hri.core.errors import HriError
from hri.core.models import Catalog, bring
from hri.speech.engine_models import MODELS, find_vosk
from hri.speech.recognizers import vosk


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.delenv(vosk.VARIABLE, raising=False)
    monkeypatch.setattr(vosk, "DEFAULT_FOLDER", tmp_path / "vosk")
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    return tmp_path


def test_vosk_takes_a_model_that_was_fetched_and_no_other(home):
    assert find_vosk() is None
    other, model = home / "other", home / "model"
    other.mkdir()
    (model / "conf").mkdir(parents=True)
    bring("another", other)
    assert find_vosk() is None
    folder = bring("small", model)
    assert find_vosk() == vosk.find_model() == folder


def test_an_unknown_model_is_answered_with_the_nearest_one():
    catalog = Catalog(MODELS)
    with pytest.raises(HriError, match=r'did you mean "vosk-model-small-en-us-0\.15"'):
        catalog.find("vosk-model-small-en-us")
    with pytest.raises(HriError, match="hri models fetch vosk-model-small-ko"):
        catalog.find("vosk-model-small-ko-0.22")
    with pytest.raises(HriError, match=r"comes with its package - pip install hri"):
        catalog.download("ctc")
