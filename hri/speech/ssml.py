"""Speech as markup: the useful part of SSML 1.1 (W3C Recommendation, September 2010).

<speak>Call <phoneme alphabet="ipa" ph="ʃəˈvɔn">Siobhan</phoneme> <emphasis>now</emphasis>.
  <break time="500ms"/> <mark name="asked"/> <prosody rate="slow" pitch="-2st">Please.</prosody>
</speak>
"""

# ruff: noqa: RUF002 - letters of the International Phonetic Alphabet are meant.
from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import reduce
from itertools import count, groupby
from pathlib import Path
from typing import TypeVar

import numpy as np

from hri.core.errors import AuthoringError, Place, did_you_mean
from hri.core.signals import Phoneme, Prosody, Samples, Span, Speech
from hri.core.xml import Element, parse_xml
from hri.hal.drivers.resampling import resample
from hri.hal.synthesizer import Skill, Synthesizer
from hri.speech.notation import number_words as say
from hri.speech.notation.abbreviations import MONTHS
from hri.speech.pronunciation.alphabets import from_arpabet, from_ipa, from_x_sampa
from hri.speech.pronunciation.phones import Phones
from hri.speech.vocalizations.in_text import SoundMark, parted
from hri.speech.vocalizations.vocalization import sound_named

SOURCE = Path("ssml")
"""Where mistakes are, for people."""
LONGEST = 100_000
"""Characters of markup."""
LONGEST_BREAK = 10.0
"""Seconds."""
MOST_SILENCE = 300.0
"""Seconds of all breaks together."""
MOST_SOUNDS = 100
"""Sounds that are not words, of a whole document: some minutes."""
MOST_SAID = 5000
"""Characters that are said, and sounds of phonemes, of a whole document."""

PLAIN_RATE = 24000
"""Samples a second of a document that was cut before its first word."""
GROWTH = 1.25
"""A document in the making is handed over each time it is longer by this factor: a speaker
converts all of it each time."""
ENDS = tuple(".!?\N{HORIZONTAL ELLIPSIS}:;,")
AFTER_SOUND = 0.12
"""Seconds of a pause after a sound that is not a word."""
JOINT = 0.02
"""Seconds of a pause that are left within a sentence."""
BREAKS = {
    "none": 0.0, "x-weak": 0.1, "weak": 0.2, "medium": 0.4, "strong": 0.8, "x-strong": 1.2,
}  # fmt: skip
"""Seconds."""
RATES = {"x-slow": 0.6, "slow": 0.8, "medium": 1.0, "fast": 1.25, "x-fast": 1.6}
PITCHES = {"x-low": 0.75, "low": 0.87, "medium": 1.0, "high": 1.15, "x-high": 1.33}
RANGES = {"x-low": 0.4, "low": 0.7, "medium": 1.0, "high": 1.4, "x-high": 1.8}
VOLUMES = {
    "silent": 0.0, "x-soft": 0.4, "soft": 0.7, "medium": 1.0, "loud": 1.3, "x-loud": 1.6,
}  # fmt: skip
EMPHASES = {
    "strong": Prosody(rate=0.85, pitch=1.12, volume=1.3, range=1.4),
    "moderate": Prosody(rate=0.92, pitch=1.06, volume=1.15, range=1.2),
    "none": Prosody(),
    "reduced": Prosody(rate=1.08, volume=0.8, range=0.7),
}
WEIGHTS = {"strong": 1.0, "moderate": 0.6, "none": 0.0, "reduced": -0.6}
"""Of a voice that can lay weight on a word within a sentence; others say it as EMPHASES has it."""
LIMITS = {"rate": (0.5, 2.0), "pitch": (0.5, 2.0), "range": (0.0, 3.0), "volume": (0.0, 2.0)}
"""Of the factors of all elements around a text together."""
VOICE_ATTRIBUTES = (
    *("name", "gender", "age", "languages"),
    *("variant", "required", "ordering", "onvoicefailure", "xml:lang"),
)
"""Those that choose a voice, and those of SSML 1.1 that make no difference here."""
VOICES = {
    "male": ("child", "plain", "grandpa"), "female": ("child", "warm", "grandma"),
    "neutral": ("child", "", ""),
}  # fmt: skip
"""The voices of a gender: of a child, a grown person, and an old one."""
GROWN, OLD = 13, 65
"""Years from which a voice is one's."""
ALPHABETS: dict[str, Callable[[str], Phones]] = {
    "ipa": from_ipa,
    "x-sampa": from_x_sampa,
    "x-arpabet": from_arpabet,
}
DATES = ("mdy", "dmy", "ymd")
UNITS = {"rate": "%", "pitch": "% st", "range": "% st", "volume": "% dB"}

