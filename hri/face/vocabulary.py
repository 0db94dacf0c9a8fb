"""The names everyone uses: ARKit's morph targets, Oculus' visemes, ROS4HRI's expressions."""

from __future__ import annotations

PAIRED = (
    "browDown", "browOuterUp", "cheekSquint", "eyeBlink", "eyeLookDown", "eyeLookIn",
    "eyeLookOut", "eyeLookUp", "eyeSquint", "eyeWide", "mouthDimple", "mouthFrown",
    "mouthLowerDown", "mouthPress", "mouthSmile", "mouthStretch", "mouthUpperUp", "noseSneer",
)  # fmt: skip
"""ARKit targets that exist for the left and the right side; one drawing serves both."""

SINGLE = (
    "browInnerUp", "cheekPuff", "jawForward", "jawLeft", "jawOpen", "jawRight", "mouthClose",
    "mouthFunnel", "mouthLeft", "mouthPucker", "mouthRight", "mouthRollLower", "mouthRollUpper",
    "mouthShrugLower", "mouthShrugUpper", "tongueOut",
)  # fmt: skip
"""ARKit targets of the whole face."""

SIDES = ("Left", "Right")
"""The sides of the face itself: its left is on the viewer's right."""

ARKIT = tuple(sorted([name + side for name in PAIRED for side in SIDES] + list(SINGLE)))
"""The 52 blend shape names of Apple's ARFaceAnchor."""

VISEMES = (
    "sil", "PP", "FF", "TH", "DD", "kk", "CH", "SS", "nn", "RR", "aa", "E", "ih", "oh", "ou",
)  # fmt: skip
"""The 15 visemes of Oculus lip sync."""

RHUBARB = {
    "A": "PP", "B": "SS", "C": "E", "D": "aa", "E": "oh", "F": "ou", "G": "FF", "H": "nn",
    "X": "sil",
}  # fmt: skip
"""The mouth shapes of Rhubarb Lip Sync by the viseme that looks like them. "E" alone is taken for
the viseme of that name wherever a viseme is wanted; in a track of Rhubarb it is "oh"."""

EXPRESSIONS = (
    "neutral", "angry", "sad", "happy", "surprised", "disgusted", "scared", "pleading",
    "vulnerable", "despaired", "guilty", "disappointed", "embarrassed", "horrified", "skeptical",
    "annoyed", "furious", "suspicious", "rejected", "bored", "tired", "asleep", "confused",
    "amazed", "excited",
)  # fmt: skip
"""The labels of ROS4HRI's hri_msgs/Expression."""

STATES = ("listening", "thinking", "error")
"""States of a robot with their own look; "asleep" is one of them too."""

LABELS = (*EXPRESSIONS, *STATES)
"""Every expression that a complete face has."""

AFFECT: dict[str, tuple[float, float]] = {
    "neutral": (0.0, 0.0), "happy": (0.85, 0.4), "excited": (0.8, 0.85), "amazed": (0.6, 0.75),
    "surprised": (0.2, 0.85), "horrified": (-0.4, 0.92), "scared": (-0.55, 0.7),
    "angry": (-0.75, 0.6), "furious": (-0.85, 0.9), "annoyed": (-0.5, 0.35),
    "disgusted": (-0.75, 0.2), "despaired": (-0.9, -0.2), "sad": (-0.75, -0.35),
    "disappointed": (-0.55, -0.25), "bored": (-0.45, -0.55), "tired": (-0.25, -0.75),
}  # fmt: skip
"""Valence and arousal of the expressions that a mood alone can have, -1 to 1: placed on the circle
of J. A. Russell, "A circumplex model of affect" (1980); labels that he does not have lie between
their neighbors. The others, such as guilty or confused, are about something, and no mood."""

REQUIRED = (
    "neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted", "asleep",
)  # fmt: skip
"""What every face can show."""

MOTIONS = ("headX", "headY", "headRoll", "headSize")
"""Channels that move the whole head: right, down, clockwise as seen, larger."""

TURNS = ("headYaw", "headPitch")
"""Channels that turn a face with a [head] table: to the viewer's right, and up."""

CORRECTIVE = "+"
"""Stands in the name of a drawing that shows two targets at once: `mouthSmile+jawOpen`."""


def sides_of(target: str) -> tuple[str, ...]:
    """The channels one drawing feeds: itself, or its left and right halves."""
    return tuple(target + side for side in SIDES) if target in PAIRED else (target,)
