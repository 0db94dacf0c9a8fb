"""Hears sentences that the robot's own voice speaks: no microphone, and no air in between."""

from pathlib import Path

from hri.core import Clock, RealClock, Utterance
from hri.hal import Recognizer, ResourceManager, Synthesizer
from hri.speech import load_grammar
from hri.speech.hearing import hear

LAMP = Path(__file__).parents[1] / "speech-01-grammar" / "lamp.jsgf"
SENTENCES = (
    "turn off the light",
    "make it blue",
    "did you see the game last night",
)


def main(clock: Clock) -> None:
    """Print what is heard of each sentence."""
    lamp = load_grammar(LAMP)
    with ResourceManager.load("resource-config", clock) as resources:
        voice = resources.obtain("voice", Synthesizer)
        recognizer = resources.obtain("recognizer", Recognizer)
        recognizer.start(lamp)
        for sentence in SENTENCES:
            speech = voice.synthesize(sentence)
            for heard in hear(speech.samples, speech.rate, recognizer, lamp):
                if isinstance(heard, Utterance):
                    print(f"{heard.rule} {dict(heard.tags)}", flush=True)
                else:
                    print(f"rejected: {heard.reason}", flush=True)


if __name__ == "__main__":
    main(RealClock())
