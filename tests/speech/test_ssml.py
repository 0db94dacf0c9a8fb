"""Speech as markup: what is said, how, when; and what is refused, where."""

# ruff: noqa: RUF001 - letters of the International Phonetic Alphabet are meant.

import numpy as np
import pytest
from hypothesis import given, strategies as st

from hri.core.clock import FakeClock
from hri.core.errors import AuthoringError
from hri.core.signals import Prosody
from hri.hal.resource import Description
from hri.hal.resource_manager import ResourceManager
from hri.speech.pronunciation.alphabets import from_arpabet, from_ipa, from_x_sampa
from hri.speech.ssml import LIMITS, Break, Mark, Passage, Ssml, is_ssml, spoken
from hri.speech.synthesizers.espeak import EspeakVoice
from hri.speech.synthesizers.natural import NaturalVoice
from hri.speech.synthesizers.silent import SilentVoice
from hri.speech.voice import Voice

from .fakes import Stage

PLAIN = Prosody()


def said(markup, kind=EspeakVoice):
    voice = kind(Description("voice", "a voice"), ResourceManager((), FakeClock()))
    voice.activate()
    return spoken(Ssml.parse(markup), voice, PLAIN, lambda speech: None, lambda: True)


def test_a_document_is_a_list_of_what_is_said_and_how():
    document = Ssml.parse(
        '<speak>It is <emphasis level="strong">very</emphasis> late.'
        '<break time="500ms"/><mark name="bye"/>'
        '<prosody rate="120%" pitch="-12st">Good <sub alias="evening">eve</sub></prosody>, sir.'
        "</speak>"
    )
    assert document.text == "It is very late. Good evening, sir."
    texts = [one.text if isinstance(one, Passage) else one for one in document.pieces]
    assert texts == [
        *("It is", "very", "late.", Break(0.5), Mark("bye"), "Good evening", ", sir."),
    ]
    _, very, _, _, _, good, _ = document.pieces
    assert very.prosody.volume > 1
    assert (good.prosody.rate, good.prosody.pitch) == (1.2, 0.5)


@pytest.mark.parametrize(
    ("kind", "written", "read"),
    [
        ("characters", "FAQ 1", "F A Q one"),
        ("telephone", "555-12", "five five five, one two"),
        ("cardinal", "-1,024", "minus one thousand twenty four"),
        ("ordinal", "23", "23rd"),
        ("ordinal", "112", "112th"),
        ("date", "2026-11-24", "November 24, 2026"),
        ("date", "12/31/2026", "December 31, 2026"),
    ],
)
def test_what_is_said_as_something_is_read_so(kind, written, read):
    markup = f'<speak><say-as interpret-as="{kind}">{written}</say-as></speak>'
    assert Ssml.parse(markup).text == read


@pytest.mark.parametrize("kind", [EspeakVoice, NaturalVoice, SilentVoice])
def test_times_go_on_over_all_that_is_said(kind):
    if kind is NaturalVoice:
        pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    speech = said('<speak>One two.<break time="1s"/><mark name="m"/> Three four.</speak>', kind)
    assert speech.text == "One two. Three four."
    assert [w.text.strip(".") for w in speech.words] == ["One", "two", "Three", "four"]
    assert all(speech.text[w.position :].startswith(w.text) for w in speech.words)
    times = [time for word in speech.words for time in (word.start, word.end)]
    assert times == sorted(times)
    assert times[-1] <= speech.duration + 1e-9
    ((name, time),) = speech.marks
    assert name == "m"
    assert times[3] + 1 <= time <= times[4]
    quiet = speech.samples[round((time - 0.99) * speech.rate) : round(time * speech.rate)]
    assert not quiet.any()


@pytest.mark.parametrize("kind", [EspeakVoice, NaturalVoice])
@pytest.mark.parametrize(
    ("alphabet", "sounds"), [("ipa", "kˈæt"), ("x-sampa", 'k"{t'), ("x-arpabet", "K AE1 T")]
)
def test_a_word_sounds_as_it_is_written_in_phonemes(kind, alphabet, sounds):
    if kind is NaturalVoice:
        pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    word = f"<phoneme alphabet='{alphabet}' ph='{sounds}'>zyq</phoneme>"
    names = [phoneme.name for phoneme in said(f"<speak>{word}</speak>", kind).phonemes]
    assert names[:3] == ["k", "a", "t"]


def test_within_a_sentence_no_pause_is_left():
    pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    marked = said("<speak>It is <emphasis>very</emphasis> late today.</speak>", NaturalVoice)
    pauses = [p for p in marked.phonemes[1:-1] if p.name.startswith("_") and p.duration > 0.12]
    assert pauses == []


