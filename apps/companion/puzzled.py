"""The companion's answers to lines that it does not understand.

`hri.conversation.puzzlement` decides on the kind of answer; here is what it has to know for that.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from hri.conversation import (
    ASKED,
    CONFIRMED,
    TELLING,
    Answer,
    Gist,
    Kind,
    Puzzle,
    act_of,
    answers_shown,
    are_alike,
    as_said,
    deed_of,
    echo_of,
    fields_of,
    introduced,
    introduces_self,
    nearest_sentence,
    sentiment_of,
)
from hri.robot import verbs
from hri.speech import (
    LEAST_SURE,
    QUESTION,
    VERY_QUIET_DB,
    Grammar,
    departure,
    guess_rule,
    normalize,
    parse,
    values_of,
)
from hri.task import TaskContext

from .acquaintance import take_name
from .companion import FAREWELLS, TENDER, Companion
from .replies import Reply

CLEAR = 0.3
"""Confidence from which words that do not count say what a sentence was about."""
OFFERED_TOPICS = frozenset(("fun",))
"""Small talk that helps who does not know what to say."""
GESTURES: Mapping[Kind, str] = {
    Kind.TOLD: "nod",
    Kind.NOTED: "nod",
    Kind.CORRECTED: "nod",
    Kind.TOLD_OF: "nod",
    Kind.TOLD_OF_ME: "nod",
    Kind.ASKED: "think",
    Kind.ASKED_OF_ME: "think",
    Kind.ASKED_OF_YOU: "think",
    Kind.ASKED_WHERE: "think",
    Kind.ASKED_WHY: "think",
    Kind.FORBIDDEN: "nod",
    Kind.ASKED_FOR: "shake",
    Kind.ASKED_FOR_DEED: "shake",
}
"""What it makes instead of a confused face."""
SHOWN: Mapping[Kind, str] = {
    Kind.INTRODUCED: "happy",
    Kind.TOLD_SAD: "vulnerable",
    Kind.TOLD_GLAD: "happy",
    Kind.TOLD_ANGRY: "vulnerable",
    Kind.TOLD_AFRAID: "vulnerable",
    Kind.TOLD_WEARY: "vulnerable",
    Kind.PRAISED: "happy",
    Kind.INSULTED: "sad",
}
"""What it shows instead."""
GOES_ON = (Kind.TOLD, Kind.NOTED, Kind.CORRECTED)
"""Kinds of lines that may go on with what was understood before them."""
FELT: Mapping[Kind, str] = {
    Kind.PRAISED: "praise",
    Kind.INSULTED: "insulted",
    Kind.TOLD_SAD: "friend_sad",
    Kind.TOLD_GLAD: "friend_glad",
}
"""Stimuli."""
OWN_WORDS = TELLING | GESTURES.keys()
"""Of these a request for other words would be no answer."""
MOST_OF_SLIP = 5
"""Words of a sentence that fails at one."""
TALES = ("because", "commands", "said", "why", "why_stopped")
"""What a reply fills in that says something only in its place."""
ENDING = ("stop", "quiet", "release", "sleep")
"""Actions that help no one who does not know what to say."""


def puzzle(companion: Companion, heard: Mapping[str, Any]) -> None:
    """Answer someone who was not understood; `heard` is what `speech.rejected` says of it.

    Of two commands that are as likely, it asks which was meant. Words that were not said to it
    get no answer.
    """
    now = companion.context.clock.now()
    is_typed = bool(heard.get("is_typed"))
    if not is_typed and heard["reason"] not in ("no speech", "robot speaking"):
        companion.last_voice = now
    if companion.is_held or companion.is_asleep:
        return
    if choices := heard.get("choices", ()):
        companion.puzzlement.last = now
        companion.show("confused")
        companion.tell("which", one=choices[0], other=choices[1])
        return
    if (unsure := heard.get("unsure")) and _is_for_it(companion, heard):
        found = parse(companion.listener.loaded_grammar, str(heard["text"]))
        if found is not None and _can_ask_for(companion, found.rule, unsure[0]):
            companion.puzzlement.last = now
            companion.show("confused")
            companion.lessons.start(_ask_for, companion, found.rule, heard)
            return
    examples = companion.examples()
    offers = [as_said(one) for rule, one in examples.items() if _is_worth_offering(companion, rule)]
    answer = companion.puzzlement.answer(_puzzle_of(companion, heard, is_typed), offers, now)
    if answer is not None:
        _tell(companion, answer, str(heard["text"]))


def _can_ask_for(companion: Companion, rule: str, tag: str) -> bool:
    """Whether a value of a command can be said by itself, and no question is open."""
    is_open = bool(companion.context.board.slot(QUESTION).value) or companion.lessons.is_busy
    values = values_of(companion.listener.loaded_grammar, rule, tag)
    return rule in companion.replies.replies and bool(values.public_rules) and not is_open


async def _ask_for(
    context: TaskContext, companion: Companion, rule: str, heard: Mapping[str, Any]
) -> None:
    """Ask for the value that was not clear, and do what the whole command says."""
    doubted = verbs.doubted_of(companion.listener.loaded_grammar, heard)
    answer = await verbs.ask_value(context, rule, heard["unsure"][0], doubted=doubted)
    if answer is not None:
        tags = {**heard.get("sure", {}), **answer.tags}
        companion.reply(rule, answer.command or answer.text, tags)


def _tell(companion: Companion, answer: Answer, text: str) -> None:
    if (gesture := GESTURES.get(answer.kind)) is not None:
        companion.make(gesture)
    else:
        companion.show(shown := SHOWN.get(answer.kind, "confused"))
        if shown in TENDER:
            companion.last_tender = companion.context.clock.now()
    if answer.kind is Kind.FORBIDDEN:
        companion.halt()  # It may be doing just that.
    if answer.kind is Kind.INTRODUCED and introduces_self(text):
        take_name(companion, answer.facts["person"])
    if answer.kind in FELT:
        companion.feel(FELT[answer.kind])
    nearest = as_said(_most_like(companion, text))
    # A text for any sentence may replace one that was said a short while ago.
    more = () if answer.kind in OWN_WORDS else (Kind.REPHRASE,)
    topic = companion.take_topic()
    then = companion.replies.then.get(topic, ()) if answer.kind in GOES_ON else ()
    template = companion.fresh(answer.kind, *more, before=then)
    words = template.format_map({"nearest": nearest, **answer.facts})
    companion.say(words[:1].upper() + words[1:])


def _puzzle_of(companion: Companion, heard: Mapping[str, Any], is_typed: bool) -> Puzzle:
    """What is known of a sentence that was not understood."""
    grammar: Grammar = companion.listener.loaded_grammar
    text, level = str(heard["text"]), heard.get("level_db")
    # Of a sound that is like none of its sentences, the nearest one says nothing.
    is_clear = is_typed or heard.get("confidence", 0.0) >= CLEAR
    words = (text if is_clear else "") or str(heard.get("begun", ""))
    is_named = is_clear and companion.replies.name.lower() in normalize(text)
    found = parse(grammar, text) if is_clear else None
    gist = grammar.made(Gist.of)
    rule = found.rule if found is not None else gist.rule_of(words)
    is_answer = rule in grammar.marked("answer")
    strange = gist.strange(text) if is_typed else []
    meant_so = _without_slip(grammar, text, strange) if is_typed and found is None else ""
    is_said, name = is_typed and not meant_so, companion.replies.name
    topic = "" if is_answer else companion.replies.about.get(rule, "")
    example = "" if is_answer else companion.examples().get(rule, "")
    if is_typed and not are_alike(text, example):
        example = ""
    deed = deed_of(text, name) if is_said else ""
    if deed and parse(grammar, deed) is not None:
        topic, example, deed = "", deed, ""  # It can do that, said by itself.
    return Puzzle(
        reason=heard["reason"],
        is_typed=is_typed,
        is_addressed=is_named or _is_for_it(companion, heard),
        is_turned_to=bool(heard.get("is_looked_at")) or is_named,
        goes_on=is_said and companion.is_in_touch,
        is_quiet=level is not None and level < VERY_QUIET_DB,
        topic=topic,
        nearest=as_said(example),
        meant=as_said(meant_so or _meant(companion, text)) if is_typed else "",
        act=act_of(text, name) if is_said else None,
        sentiment=sentiment_of(text) if is_said else None,
        person=introduced(text, name) if is_said else "",
        echo=as_said(echo_of(text, name)) if is_said else "",
        deed=as_said(deed),
        words=len(normalize(text)),
        strange=strange,
        answers=_answers(companion, grammar),
        is_answer=is_answer,
    )


def _meant(companion: Companion, text: str) -> str:
    """The example of a command that is to be said in these words, where a text is like it."""
    found = guess_rule(companion.listener.loaded_grammar, text)
    is_sure = found is not None and found.is_vague and found.probability >= LEAST_SURE
    return companion.examples().get(found.rule, "") if found is not None and is_sure else ""


def _without_slip(grammar: Grammar, text: str, strange: Sequence[str]) -> str:
    """A sentence that fails at a slip of the fingers, as it was meant; empty for any other."""
    if len(strange) != 1 or len(normalize(text)) > MOST_OF_SLIP:
        return ""
    fails = departure(grammar, text)
    if fails is None or fails.word != strange[0] or not fails.near:
        return ""
    words = [fails.near if word == fails.word else word for word in normalize(text)]
    meant_so = " ".join(words)
    return meant_so if parse(grammar, meant_so) is not None else nearest_sentence(grammar, text)


def _answers(companion: Companion, grammar: Grammar) -> list[str]:
    """What would answer the question that is open: all where they are few, else two of them.

    Its own small questions need no answer: who talks of something else is not asked for a yes.
    """
    if not companion.context.board.slot(QUESTION).value or companion.is_wondering:
        return []
    asked = companion.context.board.slot(ASKED).value
    if grammar.marked("answer") or asked == CONFIRMED:
        return ["yes", "no"]
    return [as_said(text) for text in answers_shown(grammar, asked)]


def _is_for_it(companion: Companion, heard: Mapping[str, Any]) -> bool:
    """Whether words were said to it: who is seen, and looks aside, talks to someone else."""
    is_looked_at = bool(heard.get("is_looked_at"))
    return is_looked_at or (bool(heard.get("is_addressed")) and companion.person() is None)


def _is_worth_offering(companion: Companion, rule: str) -> bool:
    """Whether a command helps someone who does not know any: none that ends something."""
    reply = companion.replies.replies.get(rule, Reply())
    topics = companion.listener.loaded_grammar.rules[rule].topics
    is_chat = bool(reply.feel) or rule in FAREWELLS or not topics <= OFFERED_TOPICS
    tells = any(field in TALES for text in reply.say for field in fields_of(text))
    return not (is_chat or tells or reply.action in ENDING)


def _most_like(companion: Companion, text: str) -> str:
    """The example of a command that is most like a text; else the question for all of them."""
    examples = companion.examples()
    near = nearest_sentence(companion.listener.loaded_grammar, text)
    return near or examples.get("help", next(iter(examples.values()), ""))
