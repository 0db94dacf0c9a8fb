from __future__ import annotations

import io
import itertools
import sys

import numpy as np
import pytest

from hri.core.clock import FakeClock
from hri.core.errors import HriError, NotAvailable
from hri.core.signals import HeardWord, Utterance
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Hypothesis, Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.acceptance import judge
from hri.speech.grammar import load_grammar
from hri.speech.recognizers import automatic
from hri.speech.recognizers.automatic import AutomaticRecognizer
from hri.speech.recognizers.consensus import ConsensusRecognizer
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.recognizers.pocketsphinx import PocketSphinxRecognizer
from hri.speech.recognizers.typed import TypedRecognizer
from hri.speech.recognizers.vosk import (
    PARTS,
    VoskRecognizer,
    hypothesis,
    is_of_another_language,
    known_sentences,
)
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.turn import Turn
from hri.speech.understanding import anticipate
from tests.recorded import BOOK, ORDERS, spoken_by_a_person

SECOND = np.zeros(16000, np.int16)
TICK = 533
"""Samples that a loop of 30 Hz brings."""


@pytest.fixture(scope="module")
def sphinx(companion):
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    manager = ResourceManager((), FakeClock())
    recognizer = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), manager)
    recognizer.activate()
    recognizer.start(companion)
    yield recognizer
    recognizer.deactivate()
    recognizer.deactivate()


def segments_of(recognizer, samples):
    found = []
    for start in range(0, len(samples), TICK):
        block = samples[start : start + TICK]
        found += recognizer.listen(block, (start + len(block)) / 16000)
    return found + recognizer.flush()


def heard(recognizer, grammar, samples):
    """What counts of a sound, at the usual strictness, while no question is open."""
    pieces = segments_of(recognizer, samples)
    judged = [anticipate(recognizer, grammar, piece, 0.5, Turn()) for piece in pieces]
    return [result for result in judged if isinstance(result, Utterance)]


def test_a_person_s_command_is_heard_exactly(sphinx, companion):
    (utterance,) = heard(sphinx, companion, spoken_by_a_person("goforward"))

    assert utterance.text == "go forward ten meters"
    assert (utterance.rule, utterance.tags) == ("move", {"distance": 10.0})
    assert utterance.confidence > 0.6
    assert 0.0 <= utterance.start < utterance.end <= 3.0


@pytest.mark.slow
def test_read_lines_of_a_book_are_no_commands(sphinx, companion):
    sounds = [spoken_by_a_person(name) for name in BOOK]

    assert len(sounds) == 5
    for sound in [*sounds, np.concatenate(sounds), np.concatenate([*sounds, SECOND] * 2)]:
        assert heard(sphinx, companion, np.concatenate([sound, SECOND])) == []


@pytest.mark.slow
def test_orders_of_coffee_are_no_commands(sphinx, companion):
    accepted = [name for name in ORDERS if heard(sphinx, companion, spoken_by_a_person(name))]

    assert accepted == []


@pytest.mark.slow
def test_what_is_heard_does_not_depend_on_what_was_heard_before(sphinx, companion):
    names = ["goforward", "something", "numbers", "cards003"]
    pieces = {name: segments_of(sphinx, spoken_by_a_person(name)) for name in names}
    rules = Turn().rules(companion)

    def heard_of(name):
        return [sphinx.decode(piece, rules) for piece in pieces[name]]

    first = {name: heard_of(name) for name in names}
    again = {name: heard_of(name) for name in reversed(names)}

    assert first == again


@pytest.mark.slow
def test_only_the_rules_that_count_now_are_listened_for(sphinx, companion, spoken):
    (piece,) = segments_of(sphinx, spoken("go forward ten meters"))
    commands, answers = Turn().rules(companion), companion.marked("answer")

    found = [sphinx.decode(piece, rules).text for rules in (commands, answers, commands)]

    assert found[0] == found[2] == "go forward ten meters"
    assert "forward" not in found[1]


