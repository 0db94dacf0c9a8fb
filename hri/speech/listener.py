"""The ears of the robot as a behavior."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

from hri.behavior.behavior import Behavior, Context
from hri.behavior.ports import Input, Output, Param
from hri.core import paths
from hri.core.clock import Worker
from hri.core.errors import HriError
from hri.core.origin import caused_by, origin
from hri.core.signals import HeardSlot, Rejection, SoundWindow, Speech, Utterance
from hri.hal.microphone import Microphone
from hri.hal.recognizer import Recognizer, Segment
from hri.speech.acceptance import OVER_SPEECH, STRICTNESS
from hri.speech.endpoint import PRE_ROLL
from hri.speech.grammar import Grammar, load_grammar, parse
from hri.speech.grammar.follow_ups import FOLLOWED_FOR, Followed, can_be_followed
from hri.speech.grammar.merging import with_interrupts_of
from hri.speech.grammar_stack import GrammarStack, Layer, Prepare, as_written
from hri.speech.own_voice_filter import OwnVoiceFilter
from hri.speech.recognizers.typed import LineDecoder
from hri.speech.room_noise import RoomListener
from hri.speech.sound_trail import SoundTrail
from hri.speech.turn import DOUBTED_FOR, FOLLOW_UP, Doubt, Turn, Wakefulness
from hri.speech.turn_taking import GOES_ON, Reading, TurnTaking
from hri.speech.understanding import SILENT_AFTER, STEP, Heard, understand

FOLDERS = "app.folders"
"""Slot of the board with the folders of the app and of those that it extends, its own first."""
MOST_OTHERS = 2
"""What else a free slot may have been, in an event."""
MOST_WAITING = 20
"""Pieces of speech that wait for their turn; beyond it the oldest are forgotten."""

Tell = Callable[[float], object]
"""What is to be done in the loop with the result of a job, at a time."""


@dataclass(slots=True)
class _Piece:
    """What happens while a piece of speech is heard."""

    has_spoken: bool = False
    """Whether the robot spoke meanwhile."""
    was_question_open: bool = False
    was_addressed: bool = False
    """Whether someone turned to the robot meanwhile."""
    told: Callable[[Heard], object] | None = None
    """Who typed it wants to know what became of it."""
    is_own_known: bool = False
    """Whether it was known at its beginning what the robot's own voice would leave of itself."""
    has_floor: bool = False
    """Whether it counts as if the robot had not spoken, which fell silent for it."""
    is_typed: bool = False
    is_for_it: bool = False
    """Whether it was meant for the robot, also where it only belongs to an open talk."""


