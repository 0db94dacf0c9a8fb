"""The natural voice: the same sound each time, with times that hold, whatever it is given."""

import json
import time
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from benchmarks.speech.feelings import MEASURES, PUBLISHED
from benchmarks.speech.melody import STORY
from hri.core.clock import FakeClock, RealClock
from hri.core.signals import EmotionState, Prosody
from hri.emotion.display import load_display
from hri.face.lips.phonemes import BREATH, sound_of
from hri.hal.drivers.resampling import resample
from hri.hal.recognizer import Segment
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.hal.synthesizer import PLAIN
from hri.speech.grammar import load_grammar
from hri.speech.notation.reading import aligned
from hri.speech.recognizers.ctc.decoder import CtcRecognizer
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.synthesizers.natural_symbols import MNEMONICS, MODIFIERS, STRESSES, longest_parts
from hri.speech.synthesizers.natural_text import words_read
from hri.speech.synthesizers.network_voice import PLAIN_WPM
from hri.speech.synthesizers.pace import slow_file
from tests.speech.conftest import HOUSE
from tests.speech.notation.test_reading import table as readings

hibari = pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")

TEXT = "I have found it! It is $5.20 at 7:30 pm, Dr. Smith."
COMMANDS = ("go forward ten meters", "turn right", "show me a happy face", "what is your name")


def opened(kind=NaturalVoice, **parameters):
    voice = kind(Description("voice", "a voice", parameters), ResourceManager((), FakeClock()))
    voice.activate()
    return voice


@pytest.fixture(scope="module")
def voice():
    return opened()