@pytest.fixture
def spoken(resources):
    """Synthetic speech at 16 kHz with silence around it."""
    voice = EspeakVoice(Description("voice", "Hri.EspeakVoice"), resources)
    voice.activate()

    def spoken(text):
        speech = voice.synthesize(text)
        sound = resample(speech.samples, speech.rate, 16000)
        return np.concatenate([SECOND, (0.4 * sound).astype(np.int16), SECOND])

    return spoken


def test_synthetic_commands_are_heard(sphinx, companion, spoken):
    texts = ["go forward ten meters", "turn right", "show me a happy face", "what is your name"]

    sound = np.concatenate([spoken(text) for text in texts])

    utterances = heard(sphinx, companion, sound)
    assert [utterance.text for utterance in utterances] == texts
    for utterance in utterances:
        assert [word.text for word in utterance.words] == utterance.text.split()
        edges = [edge for word in utterance.words for edge in (word.start, word.end)]
        assert edges == sorted(edges)
        assert (utterance.start, utterance.end) == (edges[0], edges[-1])


def test_silence_and_noise_are_no_speech(sphinx, companion):
    noise = np.random.default_rng(1).normal(0, 300, 48000).astype(np.int16)

    assert heard(sphinx, companion, np.zeros(48000, np.int16)) == []
    assert heard(sphinx, companion, noise) == []


def test_an_endless_voice_is_cut(sphinx, spoken):
    babble = np.tile(spoken("blah blah blah blah blah blah blah blah")[17600:-17600], 20)

    pieces = segments_of(sphinx, babble)

    assert max(len(piece.samples) / 16000 for piece in pieces) < 20.5
    assert all(first.end <= second.start + 0.5 for first, second in itertools.pairwise(pieces))


def test_a_word_of_no_dictionary_gets_its_sound(write, resources, spoken):
    pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    grammar = load_grammar(write("public <a> = hello zorblax | good night everyone;"))
    recognizer = PocketSphinxRecognizer(Description("ears", "Hri.PocketSphinx"), resources)
    recognizer.activate()
    try:
        recognizer.start(grammar)
        (utterance,) = heard(recognizer, grammar, spoken("hello zorblax"))
    finally:
        recognizer.deactivate()

    assert utterance.text == "hello zorblax"


def test_the_decoder_comes_back_after_its_death(sphinx, companion, spoken):
    sphinx._process.kill()
    sphinx._process.wait()

    assert [u.text for u in heard(sphinx, companion, spoken("go forward"))] == ["go forward"]


def test_typed_lines_are_heard(resources, companion):
    typed = TypedRecognizer(Description("keys", "Hri.Typed"), resources)
    typed.activate()
    typed.type_line("Go forward ten meters.", 2.0)
    typed.type_line("", 2.1)

    (segment,) = typed.listen(SECOND, 3.0)

    assert (segment.start, segment.end) == (2.0, 2.0)
    result = judge(companion, segment, typed.decode(segment), 0.5)
    assert result.tags == {"distance": 10.0}
    assert typed.listen(SECOND, 4.0) == []


def test_a_typed_line_has_the_words_of_a_free_slot_as_they_were_typed(resources, write):
    grammar = load_grammar(write("public <name> = my name is <name.spoken>;"))
    typed = TypedRecognizer(Description("keys", "Hri.Typed"), resources)
    typed.activate()
    typed.start(grammar)
    typed.type_line("My name is Jean-Luc McCoy!", 2.0)

    (segment,) = typed.listen(SECOND, 3.0)

    result = judge(grammar, segment, typed.decode(segment), 0.5)
    assert result.tags == {"name": "Jean-Luc McCoy"}
    assert result.text == result.command == "my name is jean-luc mccoy"
    assert result.slots == ()


def test_lines_of_the_terminal_have_the_keyboard_as_their_origin(resources, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO("go home\n"))
    typed = TypedRecognizer(Description("keys", "Hri.Typed"), resources)
    typed.activate()
    typed.type_line("stop", 2.0)
    typed._read()  # what its thread does
    found = [typed.listen(SECOND, time)[0] for time in (3.0, 9.0)]
    assert [(segment.text, segment.origin) for segment in found] == [
        ("stop", ""),
        ("go home", "keyboard"),
    ]


