"""Reads `replies.toml` and checks it against the grammar, the stimuli, the face and the tasks."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from inspect import Parameter
from pathlib import Path

from hri.conversation import (
    DAY,
    PARTS_OF_DAY,
    Form,
    Wording,
    check_text,
    fields_of,
    read_event,
)
from hri.core import (
    AuthoringError,
    HriError,
    Mistakes,
    Table,
    did_you_mean,
    load_toml,
)
from hri.emotion import KNOWN_FEELINGS, personality_names
from hri.robot import GRAMMARS, App
from hri.speech import Grammar, load_grammar, sure_tags
from hri.task import ImmediateTask, TaskType

from .reply_files import KIND, joined_entries, parts_of
from .reply_texts import read_wording

FILE, FORMS = "replies.toml", "forms.toml"
AFTER_YES = ("keep", "see")
"""What may be done after a yes: begin to save feelings, or say what it sees. Nothing that moves the
base: a nod, or a "yes" in other people's talk, is not heard as clearly as an order must be."""
FILLED_IN = (
    "text",
    "name",
    "time",
    "date",
    "battery",
    "why",
    "why_stopped",
    "feeling",
    "commands",
    "said",
    "because",
)
"""What may stand in braces, beside the tags of the grammar."""
MOTION = ("distance", "angle")
"""Tags of a motion: a rule that gives one may have {direction} in its texts."""
HEARD = "text"
"""What a task or an event may take beside the tags: the words that were heard."""


@dataclass(frozen=True)
class Reply:
    """What is done when a rule was heard."""

    wording: Wording = field(default_factory=Wording)
    feel: str = ""
    intensity: float = 1.0
    show: str = ""
    gesture: str = ""
    action: str = ""
    task: TaskType | None = None
    """What `action` names."""
    event: str = ""
    """What is raised, with the tags as its properties."""
    because: str = ""
    """The answer to "why" after it; empty for that it was asked to, or for what it feels."""
    form: Form | None = None
    """What it asks for, beginning with the tags."""
    form_task: TaskType | None = None
    """What the form's `action` names."""

    @property
    def say(self) -> list[str]:
        """All that it may say."""
        return self.wording.texts()


@dataclass(frozen=True)
class Question:
    """A yes/no question and what is said to the answer."""

    ask: str
    yes: str
    no: str
    action: str = ""
    """What is done after a yes, one of AFTER_YES."""
    task: TaskType | None = None
    """What `action` names."""
    show: str = ""
    """An expression that is shown after a yes."""
    hour: tuple[str, ...] = ()
    """Parts of the day at which it may be asked; any without one."""
    once: str = ""
    """DAY for a question that is asked once a day."""
    after: tuple[str, ...] = ()
    """Rules of which one must have been heard before."""
    feeling: tuple[str, ...] = ()
    """Words and labels of feelings in which it may be asked; any without one."""


@dataclass(frozen=True)
class Replies:
    """All that the companion can say."""

    name: str = ""
    voice: str = ""
    """Whose voice it speaks with; empty for that of the configuration."""
    replies: Mapping[str, Reply] = field(default_factory=dict)
    """By public rule of the grammar."""
    unasked: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """By key: what is said by itself, in one of several ways."""
    about: Mapping[str, str] = field(default_factory=dict)
    """By rule: what it is about, as "Something about {topic}?" says it."""
    questions: tuple[Question, ...] = ()
    then: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    """By rule: the answers to a line that comes soon after it and is not understood."""


