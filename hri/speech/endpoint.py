"""Where a voice begins and ends: samples in, finished pieces of speech out.

Every frame of 20 ms is asked whether a detector takes it for a voice, and how far it stands out of
what else there is to hear, both of the sound as loud as `automatic_level` makes it:

- The noise is the least level of the last two seconds (minimum statistics: R. Martin, "Noise power
  spectral density estimation based on optimal smoothing and minimum statistics", IEEE Trans. Speech
  and Audio Processing 9(5), 2001): speech dips to it between its sounds, and a noise that starts
  suddenly is known for one as soon as two seconds were never quieter.
- The background is the mean level while nobody near speaks; the talk of other people is far above
  its own dips. Whoever wants to begin must be louder than that.
- Near is what is in the upper half between the noise and the loudest of a piece, in dB. The talk of
  others before the first near sound and behind the last one is not a part of the piece.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hri.core.signals import Samples
from hri.hal.recognizer import Segment
from hri.speech.automatic_level import AutomaticLevel

FRAME = 0.02
"""Seconds that are judged at once."""
PRE_ROLL = 0.3
"""Seconds kept from before the first frame of voice: weak sounds such as "f" come before it."""
PAUSE = 0.6
"""Seconds of quiet that end a piece, unless someone wants others."""
TRAILING = 0.2
"""Seconds that weak sounds may continue after the last near one: the extra pause when others
talk.
"""
LEAST_VOICE = 0.05
"""Seconds of voice in a pause from which someone goes on; less is found in noise, too."""
LONGEST_PAUSE = 3.0
"""Seconds of quiet that a piece can be made to wait for."""
LONGEST = 20.0
"""Seconds; a longer piece is cut, so that no babble grows for ever."""
BEGIN_WINDOW, BEGIN_VOICE = 10, 5
"""Frames that are looked at together, and how many must be voice for a piece to begin."""
END_SHARE = 0.1
"""Share of the pause that may be taken for voice by mistake."""
BEGIN_MARGIN, STAY_MARGIN = 9.0, 4.0
"""Decibels above the noise at which a frame counts, before a piece and within it."""
BACKGROUND_MARGIN = 3.5
"""Decibels above the background at which a frame counts before a piece. With 6 the beginnings of 13
in 98 commands 6 dB above babble are lost, without it one in four is preceded by a piece of babble.
"""
NEAR_SHARE = 0.5
"""How far from the noise to the loudest of a piece, in dB, the near sounds begin.

