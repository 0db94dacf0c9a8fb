"""How it sounds: parameters of the behavior Hri.Voice, until the robot is started again."""

from hri.speech import Voice
from hri.task import TaskContext, immediate

USUAL_LEVEL, MOST = 5, 10
"""Of the volume, from 1; the usual one changes nothing."""
SOFTEST, LOUDEST = 1 / USUAL_LEVEL, MOST / USUAL_LEVEL
LOUDER = 1.4
"""Factor of a step."""
SLOWEST, FASTEST = 0.6, 1.6
FASTER = 1.2
VOICES = ("deep", "bright", "gentleman", "child", "robot")
"""In the order in which "another voice" takes them."""
FIRST = "voice.first"
"""Slot of the board with the voice that it had before another was asked for."""


@immediate
def speak_louder(context: TaskContext, steps: float) -> str:
    """Speak louder by some steps, or quieter where they are less than none."""
    voice = context.behavior(Voice)
    volume = _within(voice.volume * LOUDER**steps, SOFTEST, LOUDEST)
    if volume == voice.volume:
        return "I can't talk any louder." if steps > 0 else "I can't talk any quieter."
    voice.set_parameter("volume", volume)
    return "Okay, I'm louder now." if steps > 0 else "Okay, I'm quieter now."


@immediate
def set_volume(context: TaskContext, level: float) -> str:
    """Speak as loud as a level says."""
    if not 1 <= level <= MOST:
        return f"My volume goes from 1 to {MOST}."
    context.behavior(Voice).set_parameter("volume", level / USUAL_LEVEL)
    return f"Okay, my volume is {level:g} now."


@immediate
def speak_faster(context: TaskContext, steps: float) -> str:
    """Speak faster by some steps, or slower where they are less than none."""
    voice = context.behavior(Voice)
    rate = _within(voice.rate * FASTER**steps, SLOWEST, FASTEST)
    if rate == voice.rate:
        return "I can't talk any faster." if steps > 0 else "I can't talk any slower."
    voice.set_parameter("rate", rate)
    return "Okay, I'm talking faster now." if steps > 0 else "Okay, I'm talking slower now."


@immediate
def change_voice(context: TaskContext, voice: str) -> None:
    """Speak in a voice of this name, in another one, or in the usual one."""
    mouth, first = context.behavior(Voice), context.board.slot(FIRST)
    if first.value is None:
        first.set(mouth.voice, context.clock.now())
    if voice == "other":
        place = VOICES.index(mouth.voice) + 1 if mouth.voice in VOICES else 0
        voice = VOICES[place % len(VOICES)]
    mouth.set_parameter("voice", first.value if voice == "usual" else voice)


def _within(value: float, least: float, most: float) -> float:
    return min(max(value, least), most)