@pytest.mark.parametrize("word", ["I", "she", "took", "money"])
def test_weight_on_a_word_is_heard_within_the_sentence(word):
    """It gets longer and higher, it is as high as any, and what follows is flat."""
    pytest.importorskip("hibari", reason="no natural voice - pip install hibari-tts")
    text = "I never said she took the money."
    strong = f'<emphasis level="strong">{word}</emphasis>'
    plain = said(f"<speak>{text}</speak>", NaturalVoice)
    heavy = said(f"<speak>{text.replace(word, strong, 1)}</speak>", NaturalVoice)
    assert [w.text for w in heavy.words] == [w.text for w in plain.words]
    assert [s.text for s in heavy.sentences] == [text]
    place = next(n for n, w in enumerate(heavy.words) if w.text.strip(".") == word)
    before, after = (one.words[place].end - one.words[place].start for one in (plain, heavy))
    assert after > 1.1 * before
    pitches = [pitch_within(heavy, w.start, w.end) for w in heavy.words]
    assert pitches[place] > 1.15 * pitch_within(plain, *spoken_at(plain, place))
    assert pitches[place] >= 0.93 * max(pitches)
    later = pitches[place + 1 :]
    assert not later or max(later) < 0.85 * pitches[place]


def spoken_at(speech, place):
    return speech.words[place].start, speech.words[place].end