def pitch_of(speech, least=1500):
    """Hertz of the voiced parts, by autocorrelation: nothing of the voice's own is asked."""
    size, found = 1024, []
    for start in range(0, len(speech.samples) - size, size // 2):
        part = speech.samples[start : start + size].astype(float)
        if np.sqrt((part**2).mean()) < least:
            continue
        alike = np.correlate(part, part, "full")[size - 1 :]
        lags = slice(speech.rate // 450, speech.rate // 80)
        best = int(np.argmax(alike[lags])) + lags.start
        if alike[best] > 0.5 * alike[0]:
            found.append(speech.rate / best)
    return np.array(found)


def test_the_same_text_gives_the_same_samples(voice):
    first = voice.synthesize(TEXT)
    voice.synthesize("Something else.")
    again = opened().synthesize(TEXT)
    assert np.array_equal(first.samples, again.samples)
    assert first.phonemes == again.phonemes


def test_words_as_people_write_them_have_their_times(voice):
    speech = voice.synthesize(TEXT)
    assert [word.text for word in speech.words] == TEXT.split()
    assert all(TEXT[w.position :].startswith(w.text) for w in speech.words)
    times = [time for word in speech.words for time in (word.start, word.end)]
    assert times == sorted(times)
    assert 0 <= times[0] < times[-1] <= speech.duration
    price = next(word for word in speech.words if word.text == "$5.20")
    assert price.end - price.start > 1, "five dollars and twenty cents"
    assert [one.text for one in speech.sentences] == [
        "I have found it!",
        "It is $5.20 at 7:30 pm, Dr. Smith.",
    ]


def test_phonemes_follow_each_other_within_a_sentence(voice):
    speech = voice.synthesize("Please bring the blue cup to my kitchen.")
    ends = [phoneme.start + phoneme.duration for phoneme in speech.phonemes]
    assert ends[:-1] == pytest.approx([phoneme.start for phoneme in speech.phonemes[1:]])
    assert all(phoneme.duration > 0.0 for phoneme in speech.phonemes)
    assert any(phoneme.stressed for phoneme in speech.phonemes)


def test_the_lips_are_shut_when_the_sound_is_least(voice):
    """The burst of a stop is preceded by its closure, which the times must hold."""
    speech = voice.synthesize("Papa, papa, papa, papa.")
    samples = speech.samples.astype(float)

    def loudness(start, end):
        part = samples[int(start * speech.rate) : int(end * speech.rate)]
        return float(np.sqrt((part**2).mean()))

    inner = [p for p in speech.phonemes[2:-2] if p.name in ("p", "A:")]
    levels = {
        name: np.median([loudness(p.start, p.start + p.duration) for p in inner if p.name == name])
        for name in ("p", "A:")
    }
    assert levels["p"] < 0.5 * levels["A:"]


def test_every_symbol_of_the_voice_has_a_shape_of_the_mouth():
    vocabulary = json.loads(
        (Path(hibari.__file__).parent / "assets" / "vocab.json").read_text(encoding="utf-8")
    )
    silent = set(STRESSES + MODIFIERS + ' ;:,.!?—…"()“”↓→↗↘')
    assert set(vocabulary) - silent == set(MNEMONICS)
    unknown = sound_of("ß")
    assert {n for n in MNEMONICS.values() if sound_of(n) == unknown} <= set(BREATH)


@pytest.mark.parametrize(
    ("prosody", "measure", "factor"),
    [
        (Prosody(pitch=1.25), lambda speech: np.median(pitch_of(speech)), 1.25),
        (Prosody(range=2.0), lambda speech: np.std(np.log(pitch_of(speech))), 2.0),
        (Prosody(rate=1.5), lambda speech: 1 / speech.duration, 1.5),
        (Prosody(volume=0.5), lambda speech: np.abs(speech.samples.astype(float)).mean(), 0.5),
    ],
    ids=["pitch", "range", "rate", "volume"],
)
def test_prosody_is_heard(voice, prosody, measure, factor):
    text = "My mother may know where all the yellow lemons are in the morning."
    plain, changed = (measure(voice.synthesize(text, how)) for how in (PLAIN, prosody))
    assert changed / plain == pytest.approx(factor, rel=0.25)


@pytest.mark.parametrize("wpm", [90, 130, 170, 210, 250, 300])
def test_it_speaks_as_fast_as_it_is_asked_to(voice, wpm):
    speech = voice.synthesize(STORY, Prosody(rate=wpm / PLAIN_WPM))
    assert 60 * len(STORY.split()) / speech.duration == pytest.approx(wpm, rel=0.05)


def ended_at(speech):
    """Hertz of the last tenth of a second of the voice."""
    return np.median(pitch_of(speech, 400)[-5:])


@pytest.mark.parametrize(
    "text", ["You want to play with me", "I found the red ball", "Did you sleep well", "Okay"]
)
def test_a_question_rises_and_a_statement_falls(voice, text):
    asked, said = (ended_at(voice.synthesize(text + sign)) for sign in "?.")
    assert asked > 1.25 * said


def silences(speech):
    """Seconds of the silences within it, above 60 ms."""
    loud = np.abs(speech.samples.astype(float)) > 200
    lengths = np.diff(np.flatnonzero(loud)) / speech.rate
    return [float(length) for length in lengths if length > 0.06]


def test_a_comma_pauses_less_than_a_period_and_that_less_than_a_paragraph(voice):
    comma, period, question, paragraph = (
        max(silences(voice.synthesize(f"She fell into the garden{sign} All were asleep.")))
        for sign in (",", ".", "?", ".\n\n")
    )
    assert 0.1 < comma < period - 0.1 < question - 0.2 < paragraph - 0.3


def test_a_line_that_ends_within_a_sentence_does_not_end_it(voice):
    one, other = (voice.synthesize(f"She fell into{space}the garden.") for space in " \n")
    assert np.array_equal(one.samples, other.samples)


def test_feelings_are_heard_as_published(voice):
    """Pitch, range, rate and loudness of seven emotions, each against the plain sentence."""
    text = "My mother may know where all the yellow lemons are in the morning."
    display = load_display()

    def measured(prosody):
        speech = voice.synthesize(text, prosody)
        pitch = np.log(pitch_of(speech))
        loudness = np.log(np.abs(speech.samples.astype(float)).mean())
        low, middle, high = np.percentile(pitch, (10, 50, 90))
        return middle, high - low, -speech.duration, loudness

    plain, wrong = measured(PLAIN), []
    for name, directions in PUBLISHED.items():
        heard = measured(display.prosody(EmotionState(name, 1.0, 0.0, 0.0, 0.0, {name: 1.0})))
        told = zip(MEASURES, directions, heard, plain, strict=True)
        wrong += [(name, m) for m, sign, h, p in told if sign and (h - p) * sign <= 0]
    assert not wrong


@pytest.mark.parametrize(
    "text",
    [
        "How many people are in the room?",
        "Shall we walk or take the bus?",
        "The soup needs a little more salt.",
        "Monday, Wednesday, and Friday.",
        "There were cats, dogs, a horse, and two sheep.",
    ],
)
def test_what_falls_is_heard_to_fall(voice, text):
    """Not only in the curve: most of the sound at an end has the network's pitch in its phases."""
    pitch = pitch_of(voice.synthesize(text), least=300)
    low = np.percentile(pitch[-8:], 25)  # of a faint end it takes the octave now and then
    assert 12 * np.log2(low / np.median(pitch)) < -3


def test_a_long_sentence_is_heard_from_its_first_comma_on(voice):
    text = (
        "When the old man heard that the river had come over its banks again, he put on his coat,"
        " took the lamp from the shelf, called his dog, and walked down to the bridge, where some"
        " of his neighbors were already standing in the rain."
    )
    heard = []
    whole = voice.stream(text, PLAIN, heard.append, lambda: True)
    assert len(heard) > 3
    first = heard[0]
    assert [word.text for word in first.words][-1] == "again,"
    assert first.duration < 0.4 * whole.duration
    for shorter, longer in pairwise(heard):
        length = len(shorter.samples)
        assert np.array_equal(longer.samples[:length], shorter.samples)
        assert longer.continues(shorter)
    assert [word.text for word in whole.words] == text.split()
    assert [sentence.text for sentence in whole.sentences] == [text]
    gaps = [b.start - a.end for a, b in pairwise(whole.words) if a.text.endswith(",")]
    assert max(gaps) < 1.6 * min(gaps)

    cut = voice.stream(text, PLAIN, lambda speech: None, lambda: False)
    assert cut.duration < first.duration + 0.1


def test_another_pitch_is_as_loud(voice):
    levels = [
        np.abs(voice.synthesize(TEXT, Prosody(pitch=pitch)).samples.astype(float)).mean()
        for pitch in (0.8, 1.0, 1.2)
    ]
    assert max(levels) < 1.15 * min(levels)


@pytest.mark.parametrize("name", ["joy", "sadness", "anger", "fear", "surprise"])
def test_what_it_says_with_an_emotion_is_recognized(voice, name):
    ears = CtcRecognizer(Description("ears", "Hri.CtcRecognizer"), ResourceManager((), FakeClock()))
    ears.activate()
    ears.start(load_grammar(HOUSE / "grammars" / "companion.jsgf"))
    prosody = load_display().prosody(EmotionState(name, 1.0, 0.0, 0.0, 0.0, {name: 1.0}))
    heard = []
    for command in COMMANDS:
        speech = voice.synthesize(command, prosody)
        samples = np.pad(resample(speech.samples, speech.rate, ears.rate), 4800)
        heard.append(ears.decode(Segment(0.0, len(samples) / ears.rate, samples)).text)
    ears.deactivate()
    assert heard == list(COMMANDS)


def test_a_text_comes_sentence_by_sentence_and_ends_when_it_is_not_wanted(voice):
    taken = []
    whole = voice.stream(TEXT, PLAIN, taken.append, lambda: not taken)
    assert len(taken[0].sentences) == 1
    assert whole.sentences == taken[0].sentences, "the second was not made"
    taken.clear()
    voice.stream(TEXT, PLAIN, taken.append, lambda: True)
    assert np.array_equal(taken[0].samples, taken[1].samples[: len(taken[0].samples)])


def test_words_of_the_users_lexicon_sound_as_they_are_written(tmp_path):
    (tmp_path / "names.txt").write_text("zyq  K AE T\n")
    speech = opened(lexicon=str(tmp_path / "names.txt")).synthesize("Zyq sleeps.")
    assert [phoneme.name for phoneme in speech.phonemes[:3]] == ["k", "a", "t"]


def test_another_script_and_another_voice_are_left_to_espeak(voice):
    mixed = voice.synthesize("안녕하세요. Hello.")
    assert [one.text for one in mixed.sentences] == ["안녕하세요.", "Hello."]
    assert mixed.duration > 1
    british = voice.synthesize("Hello.", Prosody(voice="en-gb"))
    assert not np.array_equal(british.samples, voice.synthesize("Hello.").samples)


def fallen_back(clock=None, **parameters):
    """A voice, and the notices that opening it gave."""
    notices = []
    manager = ResourceManager((), clock or FakeClock(), notice=notices.append)
    voice = NaturalVoice(Description("voice", "Hri.NaturalVoice", parameters), manager)
    voice.activate()
    return voice, notices


def test_with_a_broken_model_espeak_speaks_after_one_line(tmp_path):
    model = Path(hibari.__file__).parent / "assets" / "hibari.onnx"
    (tmp_path / "half.onnx").write_bytes(model.read_bytes()[:3_000_000])
    for path in (tmp_path / "half.onnx", tmp_path / "none.onnx"):
        voice, notices = fallen_back(model=str(path))
        assert voice.synthesize("Hello there.", Prosody(voice="heart")).duration > 0.5
        (line,) = notices
        assert path.name in line
        assert line.endswith("; espeak-ng speaks")
        assert "\n" not in line
        assert path.name in voice.describe()


def test_a_model_that_fails_while_it_speaks_loses_no_sentence():
    voice, notices = fallen_back()

    class Lost:
        def speak(self, symbols, prosody, endings=(), accents=()):
            raise RuntimeError("lost\nat line 3")

    def after_the_first(speech):
        if len(speech.sentences) == 1:
            voice._engine = replace(voice._engine, network=Lost())

    whole = voice.stream(TEXT, PLAIN, after_the_first, lambda: True)
    assert [word.text for word in whole.words] == TEXT.split()
    assert notices == ["voice: heart failed (lost); espeak-ng speaks"]


def test_a_model_that_fails_within_a_sentence_loses_no_word():
    voice, notices = fallen_back()
    network = voice._engine.network
    text = (
        "When the old man heard that the river had come over its banks again, he put on his coat,"
        " took the lamp from the shelf, called his dog, and walked down to the bridge, where some"
        " of his neighbors were already standing in the rain."
    )

    class Breaks:
        def speak(self, *arguments):
            yield next(iter(network.speak(*arguments)))
            raise RuntimeError("lost")

    voice._engine = replace(voice._engine, network=Breaks())
    whole = voice.synthesize(text)
    assert " ".join(word.text for word in whole.words) == text
    assert notices == ["voice: heart failed (lost); espeak-ng speaks"]


class SlowClock(RealClock):
    """A machine on which each look at the time comes a second after the last."""

    time = 0.0

    def now(self):
        self.time += 1.0
        return self.time


def test_a_machine_that_does_not_keep_up_falls_back_for_good(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    voice, notices = fallen_back(SlowClock())
    spoken = 0.0
    while not notices:
        spoken += voice.synthesize("Yes.").duration
    assert notices == ["voice: this machine is too slow for heart; espeak-ng speaks"]
    assert 60 <= spoken < 61
    later, said = fallen_back(RealClock())
    assert str(slow_file()) in said[0]
    assert "espeak-ng" in later.describe()
    again, said = fallen_back(FakeClock())
    assert said == []
    assert again.describe().startswith("natural")


def test_what_was_kept_of_slow_voices_may_be_damaged(monkeypatch, tmp_path):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    slow_file().parent.mkdir(parents=True)
    slow_file().write_text("heart = [")
    assert fallen_back(RealClock())[1] == []


def test_an_abbreviation_before_a_number_ends_no_sentence(voice):
    text = "On Nov. 24 we met. It is No. 5. Yes."
    speech = voice.synthesize(text)
    assert [one.text for one in speech.sentences] == ["On Nov. 24 we met.", "It is No. 5.", "Yes."]
    assert [word.text for word in speech.words] == text.split()


@settings(max_examples=40)
@given(st.text(max_size=60))
def test_it_speaks_whatever_it_is_given(text):
    speech = opened().synthesize(text)
    ends = [0.0, *(word.end for word in speech.words)]
    assert ends[-1] <= speech.duration + 1e-6
    assert all(phoneme.duration >= -1e-9 for phoneme in speech.phonemes)


@given(st.lists(st.sampled_from("abc")), st.lists(st.sampled_from("abcd")))
def test_each_word_that_is_read_stands_for_a_written_one(written, read):
    origins = aligned(written or ["a"], read)
    assert len(origins) == len(read)
    assert origins == sorted(origins)
    assert all(0 <= one < len(written or ["a"]) for one in origins)


@given(st.text(alphabet="ab, ", max_size=300), st.integers(5, 40))
def test_long_sentences_are_parted_without_loss(symbols, most):
    parts = longest_parts(symbols, most)
    assert "".join(symbols[begin:end] for begin, end in parts) == symbols
    assert all(end - begin <= most for begin, end in parts)


WITH_SIGNS = (
    "You owe -$20 (or $5-$10), keep 40\N{EN DASH}60°C.",
    "Call 1-800-555-0199 from Room 204, 12 W 34th St, at 9 a.m.",
    "C# and CO2 at 192.168.1.100 = fun!",
)


@pytest.mark.parametrize("text", WITH_SIGNS)
@pytest.mark.parametrize("kind", [NaturalVoice, EspeakVoice])
def test_words_with_signs_have_their_times_in_every_voice(kind, text):
    speech = opened(kind).synthesize(text)
    heard = [word.text for word in speech.words]
    assert heard == text.split()
    assert all(0 <= word.start < word.end <= speech.duration for word in speech.words)


@pytest.mark.parametrize("kind", [NaturalVoice, EspeakVoice])
def test_signs_sound_as_the_words_that_are_said_for_them(kind):
    voice = opened(kind)
    written = voice.synthesize("Dial 911, pay -$20, and take 5 m² of it.")
    read = voice.synthesize(
        "Dial nine one one, pay minus twenty dollars, and take five square meters of it."
    )
    assert [one.name for one in written.phonemes] == [one.name for one in read.phonemes]


@pytest.mark.parametrize("kind", [NaturalVoice, EspeakVoice])
def test_a_letter_is_said_by_its_name_and_the_article_is_not(kind):
    voice = opened(kind)
    letter = [one.name for one in voice.synthesize("Gate A4 is open.").phonemes]
    article = [one.name for one in voice.synthesize("A gate is open.").phonemes]
    assert letter.count("eI") == 2
    assert article.count("eI") == 1
    assert words_read("Gate A4") == [("Gate", 0), ("ay", 1), ("four", 1)]


@pytest.mark.slow
@pytest.mark.parametrize("kind", readings())
def test_every_text_of_the_table_sounds_as_the_words_that_are_said_for_it(voice, kind):
    """But for stress, pauses, and the letter A, which written alone is the article."""
    reader = voice._engine.reader

    def sounds(text):
        symbols = "".join(one.symbols for one in reader.sentences(text))
        return "".join(one for one in symbols if one.isalpha() and one not in STRESSES).replace(
            "A", "ɐ"
        )

    texts = readings()[kind]
    wrong = {text: read for text, read in texts.items() if sounds(text) != sounds(read)}
    assert set(wrong) <= {"Write to a.b@example.com."}


@pytest.mark.parametrize("sign", ["a-", "aB", "'", "$"])
def test_a_very_long_word_takes_little_time(voice, sign):
    begun = time.process_time()
    list(voice._engine.reader.sentences((sign * 700)[:700]))
    assert time.process_time() - begun < 10