@dataclass(frozen=True)
class Vocabulary:
    """What the other authored files know: names that replies may use."""

    grammar: Grammar
    stimuli: Collection[str]
    expressions: Collection[str]
    gestures: Collection[str]
    app: App
    """Knows the tasks."""
    personalities: Collection[str] = field(default_factory=personality_names)
    forms: Mapping[str, Form] = field(default_factory=dict)
    """By name."""

    @cached_property
    def tags(self) -> frozenset[str]:
        """Names of all tags of the grammar."""
        return self.grammar.tag_names()

    def skill_of(self, rule: str) -> App | None:
        """The skill that a rule of the grammar is of; None for one of the app."""
        return self._skills[self.grammar.rules[rule].path]

    @cached_property
    def _skills(self) -> dict[Path, App | None]:
        """By the file of a grammar."""
        files = {rule.path for rule in self.grammar.rules.values()}
        return {path: self.app.skill_at(path) for path in files}

    @property
    def rules(self) -> tuple[str, ...]:
        """The rules that are replied to: all but those that stand for others, such as "again"."""
        public = self.grammar.public_rules
        return tuple(key for key in public if not self.grammar.rules[key].stands_for)


UNASKED = ("blocked", "bump", "battery_low", "nobody", "waiting", "no_stop")
USUALLY_UNASKED: Mapping[str, tuple[str, ...]] = {
    "answers": ('Sorry, I didn\'t get that. You can say "{one}" or "{other}".',),
    "caught": ("Something about {topic}? Say it another way, please.",),
    "near": ('I almost got that. Try "{nearest}".',),
    "told": ("Mm-hm. Go on, I'm listening.",),
    "noted": ("I see.",),
    "lost": ("I can't see you anymore. I'm looking for you.",),
    "corrected": ("Oh, okay. My mistake.",),
    "introduced": ("Nice to meet you, {person}.",),
    "told_of": ("{echo}? Tell me more.",),
    "told_of_me": ("Good to know. I'm still learning.",),
    "told_sad": ("I'm sorry to hear that.",),
    "told_glad": ("That's great!",),
    "told_angry": ("That would make me mad, too.",),
    "told_afraid": ("That sounds scary. I'm right here.",),
    "told_weary": ("That sounds hard. Take it easy.",),
    "praised": ("Thank you! That's kind of you.",),
    "insulted": ("Ouch. That wasn't very nice.",),
    "asked": ("I don't know, to be honest.",),
    "asked_of_me": ("I'm not sure. I'm just a small robot.",),
    "asked_of_you": ("You know that better than I do.",),
    "asked_where": ("I don't know where. I only see what's in front of me.",),
    "asked_why": ("I don't know why. What do you think?",),
    "forbidden": ("Okay, I won't.",),
    "asked_for": ("I don't think I can do that, sorry.",),
    "asked_for_deed": ("I don't know how to {deed}.",),
    "strange_word": ('I don\'t know the word "{word}" yet.',),
    "strange": ("I heard you, but I don't know those words yet.",),
    "not_understood": ("Sorry, I didn't get that. Could you say it another way?",),
    "unclear": ("Sorry, I didn't catch that. Could you say it again?",),
    "too_quiet": ("Sorry, that was too quiet for me. Could you speak up?",),
    "no_question": ("I didn't ask anything just now.",),
    "offer": ('I still don\'t get it. You could say "{one}" or "{other}".',),
    "which": ("Do you mean {one}, or {other}?",),
    "unanswered": ("Sorry, I didn't hear an answer.",),
    "refused": ("Okay, never mind.",),
    "awake": ("I was awake all along.",),
    "nothing_said": ("I haven't said anything yet.",),
    "asked_to": ("Because you asked me to.",),
    "battery_unknown": ("I don't know how full my battery is.",),
    "learned": ("Got it. Now I know your {thing}.",),
    "nothing_shown": ("I don't see your {thing}. Hold it up close, and say: this is my {thing}.",),
    "no_camera": ("I don't have a camera to see your {thing} with.",),
    "not_learned": ("I couldn't see enough of your {thing}. Hold it closer, in better light.",),
    "sees": ("I see {things}.",),
    "sees_nothing": ("I don't see anything I know.",),
    "waved": ("Hi there!",),
    "sees_pointed": ("That's your {thing}.",),
    "sees_at": ("I see your {thing} {place}.",),
    "not_in_sight": ("I don't see your {thing} right now. Say: find my {thing}.",),
    "found": ("Here's your {thing}.",),
    "not_found": ("I looked around, but I couldn't find your {thing}.",),
    "forgotten": ("Okay, I forgot your {thing}.",),
    "greet_by_name": ("Hello, {person}!",),
    "hello_again": ("Hello again",),
    "hello_morning": ("Good morning",),
    "hello_afternoon": ("Hello",),
    "hello_evening": ("Good evening",),
    "hello_night": ("Hello",),
    "met_again": ("{hello}, {person}!",),
    "met_after_days": ("{hello}, {person}! I haven't seen you for {days}.",),
    "met_kind": ("You were so nice to me last time.",),
    "met_rude": ("I hope we get along better today.",),
    "met_sad": ("You were sad last time. I hope you feel better.",),
    "have_we_met": ("Have we met before, {person}?",),
    "which_of_them": ("I know more than one {person}.",),
    "is_so": ("That's nice to hear.", "Good!"),
    "is_not_so": ("Oh, okay.", "I see."),
    "name_known": ("I know, {person}.",),
    "name_again": ("Sorry. What's your name again?",),
    "name_unclear": ("Sorry, I didn't get your name. You can type it, if you like.",),
    "may_remember": ("May I remember you, {person}?",),
    "will_remember": ("Thank you, {person}. I'll remember you.",),
    "will_not_remember": ("Okay. I'll only know you for today.",),
    "memory_full": ("My memory is full. Someone has to forget something first.",),
    "you_are": ("You're {person}.",),
    "nothing_told": ("You haven't told me more than that.",),
    "forgot_that": ("Okay, I forgot that: {value}.",),
    "forget_all": ("Should I forget all about you, {person}?",),
    "forgot_you": ("Done. I don't know you anymore.",),
    "unknown_thing": ("I don't know your {thing} yet. Hold it up and say: this is my {thing}.",),
}
"""What need not be written."""
MORE_FILLED_IN: Mapping[str, tuple[str, ...]] = {"not_understood": ("nearest",)}
"""Further names in braces, in texts of [unasked]."""


