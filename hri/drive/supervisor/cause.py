"""Why the base stands: a name for programs, a sentence for people."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Cause:
    """Why the base stopped, or does not set off."""

    name: str
    """One word: "cliff", "bump", "timeout"; the table is in docs/safety.md."""
    because: str
    """The rest of the sentence: "my left cliff sensor sees an edge"."""
    said: float | None = None
    """Of a stop that a person said: when the words ended, in seconds of the program's clock."""

    @property
    def words(self) -> str:
        """What the robot says when it is asked."""
        return f"I stopped because {self.because}"


DONE = Cause("done", "I was asked to")
POWER_UP = Cause("power-up", "I was switched on just now")
LOST_PORT = Cause("lost port", "I lost the line to my wheels")
JAMMED = Cause("jammed", "the line to my wheels takes no more")
SILENT_BASE = Cause("stale", "my base says nothing, so I cannot know what it senses")
GARBLED = Cause("garbled", "much of what my base says is damaged - see the line to it")
UNSTEADY = Cause("unsteady", "my base falls silent again and again - see the line to it")
FROZEN = Cause("frozen", "the program that watches over me stood still")
NO_WATCHDOG = Cause("watchdog", "the watchdog that watches over my supervisor fell silent")
NO_SUPERVISOR = Cause("supervisor", "my supervisor was gone")
NO_PROGRAM = Cause("program", "the program that drives me is gone")
COMING = Cause("somebody comes", "someone comes toward me")
OBSTACLE = Cause("obstacle", "something is in the way")
DOCKING = Cause("docking", "I go to my dock by myself - release me to drive again")
DISOBEYS = Cause("disobeys", "my base no longer obeys: its button, its charger or its own guard")


def late(seconds: float) -> Cause:
    """Delay, seconds, of the reported motion after its command."""
    return Cause("late", f"what my base reports is {seconds:.2f} s late")


def spelled(place: str) -> str:
    """A place as people say it: "front_left" is "front left"."""
    return place.replace("_", " ")