class Listener(Behavior):
    """Hears what the grammar allows: sound in, utterances out.

    Raises `speech.heard` (text, rule, tags, confidence, start, end, latency, command, may_go_on,
    continues, follow_up, and with free slots spoken), `speech.rejected` (reason, detail, text,
    confidence, begun, is_typed, is_addressed, is_looked_at, level_db), `speech.partial` (text)
    while someone speaks, `speech.interrupted` (text, rule) when a rule marked @interrupts is heard
    over the robot's own voice, and `grammar.changed` (file, reloaded) or
    `grammar.refused` (file, error).
    When the person begins to speak again soon after something was heard, `speech.continued` (text)
    asks to wait with acting on it; then another `speech.heard` takes its place, or
    `speech.confirmed` (text) lets it count. Loads its models and grammars while the rest already
    runs; speech before the first grammar is loaded waits. When the recognizer refuses the first
    one, `grammar.refused` says why, and only typed lines are heard.

    The marks of rules decide which are active, see `hri.speech.turn`. A phrase among other words
    (@anywhere) counts with the robot's name, when someone turns to the robot (`is_addressed`), in
    an open talk (`follow_up`), with `push_to_talk`, in a recording, and typed. A sentence of a rule
    marked @interrupts that is heard as clearly as over speech takes effect 0.16 s after its last
    sound, before the pause that ends a piece of speech is over. The grammar decides how long that
    is, see `hri.speech.turn_taking`. Linked to the speech and the
    position of a voice, it subtracts that voice from what it hears. No sound is ever kept.
    """

    category = "speech"

    is_speaking = Input[bool](
        "boolean", "whether the robot speaks; then few rules count", is_optional=True
    )
    speech = Input[Speech]("speech", "what the robot says, to be subtracted", is_optional=True)
    position = Input[float]("double", "seconds of it that have been heard", is_optional=True)
    question = Input[bool](
        "boolean", "whether an answer is awaited; then rules marked @answer count", is_optional=True
    )
    is_addressed = Input[bool](
        "boolean",
        "whether someone turns to the robot; without a link, its name or an open talk shows it",
        is_optional=True,
    )
    push_to_talk = Input[bool](
        "boolean", "hear only while it is true; always without a link", is_optional=True
    )
    sound = Output[SoundWindow]("sound", "the last 0.2 s that it heard, while it is not deaf")
    utterance = Output[Utterance]("utterance", "accepted speech")
    text = Output[str]("string", "the words of it")
    rule = Output[str]("string", "the rule that allows them")
    partial = Output[str]("string", "the words so far, when there are new ones")
    is_hearing = Output[bool]("boolean", "whether a voice is going on")
    noise = Output[float]("double", "level of the noise in the room, dB against full scale")
    noise_kind = Output[str]("string", "its kind: quiet, hum, hiss or unsteady")
    microphone_id = Param("microphone", "resource that hears")
    recognizer_id = Param("recognizer", "resource that finds the words")
    grammar = Param("companion", "name or path of the grammar")
    skills = Param("", "paths of grammars whose commands count beside its own, a line each")
    robot_name = Param("", "what the robot is called; rules marked @name know it")
    silent_topics = Param("", "topics, @topic of rules, that are not heard; spaces between them")
    silent_rules = Param("", "commands that are not heard, since a skill has better ones")
    strictness = Param(STRICTNESS, "confidence from which words count", minimum=0.0, maximum=1.0)
    follow_up = Param(
        FOLLOW_UP,
        "seconds after the last word in which the talk is open: no wake word or name is needed",
        minimum=0.0,
    )
    reload = Param(False, "whether a grammar is read again when its file changes")
    latency_s = Param(0.15, "time that finding the words takes on a fake clock", minimum=0.0)

    is_muted = False
    """Set it to be deaf for a while."""
    _held_until = 0.0
    _was_held = False
    _followed: Followed | None = None
    """The last command that others may follow, until some time."""
    _followed_until = 0.0
    _doubt: Doubt | None = None
    """The last answer that was nearly taken."""
    _understood_until = 0.0
    """Until when others may follow the last utterance, whatever its rule."""
    last_utterance: Utterance | None = None
    """The last utterance."""

    def check(self) -> None:
        self._read(paths.find("grammars", self.grammar))

    def start(self, context: Context) -> None:
        path = paths.find("grammars", self.grammar)
        self._first = self._read(path)
        self._events, self._clock, self._board = context.events, context.clock, context.board
        self._recognizer = context.resources.obtain(self.recognizer_id, Recognizer)
        microphone = context.resources.obtain(self.microphone_id, Microphone)
        self._ear = microphone.listen(self._recognizer.rate)
        self._trail = SoundTrail(self._recognizer.rate)
        self._waiting: deque[tuple[Segment, _Piece]] = deque(maxlen=MOST_WAITING)
        self._piece = _Piece()
        self._wakefulness = Wakefulness(self.follow_up)
        self._own_voice = OwnVoiceFilter(self._recognizer.rate)
        self._room = RoomListener(self._recognizer.rate)
        self._turns = TurnTaking(self._recognizer)
        self._worked = Segment(0.0, 0.0)
        self._partial = ""
        self._told_early = (-1, "")
        self._taken_back = ""
        """What was understood last, while the person goes on with it."""
        self._worker: Worker[Tell] = context.clock.worker(self.latency_s)
        # What is worked out beforehand takes no time away from the result.
        self._early_worker: Worker[Tell] = context.clock.worker(0.0)
        self._grammars = GrammarStack(context.clock.worker(self.latency_s), self._take_grammar)
        self._grammars.use(path).grammar = self._first
        self._grammars.update()

    # --- grammars ---

    @property
    def loaded_grammar(self) -> Grammar:
        """What is understood; there once the behavior has started."""
        layer = self._grammars.in_force
        if layer is None or layer.heard is None:
            return self._without_silent(self._first)
        return layer.heard

    def read_grammar(self) -> Grammar:
        """What its parameters say that it will hear first.

        Raises HriError or AuthoringError when the file cannot be read.
        """
        return self._without_silent(self._read(paths.find("grammars", self.grammar)))

    def _read(self, path: Path) -> Grammar:
        """A grammar file; that of its parameter with the commands of skills."""
        is_own = path == paths.find("grammars", self.grammar)
        return load_grammar(path, list(map(Path, self.skills.splitlines())) if is_own else ())

    def _without_silent(self, grammar: Grammar) -> Grammar:
        return grammar.without(self.silent_topics.split(), self.silent_rules.split())

    def use(self, grammar: str | Path) -> Layer:
        """Take another grammar, by name or path, in the place of the topmost one.

        One in the app's own folder comes first.
        It is read and compiled while the old one stays in force, and no sound is lost: a piece of
        speech is decoded by the grammar that is in force when it has ended. The rules marked
        @interrupts of the grammar that the listener started with stay in force. `Layer.error` says
        why one was refused. Raises HriError when there is no such file.
        """
        return self._grammars.use(self._found(grammar))

    def push(self, grammar: str | Path, prepare: Prepare = as_written) -> Layer:
        """Put another grammar above the topmost one, until `pop`. Raises HriError as `use`.

        The rules of the grammars below that are marked @interrupts stay in force. `prepare` turns
        the grammar in the file into the one to hear; it runs in a worker.
        """
        return self._grammars.push(self._found(grammar), prepare)

    def _found(self, grammar: str | Path) -> Path:
        return paths.find("grammars", str(grammar), self._board.slot(FOLDERS).value or ())

    def pop(self, layer: Layer) -> None:
        """Take a grammar away that was pushed; the one below it comes back into force."""
        self._grammars.pop(layer)

    def call(self, name: str) -> None:
        """Let the grammars know what the robot is called, where a rule is marked @name."""
        if name != self.robot_name:
            self.set_parameter("robot_name", name)
            self._grammars.retake()

    def know(self, slot: str, sounds: Mapping[str, tuple[str, ...]]) -> None:
        """Let the free slot of a name know what people said there before, `{text: phones}`, so that
        it is heard again; instead of what it knew before, so nothing makes it forget.

        Phones are those of `HeardSlot.phones`. They are kept in memory alone.
        """
        self._recognizer.know(slot, sounds)

    def is_in_force(self, layer: Layer) -> bool:
        """Whether a grammar is the one that is listened for."""
        in_force = self._grammars.in_force
        return in_force is not None and in_force.stands_for(layer)

    def _take_grammar(self, layer: Layer) -> None:
        """Read a grammar and give it to the recognizer; runs in a worker.

        Where there is no other one, a grammar that the recognizer refuses serves for typed lines.
        """
        layer.is_read = layer.grammar is None
        grammar = layer.grammar or self._read(layer.path)
        heard = layer.prepare(self._without_silent(grammar))
        for below in layer.below:
            other = below.grammar or self._read(below.path)
            heard = with_interrupts_of(heard, self._without_silent(other))
        unheard = None
        heard = heard.called(self.robot_name)
        try:
            self._recognizer.start(heard)
        except HriError as error:
            if self._grammars.in_force is not None and layer.unheard is None:
                raise
            unheard = error
        layer.grammar, layer.heard, layer.unheard = grammar, heard, unheard
        self._grammars.in_force = layer

    def _change_grammar(self, now: float) -> None:
        # What ended before is still decoded by the grammar that was in force then.
        if not self._waiting or self._grammars.in_force is None:
            layer = self._grammars.update()
            if layer is not None and (refused := layer.error or layer.unheard) is not None:
                error = str(refused)
                self._events.raise_event("grammar.refused", file=str(layer.path), error=error)
            elif layer is not None and layer.grammar is not self._first:
                told = {"file": str(layer.path), "reloaded": layer.is_reloaded}
                self._events.raise_event("grammar.changed", **told)
        if self.reload:
            self._grammars.reload_when_changed(now)

    # --- hearing ---

    def type_line(self, text: str, told: Callable[[Heard], object] | None = None) -> None:
        """Hear a typed line as if it had been said; little words too many or too few are forgiven.

        `told` is called with what became of it. Nothing happens for an empty one.
        """
        now = self._clock.now()
        if text.strip():
            typed = Segment(now, now, text=text.strip(), origin=origin())
            self._waiting.append((typed, _Piece(told=told)))

    def hold(self, seconds: float) -> None:
        """Hear for that long whoever said to be deaf, and without a wake word: someone holds a
        button to talk. When the time is over what was said counts at once; 0 ends it.
        """
        self._held_until = self._clock.now() + seconds

    @property
    def is_held(self) -> bool:
        """Whether it hears because of `hold`."""
        return self._held_until > 0.0 and self._clock.now() < self._held_until

    @property
    def is_idle(self) -> bool:
        """True when nothing that was heard is still on its way to be understood."""
        is_busy = self._worker.is_busy or self._early_worker.is_busy
        return not (self._waiting or is_busy or self._recognizer.is_hearing)

    def compute(self, now: float, dt: float) -> None:
        self._listen(now)
        for worker in (self._early_worker, self._worker):
            for tell in worker.poll():
                tell(now)
        self._change_grammar(now)
        self._work(now)
        self.is_hearing.send(self._recognizer.is_hearing)
        if (noise := self._room.noise) is not None:
            self.noise.send(noise.level)
            self.noise_kind.send(noise.kind)

    def _listen(self, now: float) -> None:
        """Feed the endpointer; remember what happens during each piece."""
        is_speaking = bool(self.is_speaking.value)
        if is_speaking:
            self._wakefulness.extend(now)
            if self.speech.sources:  # Else its voice cannot be subtracted.
                self._own_voice.note_speaking(now)
        position = self.position.value or 0.0
        samples = self._own_voice.filtered(self._ear.read(now), self.speech.value, position, now)
        is_held = self.is_held
        is_let_go, self._was_held = self._was_held and not is_held, is_held
        if is_held:
            self._wakefulness.extend(now)
        is_off = self.is_muted or bool(self.push_to_talk.sources and not self.push_to_talk.value)
        layer = self._grammars.in_force
        is_deaf = (is_off and not is_held) or (layer is not None and layer.unheard is not None)
        was_hearing = self._recognizer.is_hearing
        self._recognizer.mind(is_speaking, now)
        segments = self._recognizer.listen(samples[:0] if is_deaf else samples, now)
        is_over = (
            self._ear.has_ended or is_deaf or is_let_go or self._own_voice.begins_to_subtract(now)
        )
        if not is_deaf:
            self.sound.send(self._trail.after(samples))
        if is_over and self._recognizer.is_hearing:
            segments += self._recognizer.flush()
        if was_hearing or self._recognizer.is_hearing or segments:
            self._note(is_speaking)
            if not was_hearing:
                self._piece.is_own_known = self._own_voice.is_known
                self._notice_going_on()
        elif not (is_deaf or is_speaking):
            self._room.hear(samples)
        if not is_deaf:
            seconds = len(samples) / self._recognizer.rate
            self._own_voice.note_voice(self._voice_begun, seconds, now)
        self._waiting.extend((segment, self._piece) for segment in segments)
        if segments or not self._recognizer.is_hearing:
            self._piece = _Piece()

    def _note(self, is_speaking: bool) -> None:
        piece = self._piece
        piece.has_spoken |= is_speaking and not piece.has_floor
        piece.was_question_open |= bool(self.question.value)
        piece.was_addressed |= bool(self.is_addressed.value)

    # --- whose turn it is ---

    def other_voice(self, begun: float) -> float | None:
        """When the voice that is heard now began, in seconds; None without one.

        Also None where it may be what is left of the robot's own voice, which began at `begun`.
        """
        segment, voice = self._recognizer.open_segment, self._voice_begun
        if segment is None or voice is None or voice < begun:
            return voice
        if not self._piece.is_own_known or segment.noise_db is None:
            return None
        is_other = self._own_voice.is_other(voice, self._clock.now(), segment.noise_db)
        return voice if is_other else None

    @property
    def _voice_begun(self) -> float | None:
        """When the voice that is heard now began, in seconds; None without one."""
        segment = self._recognizer.open_segment
        return None if segment is None else segment.start + PRE_ROLL

    def let_speak(self) -> None:
        """Judge what is being said as if the robot had not spoken: it falls silent for it."""
        self._piece.has_floor, self._piece.has_spoken = True, False

    # --- understanding ---

    def _work(self, now: float) -> None:
        """Give the worker the next thing to do."""
        # The engine does one thing at a time.
        is_busy = self._worker.is_busy or self._early_worker.is_busy
        layer = self._grammars.in_force
        if is_busy or layer is None or layer.heard is None:
            return
        if self._waiting:
            segment, piece = self._waiting.popleft()
            turn = self._turn(piece, segment.start)
            piece.is_typed = bool(segment.text)
            piece.is_for_it = piece.is_typed or turn.is_addressed
            is_read = self._turns.has_read(segment, layer.heard, turn)
            worker = self._early_worker if is_read else self._worker
            worker.submit(lambda: self._understand(segment, piece, turn, now))
        elif (segment_so_far := self._recognizer.open_segment) is not None:
            self._advance(segment_so_far, self._piece, layer.heard, now)
        elif self._taken_back and not self._recognizer.is_hearing:
            self._give_back()

    def _turn(self, piece: _Piece, start: float) -> Turn:
        is_question_open = piece.was_question_open or bool(self.question.value)
        is_awake = self._wakefulness.is_awake(start)
        is_for_it = bool(self.push_to_talk.sources) or self._ear.microphone.is_recording
        is_addressed = piece.was_addressed or bool(self.is_addressed.value)
        return Turn(
            is_speaking=piece.has_spoken,
            is_question_open=is_question_open,
            is_awake=is_awake,
            is_addressed=is_addressed or is_for_it or is_awake or is_question_open,
            last=self._last(start),
            doubt=self._doubted(start),
        )

    def _last(self, now: float) -> Followed | None:
        """What was understood a while ago at most."""
        if now <= self._followed_until:
            return self._followed
        return Followed() if now <= self._understood_until else None

    def _doubted(self, now: float) -> Doubt | None:
        doubt = self._doubt
        return doubt if doubt is not None and now <= doubt.time + DOUBTED_FOR else None

    def _understand(self, segment: Segment, piece: _Piece, turn: Turn, begun: float) -> Tell:
        """Decode a piece; runs in the worker."""
        while True:
            layer = self._grammars.in_force
            assert layer is not None
            assert layer.heard is not None
            reading = self._reading(segment, layer, turn)
            if layer is self._grammars.in_force:
                break  # else another grammar came meanwhile, and the words may be of either
        grammar = layer.heard

        def tell(now: float) -> None:
            for heard in reading.heard:
                if self._told_early == (segment.number, _rule_of(heard)):
                    continue
                result = replace(heard, latency=now - begun)
                if (
                    isinstance(result, Utterance)
                    and piece.has_spoken
                    and self._own_voice.is_own(result)
                ):
                    result = _own_words(result)
                with caused_by(segment.origin):
                    self._tell(result, grammar, piece)

        return tell

    def _reading(self, segment: Segment, layer: Layer, turn: Turn) -> Reading:
        """What a piece says; a typed line that the grammar of a question does not allow, or only
        among other words, may be a sentence of those below.
        """
        assert layer.heard is not None
        if not segment.text:
            return self._turns.end(segment, layer.heard, self.strictness, turn)

        def read(grammar: Grammar) -> Heard:
            return understand(LineDecoder(grammar), grammar, segment, self.strictness, turn)

        first = read(layer.heard)
        if isinstance(first, Utterance) and not first.is_among_others:
            return Reading((first,))
        is_answer = isinstance(first, Utterance)
        for below in (one.heard for one in reversed(layer.below) if one.heard is not None):
            heard = read(below)
            if isinstance(heard, Utterance) and (not is_answer or _is_whole(below, heard)):
                return Reading((heard,))
        return Reading((first,))

    def _advance(self, segment: Segment, piece: _Piece, grammar: Grammar, begun: float) -> None:
        """Let the engine work on an open piece when there is enough new of it."""
        last = self._worked
        is_silent = segment.quiet >= SILENT_AFTER
        if segment.number == last.number and (
            last.quiet >= SILENT_AFTER if is_silent else segment.end - last.end < STEP
        ):
            return
        self._worked = replace(segment, samples=None)
        turn = self._turn(piece, segment.start)

        def job() -> Tell:
            if is_silent:
                return self._look_at_pause(segment, piece, turn, grammar, begun)
            words = self._recognizer.advance(segment, turn.rules(grammar))
            return lambda now: self._tell_partial(words, turn)

        self._early_worker.submit(job)

    def _look_at_pause(
        self, segment: Segment, piece: _Piece, turn: Turn, grammar: Grammar, begun: float
    ) -> Tell:
        """Find when a pause ends the turn: a sure "stop" does not wait for that."""
        reading = self._turns.read(segment, grammar, self.strictness, turn)
        heard = reading.heard[-1] if reading.heard else None
        is_clear = (
            isinstance(heard, Utterance)
            and heard.rule in grammar.marked("interrupts")
            and heard.confidence >= self.strictness + OVER_SPEECH * (1.0 - self.strictness)
        )

        def tell(now: float) -> None:
            self._recognizer.wait(segment, reading.pauses)
            if heard is None:
                return
            early = (segment.number, _rule_of(heard))
            is_sure = is_clear and not self._is_own(heard, piece)
            if is_sure and self._told_early != early:
                self._told_early = early
                self._tell(replace(heard, latency=now - begun), grammar, piece)
            elif not is_sure:
                self._tell_partial(heard.text, turn)

        return tell

    def _notice_going_on(self) -> None:
        """Take back what was understood last when the person begins again soon after it."""
        segment, last = self._recognizer.open_segment, self.last_utterance
        if segment is None or last is None or self._piece.has_spoken or not last.words:
            return
        if segment.start < last.end + GOES_ON and not self._taken_back:
            self._taken_back = last.text
            self._events.raise_event("speech.continued", text=last.text)

    def _give_back(self) -> None:
        """Nothing that the person said since changes what was understood."""
        text, self._taken_back = self._taken_back, ""
        self._events.raise_event("speech.confirmed", text=text)

    # --- telling ---

    def _is_own(self, heard: Heard, piece: _Piece) -> bool:
        return piece.has_spoken and self._own_voice.is_own(heard)

    def _tell_partial(self, words: str, turn: Turn) -> None:
        if words and words != self._partial and not turn.is_speaking:
            self._partial = words
            self.partial.send(words)
            self._events.raise_event("speech.partial", text=words)

    def _tell(self, result: Heard, grammar: Grammar, piece: _Piece) -> None:
        self._partial = ""
        if piece.told is not None:
            piece.told(result)
        confidence = round(result.confidence, 3)
        if isinstance(result, Rejection):
            if piece.was_question_open and result.reason == "low confidence":
                self._doubt = Doubt(result.text, result.confidence, result.end)
            self._events.raise_event(
                "speech.rejected",
                reason=result.reason,
                detail=result.detail,
                text=result.text,
                confidence=confidence,
                sure=dict(result.sure),
                unsure=list(result.unsure),
                choices=list(result.choices),
                begun=result.begun,
                is_typed=piece.is_typed,
                is_addressed=piece.is_for_it,
                is_looked_at=piece.is_typed or piece.was_addressed,
                level_db=result.level_db,
            )
            return
        self._taken_back, self._doubt = "", None
        self._wakefulness.extend(result.end)
        self.last_utterance = result
        self._understood_until = result.end + FOLLOWED_FOR
        if result.rule in can_be_followed(grammar):
            self._followed = Followed(result.rule, result.tags)
            self._followed_until = result.end + FOLLOWED_FOR
        self.utterance.send(result)
        self.text.send(result.text)
        self.rule.send(result.rule)
        if piece.has_spoken and result.rule in grammar.marked("interrupts"):
            self._events.raise_event("speech.interrupted", text=result.text, rule=result.rule)
        self._events.raise_event(
            "speech.heard",
            text=result.text,
            rule=result.rule,
            tags=dict(result.tags),
            confidence=confidence,
            start=round(result.start, 3),
            end=round(result.end, 3),
            latency=round(result.latency, 3),
            command=result.command,
            may_go_on=result.may_go_on,
            continues=result.continues,
            follow_up=result.follow_up,
            **({"spoken": _spoken(result.slots)} if result.slots else {}),
        )

    def stop(self) -> None:
        self._ear.close()
        self._early_worker.close()
        self._worker.close()
        self._grammars.close()


def _spoken(slots: Iterable[HeardSlot]) -> dict[str, dict[str, object]]:
    """How the words of free slots were heard, by the names of the slots."""
    return {
        slot.name: {
            "text": slot.text,
            "phones": list(slot.phones),
            "others": list(slot.others[:MOST_OTHERS]),
        }
        for slot in slots
    }


def _rule_of(heard: Heard) -> str:
    return heard.rule if isinstance(heard, Utterance) else ""


def _is_whole(grammar: Grammar, heard: Utterance) -> bool:
    """Whether a typed line is a sentence word for word; a free slot takes the words of anything."""
    if heard.confidence < 1.0 or heard.is_among_others:
        return False
    found = parse(grammar, heard.text, {heard.rule})
    return found is not None and not found.free


def _own_words(heard: Utterance) -> Rejection:
    return Rejection(
        reason="robot speaking",
        text=heard.text,
        confidence=heard.confidence,
        start=heard.start,
        end=heard.end,
        detail="its own words",
        latency=heard.latency,
        level_db=heard.level_db,
    )