def test_a_line_of_the_terminal_that_a_stop_overtakes_was_typed_before_it(
    resources, companion, monkeypatch
):
    monkeypatch.setattr(sys, "stdin", io.StringIO("go back\nstop\nturn left\n"))
    typed = TypedRecognizer(Description("keys", "Hri.Typed"), resources)
    typed.activate()
    typed.start(companion)
    typed._read()  # what its thread does
    typed.mind(True, 2.0)  # the robot speaks
    found = typed.listen(SECOND, 3.0)
    typed.mind(False, 4.0)
    found += [segment for time in (5.0, 7.0) for segment in typed.listen(SECOND, time)]
    assert [(segment.text, segment.start) for segment in found] == [
        ("stop", 3.0),
        ("go back", 3.0),
        ("turn left", 7.0),
    ]


def test_a_wrong_source_is_refused(resources):
    description = Description("keys", "Hri.Typed", {"source": "stdinn"})
    with pytest.raises(HriError, match='no source "stdinn"'):
        TypedRecognizer(description, resources).activate()


def test_vosk_without_a_model_says_where_to_put_one(resources, tmp_path):
    description = Description("ears", "Hri.Vosk", {"model": str(tmp_path)})
    with pytest.raises(NotAvailable, match="no Vosk model in"):
        VoskRecognizer(description, resources).activate()


def test_vosk_is_told_only_sentences_whose_words_it_knows(write):
    grammar = load_grammar(write("public <a> = go (home | zorblax) | stop;"))

    assert known_sentences(grammar, lambda word: word != "zorblax") == ["go home", "stop"]


def test_vosk_is_not_told_single_words_of_sentences_that_it_cannot_hear(write):
    grammar = load_grammar(write("public <a> = go zorblax | stop;"))

    assert known_sentences(grammar, lambda word: word != "zorblax") == ["stop"]
    assert known_sentences(grammar, lambda word: word == "go") == []


def test_vosk_is_told_every_word_of_a_grammar_with_more_sentences_than_it_is_told():
    companion = load_grammar("companion")

    told = known_sentences(companion, lambda word: word != "slowly")

    assert {word for sentence in told for word in sentence.split()} == companion.words() - {
        "slowly"
    }


def test_vosk_is_as_certain_as_its_least_certain_word():
    go = {"word": "go", "start": 0.3, "end": 0.5, "conf": 1.0}
    home = {"word": "home", "start": 0.5, "end": 0.9, "conf": 0.4}
    result = {"text": "go home", "result": [go, home]}

    times = (HeardWord("go", 0.3, 0.5), HeardWord("home", 0.5, 0.9))
    assert hypothesis(result) == Hypothesis("go home", 0.4, times)
    assert hypothesis({"text": ""}) == Hypothesis("", 0.0)


def vosk_model(folder):
    """The files that a model is known by, with nothing in them."""
    for part in PARTS:
        (folder / part).parent.mkdir(parents=True)
        (folder / part).touch()


@pytest.mark.parametrize(
    ("parameters", "chosen"),
    [
        ({}, CtcRecognizer),
        ({"weights": "/nowhere"}, PocketSphinxRecognizer),
        ({"weights": "/nowhere", "model": "model"}, VoskRecognizer),
    ],
)
def test_the_best_engine_that_is_there_serves(resources, tmp_path, parameters, chosen):
    if chosen is PocketSphinxRecognizer:
        pytest.importorskip("pocketsphinx", reason="it has no wheels for this Python")
    told = []
    resources.notice = told.append
    if "model" in parameters:
        vosk_model(tmp_path / "model")
        parameters = {**parameters, "model": str(tmp_path / "model")}
    ears = AutomaticRecognizer(Description("ears", "Hri.Recognizer", parameters), resources)
    ears.activate()

    assert isinstance(ears.engine, chosen)
    assert ears.describe() == f"{chosen.__name__}, chosen automatically"
    assert [line.endswith(f"(using {chosen.__name__} instead)") for line in told] == [True] * (
        chosen is not CtcRecognizer
    )
    ears.deactivate()


