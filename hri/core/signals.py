"""The values that travel between parts: immutable, typed, in SI units and radians."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from hri.core.errors import HriError, did_you_mean
from hri.core.properties import checked_name, plain_value

T = TypeVar("T")

Samples = NDArray[np.int16]
"""Mono audio, shape [n], full scale +-32767."""

Image = NDArray[np.uint8]
"""Picture, shape [height, width, 3], RGB, 0 to 255."""


@dataclass(frozen=True, slots=True)
class HeardWord:
    """A word and when it was said."""

    text: str
    start: float
    """Seconds."""
    end: float
    confidence: float | None = None
    """0 to 1: the chance that just this word was said; None from engines that cannot tell."""


@dataclass(frozen=True, slots=True)
class Alternative:
    """Something else that may have been said."""

    text: str
    share: float
    """How likely it was said instead of the best, 0 to 1; all shares and the best's make 1. Of a
    phrase that free words of the best hold, how likely that was said as well."""


@dataclass(frozen=True, slots=True)
class HeardSlot:
    """Words of a free slot, which no grammar lists, as they were heard."""

    name: str
    """Of the slot and its tag: "name" of `<name.spoken>`."""
    text: str
    """How it is spelled, lower case."""
    phones: tuple[str, ...] = ()
    """What was heard, in the set of the CMU dictionary without stress: ("SH", "AH", "V", "AO",
    "N")."""
    confidence: float = 1.0
    """0 to 1: the chance that it is this text and no other."""
    others: tuple[str, ...] = ()
    """What else it may have been, likeliest first; each sounds otherwise."""
    others_phones: tuple[tuple[str, ...], ...] = ()
    """The phones of each of them."""
    scores: tuple[float, ...] = ()
    """Natural log: how well the text and each of the others fits the sound."""


@dataclass(frozen=True, slots=True)
class Utterance:
    """Something the grammar allows was heard."""

    text: str
    """The grammar's words, lower case, one space between: "go forward ten meters"."""
    rule: str
    """The public rule that matched."""
    tags: Mapping[str, Any] = field(default_factory=dict)
    """What the words mean: {"distance": 10.0}."""
    confidence: float = 1.0
    """0 to 1; 0.5 is the calibrated point of acceptance."""
    start: float = 0.0
    """Seconds, when the voice began."""
    end: float = 0.0
    """Seconds, when the voice ended."""
    words: tuple[HeardWord, ...] = ()
    """Each word with its time; empty when the engine gives none."""
    alternatives: tuple[Alternative, ...] = ()
    """What else it may have been, likeliest first."""
    latency: float = 0.0
    """Seconds from where the pause was long enough to the result."""
    command: str = ""
    """The same words without courtesies, names, and free words around the command."""
    is_among_others: bool = False
    """Whether it is a phrase among words that nobody listed."""
    follow_up: str = ""
    """The rule of its words, where they stand for the command before them: "the other way"."""
    begun: str = ""
    """The words of a longer sentence that may have begun: someone hesitates behind them."""
    may_go_on: bool = False
    """Whether the speaker may go on with it: words may follow that change what it means."""
    continues: bool = False
    """Whether it stands in the place of the one before, since the person went on speaking."""
    level_db: float | None = None
    """dB against full scale of its loudest tenth of a second; None for what was typed."""
    slots: tuple[HeardSlot, ...] = ()
    """The words of its free slots as they were heard; none of what was typed."""


@dataclass(frozen=True, slots=True)
class Rejection:
    """A voice was there, but nothing was taken for a command."""

    reason: str
    """One of: "no speech", "not in grammar", "unlike the sound", "not now", "low confidence",
    "robot speaking"."""
    text: str = ""
    """The grammar's words that come closest."""
    confidence: float = 0.0
    start: float = 0.0
    end: float = 0.0
    detail: str = ""
    """More of the reason, for people: 'as likely: "turn around"'."""
    sure: Mapping[str, Any] = field(default_factory=dict)
    """With low confidence: the tags on which all likely sentences agree, if their rule is one."""
    unsure: tuple[str, ...] = ()
    """The names of the tags on which they do not agree: what is left to be asked."""
    choices: tuple[str, ...] = ()
    """With low confidence: two commands that are as likely, as they are said, likelier first."""
    begun: str = ""
    """The words of a sentence that was only begun, where that is likelier than any whole one."""
    latency: float = 0.0
    """Seconds from where the pause was long enough to the result."""
    level_db: float | None = None
    """dB against full scale of its loudest tenth of a second; None for what was typed."""