def load_replies(files: Sequence[Path], vocabulary: Vocabulary) -> Replies:
    """What these files say together, each adding to those before it and replacing parts of them.

    Raises AuthoringError with the place of a mistake; AuthoringErrors when there are several.
    """
    mistakes = Mistakes()
    own = [app.folder / FILE for app in (vocabulary.app, *vocabulary.app.all_skills())]
    tables = {path: load_toml(path, KIND) for path in files}
    found, is_whole = Replies(unasked=USUALLY_UNASKED), True
    for path, table in tables.items():
        parts, are_all = parts_of(table, mistakes)
        is_whole = is_whole and are_all
        found = _joined(found, _read(parts, vocabulary, mistakes, is_own=path in own))
    if is_whole:
        # One that has no replies at all has gaps there.
        last, *skills = (tables.get(path, Table({}, path, (), {})) for path in own)
        for skill in skills:
            _refuse_unanswered(found, skill, vocabulary, mistakes)
        _refuse_gaps(found, last, vocabulary, mistakes)
    mistakes.tell()
    return found


def _read(
    parts: Sequence[Table], vocabulary: Vocabulary, mistakes: Mistakes, is_own: bool
) -> Replies:
    """One file and those it names, as one.

    Only the app's own must fit the grammar: those it extends may know other rules.
    """
    table = parts[0]
    name = mistakes.keep(lambda: table.string("name", "")) or ""
    voice = mistakes.keep(lambda: table.string("voice", "")) or ""
    entries = joined_entries(parts, mistakes)
    rules = vocabulary.rules
    missing = [rule for rule in rules if rule not in entries]
    replies = {}
    for rule, entry in entries.items():
        if rule in rules:
            replies[rule] = mistakes.keep(partial(_reply, rule, entry, vocabulary)) or Reply()
        elif is_own and not _is_silent(rule, vocabulary):
            mend = "delete this table, or fix the grammar"
            if vocabulary.app.base is not None and vocabulary.app.grammar() is None:
                mend = f"add the rule to a {GRAMMARS[0]} in {vocabulary.app.folder}"
            remedy = did_you_mean(rule, missing, mend)
            mistakes.add(entry.error(None, f'the grammar has no rule "{rule}"', remedy))
    unasked = mistakes.keep(lambda: _unasked(table.table("unasked", optional=True))) or {}
    about = mistakes.keep(lambda: _about(table, vocabulary, is_own)) or {}
    asked = mistakes.keep(lambda: table.array("question")) or ()
    questions = [mistakes.keep(partial(_question, entry, vocabulary, is_own)) for entry in asked]
    then: dict[str, tuple[str, ...]] = {}
    for entry in mistakes.keep(lambda: table.array("then")) or ():
        then.update(mistakes.keep(partial(_then, entry, vocabulary, is_own)) or {})
    for part in parts:
        mistakes.keep(part.finish)
    asking = tuple(filter(None, questions))
    return Replies(name, voice, replies, unasked, about, asking, then)


