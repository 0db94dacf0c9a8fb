"""What the companion says, out of several things, and that its words fit what it feels."""

import re

import pytest

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.emotion.behaviors import EmotionModel
from hri.emotion.everyday_words import FEELINGS
from hri.robot import Robot
from tests.apps.test_own_app import JOKE, live, named, put, robot_of, shown  # noqa: F401
from tests.devices import TYPED


def said(events):
    return [event.properties["text"] for event in named(events, "speech.said")]


def companion(personality="neutral"):
    chosen = {"emotion": {"personality": personality}}
    return Robot(config="simulated", clock=FakeClock(), devices=TYPED, parameters=chosen)


def replying(put, text):  # noqa: F811
    return put({**JOKE, "replies.toml": f"[reply.twister]\n{text}\n"})


def test_a_hot_tempered_robot_that_is_scolded_is_angry_in_words_and_face():
    robot, felt, faces = companion("hot_tempered"), [], []
    emotion = robot.context.behavior(EmotionModel)
    looks = {time: lambda: felt.append(emotion.feeling().label) for time in (4.0, 10.0, 16.0)}
    lines = dict.fromkeys((3.0, 9.0, 15.0), "shame on you")
    events = live(robot, 18, lines, looks)
    angry = robot_words("scold", "angry")
    told = [text for text in said(events) if text in robot_words("scold")]
    assert len({*told}) == len(told) == 3
    assert set(told) <= set(angry)
    assert set(felt) <= FEELINGS["angry"], (felt, faces)


def test_a_neutral_robot_that_is_scolded_is_sad_and_says_so():
    events = live(companion(), 18, dict.fromkeys((3.0, 9.0, 15.0), "shame on you"))
    told = [text for text in said(events) if text in robot_words("scold")]
    assert set(told) <= set(robot_words("scold", "sad"))


def test_who_is_sad_is_not_glad_to_see_anybody_and_shows_no_happy_face():
    lines = {3.0: "i hate you", 6.0: "i hate you", 9.0: "hello"}
    robot = companion()
    seen, looks = shown(robot, [9.5, 10.0, 11.0])
    events = live(robot, 12, lines, looks)
    greeting = next(text for text in said(events) if text in robot_words("greet"))
    assert greeting in robot_words("greet", "sad")
    assert "happy" not in seen.values()


def robot_words(rule, feeling=""):
    """All that the companion may say to a rule, or only what it says with a feeling."""
    reply = replies_of(companion()).replies[rule]
    return reply.wording.feeling[feeling] if feeling else reply.say


def replies_of(robot):
    robot.app.load_tasks()
    module = robot.app.module
    return module.authored_replies(robot.context)


def test_a_feeling_takes_the_place_of_the_shown_expression(put):  # noqa: F811
    robot = robot_of(replying(put, 'say = "Ha."\nshow = "happy"\nfeeling.calm = "Hm."'))
    seen, looks = shown(robot, [2.0, 2.5])
    assert said(live(robot, 4, {1.0: "tell me a twister"}, looks)) == ["Hm."]
    assert "happy" not in seen.values()


def test_what_was_answered_is_answered_otherwise_when_it_is_asked_again(put):  # noqa: F811
    robot = robot_of(replying(put, 'say = "A stick."\nagain = ["Again?", "Once more?"]'))
    lines = dict.fromkeys((1.0, 5.0, 9.0, 13.0), "tell me a twister")
    told = [text for text in said(live(robot, 16, lines)) if text[-1] in ".?" and len(text) < 11]
    assert told == ["A stick.", "Again?", "Once more?", "A stick."]


def test_a_question_that_was_not_answered_is_not_asked_again():
    lines = {1.0: "be quiet", 4.0: "what is your name", 7.0: "hello", 11.0: "what is your name"}
    assert said(live(companion(), 14, lines))[-1] == "My name is Robin."


