"""What a typed answer says in the end, where it takes back, adds and leaves out as it goes.

As in W. Levelt, Monitoring and self-repair in speech (Cognition 14, 1983): an answer behind an
editing term ("no wait", "i mean") replaces the earlier one, and all else stays. "Large with olives
no wait small" is small with olives, and "seven minutes no make that eight" eight minutes.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum, auto
from typing import Any

from hri.conversation.alarms import completed
from hri.conversation.form_grammar import ADDED, AGREED, ALL, EMPTY, REFUSED, SEVERAL
from hri.conversation.forms import NOTHING, Form
from hri.core.signals import Utterance
from hri.speech.grammar import Grammar, Parse, parse
from hri.speech.grammar.framing import unframed

LONGEST_ANSWER = 10
"""Words of an answer that stands among others."""
LONGEST_REPAIR = 4
"""Words that stand for a part of the answer before them."""
MOST_WITHIN = 4
"""Editing terms that are looked at within answers: more are play."""
LEADING = frozenset(
    (
        "with",
        "on",
        "at",
        "for",
        "the",
        "a",
        "an",
        "any",
        "some",
        "yucky",
        "nasty",
        "gross",
        "stinky",
    )
)
"""Words that may stand between one of the signs below and an answer."""
HESITATIONS = frozenset(("um", "uh", "er", "hm", "hmm", "oh", "ah", "well", "okay", "ok", "so"))
NEGATING = frozenset(("no", "not", "don't", "without", "never", "except", "isn't"))
"""One of these among the words that say nothing else leaves open what is wanted."""
NEAR = 4
"""Within this many words before an answer: "I don't eat a lot at night, a small one" is clear."""
TURNING = frozenset(("then", "so", "but"))
"""Behind one of these it does no more: "you don't have that, then bacon"."""
CARRYING = frozenset(
    (
        *("i", "you", "we", "it", "me", "us", "have", "want", "need", "like", "think", "should"),
        *("would", "do", "to", "please", "really", "even", "any", "the", "that", "sure", "about"),
    )
)
"""Through these it reaches what is asked for: "i don't want you to add bacon"."""
LIMITING = frozenset(("but", "wait", "actually", "only", "or"))
"""One of these behind a yes leaves open whether it is one."""
EDITING = (
    *("no", "nope", "sorry", "wait", "actually", "hold on", "hang on", "scratch that", "or rather"),
    *("i mean", "i meant", "i said", "make it", "make that", "change it", "change that"),
    *("not quite", "that's not right", "that's wrong", "rather"),
)
"""Editing terms: an answer behind one of them replaces what it names again."""
HARMLESS = ("if you don't mind", "no problem", "no hurry", "no rush", "don't worry", "not bad")
"""What negates nothing that is asked."""


class Use(Enum):
    """What an answer is named for."""

    SAID = auto()
    REPAIRED = auto()
    """It stands for what was said before."""
    ADDED = auto()
    UNWANTED = auto()
    DENIED = auto()
    """Behind a "no", which may also be an editing term."""
    OFFERED = auto()
    """Behind an "or"."""


SIGNS: Mapping[Use, tuple[str, ...]] = {
    Use.ADDED: (
        *("add", "also", "and also", "plus", "extra", "even", "don't forget"),
        *("put", "put on", "throw on", "throw in"),
    ),
    Use.REPAIRED: ("or rather", "just", "only"),
    Use.UNWANTED: (
        *(
            "not",
            "instead of",
            "rather than",
            "without",
            "except",
            "but no",
            "but not",
            "and no",
            "with no",
        ),
        *("no more", "don't want", "don't like", "take off", "leave off", "leave out", "hold"),
        *(
            "skip",
            "remove",
            "drop",
            "lose",
            "ditch",
            "forget",
            "get rid of",
            "minus",
            "no need for",
        ),
        *("hate", "hates", "doesn't like", "can't have", "can't stand", "allergic to"),
    ),
    Use.DENIED: ("no", "nope"),
    Use.OFFERED: ("or", "or maybe"),
}
"""What may be said right before an answer."""
TOO = ("too", "as well", "also", "on top")
"""What may be said behind one that is added."""
OFF = ("off", "out", "away")
"""What may be said behind one that is taken away."""
CONTRAST = ("but", "just", "only")
"""Words between "no bacon" and what is wanted instead."""


def _any_of(texts: Sequence[str], where: str) -> re.Pattern[str]:
    longest_first = sorted(texts, key=len, reverse=True)
    return re.compile(where.format("|".join(map(re.escape, longest_first))))


_EDITING = _any_of(EDITING, r"(?<!\S)(?:{})(?!\S)")
_HARMLESS = _any_of(HARMLESS, r"(?<!\S)(?:{})(?!\S)")
_SIGNS = {use: _any_of(signs, r"(?:^|(?<= ))(?:{})$") for use, signs in SIGNS.items()}
_TOO = _any_of(TOO, r"^(?:(?:on|to|in|with) (?:it|that|them|there) )?(?:{})(?!\S)")
_OFF = _any_of(OFF, r"^(?:(?:so )?(?:leave|take|keep) (?:it|that|them|those) )?(?:{})(?!\S)")


@dataclass(frozen=True, slots=True)
class Change:
    """What an answer does to the slots of a form, by their names."""

    said: Mapping[str, Any] = field(default_factory=dict)
    """Values in the place of those before."""
    added: Mapping[str, tuple[Any, ...]] = field(default_factory=dict)
    """To slots of several values."""
    removed: Mapping[str, tuple[Any, ...]] = field(default_factory=dict)

    def told(self, values: Mapping[str, Any]) -> dict[str, Any]:
        """The slots with what they are then; None for one that is to be asked for again.

        Of a list from which something is taken away the rest stays: "mushrooms instead of bacon".
        """
        found: dict[str, Any] = {}
        for name in dict.fromkeys((*self.said, *self.added, *self.removed)):
            value, removed = self.said.get(name), self.removed.get(name, ())
            if name not in self.added and not isinstance(value, tuple | None):
                found[name] = completed(value, values.get(name))
            elif isinstance(before := values.get(name), tuple | None) or before == NOTHING:
                found |= {name: self._list(name, before or ())}
            elif before in removed:
                found[name] = None
        return found

    def _list(self, name: str, before: tuple[Any, ...]) -> Any:
        said, removed = self.said.get(name), self.removed.get(name, ())
        is_kept = said is None or not set(removed).isdisjoint(before)
        items = (*(before if is_kept else ()), *(said or ()), *self.added.get(name, ()))
        left = tuple(one for one in dict.fromkeys(items) if one not in removed)
        return left or (NOTHING if items or said == NOTHING else None)


def own_words(grammar: Grammar) -> Grammar:
    """The answers alone, without the words around them, of a grammar of `form_grammar`."""
    rules = {
        key: replace(rule, expression=unframed(rule.expression).body, doc_tags=())
        if rule.is_public and not (key.startswith(ADDED) and key not in (EMPTY, ALL))
        else replace(rule, is_public=False)
        for key, rule in grammar.rules.items()
    }
    return replace(grammar, rules=rules)


def is_among_others(grammar: Grammar, answer: Utterance) -> bool:
    """Whether an answer was typed among other words, which may change what it means."""
    if answer.level_db is not None or answer.rule in (SEVERAL, AGREED, REFUSED):
        return answer.level_db is None
    found = parse(grammar, answer.text, {answer.rule})
    return found is not None and bool(found.free) and not found.slots


def is_clear(grammar: Grammar, answer: Utterance) -> bool:
    """Whether the words behind a yes leave it a yes, as those of "yes but not today" do not."""
    found = parse(grammar, answer.text, {answer.rule})
    words = answer.text.split()
    others = {words[number] for number in found.free} if found is not None else {*words}
    return others.isdisjoint(NEGATING | LIMITING)


def change_of(own: Grammar, form: Form, text: str, values: Mapping[str, Any]) -> Change | None:
    """What an answer among other words changes; None where that is not clear, nothing for none.

    `own` are the answers alone, of `own_words`; `values` are the slots so far. "Wednesday not
    monday" is Wednesday, and "small but i don't know" is not clear.
    """
    words = _respoken(own, _HARMLESS.sub(" ", text).split())
    draft, start, use = _Draft(values), 0, Use.SAID
    last, rule, names = list[str](), "", set[str]()
    for begin, end, found in _answers(own, words):
        before, behind, tags = words[start:begin], words[end:], form.taken(found.tags)
        if tags.keys() != names or not _goes_on(before, use):
            use, rest = _use(before, is_first=not last)
            if _is_negated(before, rest, use):
                return None
        if use in (Use.REPAIRED, Use.DENIED) and found.rule != rule:
            tags = _repaired(own, form, last, words[begin:end]) or tags
        draft.take(_use_by_end(" ".join(behind)) or use, tags, behind)
        start, last, rule, names = end, words[begin:end], found.rule, {*tags}
    if not last:
        return Change()
    tail = words[start:]
    if repaired := _repaired_by_tail(own, form, last, tail):
        draft.take(Use.REPAIRED, repaired, [])
    elif not NEGATING.isdisjoint(tail):
        return None
    return draft.change


def _respoken(own: Grammar, words: list[str]) -> list[str]:
    """Words without those that were taken back within an answer: "in thirty no forty minutes".

    What replaces them goes on as they would have, or says nothing without the words before them:
    "in an hour no two hours".
    """
    for begin, end in _terms(words)[:MOST_WITHIN]:
        for length in range(1, min(LONGEST_REPAIR, begin, len(words) - end) + 1):
            first, repair = begin - length, words[end : end + length]
            taken_back = [*words[:begin], *words[end + length :]]
            meant = [*words[:first], *words[end:]]
            goes_on = _is_spanned(own, taken_back, begin, begin + 1)
            is_part = _is_spanned(own, words[:begin], first, begin) and not _answer(own, repair)
            if (goes_on or is_part) and _is_spanned(own, meant, first, begin + goes_on):
                return _respoken(own, meant)
    return words


def _terms(words: Sequence[str]) -> list[tuple[int, int]]:
    """Where editing terms begin and end, with others right behind them."""
    text = " ".join(words)
    found: list[tuple[int, int]] = []
    for term in _EDITING.finditer(text):
        begin, end = (len(text[:place].split()) for place in term.span())
        if found and found[-1][1] == begin:
            begin = found.pop()[0]
        found.append((begin, end))
    return found


def _is_spanned(own: Grammar, words: Sequence[str], first: int, last: int) -> bool:
    """Whether an answer begins before one place among words, and ends at another or behind it."""
    spans = (
        words[begin:end]
        for begin in range(max(first - LONGEST_REPAIR, 0), first)
        for end in range(last, min(last + LONGEST_REPAIR, len(words)) + 1)
    )
    return any(_answer(own, span) is not None for span in spans)


def _answers(own: Grammar, words: Sequence[str]) -> Iterator[tuple[int, int, Parse]]:
    """Where answers begin and end: the longest, but of a list each by itself."""
    begin = 0
    while begin < len(words):
        ends = range(begin + 1, min(begin + LONGEST_ANSWER, len(words)) + 1)
        every = [(end, found) for end in ends if (found := _answer(own, words[begin:end]))]
        if not every:
            begin += 1
            continue
        is_listed = all(isinstance(value, tuple) for value in every[-1][1].tags.values())
        end, found = every[0 if is_listed else -1]
        yield begin, end, found
        begin = end


def _answer(own: Grammar, words: Sequence[str]) -> Parse | None:
    found = parse(own, " ".join(words))
    return None if found is None or found.free else found


def _goes_on(before: Sequence[str], use: Use) -> bool:
    """Whether an answer is named for what the one before it is: "add olives and bacon"."""
    joined = {Use.ADDED: ([], ["and"]), Use.UNWANTED: (["and"], ["or"])}
    return list(before) in joined.get(use, ())


def _use(before: Sequence[str], is_first: bool) -> tuple[Use, list[str]]:
    """What an answer is named for behind these words, and those that say nothing of it."""
    core = list(before)
    while True:
        text = " ".join(core)
        for use, signs in _SIGNS.items():
            if sign := signs.search(text):
                return use, _EDITING.sub(" ", text[: sign.start()]).split()
        if not core or core[-1] not in LEADING | HESITATIONS:
            break
        core.pop()
    rest = _EDITING.sub(" ", text).split()
    if core[-1:] == ["and"]:
        is_added = is_first and HESITATIONS.issuperset(rest[:-1])
        return Use.ADDED if is_added else Use.SAID, rest
    return Use.REPAIRED if len(rest) < len(core) else Use.SAID, rest


def _is_negated(before: Sequence[str], rest: Sequence[str], use: Use) -> bool:
    """Whether a "not" reaches an answer; `rest` are those words before it that say nothing else."""
    near = rest[-NEAR:]
    places = [place for place, word in enumerate(near) if word in NEGATING]
    turns = [place for place, word in enumerate(before) if word in TURNING]
    if not places or (turns and NEGATING.isdisjoint(before[turns[-1] :])):
        return False
    return use is not Use.ADDED or CARRYING.issuperset(near[places[-1] + 1 :])


def _use_by_end(behind: str) -> Use | None:
    """What an answer is named for where the words behind it say so: "take the olives off"."""
    if _TOO.match(behind):
        return Use.ADDED
    return Use.UNWANTED if _OFF.match(behind) else None


def _repaired(
    own: Grammar, form: Form, answer: Sequence[str], repair: Sequence[str]
) -> dict[str, Any]:
    """The slots of an answer of which other words replace a part; empty where that gives none.

    A part as long as the other words comes first, and the last of several: of "an hour and ten
    minutes no twenty" it is the ten.
    """
    before = _answer(own, answer)
    if before is None:
        return {}
    spans = [(i, j) for i in range(len(answer)) for j in range(i + 1, len(answer) + 1)]
    for i, j in sorted(spans, key=lambda span: (abs(span[1] - span[0] - len(repair)), -span[0])):
        found = _answer(own, [*answer[:i], *repair, *answer[j:]])
        if found is not None and found.tags.keys() == before.tags.keys():
            return form.taken(found.tags)
    return {}


def _repaired_by_tail(
    own: Grammar, form: Form, answer: Sequence[str], tail: Sequence[str]
) -> dict[str, Any]:
    """The same for words behind the last editing term, which may have others behind them."""
    terms = [*_EDITING.finditer(" ".join(tail))]
    rest = " ".join(tail)[terms[-1].end() :].split() if terms else []
    while rest and rest[0] in LEADING | HESITATIONS:
        rest.pop(0)
    lengths = range(min(LONGEST_REPAIR, len(rest)), 0, -1)
    found = (_repaired(own, form, answer, rest[:length]) for length in lengths)
    return next(filter(None, found), {})


class _Draft:
    """What an answer has changed so far."""

    def __init__(self, values: Mapping[str, Any]) -> None:
        self._values = values
        self._said: dict[str, Any] = {}
        self._added: dict[str, tuple[Any, ...]] = {}
        self._removed: dict[str, tuple[Any, ...]] = {}
        self._open = set[str]()
        """Slots that were given two values with an "or"."""

    @property
    def change(self) -> Change | None:
        """None where only an "or" is left."""
        is_any = self._said or self._added or self._removed
        return Change(self._said, self._added, self._removed) if is_any else None

    def take(self, use: Use, tags: Mapping[str, Any], behind: Sequence[str]) -> None:
        """Take an answer; `behind` are the words behind it."""
        for name, value in tags.items():
            meant = self._denied(name, value, behind) if use is Use.DENIED else use
            if meant is Use.UNWANTED:
                self._leave_out(name, value)
            elif meant is Use.ADDED and isinstance(value, tuple):
                self._added[name] = (*self._added.get(name, ()), *value)
            elif meant is Use.OFFERED and (name in self._said or name in self._open):
                self._said.pop(name, None)
                self._open.add(name)
            else:
                self._say(name, value, meant)

    def _denied(self, name: str, value: Any, behind: Sequence[str]) -> Use:
        """What a value behind a "no" is named for."""
        if not isinstance(value, tuple):
            return Use.REPAIRED
        said = self._said.get(name)
        known = said or self._values.get(name) or ()
        is_left_out = (
            not set(known).isdisjoint(value)
            or (behind and behind[0] in CONTRAST)
            or (self._said and said is None)  # of another slot: "large no bacon"
            or len(said or ()) > len(value)  # A repair replaces like for like.
        )
        return Use.UNWANTED if is_left_out else Use.REPAIRED

    def _leave_out(self, name: str, value: Any) -> None:
        items = value if isinstance(value, tuple) else (value,)
        self._removed[name] = (*self._removed.get(name, ()), *items)
        if self._said.get(name) == value:
            del self._said[name]

    def _say(self, name: str, value: Any, use: Use) -> None:
        before = self._said.get(name)
        self._open.discard(name)
        if use is Use.REPAIRED:
            self._added.pop(name, None)
        if not isinstance(value, tuple):
            value = completed(value, before)
        elif use is not Use.REPAIRED and isinstance(before, tuple):
            value = (*before, *value)
        self._said[name] = value