With it commands and orders that go on in babble end 0.8 s after their last sound where they lasted
until the babble did (up to 8 s); of 50 orders each at 12 and 6 dB none is cut in two. 0.6 cuts weak
sounds off, 0.4 lets babble at 6 dB go on.
"""
LEAST = 0.25
"""Seconds; a shorter segment at the end of the sound is only the beginning of a word."""
LEAST_CUT = 0.5
"""Seconds of background before the first near sound that are worth being taken away."""
SMOOTHING = 5
"""Frames whose mean power is the level used here, except for single frames."""
NOISE_WINDOW = 100
"""Frames in which a voice must have dipped to the noise."""
BACKGROUND_FRAMES = 100
"""Frames, about, over which the background is a mean."""
QUIETEST = -65.0
"""dB against full scale: below it nothing is noise, and a stream is taken to begin so quiet."""
BELIEF = 10
"""Frames for which the beginning of a stream counts, so that who speaks at once is heard."""

IsVoice = Callable[[Samples], bool]
"""Takes the samples of one frame, in order, and says whether they are a voice."""


class NoiseLevel:
    """The level under which nothing has been for two seconds."""

    def __init__(self) -> None:
        self._powers: deque[float] = deque(maxlen=SMOOTHING)
        # Rising levels only: what a later frame falls below can never be the least again.
        self._least: deque[tuple[int, float]] = deque([(NOISE_WINDOW, QUIETEST)])
        self._count = 0

    @property
    def level(self) -> float:
        """How loud it is now, in dB."""
        return _decibels(sum(self._powers) / len(self._powers))

    def update(self, power: float) -> float:
        """Take the mean square of the next frame, full scale 1; the noise in dB."""
        self._powers.append(power)
        level = self.level
        while self._least and self._least[-1][1] >= level:
            self._least.pop()
        self._least.append((self._count + NOISE_WINDOW, level))
        self._count += 1
        while self._least[0][0] < self._count:
            self._least.popleft()
        return max(QUIETEST, self._least[0][1])


class Background:
    """The mean level of what is not a near voice."""

    def __init__(self) -> None:
        self.level = QUIETEST
        self._count = BELIEF

    def update(self, level: float) -> None:
        """Take the level of a frame, in dB."""
        self._count = min(self._count + 1, BACKGROUND_FRAMES)
        self.level += (max(QUIETEST, level) - self.level) / self._count


@dataclass(eq=False)
class _Piece:
    """A piece of speech that is going on."""

    number: int
    begun: float
    """Seconds."""
    noise_db: float
    room: Samples
    """Where the sound is written, so that a snapshot costs nothing however long the piece is."""
    length: int
    """Samples that are there."""
    levels: list[float]
    """Of each frame, dB."""
    loudest: float
    voiced: int
    """Frames up to the last one that stands out of the noise."""
    near: int
    """Frames up to the last near one."""
    level: float = -120.0
    """Of its loudest, as it came in, dB against full scale."""
    voice: int = 0
    """Frames of it that are voice."""
    wait: tuple[int, int] | None = None
    """Frames of voice that it had, and the frames of quiet that end it unless it has more."""

    @property
    def samples(self) -> Samples:
        return self.room[: self.length]

    def add(self, frame: Samples, level: float) -> None:
        self.room[self.length :][: len(frame)] = frame
        self.length += len(frame)
        self.levels.append(level)
        self.loudest = max(self.loudest, level)

    def cut(self, count: int) -> None:
        """Take the first frames away; what is left counts as another piece."""
        rest = self.samples[count * (self.length // len(self.levels)) :]
        # Snapshots of what it was may still be at work, so nothing is moved in place.
        self.room, self.length = np.empty_like(self.room), len(rest)
        self.room[: len(rest)] = rest
        del self.levels[:count]
        self.number += 1
        self.begun += count * FRAME
        self.voiced = max(1, self.voiced - count)
        self.near = max(1, self.near - count)

    @property
    def quiet(self) -> float:
        """Seconds since the voice, even if others talk on."""
        return max(0.0, self._since(self.voiced), self._since(self.near) - TRAILING)

    def _since(self, frames: int) -> float:
        return (len(self.levels) - frames) * FRAME


class Endpointer:
    """Cuts a stream of sound into pieces of speech; cheap enough for the robot loop."""

    def __init__(self, rate: int, detector: Callable[[int], IsVoice], pause: float = PAUSE) -> None:
        """`detector` makes one for a rate; `pause` is the seconds of quiet that end a piece."""
        self.rate = rate
        self._detector = detector
        self._size = round(FRAME * rate)
        self._pause = round(pause / FRAME)
        self._number = 0
        self._begin_stream()

    def _begin_stream(self) -> None:
        self._is_voice = self._detector(self.rate)
        self._noise = NoiseLevel()
        self._background = Background()
        self._automatic = AutomaticLevel()
        self._rest: Samples = np.zeros(0, np.int16)
        kept = round(PRE_ROLL / FRAME) + BEGIN_WINDOW
        self._before: deque[tuple[Samples, float]] = deque(maxlen=kept)
        self._recent: deque[bool] = deque(maxlen=round(LONGEST_PAUSE / FRAME))
        self._piece: _Piece | None = None

    @property
    def is_hearing(self) -> bool:
        """True while a voice is going on."""
        return self._piece is not None

    @property
    def open_segment(self) -> Segment | None:
        """What there is by now of the piece that is going on.

        Snapshots of one number begin one another; a piece that turns out to have begun with the
        talk of others goes on under the next number, without it.
        """
        return None if self._piece is None else self._segment(self._piece, self._piece.samples)

    def hold_level(self, is_held: bool) -> None:
        """Do not amplify more than now while it is held, as the robot's own voice is heard."""
        self._automatic.is_held = is_held

    def wait(self, segment: Segment, pauses: float) -> None:
        """End the open piece that a snapshot is of after this many of the usual pauses.

        At most after LONGEST_PAUSE. As soon as the voice goes on, one pause counts again.
        """
        piece = self._piece
        if piece is not None and piece.number == segment.number:
            frames = min(round(pauses * self._pause), round(LONGEST_PAUSE / FRAME))
            piece.wait = (piece.voice, frames)

    def listen(self, samples: Samples, end: float) -> list[Segment]:
        """Take the sound up to time `end`, in seconds; the pieces that ended in it."""
        sound = np.concatenate([self._rest, samples])
        count = len(sound) // self._size
        frames = sound[: count * self._size].reshape(count, self._size)
        self._rest = sound[count * self._size :]
        segments: list[Segment] = []
        for index, (frame, power) in enumerate(zip(frames, _powers(frames), strict=True)):
            time = end - (len(sound) - (index + 1) * self._size) / self.rate
            if (segment := self._take(frame, power, time)) is not None:
                segments.append(segment)
        return segments

    def flush(self) -> list[Segment]:
        """The piece that is still open; the next sound starts again."""
        segments = []
        if self._piece is not None:
            samples = np.concatenate([self._piece.samples, self._automatic.rest(self._rest)])
            if len(samples) >= LEAST * self.rate:
                segments.append(self._segment(self._piece, samples))
        self._begin_stream()
        return segments

    def _take(self, frame: Samples, power: float, time: float) -> Segment | None:
        """Judge the frame that ends at `time`; the piece that ends with it."""
        frame = self._automatic.take(frame, _decibels(power))
        gain_db = self._automatic.gain_db
        power *= 10.0 ** (gain_db / 10.0)
        noise = self._noise.update(power)
        # The detector learns from each frame, so it is asked in any case.
        is_voice = self._is_voice(frame)
        if self._piece is None:
            self._look_for_voice(frame, is_voice, _decibels(power), noise, time)
            return None
        self._piece.level = max(self._piece.level, self._noise.level - gain_db)
        self._recent.append(is_voice and _decibels(power) > noise + STAY_MARGIN)
        self._follow(self._piece, frame, is_voice, noise)
        return self._finished(self._piece) if self._is_over(self._piece) else None

    def _look_for_voice(
        self, frame: Samples, is_voice: bool, power_db: float, noise: float, time: float
    ) -> None:
        least = max(noise + BEGIN_MARGIN, self._background.level + BACKGROUND_MARGIN)
        level = self._noise.level
        self._recent.append(is_voice and power_db > least)
        self._before.append((frame, level))
        self._background.update(level)
        recent = list(self._recent)[-BEGIN_WINDOW:]
        if sum(recent) < BEGIN_VOICE:
            return
        kept = round(PRE_ROLL / FRAME) + len(recent) - recent.index(True)
        frames = list(self._before)[-kept:]
        begun, count = time - len(frames) * FRAME, len(frames)
        noise -= self._automatic.gain_db
        room = np.empty(round(LONGEST * self.rate) + count * self._size, np.int16)
        self._number += 1
        self._piece = _Piece(self._number, begun, noise, room, 0, [], QUIETEST, count, count)
        for earlier, its_level in frames:
            self._piece.add(earlier, its_level)
        self._before.clear()
        # A pause is counted from here: the quiet before the voice does not count.
        self._recent.clear()

    def _follow(self, piece: _Piece, frame: Samples, is_voice: bool, noise: float) -> None:
        """Add a frame to a piece, and tell whose it is."""
        level = self._noise.level
        is_louder = level > piece.loudest
        piece.add(frame, level)
        least = noise + max(STAY_MARGIN, NEAR_SHARE * (piece.loudest - noise))
        if level <= least:
            self._background.update(level)
        elif is_voice:
            piece.near = len(piece.levels)
        if self._recent[-1]:
            piece.voiced = len(piece.levels)
            piece.voice += 1
        # In noise that has risen above all of the piece nothing is near yet.
        if is_louder and level > least:
            self._cut_background(piece, least)

    def _cut_background(self, piece: _Piece, least: float) -> None:
        """Take away what came before the first near sound, but for the pre-roll."""
        first = next(index for index, level in enumerate(piece.levels) if level > least)
        # The level of a frame is a mean with some before it.
        count = first - SMOOTHING - round(PRE_ROLL / FRAME)
        if count * FRAME > LEAST_CUT:
            piece.cut(count)
            self._number = piece.number

    def _is_over(self, piece: _Piece) -> bool:
        pause = self._pause_of(piece)
        recent = list(self._recent)[-pause:]
        is_quiet = len(recent) >= pause and sum(recent) <= END_SHARE * pause
        is_behind = round(piece.quiet / FRAME) >= pause
        return is_quiet or is_behind or len(piece.levels) * FRAME >= LONGEST

    def _pause_of(self, piece: _Piece) -> int:
        """Frames of quiet that end a piece; those that it was made to wait for until it goes on."""
        if piece.wait is None:
            return self._pause
        voice, pause = piece.wait
        if (piece.voice - voice) * FRAME < LEAST_VOICE:
            return pause
        piece.wait = None
        # The quiet before this voice does not count any more.
        self._recent.clear()
        return self._pause

    def _segment(self, piece: _Piece, samples: Samples) -> Segment:
        return Segment(
            start=piece.begun,
            end=piece.begun + len(samples) / self.rate,
            samples=samples,
            number=piece.number,
            quiet=piece.quiet,
            noise_db=round(piece.noise_db, 1),
            level_db=round(piece.level, 1),
        )

    def _finished(self, piece: _Piece) -> Segment:
        self._piece = None
        self._recent.clear()
        return self._segment(piece, piece.samples)


def _powers(frames: Samples) -> list[float]:
    """Mean square of each frame, full scale 1, without what is constant in it."""
    powers: NDArray[np.float64] = np.var(frames, axis=1, dtype=np.float64) / 32768.0**2
    return [float(power) for power in powers]


def _decibels(power: float) -> float:
    return float(10.0 * np.log10(max(power, 1e-12)))
