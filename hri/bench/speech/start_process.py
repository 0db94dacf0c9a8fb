"""What the default engine takes before it can hear: a script for a separate process.

    python start_process.py GRAMMAR [WAV ...]

prints JSON: seconds until it is ready, and by how many bytes the process has grown then, and after
it has heard the files. It imports nothing of the bench, so that nothing of the engine is there
before it is asked for.
"""

from __future__ import annotations

import json
import os
import sys
import time
import wave
from pathlib import Path

import numpy as np

from hri.core.clock import RealClock
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.grammar import load_grammar

STATUS = Path("/proc/self/statm")


def main(path: str, *wavs: str) -> None:
    """Start the engine, let it hear, print the figures."""
    grammar = load_grammar(Path(path))
    before, begun = _resident(), time.perf_counter()
    from hri.speech.recognizers.automatic import AutomaticRecognizer

    with ResourceManager((), RealClock()) as resources:
        engine = AutomaticRecognizer(Description("recognizer", "Hri.Recognizer"), resources)
        engine.activate()
        engine.start(grammar)
        figures = {"ready_s": time.perf_counter() - begun, "ready_bytes": _resident() - before}
        for wav in wavs:
            with wave.open(wav) as file:
                samples = np.frombuffer(file.readframes(file.getnframes()), np.int16)
            pieces = [*engine.listen(samples, len(samples) / engine.rate), *engine.flush()]
            for piece in pieces:
                engine.decode(piece)
        figures["hearing_bytes"] = _resident() - before
        engine.deactivate()
    print(json.dumps(figures))


def _resident() -> int:
    """Bytes of memory in use; 0 where that is not told."""
    if not STATUS.exists():
        return 0
    return int(STATUS.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


if __name__ == "__main__":
    main(*sys.argv[1:])
