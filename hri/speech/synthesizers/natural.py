"""A natural voice: a small network that speaks English, with the time of every phoneme and word."""

from __future__ import annotations

import json
from functools import lru_cache
from pathlib import Path
from typing import Any

from hri.core.errors import NotAvailable
from hri.hal.synthesizer import Skill
from hri.speech.pronunciation.lexicon import Lexicon
from hri.speech.synthesizers.natural_network import RATE, Network
from hri.speech.synthesizers.natural_text import Reader
from hri.speech.synthesizers.network_voice import Engine, NetworkVoice, gain_of
from hri.speech.synthesizers.voice_names import HEART

NATIVE_WPM = 195.0
"""Words a minute at its usual pace, over a page of a story."""
TRIAL = "ðˈɪs ɪz hˌW lˈWd ˌI spˈik."
"""What is said once, to learn how loud a model is."""


class NaturalVoice(NetworkVoice):
    """Speaks some fifty times faster than real time; the same text gives the same samples.

    Says the words of the user's lexicon, and of the file that `lexicon` names, as they are written
    there. `model` is the file of another voice of the same kind.
    """

    parameters = ("model", "rate_wpm", "lexicon")
    skills = frozenset(Skill)

    @property
    def _name(self) -> str:
        return self.description.text("model") or HEART

    def _made(self, lexicon: Lexicon) -> Engine:
        network, gain, g2p = _loaded(self.description.text("model"))
        return Engine(network, Reader(g2p, lexicon), RATE, gain, NATIVE_WPM)


@lru_cache(maxsize=4)
def _loaded(model: str) -> tuple[Network, float, Any]:
    """A network, its gain, and what makes symbols of words.

    Raises NotAvailable without the package or the model.
    """
    try:
        from hibari.dsp import synth
        from hibari.tts import ASSETS

        from hri.speech.synthesizers.natural_dictionaries import Pronouncer
    except ImportError as error:
        what = "the natural voice is not installed"
        raise NotAvailable(f"{what} ({error}) - pip install hibari-tts") from error
    assets = Path(ASSETS)
    vocabulary = json.loads((assets / "vocab.json").read_text(encoding="utf-8"))
    network = Network(Path(model) if model else assets / "hibari.onnx", vocabulary, synth)
    return network, gain_of(network, TRIAL, RATE, model), Pronouncer()
