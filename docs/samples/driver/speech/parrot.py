"""Speaks sentences, and lets the recognizer hear what the voice said: no air in between."""

from hri.core import Clock, RealClock
from hri.hal import Recognizer, ResourceManager, Synthesizer
from hri.hal.drivers.resampling import resample
from hri.speech import load_grammar

SENTENCES = ("hello robot", "go forward two meters", "how are you")


def main(clock: Clock) -> None:
    """Print what was said and what was heard of it."""
    with ResourceManager.load("resource-config", clock) as resources:
        voice = resources.obtain("voice", Synthesizer)
        recognizer = resources.obtain("recognizer", Recognizer)
        recognizer.start(load_grammar("companion"))
        end = 0.0
        for sentence in SENTENCES:
            speech = voice.synthesize(sentence)
            end += speech.duration
            samples = resample(speech.samples, speech.rate, recognizer.rate)
            segments = [*recognizer.listen(samples, end), *recognizer.flush()]
            heard = " ".join(recognizer.decode(segment).text for segment in segments)
            print(f"said {sentence!r}, heard {heard!r}", flush=True)


if __name__ == "__main__":
    main(RealClock())