def _is_silent(rule: str, vocabulary: Vocabulary) -> bool:
    """Whether the app leaves out a rule, or a skill replaces it; its reply may stay."""
    if rule in vocabulary.app.replaced_rules:
        return True
    known = vocabulary.grammar.rules.get(rule)
    return known is not None and not known.topics.isdisjoint(vocabulary.app.silent_topics)


def _joined(below: Replies, above: Replies) -> Replies:
    return Replies(
        above.name or below.name,
        above.voice or below.voice,
        {**below.replies, **above.replies},
        {**below.unasked, **above.unasked},
        {**below.about, **above.about},
        (*below.questions, *above.questions),
        {**below.then, **above.then},
    )


def _refuse_gaps(found: Replies, table: Table, vocabulary: Vocabulary, mistakes: Mistakes) -> None:
    """Note what no file says."""
    if not found.name:
        mistakes.add(table.error(None, '"name" is missing in this file', "add name = ..."))
    given = table.data.get("reply")
    written = given if isinstance(given, dict) else {}
    own = [rule for rule in vocabulary.rules if vocabulary.skill_of(rule) is None]
    if missing := [rule for rule in own if rule not in {*found.replies, *written}]:
        mistakes.add(_unanswered(table, missing))
    for key in UNASKED:
        if key not in found.unasked and key not in table.data.get("unasked", {}):
            mistakes.add(
                table.error("unasked", f'"{key}" is missing in [unasked]', f"add {key} = ...")
            )


def _refuse_unanswered(
    found: Replies, table: Table, vocabulary: Vocabulary, mistakes: Mistakes
) -> None:
    """Note the rules of a skill, whose replies these are, that have none."""
    skill = vocabulary.app.skill_at(table.path)
    own = (rule for rule in vocabulary.rules if vocabulary.skill_of(rule) is skill)
    if missing := [rule for rule in own if rule not in found.replies]:
        mistakes.add(_unanswered(table, missing))


def _unanswered(table: Table, missing: Sequence[str]) -> AuthoringError:
    rules = f"rule{'s' * (len(missing) > 1)} {', '.join(f'<{rule}>' for rule in missing)}"
    each = " for each" * (len(missing) > 1)
    remedy = f"add a table [reply.{missing[0]}]{each}, an empty one to do nothing"
    return table.error(None, f"no reply to the {rules} of the grammar", remedy)


def _unasked(spoken: Table) -> dict[str, tuple[str, ...]]:
    known = (*UNASKED, *USUALLY_UNASKED)
    unasked = {key: _texts(spoken, key) for key in known if key in spoken}
    for key in set(spoken.keys()) - set(known):
        raise spoken.error(key, f'unknown key "{key}"', did_you_mean(key, known))
    for key in USUALLY_UNASKED.keys() & unasked.keys():
        usual = [field for text in USUALLY_UNASKED[key] for field in fields_of(text)]
        for text in unasked[key]:
            check_text(spoken, text, (*usual, *MORE_FILLED_IN.get(key, ())), key)
    return unasked


