"""Small talk: each rule has fitting replies, and each example means its rule."""

import tomllib
from collections import Counter

import pytest

from hri.emotion.stimulus import load_stimuli
from hri.face.model import load_face
from hri.face.motion.gesture_tracks import load_gestures
from hri.robot.app import load_app
from hri.speech.grammar import parse
from hri.speech.grammar.loader import load_grammar
from hri.speech.vocalizations.in_text import parted

TOPICS = (
    "about_me",
    "about_you",
    "cannot",
    "comfort",
    "courtesy",
    "friendship",
    "fun",
    "talk",
    "teasing",
)
LONGEST = 160
"""Characters of a reply: some ten seconds of speech."""
FOLDER = load_app("companion").folder / "smalltalk"


def replies(topic):
    """The [reply.RULE] tables of a topic."""
    with (FOLDER / f"{topic}.toml").open("rb") as file:
        return tomllib.load(file)["reply"]


def texts(entry):
    """All that a reply may say, with the key that it is said under."""
    for key, value in entry.items():
        if isinstance(value, list):
            yield from ((key, text) for text in value)
        elif isinstance(value, dict):
            for name, those in value.items():
                yield from ((f"{key}.{name}", text) for text in those)


def rules_of(grammar):
    """The rules of small talk, without those of the companion."""
    return [key for key in grammar.public_rules if grammar.rules[key].topics]


def understood(grammar, text):
    """What a sentence means while no question is open."""
    return parse(grammar, text, frozenset(grammar.public_rules) - grammar.marked("answer"))


@pytest.fixture(scope="module")
def smalltalk():
    return load_grammar("smalltalk")


@pytest.fixture(scope="module")
def companion():
    return load_grammar("companion").called("robin")


def test_every_rule_is_answered_in_the_file_of_its_topic(smalltalk):
    assert smalltalk.topics == frozenset(TOPICS)
    by_topic = {topic: set(replies(topic)) for topic in TOPICS}
    answered = [key for key in smalltalk.public_rules if not smalltalk.rules[key].stands_for]
    of_rules = {
        topic: {key for key in answered if topic in smalltalk.rules[key].topics} for topic in TOPICS
    }
    assert by_topic == of_rules
    assert sum(map(len, by_topic.values())) > 150


def test_every_file_of_small_talk_is_read_with_the_replies():
    with (FOLDER.parent / "replies.toml").open("rb") as file:
        also = tomllib.load(file)["also"]
    assert sorted(also) == ["people.toml", *(f"smalltalk/{topic}.toml" for topic in TOPICS)]


@pytest.mark.parametrize("topic", TOPICS)
def test_every_reply_has_several_texts_and_shows_on_the_face(topic):
    face = load_face("person")
    gestures, stimuli = load_gestures(face), load_stimuli()
    for rule, entry in replies(topic).items():
        assert len(entry["say"]) >= 2, rule
        assert {"show", "gesture", "feel"} & entry.keys(), rule
        assert entry.get("show", "neutral") in face.expressions, rule
        assert entry.get("gesture", "nod") in gestures, rule
        assert entry.get("feel", "praise") in stimuli, rule


def test_no_text_is_long_or_said_for_two_reasons():
    said = Counter()
    for topic in TOPICS:
        for rule, entry in replies(topic).items():
            for key, text in texts(entry):
                assert 2 <= len(text) <= LONGEST, (rule, key)
                words = next(part for part in parted(text) if isinstance(part, str))
                assert words[0].isupper() or words[0] == "{", (rule, key)
                assert text[-1] in ".!?", (rule, key)
                said[text] += 1
    assert [text for text, times in said.items() if times > 1] == []


def test_every_example_means_its_rule_to_the_companion(smalltalk, companion):
    for rule in rules_of(smalltalk):
        examples = smalltalk.rules[rule].examples
        assert examples, rule
        for example in examples:
            found = understood(companion, example)
            assert found is not None, example
            assert found.rule == rule, example


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("i am sad", "i_am_sad"),
        ("i am not sad", "i_am_happy"),
        ("i'm not happy", "i_am_sad"),
        ("hey robin how old are you", "age"),
        ("good evening what's new", "whats_new"),
        ("so what is your favorite color", "favorite_color"),
        ("hello robin", "greet"),
        ("you are an idiot", "insult"),
        ("i love you so much", "i_love_you"),
        ("stop it", "stop"),
        ("are you tired", "are_you_tired"),
        ("will it rain tomorrow", "weather"),
        ("could you tell us a joke please", "joke_among"),
        ("what else", "tell_more"),
        ("and you", "and_you"),
        ("like what", "like_what"),
        ("since when", "since_when"),
        ("today the kids at school call me fat again", "bullied"),
        ("i think my daughter got into medical school", "proud_of_them"),
        ("honestly i have never told anyone this", "i_confess"),
        ("he just broke up with me over text an hour ago", "heartbreak"),
        ("i want to die", "in_danger"),
        ("i wish i was dead", "in_danger"),
        ("turn around", "turn"),
        ("what is my name", "know_me"),
        ("what is your name", "name"),
        ("can it hear me", "can_you_hear"),
        ("my grandson is coming over on sunday", "my_people"),
        ("go over to the window", "go_to_place"),
        ("a little slower please", "speed"),
        ("don't tell me what time it is i don't want to know", "told_not_to"),
        ("don't look at me like that", "staring"),
        ("no not you jeff i meant the robot", "correction"),
    ],
)
def test_what_people_say_is_understood(companion, text, rule):
    found = understood(companion, text)
    assert found is not None
    assert found.rule == rule


@pytest.mark.parametrize(
    "text",
    [
        "you are not stupid",
        "you are not an idiot",
        "i am not hungry",
        "i do not want to die",
        "i don't hate you",
        "the man told the woman about the house",
    ],
)
def test_what_is_denied_or_said_of_others_is_not_taken_for_its_opposite(companion, text):
    found = understood(companion, text)
    assert found is None or found.rule not in {"insult", "scold", "in_danger", "i_am_hungry"}


@pytest.mark.parametrize(
    "text",
    [
        "i know you're just a robot but listen",
        "i want to call him but i'm too proud",
        "he always could make me laugh",
        "it was a long time ago",
        "how do you move on after that",
        "i'm afraid i have to disagree",
        "i don't know what to say to her",
        "flowers remind me of spring",
        "look at this mess in the kitchen",
    ],
)
def test_a_few_stray_words_do_not_take_a_sentence_about_something_else(companion, text):
    assert understood(companion, text) is None
