from __future__ import annotations

import os

import pytest

from hri.behavior.ports import OutputPort
from hri.core.errors import AuthoringError, HriError
from hri.core.signals import HeardSlot
from hri.speech.behaviors import Listener

from .fakes import TICK, DeafMicrophone, HighMicrophone, Stage


class RecordedMicrophone(DeafMicrophone):
    is_recording = True


def speaking(listener: Listener) -> OutputPort[bool]:
    """Something that says whether the robot speaks, linked to the listener."""
    port: OutputPort[bool] = OutputPort()
    listener.is_speaking.sources.append(port)
    return port


def test_a_command_is_heard_with_its_meaning():
    stage = Stage(Listener())
    stage.ears.script[1.0] = ("go forward ten meters", 0.92149)

    stage.run(1.0)
    assert stage.events == []
    stage.run(0.2)

    ((time, name, properties),) = stage.events
    assert 1.15 <= time <= 1.2 + TICK
    assert name == "speech.heard"
    assert properties == {
        "text": "go forward ten meters",
        "rule": "move",
        "tags": {"distance": 10.0},
        "confidence": 0.921,
        "start": 0.5,
        "end": 1.0,
        "latency": pytest.approx(0.15, abs=TICK),
        "command": "go forward ten meters",
        "may_go_on": False,
        "continues": False,
        "follow_up": "",
    }


def test_words_of_a_free_slot_come_with_their_sound(write):
    stage = Stage(Listener(grammar=str(write("public <name> = my name is <name.spoken>;"))))
    slot = HeardSlot("name", "siobhan", ("SH", "IH", "V", "AO", "N"), 0.8, ("chevonne",))
    stage.ears.script[1.0] = ("my name is siobhan", 0.9, (), (), "", "", (slot,))

    stage.run(1.5)

    ((_, name, properties),) = stage.events
    assert (name, properties["tags"]) == ("speech.heard", {"name": "siobhan"})
    assert properties["command"] == "my name is siobhan"
    assert properties["spoken"] == {
        "name": {
            "text": "siobhan",
            "phones": ["SH", "IH", "V", "AO", "N"],
            "others": ["chevonne"],
        }
    }
    assert stage.behavior.last_utterance.slots == (slot,)


@pytest.mark.parametrize(
    ("text", "confidence", "reason"),
    [
        ("go forward", 0.49, "low confidence"),
        ("go forward fish", 0.9, "not in grammar"),
        ("", 0.0, "no speech"),
    ],
)
def test_what_does_not_count_is_rejected_with_its_reason(text, confidence, reason):
    stage = Stage(Listener())
    stage.ears.script[1.0] = (text, confidence)

    stage.run(1.5)

    ((_, name, properties),) = stage.events
    assert name == "speech.rejected"
    told = (properties["reason"], properties["text"], properties["confidence"])
    assert told == (reason, text, confidence)


def test_strictness_moves_the_line():
    stage = Stage(Listener(strictness=0.8))
    stage.ears.script[1.0] = ("go forward", 0.7)

    stage.run(1.5)

    assert stage.names() == ["speech.rejected"]


def test_while_the_robot_speaks_only_stop_counts():
    listener = Listener()
    port = speaking(listener)
    stage = Stage(listener)
    stage.ears.script |= {1.0: ("go forward", 0.9), 2.0: ("stop", 0.9), 4.0: ("go back", 0.9)}

    port.value = True
    stage.run(2.5)
    port.value = False
    stage.run(2.0)

    assert stage.names() == [
        "speech.rejected",
        "speech.interrupted",
        "speech.heard",
        "speech.heard",
    ]
    assert stage.events[0][2]["reason"] == "robot speaking"
    assert stage.events[2][2]["rule"] == "stop"


def test_speech_that_began_while_the_robot_spoke_counts_as_such():
    listener = Listener()
    port = speaking(listener)
    stage = Stage(listener)
    stage.ears.script[2.0] = ("go forward", 0.9)

    stage.run(1.6)
    port.value = True
    stage.run(0.1)
    port.value = False
    stage.run(1.0)

    assert stage.events[0][2]["reason"] == "robot speaking"


def test_the_utterance_is_sent_once():
    stage = Stage(Listener())
    stage.ears.script[1.0] = ("hello robot", 0.9)
    sent = []
    for _ in range(40):
        stage.run(TICK)
        if (utterance := stage.behavior.utterance.value) is not None:
            sent.append(utterance)

    (utterance,) = sent
    assert (utterance.rule, utterance.start, utterance.end) == ("greet", 0.5, 1.0)