def _texts(table: Table, key: str) -> tuple[str, ...]:
    """A text, or a list of them; those that are empty say nothing."""
    is_list = isinstance(table.data.get(key), list)
    texts = table.strings(key) if is_list else [table.string(key)]
    return tuple(text for text in texts if text)


def _about(table: Table, vocabulary: Vocabulary, is_own: bool) -> dict[str, str]:
    """What rules are about; only those of the app's own file must be in the grammar."""
    if "about" not in table:
        return {}
    entries = table.table("about")
    topics = {rule: entries.string(rule) for rule in entries.keys()}  # noqa: SIM118 - a Table
    if is_own:
        _refuse_unknown_rules(entries, None, topics, vocabulary)
    return topics


def _refuse_unknown_rules(
    table: Table, key: str | None, rules: Collection[str], vocabulary: Vocabulary
) -> None:
    """Refuse a name that is not a rule of the grammar; `key` is where it is written."""
    known = vocabulary.grammar.rules
    for rule in rules:
        if rule not in known:
            remedy = did_you_mean(rule, vocabulary.grammar.public_rules)
            raise table.error(key or rule, f'the grammar has no rule "{rule}"', remedy)


def _reply(rule: str, entry: Table, vocabulary: Vocabulary) -> Reply:
    is_motion = not vocabulary.grammar.tag_names(rule).isdisjoint(MOTION)
    braces = {*FILLED_IN, *vocabulary.tags, *(["direction"] if is_motion else [])}
    wording = read_wording(entry, braces, vocabulary.personalities)
    show = entry.string("show", "")
    if not show.startswith("{"):
        _expression(entry, show, vocabulary)
    gesture = entry.string("gesture", "")
    if gesture and gesture not in vocabulary.gestures:
        remedy = did_you_mean(gesture, sorted(vocabulary.gestures))
        raise entry.error("gesture", f'the face has no gesture "{gesture}"', remedy)
    feel = entry.string("feel", "")
    if feel and feel not in vocabulary.stimuli:
        remedy = did_you_mean(feel, sorted(vocabulary.stimuli))
        raise entry.error("feel", f'no stimulus "{feel}"', remedy)
    intensity = entry.number("intensity", 1.0, minimum=0, maximum=1)
    action, task = entry.string("action", ""), _action(rule, entry, vocabulary)
    event = read_event(entry)
    because = entry.string("because", "")
    check_text(entry, because, braces, "because")
    form, form_task = _form(entry, vocabulary)
    entry.finish()
    return Reply(
        wording, feel, intensity, show, gesture, action, task, event, because, form, form_task
    )


def _form(entry: Table, vocabulary: Vocabulary) -> tuple[Form | None, TaskType | None]:
    """The form that `form` names, and the task of its `action`."""
    if not (name := entry.string("form", "")):
        return None, None
    if name not in vocabulary.forms:
        remedy = did_you_mean(name, vocabulary.forms, f"write [form.{name}] in {FORMS}")
        raise entry.error("form", f'there is no form "{name}"', remedy)
    form = vocabulary.forms[name]
    for rule in load_grammar(form.grammar).public_rules:
        if rule in vocabulary.rules:
            what = f"its grammar {form.grammar} has a rule <{rule}>, which is also a command"
            raise entry.error("form", f"the form {name}: {what}", "give the rule another name")
    if not form.action:
        return form, None
    try:
        task = vocabulary.app.task_type(form.action, vocabulary.app.skill_at(form.path))
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise entry.error("form", f"the form {name}: {what}", remedy) from error
    slots = [slot.name for slot in form.slots]
    for needed, parameter in task.parameters.items():
        if parameter.default is Parameter.empty and needed not in slots:
            what = f'the task {task.id} needs "{needed}", which is not a slot of the form {name}'
            raise entry.error("form", what, did_you_mean(needed, slots))
    return form, task