@dataclass(frozen=True, slots=True)
class Phoneme:
    """A sound of the voice by its espeak-ng mnemonic, stress marks stripped."""

    name: str
    start: float
    """Seconds from the start of the speech."""
    duration: float
    """Seconds."""
    stressed: bool = False


@dataclass(frozen=True, slots=True)
class Span:
    """A word or a sentence of a text that is spoken."""

    text: str
    """As it is written, punctuation included."""
    position: int
    """Characters of the whole text before it."""
    start: float
    """Seconds from the start of the speech."""
    end: float
    """Seconds; the pause after it is left out."""


@dataclass(frozen=True, slots=True)
class SoundWindow:
    """The last fraction of a second that a microphone heard. One window overlaps the next, so that
    nothing is missed by who does not see each of them.
    """

    samples: Samples
    rate: int
    """Samples a second."""
    end: int
    """Samples that were heard up to its end, from the first one on."""


@dataclass(frozen=True, slots=True)
class Speech:
    """Synthesized speech: what the speaker plays and the lips follow."""

    text: str
    samples: Samples
    rate: int
    """Samples a second."""
    phonemes: tuple[Phoneme, ...] = ()
    """In order; empty when the voice gives no times."""
    words: tuple[Span, ...] = ()
    """In order; empty when the voice gives no times. Words that melt together, such as "I am", may
    be one."""
    sentences: tuple[Span, ...] = ()
    """In order; empty when the voice gives no times."""
    marks: tuple[tuple[str, float], ...] = ()
    """Names of places in the text, and the seconds at which they are reached; in order."""
    saying: object = field(default=None, compare=False, repr=False)
    """The same for all lengths of a speech that grows while it is said; None for a whole one."""

    def continues(self, earlier: Speech | None) -> bool:
        """Whether this is a longer part of the speech that another one is a part of."""
        return self.saying is not None and earlier is not None and self.saying is earlier.saying

    def then(self, part: Speech, position: int) -> Speech:
        """This speech and another at the same rate, whose text stands at a place of this text."""
        begun = self.duration

        def moved(span: Span) -> Span:
            place, start, end = span.position + position, span.start + begun, span.end + begun
            return Span(span.text, place, start, end)

        later = (Phoneme(p.name, p.start + begun, p.duration, p.stressed) for p in part.phonemes)
        return Speech(
            self.text,
            np.concatenate((self.samples, part.samples)),
            self.rate,
            (*self.phonemes, *later),
            (*self.words, *map(moved, part.words)),
            (*self.sentences, *map(moved, part.sentences)),
            (*self.marks, *((name, time + begun) for name, time in part.marks)),
            self.saying or object(),
        )

    @property
    def duration(self) -> float:
        """Seconds."""
        return len(self.samples) / self.rate

    def caption(self, position: float) -> str:
        """The sentence that is heard at a time, seconds, until the next one begins; the whole text
        where the voice gives no times of sentences.
        """
        begun = [sentence.text for sentence in self.sentences if sentence.start <= position]
        return begun[-1] if begun else self.sentences[0].text if self.sentences else self.text

    def heard(self, position: float) -> str:
        """The words that have been completely heard at a time, seconds.

        For a voice that gives no times: as many of the words as there are seconds of the whole.
        """
        if position >= self.duration:
            return self.text
        if self.words:
            return " ".join(word.text for word in self.words if word.end <= position)
        words = self.text.split()
        return " ".join(words[: int(len(words) * position / self.duration)])


@dataclass(frozen=True, slots=True)
class VoiceQuality:
    """How a voice sounds beside pitch, pace and loudness; 0 is the plain voice."""

    breath: float = 0.0
    """0 to 1: air that is heard beside the voice."""
    tension: float = 0.0
    """-1 to 1: lax and soft in timbre, to pressed and sharp."""
    tremble: float = 0.0
    """0 to 1: pitch and loudness shake."""
    smile: float = 0.0
    """-1 to 1: lips drawn down and forward, to lips drawn apart."""
    onset: float = 0.0
    """-1 to 1: each phrase begins softly, to abruptly."""


