"""The models of the speech engines."""

from __future__ import annotations

import importlib.util
from pathlib import Path

from hri.core.errors import NotAvailable
from hri.core.models import Download, Packaged, fetched, models_folder
from hri.speech.recognizers.ctc.weights import find_weights


def find_pocketsphinx() -> Path:
    """The English model inside the installed PocketSphinx, which is not imported for it.

    Raises NotAvailable where it is not installed.
    """
    package = importlib.util.find_spec("pocketsphinx")
    for folder in (package.submodule_search_locations or ()) if package else ():
        model = Path(folder, "model", "en-us")
        if model.is_dir():
            return model
    raise NotAvailable(
        "pocketsphinx is not installed (Python 3.14 has no wheels of it) - use another recognizer"
    )


_VOSK = "https://alphacephei.com/vosk/models"

PACKAGED = (
    Packaged("ctc", "English phones, the default engine", "Apache-2.0", "hri", find_weights),
    Packaged("pocketsphinx", "English", "BSD", "pocketsphinx", find_pocketsphinx),
)
DOWNLOADS = (
    Download(
        "vosk-model-small-en-us-0.15",
        "Vosk, English",
        "Apache-2.0",
        f"{_VOSK}/vosk-model-small-en-us-0.15.zip",
        41_205_931,
        "30f26242c4eb449f948e42cb302dd7a686cb29a3423a8367f99ff41780942498",
    ),
    Download(
        "vosk-model-en-us-0.22-lgraph",
        "Vosk, English, more exact and slower",
        "Apache-2.0",
        f"{_VOSK}/vosk-model-en-us-0.22-lgraph.zip",
        130_557_655,
        "d9838b4aaa82a75c4a17f5aca300eaca129aaab2a7cbf951bafbb500eb9c4334",
    ),
    Download(
        "vosk-model-small-ko-0.22",
        "Vosk, Korean",
        "Apache-2.0",
        f"{_VOSK}/vosk-model-small-ko-0.22.zip",
        86_914_329,
        "eea36124087fed26c59996a4761519458e3bd185e8ea9d9865ad8760c4a1d989",
    ),
)
MODELS = (*PACKAGED, *DOWNLOADS)


def find_vosk() -> Path | None:
    """The first fetched model that Vosk can load; None when there is none."""
    folders = (models_folder() / name for name in fetched())
    return next((folder for folder in folders if (folder / "conf").is_dir()), None)