def test_it_is_idle_when_all_is_understood():
    stage = Stage(Listener())
    stage.ears.script |= {1.0: ("hello robot", 0.9), 1.01: ("go forward", 0.9)}

    stage.run(0.3)
    assert stage.behavior.is_idle
    stage.run(0.4)
    assert stage.behavior.is_hearing.value
    assert not stage.behavior.is_idle
    stage.run(0.4)
    assert not stage.behavior.is_idle
    stage.run(0.4)
    assert stage.behavior.is_idle
    assert stage.names() == ["speech.heard", "speech.heard"]


def test_it_is_not_idle_before_it_tells_what_it_understood_in_a_pause():
    stage = Stage(Listener())
    stage.ears.script[1.0], stage.ears.pause = ("hello robot", 0.9), 0.4

    stage.run(0.6)
    while "speech.heard" not in stage.names():
        assert not stage.behavior.is_idle
        stage.run(TICK)

    assert stage.behavior.is_idle


def test_a_wrong_grammar_is_refused_before_anything_starts(write):
    with pytest.raises(AuthoringError, match="no rule <colr>"):
        Stage(Listener(grammar=str(write("public <a> = <colr>;\n<color> = red;"))))
    with pytest.raises(HriError, match=r'no "companio" in grammars - did you mean "companion"'):
        Stage(Listener(grammar="companio"))


def test_a_microphone_of_another_rate_is_heard_at_the_recognizers():
    stage = Stage(Listener(), HighMicrophone)
    stage.run(2.0)
    assert stage.ears.count == pytest.approx(2.0 * stage.ears.rate, rel=0.02)


def test_what_is_understood_so_far_is_told_while_somebody_speaks():
    stage = Stage(Listener(latency_s=0.0))
    stage.ears.script[1.0] = ("go forward", 0.9)
    stage.ears.partials = {0.6: "go", 0.9: "go forward"}

    stage.run(1.5)

    assert [p["text"] for _, name, p in stage.events if name == "speech.partial"] == [
        "go",
        "go forward",
    ]
    times = [time for time, name, _ in stage.events if name == "speech.partial"]
    assert times[1] - times[0] >= 0.2 - TICK


def test_nothing_is_told_of_the_words_while_the_robot_itself_speaks():
    listener = Listener(latency_s=0.0)
    port = speaking(listener)
    stage = Stage(listener)
    stage.ears.script[1.0], stage.ears.partials = ("go forward", 0.9), {0.5: "go"}

    port.value = True
    stage.run(1.5)

    assert stage.names() == ["speech.rejected"]


def test_the_engine_is_told_which_rules_count():
    listener = Listener()
    question: OutputPort[bool] = OutputPort(True)
    stage = Stage(listener)
    stage.ears.script |= {1.0: ("yes please", 0.9), 3.0: ("yes please", 0.9)}

    stage.run(2.0)
    listener.question.sources.append(question)
    stage.run(2.0)

    unasked, everything, asked = stage.ears.decoded_with
    assert everything == frozenset(), "what no rule explains is held against all of them"
    assert asked - unasked == {"yes", "no", "unsure"}
    assert stage.names() == ["speech.rejected", "speech.heard"]


@pytest.mark.parametrize(
    ("first", "again", "after", "is_heard"),
    [
        (("yes", 0.4), ("yes", 0.4), 3.0, True),
        (("yes", 0.27), ("yes", 0.27), 3.0, False),
        (("yes", 0.45), ("yes", 0.2), 3.0, False),
        (("yes", 0.2), ("yes", 0.45), 3.0, False),
        (("yes", 0.45), ("no", 0.45), 3.0, False),
        (("yes", 0.45), ("yes", 0.45), 25.0, False),
    ],
)
def test_an_answer_that_is_said_again_is_believed_more(first, again, after, is_heard):
    listener = Listener()
    listener.question.sources.append(OutputPort(True))
    stage = Stage(listener)
    stage.ears.script |= {1.0: first, 1.0 + after: again}

    stage.run(after + 2.0)

    assert stage.names()[0] == "speech.rejected"
    assert stage.names()[1:] == (["speech.heard"] if is_heard else ["speech.rejected"])