PLAIN_QUALITY = VoiceQuality()


@dataclass(frozen=True, slots=True)
class Prosody:
    """How something is said; numbers are factors, 1 is the plain voice."""

    rate: float = 1.0
    """Of the words a minute."""
    pitch: float = 1.0
    """Of the frequency of the voice."""
    volume: float = 1.0
    """Of the amplitude."""
    range: float = 1.0
    """Of how far the pitch moves up and down, in semitones; 0 is monotonous."""
    voice: str = ""
    """Another voice than the synthesizer's own, such as "en-gb+f3"; empty for its own."""
    sounds: tuple[tuple[str, tuple[str, ...]], ...] = ()
    """Words, in small letters, whose phones of the CMU dictionary are given."""
    quality: VoiceQuality = PLAIN_QUALITY
    """What beside the factors is heard of a feeling, by a voice that can."""
    emphases: tuple[tuple[int, int, float], ...] = ()
    """Characters of the text, first and last + 1, that are said with more (up to 1) or less (down
    to -1) weight than the rest, by a voice that can."""


@dataclass(frozen=True, slots=True)
class Stimulus:
    """Something that moves the emotions: a name from `emotions/stimuli` and how strong."""

    name: str
    intensity: float = 1.0
    """0 to 1."""


@dataclass(frozen=True, slots=True)
class EmotionState:
    """What the robot feels now."""

    label: str
    """The strongest emotion ("joy") or the name of the mood when none stands out ("relaxed")."""
    intensity: float
    """0 to 1."""
    valence: float
    """Pleasure of the mood, -1 to 1."""
    arousal: float
    """-1 to 1."""
    dominance: float
    """-1 to 1."""
    emotions: Mapping[str, float] = field(default_factory=dict)
    """Intensity 0 to 1 of each emotion."""
    drives: Mapping[str, float] = field(default_factory=dict)
    """How pressing each need is, 0 to 1."""
    mood: str = ""
    """The name of the mood, whatever the label; empty where nobody has named it."""


@dataclass(frozen=True, slots=True)
class Expression:
    """What the face is asked to show: a label of the face's vocabulary and how much, 0 to 1."""

    label: str = "neutral"
    intensity: float = 1.0
    duration: float | None = None
    """Seconds from when it sets in until it fades to the mood again; without, it stays. 0 is as
    long as the face holds it by itself."""
    valence: float | None = None
    arousal: float | None = None
    """Of the mood below it, -1 to 1 each; None leaves the mood as it is."""


@dataclass(frozen=True, slots=True)
class FaceWeights:
    """Weights of morph targets by name, 0 to 1 (corners may go a little beyond)."""

    values: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class Gaze:
    """Where the eyes look, -1 to 1 of their range: x to the viewer's right, y up."""

    x: float = 0.0
    y: float = 0.0
    point: tuple[float, float, float] | None = None
    """What to look at instead of x and y: meters from between the eyes in the robot's axes, x
    ahead, y left, z up."""


@dataclass(frozen=True, slots=True)
class FaceBox:
    """A face found in a frame, in pixels."""

    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True, slots=True)
class HeadPose:
    """How a head is turned. Pitch positive down, yaw positive to the person's left, radians."""

    time: float
    """Seconds, when the picture was taken."""
    pitch: float
    yaw: float
    roll: float = 0.0
    box: FaceBox | None = None


@dataclass(frozen=True, slots=True)
class HeadGesture:
    """A movement of the head that means something."""

    kind: str
    """"nod", "shake", or another pattern of `config/gestures.toml`."""
    time: float
    """Seconds, when the picture was taken with which it was recognized."""
    confidence: float = 1.0
    """0 to 1."""
    person: str = ""
    """Id of the person who made it; empty when people are not distinguished."""
    latency: float = 0.0
    """Seconds from where the movement began."""


Landmarks = NDArray[np.float32]
"""Points of a face mesh, shape [468, 3]: x and y in pixels of the picture, z in the same scale,
growing away from the camera; numbered as in MediaPipe's face mesh."""


