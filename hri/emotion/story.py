"""Stories as plain text: events in the life of the robot, and the feelings to expect of it.

    title: A friend comes late
    0:00   hope: Anna comes (worth 0.8, likely 0.9, within 5 min)
           waiting: Anna is not here yet
    9:00   expect: fear
    12:00  happened: Anna comes (by Anna)
    12:05  expect: joy or relief

What happens is a stimulus in its own words, with a name in the place of "you"; `over:` ends one
that lasts. `docs/emotions.md` has all lines.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.core.reading import read_text
from hri.core.signals import EmotionState
from hri.emotion.affect import Affect
from hri.emotion.appraisal import SELF, ActionEvent, GoalEvent, ObjectEvent, OccEvent, check_name
from hri.emotion.dynamics import Dynamics
from hri.emotion.emotions import NAMES
from hri.emotion.everyday_words import FEELINGS
from hri.emotion.explanation import explained
from hri.emotion.label import MOODS
from hri.emotion.model_spec import EmotionModelSpec
from hri.emotion.reasons import VERB_WITH_NAME

MOST_LINES = 5000
OF_A_DEED = 0.25
"""How praiseworthy it is, or blameworthy, to bring about what the robot hopes for, or fears."""
GOOD = 0.05
"""Pleasure of a mood from which on it is good; below minus that it is bad."""
NEUTRAL = 0.15
"""Pleasure, either way, up to which it may be called neutral."""

_TIME = re.compile(r"(?:(\d{1,6}):)?(\d{1,6}):(\d\d(?:\.\d+)?)\s+(.+)")
_KEYED = re.compile(r"([a-z]+(?: [a-z]+)?):\s*(.*)")
_BRACKETS = re.compile(r"(.*?)\s*\(([^()]*)\)\s*")
_DURATION = re.compile(r"(\d{1,6}(?:\.\d+)?) ?(s|min|h)")
_UNITS = {"s": 1.0, "min": 60.0, "h": 3600.0}
_NOBODY = ("somebody", "someone", "you")
_MOOD_SIGNS = ("good", "bad", "neutral")
_GOAL_WORDS: dict[str, Callable[[GoalEvent, str], GoalEvent]] = {
    "waiting": lambda goal, words: replace(goal, waiting=words),
    "fulfilled": lambda goal, words: replace(goal, fulfilled=words),
    "failed": lambda goal, words: replace(goal, failed=words),
}


@dataclass(frozen=True, slots=True)
class Felt:
    """A stimulus, or with intensity 0 the end of one that lasts."""

    stimulus: str
    intensity: float
    person: str | None


@dataclass(frozen=True, slots=True)
class Expected:
    """What a reader expects at a time."""

    kind: str
    """"", "not", "mood" or "because"."""
    values: tuple[str, ...]
    """Labels, signs of the mood, or a text."""


@dataclass(frozen=True, slots=True)
class Line:
    """What a line of a story says."""

    place: Place
    time: float
    """Seconds."""
    text: str
    what: Felt | OccEvent | Expected


@dataclass(frozen=True, slots=True)
class Story:
    """A story as it was read."""

    path: Path
    title: str
    personality: str
    lines: tuple[Line, ...]


@dataclass(frozen=True, slots=True)
class Moment:
    """What the robot feels after a line."""

    line: Line
    affect: Affect
    state: EmotionState
    because: str
    """Its answer to "why?"."""
    failure: str = ""
    """What is otherwise than expected; empty for nothing."""


def load_story(path: Path, model: Callable[[str], EmotionModelSpec]) -> Story:
    """Read a story; `model` loads the emotions of a personality.

    Raises HriError for a file that cannot be read, AuthoringError with the place for a wrong line.
    """
    lines = read_text(path, "story").splitlines()
    if len(lines) > MOST_LINES:
        raise AuthoringError(Place(path), f"{len(lines)} lines", f"keep {MOST_LINES} at most")
    headers = _headers(path, lines)
    personality = headers.get("personality", "neutral")
    reader = _Reader(model(personality))
    for number, line in enumerate(lines, start=1):
        if text := line.partition("#")[0].strip():
            reader.read(text, Place(path, number))
    return Story(path, headers.get("title", path.stem), personality, tuple(reader.lines))


def played(story: Story, model: EmotionModelSpec) -> Iterator[Moment]:
    """The feelings after each line."""
    dynamics = model.dynamics()
    affect = dynamics.rest(0.0)
    for line in story.lines:
        affect, failure = dynamics.advance(affect, line.time), ""
        match line.what:
            case Felt(stimulus=name, intensity=intensity, person=person):
                affect = dynamics.feel(affect, name, intensity, line.time, person)
            case Expected() as expected:
                failure = _failure(expected, model, dynamics, affect)
            case event:
                affect = dynamics.appraise(affect, event, line.time)
        because = explained(model, dynamics, affect)
        yield Moment(line, affect, dynamics.read(affect), because, failure)


def _failure(
    expected: Expected, model: EmotionModelSpec, dynamics: Dynamics, affect: Affect
) -> str:
    """What is otherwise, as a sentence; empty when all is as expected."""
    state, wanted = dynamics.read(affect), " or ".join(expected.values)
    match expected.kind:
        case "mood":
            signs = [sign for sign in _MOOD_SIGNS if _is_mood(sign, state.valence)]
            if not set(signs) & set(expected.values):
                return f"the mood is {state.valence:+.2f}, not {wanted}"
        case "because":
            because = explained(model, dynamics, affect)
            if expected.values[0].lower() not in because.lower():
                return f'it says "{because}"'
        case "not":
            if state.label in _labels(expected.values):
                return f"{state.label} leads"
        case _:
            if state.label not in _labels(expected.values):
                return f"{state.label} leads, not {wanted}"
    return ""


def _is_mood(sign: str, pleasure: float) -> bool:
    if sign == "neutral":
        return abs(pleasure) <= NEUTRAL
    return pleasure > GOOD if sign == "good" else pleasure < -GOOD


def _labels(words: tuple[str, ...]) -> set[str]:
    labels: set[str] = set()
    for word in words:
        labels |= {word} | FEELINGS.get(word, frozenset())
    return labels


def _headers(path: Path, lines: list[str]) -> dict[str, str]:
    """The lines before the first time."""
    headers: dict[str, str] = {}
    for number, line in enumerate(lines, start=1):
        text = line.partition("#")[0].strip()
        if _TIME.fullmatch(text):
            break
        if text:
            found = _KEYED.fullmatch(text)
            if found is None or found[1] not in ("title", "personality"):
                remedy = "begin with title: or personality:, or with a time, such as 0:00"
                raise AuthoringError(Place(path, number), f'"{text[:60]}"', remedy)
            headers[found[1]] = found[2]
    return headers


class _Reader:
    """Reads the lines of a story one by one."""

    def __init__(self, model: EmotionModelSpec) -> None:
        self.lines: list[Line] = []
        self._stimuli = [
            (_pattern(spec.words), spec.name, spec.held is not None)
            for spec in model.stimuli.values()
        ]
        self._sentences = [spec.words for spec in model.stimuli.values()]
        self._goals: dict[str, GoalEvent] = {}

    def read(self, text: str, place: Place) -> None:
        """Take a line that is not empty. Raises AuthoringError."""
        timed, keyed = _TIME.fullmatch(text), _KEYED.fullmatch(text)
        if timed is not None:
            hours, minutes, seconds, said = timed.groups()
            time = 3600.0 * int(hours or 0) + 60.0 * int(minutes) + float(seconds)
            if self.lines and time < self.lines[-1].time:
                raise AuthoringError(place, "the times go back", "write the lines in order of time")
            try:
                what = self._what(said)
            except ValueError as error:
                problem, _, remedy = str(error).partition(" - ")
                raise AuthoringError(place, problem, remedy or "write it otherwise") from error
            self.lines.append(Line(place, time, said, what))
        elif keyed is not None and keyed[1] in _GOAL_WORDS:
            self._say_of_goal(keyed[1], keyed[2], place)
        elif self.lines:
            raise AuthoringError(place, f'"{text[:60]}" has no time', "begin it with one: 1:30")

    def _say_of_goal(self, key: str, words: str, place: Place) -> None:
        last = self.lines[-1] if self.lines else None
        if last is None or not isinstance(last.what, GoalEvent):
            remedy = "write it below a line such as 0:00 hope: Anna comes"
            raise AuthoringError(place, f"{key} belongs to no goal", remedy)
        goal = _GOAL_WORDS[key](last.what, words)
        self._goals[goal.goal] = goal
        self.lines[-1] = replace(last, what=goal)

    def _what(self, said: str) -> Felt | OccEvent | Expected:
        """Raises ValueError with what is wrong, and a remedy after a dash."""
        keyed = _KEYED.fullmatch(said)
        if keyed is None:
            return self._felt(said, is_over=False)
        key, text = keyed.groups()
        if key == "over":
            return self._felt(text, is_over=True)
        if key.partition(" ")[0] == "expect":
            return _expected(key.partition(" ")[2], text)
        read: dict[str, Callable[[str, str, dict[str, str]], OccEvent]] = {
            "hope": self._goal,
            "fear": self._goal,
            "doubtful": self._changed,
            "happened": self._changed,
            "failed": self._changed,
            "deed": _deed,
            "thing": _thing,
        }
        if key not in read:
            raise ValueError(f'no "{key}:" - {did_you_mean(key, (*read, "over", "expect"))}')
        name, options = _options(text)
        event = read[key](key, name, options)
        if options:
            raise ValueError(f'"{next(iter(options))}" says nothing here - leave it out')
        return event

    def _felt(self, said: str, is_over: bool) -> Felt:
        sentence, options = said, {}
        if (found := _BRACKETS.fullmatch(said)) is not None:
            sentence, options = found[1], {"": found[2]}
        for pattern, name, lasts in self._stimuli:
            if (match := pattern.fullmatch(sentence)) is not None:
                if is_over and not lasts:
                    raise ValueError(f'"{sentence}" does not last - leave out over:')
                person = match.groupdict().get("person")
                if person is not None and person.lower() in _NOBODY:
                    person = None
                if person is not None:
                    check_name("person", person)
                strength = _number(options.get("", "1"), "a strength", 0.0)
                return Felt(name, 0.0 if is_over else strength, person)
        raise ValueError(f'"{sentence}" - {did_you_mean(sentence, self._sentences)}')

    def _goal(self, key: str, name: str, options: dict[str, str]) -> GoalEvent:
        worth = _number(options.pop("worth", "0.7"), "worth", 0.0)
        within = options.pop("within", None)
        goal = GoalEvent(
            name,
            worth if key == "hope" else -worth,
            _number(options.pop("likely", "0.7"), "likely", 0.0),
            expected_s=None if within is None else _seconds(within),
        )
        self._goals[name] = goal
        return goal

    def _changed(self, key: str, name: str, options: dict[str, str]) -> GoalEvent:
        if name not in self._goals:
            raise ValueError(f'no goal "{name}" before - {did_you_mean(name, self._goals)}')
        likely = {"happened": "1", "failed": "0"}.get(key) or options.pop("likely", "")
        agent = options.pop("by", None)
        desired = self._goals[name].utility * (1 if key == "happened" else -1)
        return replace(
            self._goals[name],
            likelihood_after=_number(likely, "likely", 0.0),
            agent=agent,
            praiseworthiness=None if agent is None else math.copysign(OF_A_DEED, desired),
            expected_s=None,
        )


def _deed(key: str, said: str, options: dict[str, str]) -> ActionEvent:
    agent, _, action = said.partition(" ")
    return ActionEvent(
        action,
        _number(options.pop("good", "0"), "good", -1.0),
        SELF if agent == "I" else agent,
        desirability=_number(options.pop("for me", "0"), "for me", -1.0),
        makes_good=options.pop("makes good", ""),
    )


def _thing(key: str, said: str, options: dict[str, str]) -> ObjectEvent:
    return ObjectEvent(said, _number(options.pop("appeal", "0.5"), "appeal", -1.0))


def _expected(kind: str, text: str) -> Expected:
    if kind not in ("", "not", "mood", "because"):
        raise ValueError(f'no "expect {kind}:" - write not, mood or because')
    if kind == "because":
        return Expected(kind, (text,))
    values = tuple(word.strip().replace(" ", "_") for word in text.split(" or "))
    known = _MOOD_SIGNS if kind == "mood" else (*NAMES, *MOODS, *FEELINGS)
    for value in values:
        if value not in known:
            raise ValueError(f'no feeling "{value}" - {did_you_mean(value, known)}')
    return Expected(kind, values)


def _options(text: str) -> tuple[str, dict[str, str]]:
    """The text before the brackets, and the parts within them by their first words."""
    found = _BRACKETS.fullmatch(text)
    if found is None:
        return text, {}
    options: dict[str, str] = {}
    for part in found[2].split(","):
        key = next((key for key in _KEYS if part.strip().startswith(f"{key} ")), None)
        if key is None:
            raise ValueError(f'"{part.strip()}" - {did_you_mean(part.strip(), _KEYS)}')
        options[key] = part.strip().removeprefix(key).strip()
    return found[1], options


_KEYS = ("worth", "likely", "within", "by", "good", "for me", "makes good", "appeal")


def _number(text: str, name: str, lowest: float) -> float:
    try:
        value = float(text)
    except ValueError:
        value = float("nan")
    if not lowest <= value <= 1.0:
        raise ValueError(f'{name} is "{text}" - write a number from {lowest:g} to 1')
    return value


def _seconds(text: str) -> float:
    found = _DURATION.fullmatch(text)
    if found is None or not float(found[1]) > 0:
        raise ValueError(f'"{text}" is not a time - write such as 5 min')
    return float(found[1]) * _UNITS[found[2]]


def _pattern(words: str) -> re.Pattern[str]:
    """The words of a stimulus with anyone's name in the place of the person."""
    parts = []
    for part in re.split(r"(\{[^{}]*\})", words):
        pronoun, _, verb = part.strip("{}").partition(" ")
        if not part.startswith("{"):
            parts.append(re.escape(part))
        elif verb:
            parts.append(rf"(?P<person>[^\W\d]\w*) (?:{verb}|{VERB_WITH_NAME[verb]})")
        else:
            parts.append(r"(?P<person>[^\W\d]\w*)" + ("'s" if pronoun == "your" else ""))
    return re.compile("".join(parts), re.IGNORECASE)