@pytest.mark.parametrize("is_open", [True, False])
def test_a_careful_command_or_one_without_a_question_is_not_believed_more(is_open, write):
    grammar = write("/** @careful */ public <go> = go away;\npublic <hello> = hello;")
    listener = Listener(grammar=str(grammar))
    listener.question.sources.append(OutputPort(is_open))
    stage = Stage(listener)
    said = ("go away" if is_open else "hello", 0.45)
    stage.ears.script |= {1.0: said, 4.0: said}

    stage.run(6.0)

    assert stage.names() == ["speech.rejected", "speech.rejected"]


def test_a_wake_word_opens_the_talk_for_a_while(write):
    grammar = write("/** @wake */ public <hey> = hey robot;\npublic <greet> = hello;")
    stage = Stage(Listener(grammar=str(grammar), follow_up=3.0))
    stage.ears.script |= {1.0: ("hello", 0.9), 2.0: ("hey robot", 0.9), 4.0: ("hello", 0.9)}
    stage.ears.script |= {6.5: ("hello", 0.9), 11.0: ("hello", 0.9)}

    stage.run(12.0)

    assert stage.names() == [
        "speech.rejected",
        "speech.heard",
        "speech.heard",
        "speech.heard",
        "speech.rejected",
    ]


PHRASES = """
/** @anywhere */ public <leave> = see you later [<me>];
/** @name */ <me> = robot;
"""


def leaving(write, microphone=DeafMicrophone, port="", value=True):
    """What becomes of "see you later" among other words, said at 1 s, 4 s and 20 s."""
    listener = Listener(grammar=str(write(PHRASES)))
    if port:
        getattr(listener, port).sources.append(OutputPort(value))
    stage = Stage(listener, microphone)
    among = ("<any> see you later <any>", 0.9)
    stage.ears.script |= {1.0: among, 4.0: among, 20.0: among}
    stage.run(21.0)
    return [name.removeprefix("speech.") for name in stage.names()]


def test_a_phrase_among_other_words_waits_for_someone_who_turns_to_the_robot(write):
    assert leaving(write) == ["rejected"] * 3
    assert leaving(write, port="is_addressed", value=False) == ["rejected"] * 3
    for port in ("is_addressed", "question", "push_to_talk"):
        assert leaving(write, port=port) == ["heard"] * 3


def test_a_recording_is_meant_for_the_robot(write):
    assert leaving(write, microphone=RecordedMicrophone) == ["heard"] * 3


def test_its_name_opens_the_talk_for_phrases_among_other_words(write):
    stage = Stage(Listener(grammar=str(write(PHRASES))))
    among = ("<any> see you later <any>", 0.9)
    stage.ears.script |= {1.0: ("<any> robot <any> see you later", 0.9), 5.0: among, 20.0: among}
    stage.run(21.0)
    assert stage.names() == ["speech.heard", "speech.heard", "speech.rejected"]


def test_who_looked_while_they_spoke_is_heard_after_they_look_away(write):
    listener = Listener(grammar=str(write(PHRASES)))
    looks: OutputPort[bool] = OutputPort(True)
    listener.is_addressed.sources.append(looks)
    stage = Stage(listener)
    stage.ears.script[1.0] = ("<any> see you later <any>", 0.9)
    stage.run(0.8)
    looks.value = False
    stage.run(1.0)
    assert stage.names() == ["speech.heard"]


def test_push_to_talk_is_deaf_until_it_is_pushed_and_done_when_it_is_let_go():
    listener = Listener()
    button: OutputPort[bool] = OutputPort(False)
    listener.push_to_talk.sources.append(button)
    stage = Stage(listener)

    stage.run(1.0)
    assert stage.ears.count == 0
    button.value = True
    stage.run(1.0)
    assert stage.ears.count == 16000


def test_a_muted_listener_hears_nothing():
    stage = Stage(Listener())
    stage.behavior.is_muted = True
    stage.run(1.0)
    assert stage.ears.count == 0


def test_a_muted_listener_hears_while_it_is_held_and_no_longer():
    stage = Stage(Listener())
    stage.behavior.is_muted = True
    stage.behavior.hold(1.0)
    stage.run(2.0)
    assert stage.ears.count == pytest.approx(16000, abs=800)  # of one tick
    stage.behavior.hold(1.0)
    stage.run(0.5)
    stage.behavior.hold(0.0)
    stage.run(1.0)
    assert stage.ears.count == pytest.approx(24000, abs=1600)