def pitch_within(speech, start, end):
    """The highest pitch, hertz, of what is loud in a stretch, by autocorrelation; else 0."""
    size, found = 1024, [0.0]
    first, last = round(start * speech.rate), round(end * speech.rate)
    for begin in range(first, max(last - size // 2, first + 1), 240):
        part = speech.samples[begin : begin + size].astype(float)
        if len(part) < size or np.sqrt((part**2).mean()) < 800:
            continue
        alike = np.correlate(part, part, "full")[size - 1 :] / np.arange(size, 0, -1)
        lags = slice(speech.rate // 420, speech.rate // 110)
        best = int(np.argmax(alike[lags])) + lags.start
        if alike[best] > 0.7 * alike[0]:
            found.append(speech.rate / best)
    return float(np.percentile(found, 80))


def test_a_mark_is_an_event_when_it_is_reached():
    stage = Stage(Voice())
    stage.behavior.say(Ssml.parse('<speak>hello<mark name="half"/>hello<mark name="e"/></speak>'))
    stage.run(2.0)
    marks = [(time, what["name"]) for time, name, what in stage.events if name == "speech.marked"]
    assert [name for _, name in marks] == ["half", "e"]
    begun, ended = stage.events[0][0], stage.events[-1][0]
    assert stage.names() == ["speech.said", "speech.marked", "speech.marked", "speech.finished"]
    assert marks[0][0] == pytest.approx((begun + ended) / 2, abs=0.1)


@pytest.mark.parametrize(
    ("markup", "message"),
    [
        ("<speak>a <brek/></speak>", 'ssml:1:10: <brek> .* did you mean "break"'),
        ('<speak>\n<break time="5 minutes"/></speak>', "ssml:2:8: time is"),
        ('<speak><break time="11s"/>a</speak>', "keep to 10 s"),
        ('<speak><prosody rate="slwo">x</prosody></speak>', 'did you mean "slow"'),
        ('<speak><prosody rate="2st">x</prosody></speak>', "rate is"),
        ('<speak><phoneme ph="ʘ">x</phoneme></speak>', 'no sound "ʘ"'),
        ('<speak><phoneme ph="a">x y</phoneme></speak>', "2 words"),
        ('<speak><say-as interpret-as="dat">x</say-as></speak>', 'did you mean "date"'),
        ('<speak><say-as interpret-as="date">99/99/1</say-as></speak>', "cannot be read as date"),
        (
            f'<speak><say-as interpret-as="date">1-2-{"9" * 5000}</say-as></speak>',
            "cannot be read as date - write three numbers",
        ),
        ("<speak><sub>x</sub></speak>", 'no "alias"'),
        (
            "<speak>a\n" + '<break time="10s"/>' * 31 + "</speak>",
            "ssml:2:571: the breaks take more than 300 s together - say it in parts",
        ),
        ("<speak>" + "a<p>b</p>" * 751 + "</speak>", "the breaks take more than 300 s"),
        (f"<speak>a\n<s>{'a ' * 2600}</s></speak>", "ssml:2:1: it says more than 5000 characters"),
        (f'<speak>\n<sub alias="{"a" * 5001}">b</sub></speak>', "ssml:2:1: it says more than 5000"),
        (f'<speak><phoneme ph="{"æ" * 5000}">b</phoneme></speak>', "it says more than 5000"),
        ("<speak>a", "close <speak>"),
        ("<speak/>", "it says nothing"),
        ("<say>a</say>", "<speak>"),
        ('<!DOCTYPE s [<!ENTITY a "b">]><speak>&a;</speak>', "DOCTYPE"),
        ("<speak>&lol;</speak>", "undefined entity"),
        ("<speak>" + "<p>" * 10_000, "too deep"),
        ("<speak>" + "a " * 600_000 + "</speak>", "keep to 100000"),
        ("<speak>\x07</speak>", "not well-formed"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(markup, message):
    with pytest.raises(AuthoringError, match=message) as raised:
        Ssml.parse(markup)
    assert "\n" not in str(raised.value)


def handed_over(markup):
    """What is given to whoever plays a document, part by part, in samples."""
    voice = SilentVoice(Description("voice", "a voice"), ResourceManager((), FakeClock()))
    parts = []
    spoken(
        Ssml.parse(markup), voice, PLAIN, lambda speech: parts.append(speech.samples), lambda: True
    )
    return parts


@pytest.mark.parametrize(
    "markup",
    [
        "<speak>a" + '<break time="60ms"/>' * 4900 + "</speak>",
        "<speak>a" + '<mark name="m"/>' * 6000 + "</speak>",
        "<speak>" + "a<emphasis>b</emphasis>" * 2000 + "</speak>",
        "<speak>" + '<prosody rate="slow">a</prosody> b' * 2000 + "</speak>",
        "<speak>" + "<s>" * 60 + "a" * 4900 + "</s>" * 60 + "</speak>",
        f'<speak><phoneme ph="a">a{"!" * 4000}a{"!" * 800}</phoneme></speak>',
    ],
)
def test_the_work_grows_as_the_document_does(markup):
    """However many parts there are, their sound is copied and handed over a few times."""
    parts = handed_over(markup)
    assert len(parts) < 60
    assert sum(map(len, parts)) <= 6 * len(parts[-1])
    assert all(np.shares_memory(part, parts[-1]) or len(part) < len(parts[-1]) for part in parts)


@given(st.text(alphabet="<>/speakbr=\"'& a1\ud800é", max_size=80))
def test_any_text_is_parsed_or_refused(text):
    try:
        document = Ssml.parse(f"<speak>{text}</speak>")
    except AuthoringError:
        return
    assert document.text


CHANGES = st.sampled_from(("+50%", "-90%", "300%", "x-low", "+24st", "medium"))


@given(st.lists(CHANGES, min_size=1, max_size=12))
def test_nested_changes_stay_within_what_can_be_followed(changes):
    opened = "".join(f'<prosody pitch="{change}">' for change in changes)
    (passage,) = Ssml.parse(f"<speak>{opened}a{'</prosody>' * len(changes)}</speak>").pieces
    low, high = LIMITS["pitch"]
    assert low <= passage.prosody.pitch <= high


def test_plain_text_may_have_any_signs():
    assert not is_ssml("a < b and <speakers>")
    assert is_ssml(' <speak version="1.1">a</speak>')
    speech = SilentVoice(Description("v", "v"), ResourceManager((), FakeClock())).synthesize("a<b>")
    assert np.isclose(speech.duration, 2 * 0.06)


def test_the_alphabets_name_the_same_sounds():
    assert from_ipa("ʃəˈvɔn") == from_x_sampa('S@"vOn') == from_arpabet("SH AH V AO1 N")
    with pytest.raises(ValueError, match="Q7"):
        from_arpabet("Q7")


@pytest.mark.parametrize(
    ("attributes", "voice"),
    [
        ('name="David" gender="male" age="25"', "David plain"),
        ('name="en-gb"', "en-gb"),
        ('gender="female"', "warm"),
        ('gender="male" age="80"', "grandpa"),
        ('age="6"', "child"),
        ('gender="neutral" variant="2"', ""),
        ('languages="de" required="languages"', "de"),
    ],
)
def test_a_voice_is_asked_for_as_ssml_1_1_does(attributes, voice):
    (passage,) = Ssml.parse(f"<speak><voice {attributes}>Hi.</voice></speak>").pieces
    assert passage.prosody.voice == voice


@pytest.mark.parametrize("attributes", ["", 'gender="man"', 'age="old"', 'variant="2"', 'sex="m"'])
def test_a_voice_that_cannot_be_meant_is_refused(attributes):
    with pytest.raises(AuthoringError, match=r"voice|gender|age|sex"):
        Ssml.parse(f"<speak><voice {attributes}>Hi.</voice></speak>")


@pytest.mark.parametrize(
    ("text", "is_markup"),
    [
        ('<?xml version="1.0"?><speak>Hi.</speak>', True),
        (' \n<speak\nversion="1.1">Hi.</speak>', True),
        ("\ufeff<speak>Hi.</speak>", True),
        ("<speaker> is a tag", False),
        ("a < b", False),
        ("<?", False),
    ],
)
def test_markup_is_known_by_its_begin(text, is_markup):
    assert is_ssml(text) == is_markup


def test_a_declared_encoding_is_that_of_the_file_not_of_the_text():
    source = '<?xml version="1.0" encoding="ISO-8859-1" standalone="yes"?>\n<speak>Café</speak>'
    assert Ssml.parse(source).text == "Café"


def test_other_xml_is_refused_by_its_name():
    with pytest.raises(AuthoringError, match="<html> is not a text to speak"):
        Ssml.parse('<?xml version="1.0"?><html>Hi.</html>')


def test_large_numbers_are_read_as_numbers():
    markup = '<speak><say-as interpret-as="cardinal">-1,234,567</say-as></speak>'
    read = "minus one million two hundred thirty four thousand five hundred sixty seven"
    assert Ssml.parse(markup).text == read
