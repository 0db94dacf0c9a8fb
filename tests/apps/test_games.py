"""Games of the companion that watch the head: Simon says, and the mirror."""

import pytest

from hri.core import FakeClock
from hri.core.models import folder_of
from hri.robot import Robot
from hri.robot.verbs import SHOWN
from hri.speech.recognizers.typed import TypedRecognizer
from hri.testing import live_for
from hri.testing.dialogues import TYPED
from hri.vision.face_models import FACE, MESH
from tests.apps.test_companion import SEEING, SMALL_SCREEN

DEEDS = {"nod your head": "head.nodded", "shake your head": "head.shaken"}


def ordered(said):
    """What the last order of Simon says asks for."""
    return next((deed for words, deed in DEEDS.items() if said.lower().endswith(f"{words}!")), "")


def played(line, play):
    """What the robot says after a line that begins a game.

    `play` says what the person does then, a gesture such as `head.nodded`, or a line to type; the
    game is over when it says None.
    """
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=TYPED, seed=1)
    keyboard = robot.resources.obtain("recognizer", TypedRecognizer)
    said = []

    def do(deed):
        if deed.startswith("head."):
            robot.events.raise_event(deed, person="")
        elif deed:
            keyboard.type_line(deed, robot.clock.now())

    def respond(event):
        said.append(event.properties["text"])
        deed = play(said[-1])
        if deed is None:
            robot.finish()
        else:
            robot.clock.call_at(event.time + 1.0, lambda: do(deed))

    robot.events.subscribe("speech.finished", respond)
    robot.clock.call_at(1.0, lambda: do(line))
    robot.live_until_over(*robot.app.load_tasks())
    return said


def play_simon(obeys):
    """What is said when all those orders are obeyed."""

    def play(words):
        order = ordered(words)
        return None if not order else order if obeys(words) else ""

    return played("let's play simon says", play)


def test_who_does_what_simon_says_alone_makes_no_mistake():
    said = play_simon(lambda words: "Simon says: " in words)
    assert said[5].endswith("The game is over, and you made no mistake!")
    assert sum("Simon says: " in words for words in said) == 3
    assert sum("Well done" in words for words in said) == 2


def test_who_does_all_that_is_said_makes_two_mistakes():
    said = play_simon(lambda words: True)
    assert said[5].endswith("You made 2 mistakes, and I had fun!")
    assert sum("Simon didn't say that" in words for words in said) == 2


def test_simon_says_ends_when_no_gesture_can_be_seen():
    said = play_simon(lambda words: False)
    assert said[-1].startswith("I can't see your head move.")


@pytest.mark.parametrize(
    ("line", "last"),
    [("i give up", "Okay, we can play again later."), ("what time is it", "It's 10:00 AM.")],
)
def test_words_end_simon_says_and_get_their_answer(line, last):
    said = played("let's play simon says", lambda words: line if ordered(words) else None)
    assert said[1:] == [last]


def test_the_mirror_ends_when_nothing_is_seen_for_long():
    said = played("copy me", lambda words: "" if "Nod" in words else None)
    assert said[1:] == ["I see nothing more to copy. That was fun!"]


@pytest.mark.skipif(
    not (folder_of(FACE.name) / MESH.name).is_file(), reason="no face mesh: hri models fetch face"
)
def test_the_mirror_smiles_while_the_person_smiles():
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=(SMALL_SCREEN,), seed=1)
    robot.visitor.say("copy me", after=6.0)
    robot.events.subscribe("speech.finished", lambda event: robot.visitor.smile(after=1.0))
    shown = {}

    def note(time=0.0):
        expression = robot.board.slot(SHOWN).value
        shown[time] = expression and expression.label
        robot.clock.call_at(time + 0.1, lambda: note(time + 0.1))

    note()
    events = live_for(robot, 15.0, *robot.app.load_tasks())
    began, over = (
        next(event.time for event in events if event.name == name)
        for name in ("person.expressed", "person.relaxed")
    )
    assert 1.0 < over - began < 3.0
    assert {label for time, label in shown.items() if began + 0.2 < time < over - 0.1} == {"happy"}
    assert not any(label for time, label in shown.items() if time > over + 0.2)


def test_the_mirror_nods_when_the_person_nods():
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=SEEING, seed=1)
    robot.visitor.say("copy me", after=1.0)
    robot.events.subscribe("speech.finished", lambda event: robot.visitor.nod(after=0.5))
    events = live_for(robot, 8.0, *robot.app.load_tasks())
    assert [event.properties["name"] for event in events if event.name == "gesture.ended"] == [
        "nod"
    ]
