"""The cost of the natural voice, and a digest of its speech: a script for a separate process.

    python natural_voice_process.py TEXT

prints JSON: seconds until it is ready, by how many bytes the process has grown when it has said the
text, processor seconds for each second of sound, and a digest of the samples. It imports nothing of
the voice before it begins to count.
"""

from __future__ import annotations

import hashlib
import json
import os
import sys
import time
from pathlib import Path

from hri.core.clock import FakeClock
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.synthesizers.espeak import EspeakVoice

STATUS = Path("/proc/self/statm")
TIMES = 5


def main(text: str) -> None:
    """Open the voice, let it speak, print the figures."""
    with ResourceManager((), FakeClock()) as resources:
        other = EspeakVoice(Description("other", "Hri.EspeakVoice"), resources)
        other.activate()  # the robot has it anyhow
        before, begun = _resident(), time.perf_counter()
        from hri.speech.synthesizers.natural import NaturalVoice

        voice = NaturalVoice(Description("voice", "Hri.NaturalVoice"), resources)
        voice.activate()
        ready = time.perf_counter() - begun
        first = voice.synthesize(text)
        worked = time.process_time()
        made = sum(voice.synthesize(text).duration for _ in range(TIMES))
        figures = {
            "ready_s": ready,
            "factor": (time.process_time() - worked) / made,
            "bytes": _resident() - before,
            "digest": hashlib.sha256(first.samples.tobytes()).hexdigest(),
        }
        voice.deactivate()
        other.deactivate()
    print(json.dumps(figures))


def _resident() -> int:
    """Bytes of memory in use; 0 where the system does not report them."""
    if not STATUS.exists():
        return 0
    return int(STATUS.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


if __name__ == "__main__":
    main(sys.argv[1])
