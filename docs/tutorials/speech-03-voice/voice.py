"""Says a sentence, is interrupted, and says it again with other feelings."""

from hri.behavior import Context
from hri.core import Clock, EmotionState, EventBus, RealClock
from hri.emotion.display import load_display
from hri.hal import ResourceManager, Synthesizer
from hri.speech import Priority, Voice

SENTENCE = "I have found the red ball. Shall I bring it to you?"
TICK = 0.05


def show_times(voice: Synthesizer) -> None:
    """Print when each word of a sentence is said, and the sounds of the first."""
    speech = voice.synthesize(SENTENCE)
    for word in speech.words[:4]:
        print(f"{word.text} {word.start:.2f} to {word.end:.2f}", flush=True)
    print(" ".join(phoneme.name for phoneme in speech.phonemes[:6]), flush=True)


def show_feelings(voice: Synthesizer) -> None:
    """Print how long the sentence lasts with an emotion."""
    display = load_display()
    for emotion in ("joy", "sadness"):
        state = EmotionState(emotion, 1.0, 0.0, 0.0, 0.0, {emotion: 1.0})
        prosody = display.prosody(state)
        speech = voice.synthesize(SENTENCE, prosody)
        print(f"{emotion}: {speech.duration:.1f} s, pitch {prosody.pitch:.2f}", flush=True)


def interrupt(resources: ResourceManager, clock: Clock) -> None:
    """Say the sentence, and something that cannot wait in the middle of it."""
    voice = Voice()
    voice.start(Context(clock, EventBus(clock), resources))
    sentence = voice.say(SENTENCE)
    for tick in range(round(4.0 / TICK)):
        if tick == round(1.0 / TICK):
            voice.say("Watch out!", Priority.ALARM)
        clock.advance(TICK)
        voice.compute(clock.now(), TICK)
    voice.stop()
    print(f"cut: {sentence.was_cut}, heard: {sentence.heard}", flush=True)


def main(clock: Clock) -> None:
    """Print the voice's description of itself."""
    with ResourceManager.load("resource-config", clock) as resources:
        voice = resources.obtain("voice", Synthesizer)
        show_times(voice)
        show_feelings(voice)
        interrupt(resources, clock)


if __name__ == "__main__":
    main(RealClock())
