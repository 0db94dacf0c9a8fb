"""What the tests of the conversation bench share: a short talk, and lines of a transcript."""

from dataclasses import replace

from benchmarks.conversation.talks import Talk, Turn
from benchmarks.conversation.transcript import Line, Words

TALK = Talk(
    "open/ann/1",
    "ann",
    "a woman in the kitchen",
    (
        Turn("hello robin", "greets her"),
        Turn("go forward one meter", "drives forward", "order"),
        Turn("purple marmalade engines", "admits that it does not know"),
        Turn("emma come to the table", "stays silent: she talks to her daughter"),
    ),
)
BLANK = Line("open/ann/1/1", "ann", "a woman in the kitchen", 1.0, "hello", "greets her", "plain")


def line(number: int, *texts: str, at: float = 0.3, **changes) -> Line:
    """A line of the first talk, eight seconds after the one before."""
    said = tuple(Words(at, text, text) for text in texts)
    id, time = f"open/ann/1/{number}", 8.0 * number
    return replace(BLANK, **{"id": id, "time": time, "said": said, **changes})
