"""Whose turn it is to begin: when the robot may say something that nobody asked for just now.

It never talks into a sentence or a question. With small talk it also waits for the end of a
dialogue or a drive, and says nothing after a farewell, at night, or when it did not understand what
people said last. News that someone waits for come sooner, and an alarm comes at any hour.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum

NEVER = -math.inf

CALM_SECONDS = 7.0
"""After the last word of anyone."""
TENDER_SECONDS = 60.0
"""After it said something tender: who told it of a loss does not want to be asked about dinner."""
COMPANY_SECONDS = 45.0
"""How long after the last words someone who is seen counts as company."""
UNSEEN_SECONDS = 20.0
"""The same for someone who is not seen."""
BETWEEN_SECONDS = 40.0
"""From one of its questions to the next."""
FAREWELL_SECONDS = 20.0
"""After a farewell, and for as long as no one says anything else."""
DIALOGUE_SECONDS = 20.0
"""How long a dialogue may go on after a question of a task, while that thinks."""
MURMUR_AFTER_SECONDS = 60.0
"""After the last word of anyone, before it hums to itself."""
ABOUT_SECONDS = 900.0
"""How long after the last words someone may still be about."""
NIGHT = (22, 6)
"""Hours of the day at which the night begins and ends."""
BREATH_SECONDS = 1.5
"""After the last word of anyone, also for news."""
GIVES_WAY_SECONDS = 0.3
"""Seconds after its beginning in which whoever begins to speak still has the floor first."""


class Importance(IntEnum):
    """How much something that nobody asked for just now matters."""

    CHAT = 0
    """It passes the time."""
    NEWS = 1
    """Someone will want to know, once they are awake and not talking."""
    ALARM = 2
    """Someone wanted to be told at this time, whatever else is."""


@dataclass(frozen=True, slots=True)
class Scene:
    """How things stand; times are seconds of the clock."""

    now: float
    hour: int = 12
    """Of the wall clock, 0 to 23."""
    quiet_hours: tuple[int, int] = NIGHT
    """Those in which people may sleep; none where both are the same."""
    is_asleep: bool = False
    is_quiet: bool = False
    """Whether it was asked to be quiet."""
    is_voice_heard: bool = False
    """Whether someone speaks, to whomever."""
    is_speaking: bool = False
    """Whether the robot speaks, or is about to."""
    is_question_open: bool = False
    is_driving: bool = False
    is_seen: bool = False
    """Whether a person is in sight."""
    understood: float = NEVER
    """When it last understood someone."""
    voice: float = NEVER
    """When a voice was last heard, also of sentences that were rejected."""
    spoke: float = NEVER
    """When it last finished saying something."""
    puzzled: float = NEVER
    """When it last did not understand a sentence that was meant for it."""
    farewell: float = NEVER
    """When someone last said goodbye, or sent it to sleep."""
    dialogue: float = NEVER
    """When a task last asked something, or got an answer."""
    tender: float = NEVER
    """When it last comforted someone, or said that it is sorry."""
    wondered: float = NEVER
    """When it last asked something by itself."""


def is_night(hour: int, quiet_hours: tuple[int, int] = NIGHT) -> bool:
    """Whether people may sleep at an hour of the day."""
    begins, ends = quiet_hours
    if begins <= ends:
        return begins <= hour < ends
    return hour >= begins or hour < ends


def why_silent(scene: Scene, importance: Importance = Importance.CHAT) -> str:
    """Why the robot must not begin to speak; empty when it may."""
    now, silence = scene.now, scene.now - max(scene.understood, scene.voice)
    always = {
        "someone speaks": scene.is_voice_heard,
        "it speaks": scene.is_speaking,
        "a question is open": scene.is_question_open,
    }
    for_news = {
        "it sleeps": scene.is_asleep,
        "it was asked to be quiet": scene.is_quiet,
        "it is night": is_night(scene.hour, scene.quiet_hours),
        "a dialogue goes on": now - scene.dialogue < DIALOGUE_SECONDS,
        "someone told it something sad": now - scene.tender < TENDER_SECONDS,
        "someone spoke just now": min(silence, now - scene.spoke) < BREATH_SECONDS,
    }
    patience = COMPANY_SECONDS if scene.is_seen else UNSEEN_SECONDS
    for_chat = {
        "it drives": scene.is_driving,
        "it did not understand": scene.puzzled > scene.understood,
        "someone said goodbye": now - scene.farewell < FAREWELL_SECONDS
        or NEVER < scene.understood <= scene.farewell,
        "someone spoke just now": silence < CALM_SECONDS,
        "no one is there": now - scene.understood >= patience,
        "it asked just now": now - scene.wondered < BETWEEN_SECONDS,
    }
    kinds = (for_chat, for_news, always)
    reasons = [reason for kind in kinds[importance:][::-1] for reason in kind.items()]
    return next((why for why, holds in reasons if holds), "")


def may_begin(scene: Scene, importance: Importance = Importance.CHAT) -> bool:
    """Whether the robot may say something that nobody asked for just now."""
    return not why_silent(scene, importance)


def may_murmur(scene: Scene) -> bool:
    """Whether it may hum or sigh to itself: nothing has happened for a while, and someone is in
    sight, or has talked to it and may still be about.
    """
    now = scene.now
    is_busy = scene.is_voice_heard or scene.is_speaking or scene.is_question_open
    is_resting = scene.is_asleep or scene.is_quiet
    is_resting = is_resting or is_night(scene.hour, scene.quiet_hours)
    last = max(scene.understood, scene.voice, scene.dialogue)
    is_anyone_about = scene.is_seen or now - scene.understood < ABOUT_SECONDS
    is_time = now - last >= MURMUR_AFTER_SECONDS and is_anyone_about
    is_tender = now - scene.tender < TENDER_SECONDS + MURMUR_AFTER_SECONDS
    return is_time and not (is_busy or is_resting or is_tender or scene.is_driving)


def gives_way(begun: float, voice: float) -> bool:
    """Whether a voice that began at a time had the floor before the robot, which began at another.

    `voice` may lie before `begun`: the first sounds of a word do not count as a voice yet.
    """
    return voice - begun <= GIVES_WAY_SECONDS
