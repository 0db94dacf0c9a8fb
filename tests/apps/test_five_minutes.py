"""Five minutes with one person, as they are said: skills, memory, feelings and the base."""

from pathlib import Path

import pytest

from hri.core import FakeClock
from hri.robot import Robot
from hri.testing.dialogues import TYPED, played, read_dialogues

VISIT = """
```dialogue
you: hello
robot: Good morning! *
you: my name is Anna
robot: *
robot: May I remember you, Anna?
you: yes
robot: Thank you, Anna. I'll remember you.
robot: What do you like?
you: i feel a bit tired today
robot: *
you: remind me to call my mom
robot: When?
you: this evening at six
robot: Okay, I'll remind you to call your mom at 6:00 PM.
you: tell me a joke
robot: *
you: what day is tomorrow
robot: Tomorrow is Thursday, June 19.
you: what's seven times eight
robot: 7 times 8 is 56.
you: and minus six
robot: 56 minus 6 is 50.
you: how do you spell beautiful
robot: B, E, A, U, T, I, F, U, L.
you: speak a little slower please
robot: Okay, I'm talking slower now.
you: quiz me
robot: Three questions*
robot: *: *, * or *?
you: i don't know
robot: *The answer is *.
robot: *: *, * or *?
you: never mind
robot: Okay, never mind.
you: i like jazz
robot: *
you: what do you know about me
robot: You're Anna. You like jazz.
you: let's play charades
robot: Look at my face!
robot: How do I feel?
you: happy
robot: *I was *
robot: And how do I feel now?
you: never mind
robot: Okay, never mind.
you: set a tea timer for ten seconds
robot: Okay, 10 seconds for the tea.
robot: Ring, ring! Your tea timer is over.
you: thank you
robot: *
you: roll two dice
robot: I rolled * and *.
you: how do you feel
robot: *
you: why
robot: *
you: go forward half a meter
robot: Going forward*
you: stop
robot: I stopped.
you: what did i want to do
robot: At 6:00 PM you want to call your mom.
you: cancel that reminder
robot: Okay, I won't remind you to call your mom.
you: goodbye
robot: *
```
"""


@pytest.mark.slow
def test_five_minutes_with_anna(tmp_path: Path) -> None:
    page = tmp_path / "visit.md"
    page.write_text(VISIT)
    (dialogue,) = read_dialogues(page)
    robot = Robot("companion", "simulated", clock=FakeClock(), devices=TYPED, seed=1)
    assert dialogue.mistake(played(robot, dialogue)) == ""