def test_another_grammar_takes_over_while_somebody_speaks(write):
    stage = Stage(Listener())
    stage.ears.script |= {1.0: ("go forward", 0.9), 2.0: ("red wine", 0.9)}

    stage.run(0.8)
    layer = stage.behavior.push(write("public <drink> = red wine;", "drinks"))
    stage.run(1.6)

    # What ended before the new one was ready is of the new one too, on a clock that stands still.
    assert stage.behavior.is_in_force(layer)
    assert stage.behavior.loaded_grammar.name == "drinks"
    heard = [p["text"] for _, name, p in stage.events if name == "speech.heard"]
    assert heard[-1] == "red wine"
    assert "grammar.changed" in stage.names()

    stage.behavior.pop(layer)
    stage.behavior.pop(layer)
    stage.ears.script[3.5] = ("go back", 0.9)
    stage.run(2.0)
    assert stage.events[-1][2]["text"] == "go back"


@pytest.mark.parametrize("way", ["push", "use", "push twice", "use above"])
def test_stop_counts_under_every_other_grammar(write, way):
    stage = Stage(Listener())
    stage.run(0.5)
    drinks, snacks = (
        write("public <drink> = red wine;", "drinks"),
        write("public <a> = b;", "snacks"),
    )
    put = {
        "push": [stage.behavior.push],
        "use": [stage.behavior.use],
        "push twice": [lambda path: stage.behavior.push(snacks), stage.behavior.push],
        "use above": [lambda path: stage.behavior.push(snacks), stage.behavior.use],
    }[way]
    for step in put:
        step(drinks)
        stage.run(0.5)
    stage.ears.script |= {2.5: ("stop", 0.9), 3.5: ("red wine", 0.9), 4.5: ("go forward", 0.9)}
    stage.run(4.0)
    told = []
    stage.behavior.type_line("stop moving", told.append)
    stage.run(0.5)

    assert [one.rule for one in told] == ["stop"], "of what was typed alone"
    heard = [(p.get("rule"), p["text"]) for _, name, p in stage.events if "speech" in name]
    assert heard == [
        ("stop", "stop"),
        ("drink", "red wine"),
        (None, "go forward"),
        ("stop", "stop moving"),
    ]


def test_stop_counts_over_speech_and_before_the_pause_under_another_grammar(write):
    listener = Listener()
    port = speaking(listener)
    stage = Stage(listener)
    stage.ears.pause = 0.45
    stage.run(0.5)
    listener.push(write("public <drink> = red wine | stop;", "drinks"))
    port.value = True
    stage.ears.script = {1.5: ("stop", 0.9)}
    stage.run(0.8)
    assert stage.names() == ["grammar.changed", "speech.interrupted", "speech.heard"]
    assert stage.events[-1][2]["rule"] == "stop"


def test_a_first_grammar_that_was_read_again_is_the_one_whose_stop_counts(write):
    path = write("/** @interrupts */\npublic <stop> = stop;", "first")
    stage = Stage(Listener(grammar=str(path), reload=True))
    stage.run(2.0)
    write("/** @interrupts */\npublic <end> = enough;", "first")
    os.utime(path, (2_000_000_000, 2_000_000_000))
    stage.run(2.0)
    stage.behavior.use(write("public <drink> = red wine;", "drinks"))
    stage.run(0.5)
    assert stage.behavior.loaded_grammar.public_rules == ("end", "drink")


@pytest.mark.parametrize(
    ("rules", "why"),
    [("public <a> = <b>;", "no rule <b>"), ("public <a> = unspeakable;", "unspeakable - write")],
)
def test_a_faulty_grammar_is_refused_and_the_old_one_stays(write, rules, why):
    stage = Stage(Listener())
    stage.run(0.5)
    layer = stage.behavior.use(write(rules, "faulty"))
    stage.ears.script[1.5] = ("go forward", 0.9)
    stage.run(1.5)

    assert why in str(layer.error)
    assert stage.names() == ["grammar.refused", "speech.heard"]
    assert why in stage.events[0][2]["error"]
    assert not stage.behavior.is_in_force(layer)


def test_a_first_grammar_that_the_recognizer_refuses_serves_for_typed_lines(write):
    path = write("public <a> = unspeakable | go forward;")
    stage = Stage(Listener(grammar=str(path)))
    stage.run(1.5)
    assert stage.names() == ["grammar.refused"]
    assert "unspeakable - write" in stage.events[0][2]["error"]

    stage.behavior.type_line("unspeakable")
    stage.run(0.5)
    assert stage.names()[1:] == ["speech.heard"]

    layer = stage.behavior.push(write("public <b> = hello;", "other"))
    stage.run(0.5)
    stage.ears.script[3.0] = ("hello", 0.9)
    stage.run(1.0)
    assert stage.names()[2:] == ["grammar.changed", "speech.heard"]

    stage.behavior.pop(layer)
    stage.run(1.0)
    assert stage.names()[4:] == ["grammar.refused"]
    stage.behavior.type_line("unspeakable")
    stage.run(0.5)
    assert stage.names()[5:] == ["speech.heard"]