_BEGIN = re.compile(r"[\ufeff\s]*<(?:\?xml\s|speak[\s>])")
_DECLARED = re.compile(r"(<\?xml[^>]{0,80}?)\s+encoding=[\"'][^\"'>]{0,40}[\"']([^>]{0,80}\?>)")
_AGE = re.compile(r"\d{1,3}")
_NO_SPACE_BEFORE = re.compile(r"[.,;:!?)]")
_WORD = re.compile(r"\w(.*\w)?")
_TIME = re.compile(r"\+?(\d{0,6}\.?\d{1,6})(ms|s)")
_CHANGE = re.compile(r"([+-]?)(\d{0,4}\.?\d{1,4})(%|st|dB)")

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Passage:
    """Words that are said in one way."""

    text: str
    prosody: Prosody
    weight: float = 0.0
    """Of an emphasis: -1 (less) to 1 (more than the words around it)."""
    around: Prosody | None = None
    """How those are said, where it has a weight."""


@dataclass(frozen=True, slots=True)
class Break:
    """A pause."""

    seconds: float


@dataclass(frozen=True, slots=True)
class Mark:
    """A place that is reported when it is reached."""

    name: str


Piece = Passage | Break | Mark | SoundMark
Placed = tuple[Element, Piece]
"""A piece, and the element that says it."""


@dataclass(frozen=True, slots=True)
class Ssml:
    """A text with markup, checked: `Ssml.parse("<speak>Hello.</speak>")`.

    In its words, and in a text without markup (`of_text`), "[giggle]" makes a sound.
    """

    text: str
    """The words that are said."""
    pieces: tuple[Piece, ...]

    @classmethod
    def of_text(cls, text: str) -> Ssml:
        """A text without markup, in which sounds such as "[giggle]" are made.

        What is longer than MOST_SAID, and more than MOST_SOUNDS, is left out.
        """
        marks = count(1)
        pieces = (
            Passage(part, Prosody()) if isinstance(part, str) else part
            for part in parted(text[:MOST_SAID])
            if isinstance(part, str) or next(marks) <= MOST_SOUNDS
        )
        return cls(text, tuple(pieces))

    def without_sounds(self) -> Ssml:
        """The words alone, which may be none."""
        pieces = [piece for piece in self.pieces if not isinstance(piece, SoundMark)]
        texts = [piece.text for piece in pieces if isinstance(piece, Passage)]
        return Ssml(reduce(_written_after, texts) if texts else "", tuple(pieces))

    @classmethod
    def parse(cls, source: str) -> Ssml:
        """Raises AuthoringError with line and column of the first mistake."""
        if len(source) > LONGEST:
            what = f"{len(source)} characters of markup"
            raise AuthoringError(Place(SOURCE), what, f"keep to {LONGEST}")
        source = _DECLARED.sub(r"\1\2", source, count=1)  # it is decoded
        root = parse_xml(source.encode("utf-8", "replace"), SOURCE)
        if root.tag != "speak":
            raise root.error(f"<{root.tag}> is not a text to speak", "write <speak>...</speak>")
        pieces = tuple(_joined(_bounded(_pieces(root, Prosody()))))
        texts = [piece.text for piece in pieces if isinstance(piece, Passage | SoundMark)]
        if not texts:
            raise root.error("it says nothing", "put words between <speak> and </speak>")
        return cls(reduce(_written_after, texts), pieces)


def is_ssml(text: str) -> bool:
    """Whether a text is meant as markup; a plain text may have any `<` elsewhere."""
    return _BEGIN.match(text) is not None