class Certain(TypedRecognizer):
    """Hears the same words in every sound."""

    words = "go forward"

    def decode(self, segment, rules=None):
        return Hypothesis(self.words, 0.8)


def test_the_best_engine_for_another_language_is_vosk(resources, write, tmp_path, monkeypatch):
    monkeypatch.setattr(automatic, "VoskRecognizer", Certain)
    french, english = write("public <a> = éteins la lumière;", "f"), write("public <a> = stop now;")
    for model in ("", str(tmp_path)):
        description = Description("ears", "Hri.Recognizer", {"model": model} if model else {})
        ears = AutomaticRecognizer(description, resources)
        ears.activate()
        ears.start(load_grammar(english))
        assert isinstance(ears.engine, CtcRecognizer)
        if model:
            ears.start(load_grammar(french))
            assert isinstance(ears.engine, Certain)
        else:
            with pytest.raises(HriError, match="in French, and only Vosk"):
                ears.start(load_grammar(french))
        ears.start(load_grammar(english))
        assert isinstance(ears.engine, CtcRecognizer)
        ears.deactivate()


def test_a_vosk_model_of_english_takes_no_french(write):
    french = load_grammar(write("public <a> = éteins la lumière du salon;"))
    assert is_of_another_language(french, {"la", "salon"}.__contains__)
    assert not is_of_another_language(french, {"la", "lumière", "éteins"}.__contains__)
    names = load_grammar(write("public <a> = call (zorblax | glorp | fnord);", "names"))
    assert not is_of_another_language(names, {"call"}.__contains__)


class Choosy(Certain):
    """Refuses every grammar but the first."""

    first = None

    def start(self, grammar):
        if self.first not in (None, grammar):
            raise HriError("too large - split it")
        self.first = grammar


class Open(Certain):
    """Keeps the last grammar."""

    def start(self, grammar):
        self.grammar = grammar


@pytest.mark.parametrize("kinds", [(Choosy, Open), (Open, Choosy)])
def test_what_one_of_two_engines_refuses_is_in_force_for_neither(
    resources, companion, write, kinds
):
    engines = [
        kind(Description(id, "Hri.Typed"), resources) for id, kind in zip("ab", kinds, strict=True)
    ]
    for engine in engines:
        engine.activate()
        resources.substitute(engine.id, engine)
    veto = ConsensusRecognizer(
        Description("ears", "Hri.Veto", {"first": "a", "second": "b"}), resources
    )
    veto.activate()
    veto.start(companion)
    with pytest.raises(HriError, match="too large"):
        veto.start(load_grammar(write("public <a> = go;")))

    (keeper,) = (engine for engine in engines if isinstance(engine, Open))
    assert keeper.grammar is companion


@pytest.mark.parametrize(
    ("second", "confidence", "detail"),
    [
        ("go forward ten meters", 0.8, ""),
        ("go forward ten meter", 0.8, ""),
        ("stop", 0.0, 'as likely: "stop"'),
        ("", 0.0, "another engine hears no words"),
    ],
)
def test_a_second_engine_vetoes_what_it_does_not_hear(
    resources, companion, second, confidence, detail
):
    for id, words in (("a", "go forward ten meters"), ("b", second)):
        engine = Certain(Description(id, "Hri.Typed"), resources)
        engine.words = words
        engine.activate()
        resources.substitute(id, engine)
    veto = ConsensusRecognizer(
        Description("ears", "Hri.Veto", {"first": "a", "second": "b"}), resources
    )
    veto.activate()
    veto.start(companion)

    piece = Segment(0.0, 1.0, SECOND)
    heard = judge(companion, piece, veto.decode(piece), strictness=0.1)
    assert (heard.text, heard.confidence) == ("go forward ten meters", confidence)
    assert getattr(heard, "detail", "") == detail
    assert veto.decode(Segment(0.0, 1.0, text="x")).alternatives == ()
