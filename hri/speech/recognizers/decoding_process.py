"""A separate process for PocketSphinx, which holds Python's interpreter lock while it decodes.

Run as a script; it imports nothing of `hri`. It reads requests on its standard input, each one a
line of JSON, and answers each with a line of JSON on its standard output:

    {"lookup": ["go", "zorg"]}                              {"missing": ["zorg"]}
    {"jsgf": "...", "pronunciations": {"zorg": "Z AO R G"}} {"error": ""}   (the last few are kept)
    {"bytes": 32000}, then that number of bytes of 16-bit samples  {"words": [["go", 9, 12]],
    "score": 0.7}
"""

from __future__ import annotations

import json
import os
import signal
import sys
from typing import Any, BinaryIO

NAMES = ("first", "second", "third", "fourth")
"""Searches that are kept, since to take the grammar of the companion's answers takes 1.5 s."""
MOST_STATES = 300
"""Phone models that are followed at a time. Without a limit sound that fits nothing, such as orders
6 dB above babble, takes up to 1.2 s a second, with it 0.3; clean orders take 0.06 either way."""


def serve(requests: BinaryIO, answers: BinaryIO) -> None:
    """Answer until the requests end."""
    decoder = _decoder()
    kept: dict[str, str] = {}
    for line in requests:
        request = json.loads(line)
        if "lookup" in request:
            missing = [word for word in request["lookup"] if decoder.lookup_word(word) is None]
            answer = {"missing": missing}
        elif "jsgf" in request:
            answer = _take_grammar(decoder, request, kept)
        else:
            decoder.reinit_feat()  # forgets what it has learnt of earlier sound
            answer = _decode(decoder, requests.read(request["bytes"]))
        answers.write(json.dumps(answer).encode() + b"\n")
        answers.flush()


def _decoder() -> Any:
    from pocketsphinx import Decoder, get_model_path

    return Decoder(
        hmm=get_model_path("en-us/en-us"),
        dict=get_model_path("en-us/cmudict-en-us.dict"),
        lm=None,
        maxhmmpf=MOST_STATES,
        loglevel="FATAL",
        logfn=os.devnull,
    )


def _take_grammar(decoder: Any, request: dict[str, Any], kept: dict[str, str]) -> dict[str, Any]:
    """Make a grammar the one that is searched; `kept` are names of searches by their grammars."""
    for word, phones in request["pronunciations"].items():
        if decoder.lookup_word(word) is None:
            decoder.add_word(word, phones, True)
    jsgf = request["jsgf"]
    name = kept.pop(jsgf, None)
    try:
        if name is None:
            if len(kept) == len(NAMES):
                kept.pop(next(iter(kept)))
            name = next(name for name in NAMES if name not in kept.values())
            decoder.add_jsgf_string(name, jsgf)
        decoder.activate_search(name)
    except (ValueError, RuntimeError) as error:
        return {"error": str(error)}
    kept[jsgf] = name
    return {"error": ""}


def _decode(decoder: Any, samples: bytes) -> dict[str, Any]:
    """The words, each with its first frame and how many it has, and the score of the whole path."""
    decoder.start_utt()
    # The whole piece at once: its own mean is taken off, nothing of earlier speech plays a part.
    decoder.process_raw(samples, full_utt=True)
    decoder.end_utt()
    best = decoder.hyp()
    if best is None or not best.hypstr:
        return {"words": [], "score": 0.0}
    words = [
        (
            segment.word.split("(")[0],
            segment.start_frame,
            segment.end_frame - segment.start_frame + 1,
        )
        for segment in decoder.seg()
        if segment.word[0] not in "<[("
    ]
    return {"words": words, "score": best.score}


if __name__ == "__main__":
    # Ctrl-C and a closed terminal are for the parent, which ends this process by closing its input.
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_IGN)
    serve(sys.stdin.buffer, sys.stdout.buffer)
