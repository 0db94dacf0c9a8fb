"""A command that stands in a longer sentence: "turn around, i want to see your back".

For what is typed, where each word is known and only the sentence is longer than any of the grammar.
The rest must begin something new, or address someone; where it could change what the command
means ("turn around when i say so", "come here, i mean stop"), the sentence counts as a whole or not
at all.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from itertools import islice

from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.matching import MOST_WORDS, Matcher, Parse, as_written, parse
from hri.speech.grammar.words import typed

MOST_PIECES = 24
"""Parts of a text that are looked at, from the left; a text that has more repeats itself."""
FEWEST_WORDS = 2
"""Words of the command; one alone may mean anything, except behind another command."""
# fmt: off
FILLERS = frozenset((
    "actually", "ah", "alright", "anyway", "aw", "careful", "even", "exactly", "fine", "great",
    "ha", "haha", "hey", "hm", "hmm", "huh", "just", "kinda", "like", "literally", "oh", "ok",
    "okay", "ooh", "really", "shoot", "so", "sorta", "ugh", "uh", "um", "well", "whoa", "wow",
    "yeah", "yep", "yes", "yo",
))
"""Words that may be left out wherever they stand."""
CALLS = frozenset((
    "bro", "bud", "buddy", "dear", "dude", "everybody", "everyone", "friend", "guys", "hon",
    "honey", "kiddo", "man", "pal", "pet", "robot", "sweetheart", "sweetie",
))
"""Whom a sentence is said to; before and behind a command."""
BEGINNINGS = frozenset((
    "and", "are", "but", "can", "did", "do", "don't", "he", "he's", "i", "i'll", "i'm", "i've",
    "is", "it'll", "it's", "let", "let's", "now", "please", "she", "she's", "that's", "then",
    "there", "there's", "they", "they're", "we", "we'll", "we're", "what", "what's", "where",
    "who", "why", "will", "would", "you", "you'll", "you're",
))
"""First words of a clause, which a command may begin with."""
BREAKS = frozenset((
    "a", "because", "by", "cause", "from", "it", "my", "or", "since", "this", "with",
))
"""Words behind a command that do not belong to it; before one they may hang on what was said."""
TURNS = frozenset((
    "cancel", "if", "instead", "joking", "kidding", "later", "mean", "meant", "never",
    "nevermind", "no", "nope", "not", "rather", "stop", "unless", "until", "wait", "when",
    "won't",
))
"""Words of a rest that take back what was said, or say when."""
OPEN = frozenset(("how", "what", "where", "who", "why"))
"""Behind these words a clause only begins."""
MORE = frozenset((
    "again", "closer", "farther", "faster", "further", "less", "louder", "more", "slower",
))
"""One of these alone is enough behind another command."""
POLITE = frozenset((("can", "you"), ("could", "you"), ("will", "you"), ("would", "you")))
"""What an order may begin with."""
GREETINGS = frozenset(("bye", "goodbye", "hello", "hi", "morning", "thanks"))
"""One of these alone is enough at the beginning."""
LONGEST_GREETING = 2
"""Words, perhaps with a name."""
# fmt: on


def excerpt(grammar: Grammar, text: str, rules: Collection[str] | None = None) -> Parse | None:
    """The command that stands in a typed text; None without one. The longest counts.

    One without a topic, which may move the robot, must come first in the sentence if it does not
    count @anywhere, and counts before all small talk. `rules` are the public rules that count;
    None is all. Raises AuthoringError where `Grammar.automaton` does.
    """
    words = [word for word in typed(text) if word not in FILLERS]
    if len(words) > MOST_WORDS:
        return None
    begin = _begin(words)
    taken = []
    pieces = _pieces(grammar.made(as_written), words, begin)
    for start, end in islice(pieces, MOST_PIECES):
        found = parse(grammar, " ".join(words[start:end]), rules)
        if found is not None and _may_be_taken(grammar, found, start == begin, words[end:]):
            is_chat = bool(grammar.rules[found.rule].topics)
            taken.append((not is_chat, end - start, -start, found))
    return max(taken, key=lambda one: one[:3])[-1] if taken else None


def _begin(words: Sequence[str]) -> int:
    """The number of the first word behind a call and a polite beginning: "buddy, could you"."""
    begin = 1 if words[:1] and words[0] in CALLS else 0
    is_polite = tuple(words[begin : begin + 2]) in POLITE
    return begin + 2 if is_polite else begin


def _pieces(matcher: Matcher, words: Sequence[str], begin: int) -> Iterator[tuple[int, int]]:
    """Where sentences begin and end that stand between the borders of clauses."""
    later = (n for n in range(1, len(words)) if words[n - 1] in CALLS or words[n] in BEGINNINGS)
    for start in dict.fromkeys((begin, 0, *later)):
        state = matcher.begin()
        for end in range(start + 1, len(words) + 1):
            step = state.step(words[end - 1])
            if step is None:
                break
            state = step.state
            if state.is_final and _begins_anew(words[end:], words[start:end]):
                yield start, end


def _begins_anew(rest: Sequence[str], piece: Sequence[str]) -> bool:
    """Whether behind a piece something new begins, or it is said once more; a greeting needs no
    border.
    """
    is_border = not rest or rest[0] in BEGINNINGS | BREAKS | CALLS or rest[: len(piece)] == piece
    return is_border or (len(piece) <= LONGEST_GREETING and piece[0] in GREETINGS)


def _may_be_taken(grammar: Grammar, found: Parse, is_first: bool, rest: Sequence[str]) -> bool:
    """Whether the rest of a sentence leaves a command what it is."""
    command = grammar.rules[found.rule].stands_for or found.rule
    if command in grammar.marked("interrupts"):
        return is_first  # A stop harms nobody.
    words = found.text.split()
    is_follow_up = found.rule in grammar.marked("after")
    is_greeting = is_first and words[0] in GREETINGS
    is_long = len(words) >= FEWEST_WORDS or (is_follow_up and words[0] in MORE) or is_greeting
    if found.free or not is_long or found.rule in grammar.marked("answer"):
        return False
    if rest and (words[-1] in OPEN or (is_follow_up and words[-1] == "you")):
        return False
    if grammar.rules[found.rule].topics or found.rule in grammar.marked("anywhere"):
        return True
    return is_first and TURNS.isdisjoint(rest) and rest != ["don't"]