def test_the_hour_and_the_personality_widen_what_is_said(put):  # noqa: F811
    text = 'say = "A."\nhour = {morning = "B.", night = "C."}\npersonality.neutral = ["D."]'
    robot = robot_of(replying(put, f'{text}\npersonality.shy = "E."'))
    told = said(live(robot, 14, dict.fromkeys((1.0, 4.0, 7.0, 10.0), "tell me a twister")))
    assert [text for text in told if len(text) == 2] == ["B.", "D.", "A.", "B."]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('agian = "A."', '2:1: unknown key "agian" - did you mean "again"?'),
        ('feeling.angri = "A."', '2:1: unknown feeling "angri" - did you mean "angry"?'),
        ('feeling = {sad = "A.", sadnes = "B."}', '2:24: unknown feeling "sadnes" - did you mean'),
        ('hour.mornin = "A."', '2:1: unknown hour "mornin" - did you mean "morning"?'),
        ('personality.shi = "A."', '2:1: unknown personality "shi" - did you mean "shy"?'),
        ('again = "It is {tim}."', '2:1: nothing fills in {tim} - did you mean "time"?'),
        ('hour.night = ["{name"]', "2:1: .*close every {brace}"),
        ('feeling.sad = ["{direction}"]', "2:1: nothing fills in {direction}"),
        ('hour = ["A."]', "2:1: hour is a list - write a table"),
        ("feeling.sad = [1]", "2:1: sad holds something that is not a text"),
    ],
)
def test_a_mistake_in_what_is_said_has_a_place_and_a_remedy(put, text, message):  # noqa: F811
    with pytest.raises(AuthoringError, match=f"replies.toml:{message}"):
        robot_of(replying(put, text))


def test_an_own_personality_may_have_words(put, tmp_path, monkeypatch):  # noqa: F811
    folder = tmp_path / "emotions" / "personalities"
    folder.mkdir(parents=True)
    (folder / "pirate.toml").write_text('schema = 1\ndescription = "says arr"\n')
    monkeypatch.setenv("HRI_PATH", str(tmp_path))
    app = replying(put, 'personality.pirate = "Arr."')
    chosen = {"emotion": {"personality": "pirate"}}
    robot = Robot(str(app), "simulated", clock=FakeClock(), devices=TYPED, parameters=chosen)
    assert said(live(robot, 3, {1.0: "tell me a twister"})) == ["Arr."]


def test_after_good_night_it_says_so_and_asks_nothing():
    events = live(companion(), 25, {3.0: "good night"})
    assert said(events) == ["Good night. Sleep well."]
    assert not named(events, "question.asked")


NAMED = {
    "sad": r"\b(sad|a little down|cry|lonely)\b",
    "angry": r"\b(mad|angry|grumpy|upset|fair)\b",
    "scared": r"\b(scared|afraid|spooked|scaring)\b",
    "happy": r"\b(happy|glad|great|yay|day)\b",
}


def test_words_name_only_the_feeling_that_they_are_for():
    """The voice and the face show what it feels: an angry one must not say that it is sad."""
    for rule, reply in replies_of(companion()).replies.items():
        wording = reply.wording
        for felt, texts in wording.feeling.items():
            for text in texts:
                says = [name for name, words in NAMED.items() if re.search(words, text.lower())]
                # Who is scared may be glad of company, and speaks of the anger of others.
                allowed = {"scared": {"happy", "angry"}, "sad": {"angry"}}.get(felt, set())
                assert set(says) <= {felt, *allowed}, (rule, text)
        if rule in ("joke", "story", "riddle"):
            continue  # They tell of the feelings of others.
        for text in (*wording.say, *wording.again):
            says = [name for name in ("sad", "angry", "scared") if re.search(NAMED[name], text)]
            assert not says, (rule, text)


def test_no_reply_is_the_only_one_and_none_is_long():
    for rule, reply in replies_of(companion()).replies.items():
        said = reply.wording.say
        assert len(said) != 1 or "{" in said[0], rule
        is_longer = rule in ("in_danger", "being_hurt", "emergency", "story")
        longest = 130 if is_longer else 90
        assert all(len(text) <= longest for text in reply.say), rule
