"""Whether what an engine made of a sound counts: our own parser and the strictness decide."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from typing import Any

from hri.core.signals import HeardWord, Rejection, Utterance
from hri.hal.recognizer import Alternative, Hypothesis, Segment
from hri.speech.automatic_level import too_quiet
from hri.speech.grammar import Grammar
from hri.speech.grammar.doc_comments import ANY_COMMAND
from hri.speech.grammar.follow_ups import out_of_place, resolved
from hri.speech.grammar.matching import Parse, departure, meanings, parse
from hri.speech.grammar.tags import are_same
from hri.speech.grammar.words import ANY, listed
from hri.speech.slot_confidence import REST, slot_confidences
from hri.speech.turn import Turn

STRICTNESS = 0.5
"""Confidence from which words count, unless someone wants another."""
CAREFUL = 0.1
"""How far a rule that moves the robot is from the strictness to certainty. At the default this
keeps out a third of the foreign sentences that got in, a quarter at 12 dB, and one in a hundred of
the right ones."""
OVER_SPEECH = 0.4
"""The same while the robot speaks: the rest of the echo sometimes sounds like a command (up
to 0.43 in the simulated room, where "stop" had 0.8 and more).
"""
UNASKED = 0.3
"""The same for someone who does not turn to the robot and does not say its name."""
SURELY = 0.6
"""The same for what such a person says that moves the robot, for a single word among other words,
and for other words that only its name makes a command. At 12 dB, of the sentences in which a name
was found, 46 of 55 in which it was said get in instead of 50, and 2 of 46 others instead of 13."""
FAR_BELOW = 0.2
"""Share of the strictness under which the nearest sentence of the grammar was not meant at all."""

LIKELY = 0.05
"""Share from which a sentence may be what was said, when the likely ones are compared."""

UNCLEAR = ("no speech", "unlike the sound", "low confidence")
"""Reasons that a sound which is too quiet may have."""

NEAREST = "the nearest sentence, but it does not fit"

MOST_EXPECTED = 6
"""Words that are named of those which might have followed."""


def judge(
    grammar: Grammar,
    segment: Segment,
    hypothesis: Hypothesis,
    strictness: float = STRICTNESS,
    turn: Turn | None = None,
) -> Utterance | Rejection:
    """The utterance, or the reason for its rejection.

    `turn` says which rules are active; without one, all do. The engine's likely alternatives with
    another meaning count against the words; rules marked `@careful` must be heard more clearly than
    the strictness, 0 to 1, alone demands.
    """
    all_rules = frozenset(grammar.public_rules) if turn is None else None
    turn = (turn or Turn()).of(segment)
    rules = all_rules or turn.rules(grammar)
    found = _parse_of(grammar, hypothesis.text, rules, turn)
    alternatives = (*hypothesis.alternatives, *_as_specific(grammar, found, rules, turn))
    meanings_of = ((other, _meaning(grammar, other.text, turn)) for other in alternatives)
    others = [
        (other, meaning)
        for other, meaning in meanings_of
        if not _is_value(grammar, hypothesis, found, meaning)
    ]
    doubts = [other for other, meaning in others if _differ(grammar, found, meaning)]
    meant = (meaning for other, meaning in others if other.share >= LIKELY)
    likely = [] if found is None else [found, *filter(None, meant)]
    doubt = min(1.0, sum(alternative.share for alternative in doubts))
    believed = _believed(grammar, hypothesis, found, strictness, turn)
    hypothesis = replace(hypothesis, confidence=believed)
    confidence = hypothesis.confidence * (1.0 - doubt)
    words, start, end = _times(segment, hypothesis)
    least = needed(grammar, found, strictness, turn)
    reason, detail = _reason(grammar, hypothesis, likely, rules, turn, least)
    choices: tuple[str, ...] = ()
    if not reason and confidence < least:
        rival = max(doubts, key=lambda one: one.share)
        choices = _choices(grammar, found, rival.text)
        reason, detail = "low confidence", _as_likely(listed(rival.text))
    weak = _weak(found, hypothesis, others, strictness)
    if found is not None and weak and not reason:
        reason, detail = "low confidence", _unheard(found, weak)
    if reason == "not in grammar":
        detail = _departure(grammar, hypothesis.text)
    if reason in UNCLEAR:
        detail = too_quiet(segment.level_db) or detail
    if turn.is_speaking and reason:
        reason = "robot speaking"
    if reason or found is None:
        doubted = likely if reason == "low confidence" else ()
        sure = {name: value for name, value in agreed(doubted).items() if name not in weak}
        return Rejection(
            reason,
            listed(hypothesis.text),
            confidence,
            start,
            end,
            detail,
            sure=sure,
            unsure=_unsure(doubted, weak),
            choices=choices if doubted else (),
            begun=listed(hypothesis.begun),
            level_db=segment.level_db,
        )
    return Utterance(
        text=hypothesis.paraphrase or listed(found.text),
        rule=found.rule,
        tags=found.tags,
        confidence=confidence,
        start=start,
        end=end,
        words=words,
        alternatives=hypothesis.alternatives,
        command=_command(grammar, found),
        is_among_others=_is_among_others(grammar, found),
        follow_up="" if found.tree.rule == found.rule else found.tree.rule,
        begun=listed(hypothesis.begun),
        level_db=segment.level_db,
        slots=hypothesis.slots,
    )


def _weak(
    found: Parse | None,
    hypothesis: Hypothesis,
    others: Sequence[tuple[Alternative, Parse | None]],
    strictness: float,
) -> tuple[str, ...]:
    """The tags whose values are not sure; REST for what gives none of them."""
    if found is None:
        return ()
    rivals = [(meaning, other.share) for other, meaning in others]
    sure = slot_confidences(found, hypothesis.words, rivals)
    return tuple(name for name, confidence in sure.items() if confidence < strictness)


def _unheard(found: Parse, weak: Sequence[str]) -> str:
    """Which words are not sure, for people."""
    words = enumerate(found.text.split())
    unsure = [word for place, word in words if found.tag_of(place) in weak]
    return f'unsure of "{listed(" ".join(unsure))}"' if unsure else "something may be missing"


def _unsure(likely: Sequence[Parse], weak: Sequence[str]) -> tuple[str, ...]:
    """The names of the tags that are to be asked for: those that likely sentences of one rule do
    not agree on, and those that are weak.
    """
    if not likely or len({one.rule for one in likely}) > 1:
        return ()
    weak_tags = [name for name in weak if name != REST]
    return tuple(dict.fromkeys((*disputed(likely), *weak_tags)))


def _times(segment: Segment, hypothesis: Hypothesis) -> tuple[tuple[HeardWord, ...], float, float]:
    """The words by the clock, and when they begin and end."""
    words = tuple(
        replace(word, start=segment.start + word.start, end=segment.start + word.end)
        for word in hypothesis.words
    )
    if not words:
        return (), segment.start, segment.end - segment.quiet
    return words, words[0].start, words[-1].end


def _command(grammar: Grammar, found: Parse) -> str:
    """The words of a sentence without those that are said around it."""
    aside = set(found.around)
    marks = {"aside", "name"} if aside else {"aside"}
    for _, tree in found.tree.walk():
        if grammar.rules[tree.rule].marks & marks:
            aside.update(range(tree.start, tree.end))
    words = enumerate(found.text.split())
    return " ".join(word for place, word in words if place not in aside)


def _as_specific(
    grammar: Grammar, found: Parse | None, rules: Collection[str], turn: Turn
) -> Iterator[Alternative]:
    """Beside a phrase among other words, others that mean something else: all were said.

    Where all free words are those of a free slot of a command, it is not small talk, nor where it
    answers a form: "they'd rather have bacon" is not "they would", either.
    """
    if found is None or not found.free:
        return
    answers, fills, typed = map(grammar.marked, ("answer", "fills", "typed"))
    is_filled = bool(found.slots) and not found.around and not grammar.rules[found.rule].topics
    is_filled |= found.rule in fills
    is_answer = turn.is_question_open and found.rule in answers
    for other in meanings(grammar, found.as_typed, answers if is_answer else rules):
        if is_filled and grammar.rules[other.rule].topics:
            continue
        if found.rule in fills and "gives_way" in grammar.rules[other.rule].marks:
            continue
        both = {found.rule, other.rule}
        # What several typed words mean is for the form to say; "in Tuesday" is one answer, by
        # whichever rule.
        if both <= fills and (both & typed or are_same(found.tags, other.tags)):
            continue
        if not resolved(grammar, other, turn.last).means_the_same(found):
            yield Alternative(_command(grammar, other), 1.0)


def _choices(grammar: Grammar, found: Parse | None, other: str) -> tuple[str, ...]:
    """Two sentences of which one was meant, as they are said; none if the other has no words."""
    meant = parse(grammar, other)
    if found is None or meant is None:
        return ()
    return _command(grammar, found), _command(grammar, meant)


def agreed(likely: Sequence[Parse]) -> dict[str, Any]:
    """The tags that all of some sentences have; none unless they are of one rule."""
    if len({one.rule for one in likely}) != 1:
        return {}
    first, *others = likely
    return {
        name: value
        for name, value in first.tags.items()
        if all(name in other.tags and other.tags[name] == value for other in others)
    }


def disputed(likely: Sequence[Parse]) -> tuple[str, ...]:
    """The names of the tags that some sentences of one rule do not agree on, in order."""
    if len({one.rule for one in likely}) > 1:
        return ()
    names = dict.fromkeys(name for one in likely for name in one.tags)
    return tuple(name for name in names if name not in agreed(likely))


def _as_likely(text: str) -> str:
    return f'as likely: "{text}"' if text else "another engine hears no words"


def needed(
    grammar: Grammar, found: Parse | None, strictness: float, turn: Turn | None = None
) -> float:
    """Confidence that a sentence must have at a strictness: some more than others."""
    if found is None:
        return strictness
    turn = turn or Turn()
    marks = grammar.rules[found.rule].marks
    if turn.is_question_open and "answer" in marks:
        return strictness  # The engine knows that it is likely.
    share = CAREFUL if "careful" in marks else 0.0
    if turn.is_speaking:
        share = OVER_SPEECH
    elif _is_among_others(grammar, found):
        is_phrase = len(_command(grammar, found).split()) > 1
        share += 0.0 if turn.is_addressed and is_phrase else SURELY
    elif not (turn.is_addressed or "interrupts" in marks or _is_named(grammar, found)):
        share += SURELY if "careful" in marks else UNASKED
    return strictness + share * (1.0 - strictness)


def _believed(
    grammar: Grammar, hypothesis: Hypothesis, found: Parse | None, strictness: float, turn: Turn
) -> float:
    """The confidence in a sentence; an answer that is said a second time has more of it."""
    if found is None or turn.doubt is None or not turn.is_question_open:
        return hypothesis.confidence
    if "careful" in grammar.rules[found.rule].marks:
        return hypothesis.confidence
    return turn.doubt.and_again(hypothesis.text, hypothesis.confidence, strictness)


def _parse_of(grammar: Grammar, text: str, rules: Collection[str], turn: Turn) -> Parse | None:
    """What a text means, by a rule that counts where there is one; to an open question "go ahead"
    is an answer and not an order. What interrupts does so though it may have been among others.
    """
    interrupting = grammar.marked("interrupts") if ANY in text.split() else frozenset()
    if interrupting and (found := parse(grammar, listed(text), interrupting)) is not None:
        return found
    answers = grammar.marked("answer") if turn.is_question_open else frozenset()
    return _meaning(grammar, text, turn, *filter(None, (answers, rules)), None)


def _meaning(
    grammar: Grammar, text: str, turn: Turn, *rules: Collection[str] | None
) -> Parse | None:
    """The meaning of a text, given the last utterance."""
    found = parse(grammar, text, *rules)
    if found is None or (found.rule in grammar.marked("typed") and not turn.is_typed):
        return found
    return resolved(grammar, found, turn.last)


def _differ(grammar: Grammar, one: Parse | None, other: Parse | None) -> bool:
    """Whether two texts mean different things; one without a meaning differs from all, and what
    fills slots of a form alike is the same by whichever rule.
    """
    if one is None or other is None:
        return True
    if {one.rule, other.rule} <= grammar.marked("fills"):
        return not are_same(one.tags, other.tags)
    return (one.rule, one.tags) != (other.rule, other.tags)


def _is_value(
    grammar: Grammar, hypothesis: Hypothesis, found: Parse | None, other: Parse | None
) -> bool:
    """Whether another meaning is that of words which fill a free slot of a sentence.

    Who says "remind me to call my mother" does not ask for a call. A stop counts wherever it is.
    """
    if found is None or found.around or other is None:
        return False
    is_phrase = len(other.text.split()) > 1 and other.rule not in grammar.marked("interrupts")
    return is_phrase and any(f" {other.text} " in f" {slot.text} " for slot in hypothesis.slots)


def _reason(
    grammar: Grammar,
    hypothesis: Hypothesis,
    likely: Sequence[Parse],
    rules: Collection[str],
    turn: Turn,
    needed: float,
) -> tuple[str, str]:
    """Why the words do not count, whatever else they may have been, and more of it.

    `likely` has the words' meaning, then those of likely alternatives; empty for words without one.
    """
    if not hypothesis.text:
        return "no speech", ""
    if not likely:
        return "not in grammar", ""
    found = likely[0]
    is_among_others = _is_among_others(grammar, found)
    if hypothesis.confidence < FAR_BELOW * needed:
        return "unlike the sound", NEAREST
    if found.rule not in rules:
        return "not now", f"<{found.rule}> counts only {_when(found.rule, grammar, turn)}"
    is_for_it = turn.is_addressed or all(_is_named(grammar, one) for one in likely)
    is_chat = bool(grammar.rules[found.rule].topics)
    if (is_among_others or is_chat) and not is_for_it:
        return "not now", "said to someone else"
    if hypothesis.confidence < needed and is_among_others:
        return "unlike the sound", NEAREST  # It was hardly meant, for most words are others.
    if hypothesis.confidence < needed:
        return "low confidence", f"{hypothesis.confidence:.2f} is below {needed:.2f}"
    return "", ""


def _is_among_others(grammar: Grammar, found: Parse) -> bool:
    return bool(found.around) and found.rule in grammar.marked("anywhere") | grammar.marked("typed")


def _is_named(grammar: Grammar, found: Parse) -> bool:
    return any("name" in grammar.rules[tree.rule].marks for _, tree in found.tree.walk())


def _departure(grammar: Grammar, text: str) -> str:
    """Where words leave the grammar, for people."""
    refused = departure(grammar, text)
    if refused is None:
        return ""
    expected = ", ".join(refused.expected[:MOST_EXPECTED])
    if len(refused.expected) > MOST_EXPECTED:
        expected += ", ..."
    if not refused.understood:
        told = f'no sentence begins with "{refused.word}"'
    else:
        told = f'after "{refused.understood}": {expected or "nothing more"}'
    return f"{told} - {refused.remedy}" if refused.remedy.startswith("did you") else told


def _when(rule: str, grammar: Grammar, turn: Turn) -> str:
    """When a rule counts that does not count now."""
    if turn.is_speaking:
        return "when the robot is silent"
    if rule in out_of_place(grammar, turn.last):
        named = [f"<{name}>" for name in grammar.rules[rule].after if name != ANY_COMMAND]
        return f"soon after {' or '.join(named) or 'another command'}"
    if rule in grammar.marked("typed"):
        return "when it is typed"
    is_answer = rule in grammar.marked("answer")
    return "while a question is open" if is_answer else "after the wake word"