def combined(one: Prosody, other: Prosody) -> Prosody:
    """One prosody within another: factors multiply within LIMITS, the inner voice counts."""
    factors = {
        name: min(max(getattr(one, name) * getattr(other, name), low), high)
        for name, (low, high) in LIMITS.items()
    }
    return Prosody(
        **factors,
        voice=other.voice or one.voice,
        sounds=(*one.sounds, *other.sounds),
        quality=one.quality,
        emphases=other.emphases,
    )


def spoken(
    document: Ssml,
    voice: Synthesizer,
    prosody: Prosody,
    take: Callable[[Speech], object],
    is_wanted: Callable[[], bool],
) -> Speech:
    """A document in the sound of a voice, handed over as `Synthesizer.stream` does.

    Positions of words count in `document.text`. Where a passage ends within a sentence, the pause
    of its end is cut.
    """
    track = _Track(document.text)
    position, handed_over = 0, 0.0
    pieces = document.pieces
    for piece in _flowing_together(pieces) if Skill.EMPHASIS in voice.skills else pieces:
        if isinstance(piece, Mark):
            track.mark(piece.name)
        elif isinstance(piece, Break):
            track.pause(piece.seconds)
        elif is_wanted():
            position = document.text.index(piece.text, position)
            if isinstance(piece, SoundMark):
                said = _sounded(piece, voice, prosody)
            else:
                way = combined(prosody, piece.prosody)
                said = _flowing(voice.stream(piece.text, way, _ignore, is_wanted))
            track.append(said, position)
            position += len(piece.text)
            if track.duration >= GROWTH * handed_over:
                handed_over = track.duration
                take(track.speech())
    whole = track.speech()
    take(whole)
    return whole


def _sounded(mark: SoundMark, voice: Synthesizer, prosody: Prosody) -> Speech:
    """A sound that is not a word, in the pitch and loudness of a prosody, and a short pause."""
    tract = voice.tract(prosody.voice)
    higher = replace(tract, pitch_hz=tract.pitch_hz * prosody.pitch)
    speech = sound_named(mark.name).speech(higher, mark.strength, mark.length)
    louder = np.clip(speech.samples * prosody.volume, -32768, 32767).astype(np.int16)
    return replace(speech, samples=np.pad(louder, (0, round(AFTER_SOUND * speech.rate))))


def _flowing_together(pieces: Iterable[Piece]) -> Iterator[Piece]:
    """Passages that differ in their emphasis alone become one, with weights within it."""
    for way, alike in groupby(pieces, _way_around):
        if way is None:
            yield from alike
        else:
            yield _weighed([piece for piece in alike if isinstance(piece, Passage)], way)


def _way_around(piece: Piece) -> Prosody | None:
    """How the words around a passage are said; None for a piece that is not one."""
    if not isinstance(piece, Passage):
        return None
    return replace(piece.around or piece.prosody, sounds=())


def _weighed(passages: Sequence[Passage], way: Prosody) -> Passage:
    """Passages as one, which is said in a way, with weight on some of its characters."""
    text, spans = "", []
    for passage in passages:
        text = _written_after(text, passage.text) if text else passage.text
        if passage.weight:
            spans.append((len(text) - len(passage.text), len(text), passage.weight))
    sounds = tuple(sound for passage in passages for sound in passage.prosody.sounds)
    return Passage(text, replace(way, sounds=sounds, emphases=tuple(spans)))


def _ignore(speech: Speech) -> None:
    """The parts of a passage are handed over when it is whole."""