@dataclass(frozen=True, slots=True)
class Countenance:
    """What the parts of a face do."""

    smile: float = 0.0
    """0 to 1."""
    brows: float = 0.0
    """-1 drawn together and down, 0 at rest, 1 raised."""
    blink: float = 0.0
    """0 eyes open, 1 shut."""


@dataclass(frozen=True, slots=True)
class Hand:
    """A hand of someone, as it was looked at last."""

    side: str
    """The person's own: "left" or "right"."""
    time: float
    """Seconds, of the picture in which it was looked at; pictures between show the same."""
    landmarks: Landmarks
    """Shape [21, 3], pixels: wrist, then four from the root of each finger to its tip, the thumb
    first; depth in pixels too, negative nearer than the wrist.
    """
    shape: str = ""
    """One of "open", "pointing", "thumb", "fist"; empty for any other."""
    straight: tuple[bool, ...] = (False,) * 5
    """Which fingers are straight, the thumb first."""
    presence: float = 1.0
    """How surely it is a hand, 0 to 1."""
    is_palm: bool = False
    """Whether it shows its palm, not its back."""
    bearing: float = 0.0
    """Radians from the robot's straight ahead to the left."""
    elevation: float = 0.0
    """Radians from the robot's straight ahead up."""
    pointing_bearing: float = 0.0
    """Where the index finger points: radians to the left of what the robot calls ahead; pi, or
    -pi, is back at the robot."""
    pointing_elevation: float = 0.0
    """Radians above level."""
    number: int = 0
    """The same while it is followed."""

    @property
    def fingers(self) -> int:
        """How many fingers are straight, 0 to 5."""
        return sum(self.straight)


@dataclass(frozen=True, slots=True)
class Person:
    """Someone whom the camera sees, or saw a moment ago."""

    id: str
    """"p1", "p2" ...; the same while they are seen and for some seconds after."""
    pose: HeadPose
    """How the head is turned, against the way to the camera; with its box and its time."""
    motion: HeadPose | None = None
    """Pitch and yaw from the motion of the picture alone: they show swings, not lasting turns of
    the head. None without motion.
    """
    is_visible: bool = True
    """False while they are out of sight but not yet given up; the rest is then as it was last."""
    distance: float = math.nan
    """Meters from the camera; NaN when unknown."""
    bearing: float = 0.0
    """Radians from the robot's straight ahead to the left."""
    elevation: float = 0.0
    """Radians from the robot's straight ahead up."""
    looking: float = 0.0
    """How surely they look at the robot, 0 to 1."""
    is_looking: bool = False
    """The same with hysteresis."""
    engagement: str = "unengaged"
    """One of "unengaged", "engaging", "engaged", "disengaging"."""
    countenance: Countenance | None = None
    """None without a face mesh."""
    landmarks: Landmarks | None = None
    """None without a face mesh."""
    name: str = ""
    """The person's name, when a face recognizer knows it."""
    hands: tuple[Hand, ...] = ()
    """Those that are followed, at most two; none without the networks of hands."""
    since: float = math.nan
    """Seconds, when they came into sight; NaN when unknown."""
    has_face: bool = True
    """False while only their body is in sight: place and distance are then those of the body, the
    pose is as it was last, without a box, and there are no landmarks."""
    body: FaceBox | None = None
    """While only the body is in sight: from crown to feet, which may lie outside of the picture."""


@dataclass(frozen=True, slots=True)
class HandGesture:
    """A gesture of a hand."""

    kind: str
    """Its row in `config/hands.toml`, such as "wave"."""
    time: float
    """Seconds, of the picture with which it was complete."""
    hand: Hand
    person: str = ""
    """Id of whose it is."""
    latency: float = 0.0
    """Seconds since it began."""


@dataclass(frozen=True, slots=True)
class People:
    """Everyone whom the camera sees or saw a moment ago, in the order of their ids."""

    time: float
    """Seconds, when the picture was taken."""
    persons: tuple[Person, ...] = ()
    attended: str = ""
    """Id of the attended person; empty when there is none."""

    def person(self, id: str) -> Person | None:
        """The one of this id; None when they are not here."""
        return next((person for person in self.persons if person.id == id), None)