def _action(rule: str, entry: Table, vocabulary: Vocabulary) -> TaskType | None:
    """The task that `action` names; one of the app comes before one of the companion."""
    if not (action := entry.string("action", "")):
        return None
    app, skill = vocabulary.app, vocabulary.app.skill_at(entry.path)
    part = skill or app
    own = [name for name in app.task_names(skill) if name not in part.tasks]
    if action not in own and app.has_plain_function(action, skill):
        what = f"{action} in tasks.py is not a task"
        remedy = f"write: async def {action}(context, ...), or decorate it with @immediate"
        raise entry.error("action", what, remedy)
    if action not in own and "." not in action:
        remedy = did_you_mean(action, own)
        tasks = part.folder / "tasks.py"
        if not tasks.exists():
            remedy = f"{remedy} If it is a task of yours, {tasks} is missing"
        raise entry.error("action", f'action is "{action}"', remedy)
    try:
        task = app.task_type(action, skill)
    except HriError as error:
        what, _, remedy = str(error).partition(" - ")
        raise entry.error("action", what, remedy) from error
    _refuse_unfit(rule, task, entry, vocabulary.grammar)
    return task


def _refuse_unfit(rule: str, task: TaskType, entry: Table, grammar: Grammar) -> None:
    """Refuse a task that does not take a tag of the rule, or needs one that may be missing."""
    tags, sure = grammar.tag_names(rule), sure_tags(grammar.rules, rule) | {HEARD}
    taken = list(task.parameters)
    # The companion's own actions may leave out tags, as they always did.
    for tag in () if isinstance(task, ImmediateTask) else sorted(tags - set(taken)):
        what = f'<{rule}> gives "{tag}", which the task {task.id} does not take'
        remedy = did_you_mean(tag, taken, f"give it a parameter {tag}")
        raise entry.error("action", what, remedy)
    for name in taken:
        if task.parameters[name].default is Parameter.empty and name not in sure:
            when = "not always give" if name in tags else "not give"
            what = f'the task {task.id} needs "{name}", which <{rule}> does {when}'
            remedy = f"give {name} a default value, or write {{{name}=...}} in the grammar"
            raise entry.error("action", what, remedy)


def _question(entry: Table, vocabulary: Vocabulary, is_own: bool) -> Question:
    ask, yes, no = entry.string("ask"), entry.string("yes", ""), entry.string("no", "")
    action = entry.string("action", "", among=AFTER_YES)
    show = _expression(entry, entry.string("show", ""), vocabulary)
    hour, after = _listed(entry, "hour"), _listed(entry, "after")
    feeling = _listed(entry, "feeling")
    for name in feeling:
        if name not in KNOWN_FEELINGS:
            raise entry.error(
                "feeling", f'unknown feeling "{name}"', did_you_mean(name, KNOWN_FEELINGS)
            )
    for part in hour:
        if part not in PARTS_OF_DAY:
            raise entry.error("hour", f'hour is "{part}"', did_you_mean(part, PARTS_OF_DAY))
    if is_own:
        _refuse_unknown_rules(entry, "after", after, vocabulary)
    once = entry.string("once", "", among=(DAY,))
    entry.finish()
    task = vocabulary.app.task_type(action) if action in vocabulary.app.task_names() else None
    return Question(ask, yes, no, action, task, show, hour, once, after, feeling)


def _then(entry: Table, vocabulary: Vocabulary, is_own: bool) -> dict[str, tuple[str, ...]]:
    """The answers to a line that comes after some rules and is not understood, by rule."""
    after, texts = entry.strings("after"), _texts(entry, "say")
    if is_own:
        _refuse_unknown_rules(entry, "after", after, vocabulary)
    for text in texts:
        check_text(entry, text, (), "say")
    entry.finish()
    return dict.fromkeys(after, texts)


def _listed(entry: Table, key: str) -> tuple[str, ...]:
    """What may be a text or a list of texts."""
    return _texts(entry, key) if key in entry else ()


def _expression(entry: Table, show: str, vocabulary: Vocabulary) -> str:
    """An expression of the face. Raises AuthoringError for one that it does not have."""
    if show and show not in vocabulary.expressions:
        remedy = did_you_mean(show, sorted(vocabulary.expressions))
        raise entry.error("show", f'the face has no expression "{show}"', remedy)
    return show
