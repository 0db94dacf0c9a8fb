"""The names everybody uses: ARKit's morph targets, Oculus' visemes, ROS4HRI's expressions."""

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

EXPRESSIONS = (
    "neutral", "angry", "sad", "happy", "surprised", "disgusted", "scared", "pleading",
    "vulnerable", "despaired", "guilty", "disappointed", "embarrassed", "horrified", "skeptical",
    "annoyed", "furious", "suspicious", "rejected", "bored", "tired", "asleep", "confused",
    "amazed", "excited",
)  # fmt: skip
"""The labels of ROS4HRI's hri_msgs/Expression."""

REQUIRED = (
    "neutral", "happy", "sad", "angry", "surprised", "scared", "disgusted", "asleep",
)  # fmt: skip
"""What every face can show."""

MOTIONS = ("headX", "headY", "headRoll", "headSize")
"""Channels that move the whole head: right, down, clockwise as seen, larger."""


def sides_of(target: str) -> tuple[str, ...]:
    """The channels one drawing feeds: itself, or its left and right halves."""
    return tuple(target + side for side in SIDES) if target in PAIRED else (target,)