@dataclass(frozen=True, slots=True)
class ColorBlob:
    """A part of a picture that has a learned color."""

    name: str
    """Of the color."""
    x: float
    """Of its center, pixels from the left."""
    y: float
    """Pixels from the top."""
    width: float
    """Of the box around it, pixels."""
    height: float
    area: float
    """Pixels."""
    outline: tuple[tuple[float, float], ...]
    """Corners of a polygon around it, pixels."""
    bearing: float = 0.0
    """Radians from the robot's straight ahead to the left."""
    elevation: float = 0.0
    """Radians from the robot's straight ahead up."""
    confidence: float = 1.0
    """0 to 1: how likely it has this color, and is the thing that has it: by its chroma and its
    brightness, by how compact it is and how it stands out, and by what else has the color."""


@dataclass(frozen=True, slots=True)
class ColorBlobs:
    """The blobs of one picture, the largest first."""

    time: float
    """Seconds, when the picture was taken."""
    found: tuple[ColorBlob, ...] = ()

    def largest(self, name: str = "") -> ColorBlob | None:
        """The largest of a color that is likelier than not, or else the largest; of all colors
        without a name.
        """
        those = [blob for blob in self.found if name in ("", blob.name)]
        likely = (blob for blob in those if blob.confidence > 0.5)
        return next(likely, those[0] if those else None)


@dataclass(frozen=True, slots=True)
class MovingRegion:
    """A part of a picture that moves against what is behind it."""

    x: float
    """Of its center, pixels from the left."""
    y: float
    """Pixels from the top."""
    width: float
    """Of the box around it, pixels."""
    height: float
    bearing: float
    """Radians from the robot's straight ahead to the left."""


@dataclass(frozen=True, slots=True)
class Motion:
    """How a picture has moved since the one before."""

    time: float
    """Seconds, when the picture was taken."""
    elapsed: float
    """Seconds since the one before."""
    cells: NDArray[np.float32]
    """Shape [rows, columns, 2]: pixels a second to the right and down, averaged over each cell,
    without what the robot's own turning makes of it."""
    regions: tuple[MovingRegion, ...] = ()
    """What moves, the largest first."""
    confidence: NDArray[np.float32] = field(default_factory=lambda: np.zeros((0, 0), np.float32))
    """Shape [rows, columns], 0 to 1: how sure the motion of each cell is; low on plain walls."""


@dataclass(frozen=True, slots=True)
class FoundObject:
    """An object that was recognized in a picture."""

    name: str
    x: float
    """Of its center, pixels from the left."""
    y: float
    """Pixels from the top."""
    outline: tuple[tuple[float, float], ...]
    """Corners of a polygon around it, pixels; parts of it may lie outside of the picture."""
    confidence: float
    """0 to 1."""
    distance: float = math.nan
    """Meters from the camera; NaN when its size is unknown."""
    bearing: float = 0.0
    """Radians from the robot's straight ahead to the left."""
    elevation: float = 0.0
    """Radians from the robot's straight ahead up."""
    attributes: Mapping[str, float | str] = field(default_factory=dict, hash=False)
    """What its set says of it: numbers and texts by name."""


@dataclass(frozen=True, slots=True)
class Objects:
    """The objects of one picture, the surest first."""

    time: float
    """Seconds, when the picture was taken."""
    found: tuple[FoundObject, ...] = ()

    def named(self, name: str) -> FoundObject | None:
        """The surest of this name; None when none is there."""
        return next((one for one in self.found if one.name == name), None)


@dataclass(frozen=True, slots=True)
class Marker:
    """A printed marker that was found in a picture."""

    family: str
    """Such as "apriltag_36h11"; "qr" for a code with a text."""
    id: int
    """Of the marker in its family; -1 for a code with a text."""
    outline: tuple[tuple[float, float], ...]
    """Its four corners, pixels: the upper left one as it is printed, then clockwise."""
    x: float
    """Of its center, pixels from the left."""
    y: float
    """Pixels from the top."""
    distance: float
    """Meters from the camera to its center."""
    bearing: float
    """Radians from the robot's straight ahead to the left."""
    elevation: float
    """Radians from the robot's straight ahead up."""
    tilt: float
    """Radians between its normal and the line of sight; 0 when it faces the camera."""
    point: tuple[float, float, float]
    """Its center in the robot's axes, meters: x ahead, y left, z up."""
    facing: tuple[float, float, float]
    """Its normal in the robot's axes, of length 1, toward whoever reads it."""
    is_sure: bool = True
    """Whether it cannot be tilted as much to the other side: small and nearly from the front, both
    look the same."""
    text: str = ""
    """Of a code: nothing in it is opened, looked up or obeyed."""

    @property
    def name(self) -> str:
        """By which it is known again, such as "apriltag_36h11:7" and "qr:hello"."""
        return f"{self.family}:{self.text if self.id < 0 else self.id}"

    @property
    def pose(self) -> Pose2D:
        """On the robot's floor: where it is, and where it faces."""
        x, y, _ = self.point
        return Pose2D(x, y, math.atan2(self.facing[1], self.facing[0]))