class _Track:
    """A speech that grows; what it is so far takes no copy of its sound."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._rate = 0
        """Samples a second, of the first part; 0 before it."""
        self._sound: Samples = np.zeros(0, np.int16)
        self._count = 0
        """Samples that are filled."""
        self._silence = 0.0
        """Seconds of breaks after them."""
        self._phonemes: list[Phoneme] = []
        self._words: list[Span] = []
        self._sentences: list[Span] = []
        self._marks: list[tuple[str, float]] = []

    @property
    def duration(self) -> float:
        """Seconds."""
        return self._silence + (self._count / self._rate if self._rate else 0.0)

    def mark(self, name: str) -> None:
        self._marks.append((name, self.duration))

    def pause(self, seconds: float) -> None:
        self._silence += seconds

    def append(self, part: Speech, position: int) -> None:
        """Go on with a part whose text stands at a place of the whole."""
        self._rate = self._rate or part.rate
        samples = part.samples
        if part.rate != self._rate:
            samples = resample(samples, part.rate, self._rate)
        self._fill()
        begun = self.duration

        def moved(span: Span) -> Span:
            place, start, end = span.position + position, span.start + begun, span.end + begun
            return Span(span.text, place, start, end)

        self._phonemes += (
            Phoneme(p.name, p.start + begun, p.duration, p.stressed) for p in part.phonemes
        )
        self._words += map(moved, part.words)
        self._sentences += map(moved, part.sentences)
        self._extend(samples)

    def speech(self) -> Speech:
        """All of it so far."""
        self._rate = self._rate or PLAIN_RATE
        self._fill()
        return Speech(
            self._text,
            self._sound[: self._count],
            self._rate,
            tuple(self._phonemes),
            tuple(self._words),
            tuple(self._sentences),
            tuple(self._marks),
        )

    def _fill(self) -> None:
        """Make samples of the breaks."""
        self._extend(np.zeros(round(self._silence * self._rate), np.int16))
        self._silence = 0.0

    def _extend(self, samples: Samples) -> None:
        count = self._count + len(samples)
        if count > len(self._sound):  # a new place: what was handed over stays as it is
            larger = np.zeros(2 * count, np.int16)
            larger[: self._count] = self._sound[: self._count]
            self._sound = larger
        self._sound[self._count : count] = samples
        self._count = count


def _flowing(speech: Speech) -> Speech:
    """Without the pause after it, unless it ends a sentence."""
    last = speech.phonemes[-1:]
    if speech.text.rstrip()[-1:] in ENDS or not last or not last[0].name.startswith("_"):
        return speech
    end = round((last[0].start + JOINT) * speech.rate)
    return replace(speech, samples=speech.samples[:end], phonemes=speech.phonemes[:-1])


def _pieces(element: Element, prosody: Prosody) -> Iterator[Placed]:
    """What an element says, in order."""
    for part in element.content():
        if isinstance(part, str):
            for piece in parted(" ".join(part.split())):
                yield element, Passage(piece, prosody) if isinstance(piece, str) else piece
        elif part.tag not in _ELEMENTS:
            what = f"<{part.tag}> is not a part of SSML that is understood"
            raise part.error(what, did_you_mean(part.tag, _ELEMENTS))
        else:
            yield from _ELEMENTS[part.tag](part, prosody)


def _bounded(pieces: Iterator[Placed]) -> Iterator[Piece]:
    """The pieces alone. Raises AuthoringError at the one that makes the document too long."""
    silence, said, sounds = 0.0, 0, 0
    for element, piece in pieces:
        if isinstance(piece, Break):
            silence += piece.seconds
            if silence > MOST_SILENCE:
                what = f"the breaks take more than {MOST_SILENCE:g} s together"
                raise element.error(what, "say it in parts")
        elif isinstance(piece, SoundMark):
            sounds += 1
            if sounds > MOST_SOUNDS:
                what = f"it makes more than {MOST_SOUNDS} sounds"
                raise element.error(what, "say it in parts")
        elif isinstance(piece, Passage):
            said += len(piece.text) + sum(len(phones) for _, phones in piece.prosody.sounds)
            if said > MOST_SAID:
                what = f"it says more than {MOST_SAID} characters"
                raise element.error(what, "say it in parts")
        yield piece


def _joined(pieces: Iterator[Piece]) -> Iterator[Piece]:
    """Passages that follow each other and are said in one way become one."""
    last: Passage | None = None
    for piece in pieces:
        if isinstance(piece, Passage) and last is not None and _is_alike(last, piece):
            sounds = (*last.prosody.sounds, *piece.prosody.sounds)
            text = _written_after(last.text, piece.text)
            last = Passage(text, replace(piece.prosody, sounds=sounds))
            continue
        if last is not None:
            yield last
        last = piece if isinstance(piece, Passage) else None
        if last is None:
            yield piece
    if last is not None:
        yield last


def _written_after(text: str, more: str) -> str:
    return text + ("" if _NO_SPACE_BEFORE.match(more) else " ") + more


def _is_alike(one: Passage, other: Passage) -> bool:
    return replace(one.prosody, sounds=()) == replace(other.prosody, sounds=())


def _part(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes("xml:lang")
    yield from _pieces(element, prosody)
    if element.tag == "p":
        yield element, Break(BREAKS["medium"])


def _break(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check((), ("time", "strength"))
    seconds = _named(element, "strength", BREAKS, "medium")
    if time := element.get("time", ""):
        found = _TIME.fullmatch(time.strip())
        if found is None:
            raise element.error(f'time is "{time}"', 'write "500ms" or "1.5s"', "time")
        seconds = float(found[1]) / (1000 if found[2] == "ms" else 1)
    if seconds > LONGEST_BREAK:
        raise element.error(f"a break of {seconds:g} s", f"keep to {LONGEST_BREAK:g} s", "time")
    if seconds:
        yield element, Break(seconds)


def _emphasis(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes("level")
    weight = _named(element, "level", WEIGHTS, "moderate")
    change = _named(element, "level", EMPHASES, "moderate")
    for below, piece in _pieces(element, prosody):
        if isinstance(piece, Passage):
            way = combined(piece.prosody, change)
            piece = Passage(piece.text, way, weight, piece.around or piece.prosody)
        yield below, piece


def _prosody(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes("rate", "pitch", "range", "volume")
    change = Prosody(
        rate=_factor(element, "rate", RATES),
        pitch=_factor(element, "pitch", PITCHES),
        range=_factor(element, "range", RANGES),
        volume=_factor(element, "volume", VOLUMES),
    )
    yield from _pieces(element, combined(prosody, change))


def _voice(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes(*VOICE_ATTRIBUTES)
    if not element.attributes.keys() & set(VOICE_ATTRIBUTES[:4]):
        raise element.error("<voice> asks for no voice", 'add name="..." or gender="..."')
    wishes = " ".join((element.get("name", ""), element.get("languages", ""), _character(element)))
    yield from _pieces(element, replace(prosody, voice=" ".join(wishes.split()) or prosody.voice))


def _character(element: Element) -> str:
    """The voice of a gender and an age; empty where none is asked for."""
    gender, age = _named(element, "gender", VOICES, "neutral"), element.get("age", "").strip()
    if age and not _AGE.fullmatch(age):
        raise element.error(f'age is "{age}"', 'write years, such as "25"', "age")
    years = int(age or GROWN)
    young, grown, old = gender
    return young if years < GROWN else old if years >= OLD else grown


def _say_as(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes("interpret-as", "format")
    kind, words = element.get("interpret-as"), _words(element)
    if kind not in _SAID_AS:
        remedy = did_you_mean(kind, _SAID_AS)
        raise element.error(f'interpret-as is "{kind}"', remedy, "interpret-as")
    try:
        yield element, Passage(_SAID_AS[kind](words, element.get("format", "")), prosody)
    except ValueError as error:
        what = f'"{words:.40}" cannot be read as {kind}'
        raise element.error(what, str(error), "interpret-as") from error


def _phoneme(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes("alphabet", "ph")
    words, alphabet = _words(element).split(), element.get("alphabet", "ipa")
    if len(words) != 1:
        raise element.error(f"{len(words)} words in <phoneme>", "give each word its own")
    if alphabet not in ALPHABETS:
        remedy = did_you_mean(alphabet, ALPHABETS)
        raise element.error(f'alphabet is "{alphabet}"', remedy, "alphabet")
    try:
        phones = ALPHABETS[alphabet](element.get("ph"))
    except ValueError as error:
        what, remedy = f'no sound "{error}" in {alphabet}', "write a sound of English"
        raise element.error(what, remedy, "ph") from error
    if not phones:
        raise element.error("ph has no sounds", "write them, or leave out <phoneme>", "ph")
    core = _WORD.search(words[0])
    word = core[0].lower() if core else ""
    yield element, Passage(words[0], replace(prosody, sounds=((word, phones),)))


def _sub(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check_attributes("alias")
    _words(element)
    if alias := " ".join(element.get("alias").split()):
        yield element, Passage(alias, prosody)


def _words(element: Element) -> str:
    """The text of an element that has no others inside."""
    for child in element:
        raise child.error(f"<{child.tag}> has no place in <{element.tag}>", "delete it")
    return " ".join(element.text.split())


def _mark(element: Element, prosody: Prosody) -> Iterator[Placed]:
    element.check((), ("name",))
    yield element, Mark(element.get("name"))


_ELEMENTS: Mapping[str, Callable[[Element, Prosody], Iterator[Placed]]] = {
    "p": _part,
    "s": _part,
    "break": _break,
    "emphasis": _emphasis,
    "prosody": _prosody,
    "voice": _voice,
    "say-as": _say_as,
    "phoneme": _phoneme,
    "sub": _sub,
    "mark": _mark,
}


def _characters(text: str, _: str) -> str:
    return " ".join(
        say.by_digits(c) if c.isdecimal() else c.upper() for c in text if not c.isspace()
    )


def _digits(text: str, _: str) -> str:
    groups = re.findall(r"\d+", text)
    if not groups:
        raise ValueError("write digits")
    return ", ".join(map(say.by_digits, groups))


def _cardinal(text: str, _: str) -> str:
    if not re.fullmatch(r"-?[\d,]*\d(\.\d+)?", text):
        raise ValueError("write a number, such as 42")
    sign, number = ("minus ", text[1:]) if text.startswith("-") else ("", text)
    return sign + say.number(number)


def _ordinal(text: str, _: str) -> str:
    if not re.fullmatch(r"\d{1,9}", text):
        raise ValueError("write a whole number, such as 3")
    last = "th" if text[-2:-1] == "1" else {"1": "st", "2": "nd", "3": "rd"}.get(text[-1], "th")
    return text + last


def _date(text: str, order: str) -> str:
    numbers = re.findall(r"\d+", text)
    order = order or ("ymd" if numbers and len(numbers[0]) == 4 else "mdy")
    if order not in DATES or len(numbers) != 3 or max(map(len, numbers)) > 4:
        raise ValueError('write three numbers, and format="mdy", "dmy" or "ymd"')
    found = dict(zip(order, map(int, numbers), strict=True))
    if not (1 <= found["m"] <= 12 and 1 <= found["d"] <= 31):
        raise ValueError('change the format: "mdy", "dmy" or "ymd"')
    return f"{MONTHS[found['m'] - 1]} {found['d']}, {found['y']}"


def _as_written(text: str, _: str) -> str:
    return text


_SAID_AS: Mapping[str, Callable[[str, str], str]] = {
    "characters": _characters,
    "spell-out": _characters,
    "digits": _digits,
    "telephone": _digits,
    "cardinal": _cardinal,
    "number": _cardinal,
    "ordinal": _ordinal,
    "date": _date,
    "time": _as_written,
}


def _named(element: Element, attribute: str, values: Mapping[str, T], otherwise: str) -> T:
    name = element.get(attribute, otherwise)
    if name not in values:
        raise element.error(f'{attribute} is "{name}"', did_you_mean(name, values), attribute)
    return values[name]


def _factor(element: Element, attribute: str, names: Mapping[str, float]) -> float:
    """A change as a factor: a word, percent, semitones, or decibels."""
    value = element.get(attribute, "medium").strip()
    if value in (*names, "default"):
        return names.get(value, 1.0)
    found = _CHANGE.fullmatch(value)
    if found is None or found[3] not in UNITS[attribute].split():
        remedy = did_you_mean(value, names, 'write "slow", "+10%", "-2st" or "+6dB"')
        raise element.error(f'{attribute} is "{value}"', remedy, attribute)
    sign, amount, unit = found[1], float(found[2]), found[3]
    signed = -amount if sign == "-" else amount
    if unit == "%":  # without a sign it is a share of the plain voice
        return max(1 + signed / 100, 0.0) if sign else amount / 100
    return float(2 ** (min(signed, 99) / 12) if unit == "st" else 10 ** (min(signed, 99) / 20))