def test_a_grammar_is_read_again_when_its_file_changes(write):
    path = write("public <greet> = hello;")
    stage = Stage(Listener(grammar=str(path), reload=True))
    stage.run(2.0)
    assert stage.events == []

    write("public <greet> = hello;\npublic <part> = farewell;")
    os.utime(path, (2_000_000_000, 2_000_000_000))
    stage.run(2.0)
    assert stage.names() == ["grammar.changed"]
    assert stage.behavior.loaded_grammar.public_rules == ("greet", "part")

    path.write_text("#JSGF V1.0;\ngrammar test;\npublic <greet> = <hullo>;")
    os.utime(path, (2_000_000_100, 2_000_000_100))
    stage.run(4.0)
    assert stage.names() == ["grammar.changed", "grammar.refused"]
    assert stage.behavior.loaded_grammar.public_rules == ("greet", "part")


def test_a_grammar_that_was_read_again_is_taken_away_by_who_put_it_there(write):
    stage = Stage(Listener(reload=True))
    stage.run(0.5)
    path = write("public <drink> = red wine;", "drinks")
    layer = stage.behavior.push(path)
    stage.run(0.5)

    for second in range(2):
        write("public <drink> = white wine;", "drinks")
        os.utime(path, (2_000_000_000, 2_000_000_000 + second))
        stage.run(2.5)
        assert list(stage.behavior.loaded_grammar.sentences_of("drink", 1)) == ["white wine"]
        assert stage.behavior.is_in_force(layer)
    assert stage.names() == ["grammar.changed"] * 3
    assert [told["reloaded"] for _, _, told in stage.events] == [False, True, True]

    stage.behavior.pop(layer)
    stage.run(0.5)
    assert stage.behavior.loaded_grammar.name == "companion"


@pytest.mark.parametrize(
    ("words", "confidence", "when"),
    [("stop", 0.9, 0.8), ("stop", 0.6, 1.05), ("go forward", 0.9, 1.05)],
)
def test_a_sure_stop_does_not_wait_for_the_pause_to_end(words, confidence, when):
    stage = Stage(Listener())
    stage.ears.pause = 0.45
    stage.ears.script = {1.0: (words, confidence)}
    stage.run(2.0)

    heard = [(time, what) for time, name, what in stage.events if name == "speech.heard"]
    assert [what["text"] for _, what in heard] == [words]
    assert heard[0][0] == pytest.approx(when, abs=0.06)


def test_who_goes_on_after_a_stop_is_heard_too():
    stage = Stage(Listener())
    stage.ears.pause = 0.45
    stage.ears.script = {1.0: ("stop", 0.9)}
    stage.run(0.9)
    stage.ears.script = {1.0: ("go forward", 0.9)}
    stage.run(1.0)

    assert [what["text"] for _, name, what in stage.events if name == "speech.heard"] == [
        "stop",
        "go forward",
    ]


def test_what_people_said_in_a_slot_is_known_to_the_ears():
    stage = Stage(Listener())
    stage.behavior.know("name", {"zorvin": ("Z", "AO", "R", "V", "IH", "N")})
    stage.run(0.2)
    assert stage.ears.known == {"name": {"zorvin": ("Z", "AO", "R", "V", "IH", "N")}}
    stage.behavior.know("name", {})
    assert stage.ears.known == {"name": {}}


@pytest.mark.parametrize(
    ("text", "rule"),
    [
        ("red wine and go forward", "drink"),
        ("go forward with red wine", "drink"),
        ("bring red wine here", "bring"),
        ("note red wine here", "drink"),
        ("red wine", "drink"),
    ],
)
def test_a_typed_line_that_answers_only_among_other_words_may_be_a_whole_command(write, text, rule):
    commands = "public <bring> = bring red wine here | red wine;\npublic <note> = note <it.spoken>;"
    stage = Stage(Listener(grammar=str(write(commands, "commands"))))
    stage.run(0.5)
    stage.behavior.push(write("/** @anywhere */\npublic <drink> = red wine;", "drinks"))
    stage.run(0.5)
    told = []
    stage.behavior.type_line(text, told.append)
    stage.run(0.8)
    assert told[0].rule == rule