@dataclass(frozen=True, slots=True)
class Markers:
    """The markers of one picture, the nearest first."""

    time: float
    """Seconds, when the picture was taken."""
    found: tuple[Marker, ...] = ()


@dataclass(frozen=True, slots=True)
class Frame:
    """A picture from a camera."""

    image: Image
    time: float
    """Seconds, when it was taken."""
    sequence: int
    """Counts up by one per picture taken; gaps are pictures lost."""

    @property
    def width(self) -> int:
        """Pixels."""
        return int(self.image.shape[1])

    @property
    def height(self) -> int:
        """Pixels."""
        return int(self.image.shape[0])

    def write_file(self, path: str | Path, quality: float = 0.8) -> None:
        """Write it as the suffix says: .jpg, .jpeg, .png or .webp.

        `quality` is 0 (small) to 1 (like the original) for a JPEG; PNG and WebP are always exact.
        Raises HriError when it cannot be written, ValueError for a quality out of range.
        """
        from hri.core.picture_writer import write_picture  # OpenCV, only for who writes a file

        write_picture(path, self.image, quality)


@dataclass(frozen=True, slots=True)
class Twist:
    """A velocity of the base: meters a second forward, radians a second to the left."""

    linear: float = 0.0
    angular: float = 0.0


@dataclass(frozen=True, slots=True)
class Pose2D:
    """Where the base is: meters and radians in the frame it started in, x ahead, y left."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, slots=True)
class RangeReading:
    """Distance to what a range sensor sees."""

    sensor: str
    distance: float
    """Meters; infinity when nothing is in range."""
    time: float
    raw: int | None = None
    """What the sensor counted, 0 when nothing is in range; None for a sensor that counts not."""


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened; names read `subject.past`: "speech.heard"."""

    name: str
    time: float = 0.0
    """Seconds of the clock at which it was raised; 0 before."""
    properties: Mapping[str, Any] = field(default_factory=dict)
    is_from_outside: bool = False
    """Whether another program raised it, over the network: nothing that the robot has sensed."""
    origin: str = ""
    """Who caused it from outside, as `hri.core.origin` has it; empty for the robot itself."""
    since_1970: float = field(default=0.0, compare=False, repr=False)
    """Seconds since 1970 at which it was raised, for people; 0 before."""

    def set_property(self, name: str, value: float | str) -> None:
        """Give a property to an event that will be raised; a text like "3.0" becomes a number.

        Raises HriError once it has been raised, for a name that cannot be written, and for what is
        not a finite number or a text.
        """
        if self.since_1970 or not isinstance(self.properties, dict):
            remedy = "make an event of that name, and set its properties"
            raise HriError(f"{self.name} has been raised and does not change - {remedy}")
        self.properties[checked_name(name)] = plain_value(name, value)

    def get_property(self, name: str, kind: type[T]) -> T:
        """The value of a property, which must be of a type; a whole number is a float as well.

        Raises HriError when it is not there, or of another type.
        """
        if name not in self.properties:
            remedy = did_you_mean(name, self.properties)
            raise HriError(f'{self.name} has no property "{name}" - {remedy}')
        value = self.properties[name]
        if kind is float and isinstance(value, int) and not isinstance(value, bool):
            return float(value)  # type: ignore[return-value]
        if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
            what = f"is a {type(value).__name__}, no {kind.__name__}"
            raise HriError(f'{self.name}: the property "{name}" {what} - fix who raises it')
        return value
