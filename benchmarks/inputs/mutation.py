"""Bad inputs made of good ones: pure, the same for the same random numbers.

Text is taken apart into words, numbers, quotations and signs, which are exchanged, repeated, nested
and replaced by values that break readers; anything else is changed byte by byte.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache
from random import Random

LARGEST = 300_000
"""Bytes of an input, unless its seed is larger already."""
DEEPEST = 3000
"""Brackets that are nested."""
MOST_COPIES = 3000

Tokens = list[bytes]

_TOKEN = re.compile(
    rb"\s+|[A-Za-z_][\w-]*|[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?"
    rb"|\"[^\"\n]*\"|'[^'\n]*'|[^\w\s]|."
)
_NUMBER = re.compile(rb"[-+]?\d")
_WORD = re.compile(rb"[A-Za-z_]")
_NUMBERS = (
    b"0", b"-1", b"1e308", b"-1e308", b"1e-320", b"nan", b"inf", b"-inf", b"1e999", b"9" * 400,
    b"1" * 5000, b"0x7fffffffffffffff", b"2147483648", b"18446744073709551616", b"1_000", b"0.1.2",
    b"65536", b"100000", b"4294967295",
)  # fmt: skip
_WORDS = (
    b"", b"a" * 300, b"a" * 70_000, b".." * 3 + b"/etc/passwd", b"/etc/hostname", b"/dev/zero",
    "\u202e\u2066".encode(), b"\x1b[2J\x1b[31m", b"\x00", b"\xff\xfe", b"\xed\xa0\x80", b"%s%n",
    "é\u0301".encode() * 40, b"__class__", b"nan", b"true", b"\\", b"\n\n", b"a.b" * 20_000,
    "\U0001f600".encode() * 30, b"{}" * 50, b"../" * 100,
)  # fmt: skip
_BRACKETS = ((b"(", b")"), (b"[", b"]"), (b"{", b"}"), (b"<", b">"), (b"<a>", b"</a>"), (b"-", b""))
_FIELDS = (b"\0\0\0\0", b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80", b"\x01\0\0\0")


def mutated(seeds: Sequence[bytes], is_text: bool, random: Random) -> bytes:
    """An input made of one or two of the seeds by one to four changes."""
    seed = random.choice(seeds)
    most = max(LARGEST, len(seed))
    if not is_text or random.random() < 0.1:
        return _several(_pieces_of_seed(seed), _BINARY, seeds, random)[:most]
    return _several(_tokens_of_seed(seed), _TEXT, seeds, random)[:most]


@cache
def _tokens_of_seed(seed: bytes) -> Tokens:
    return _TOKEN.findall(seed)


@cache
def _pieces_of_seed(seed: bytes) -> Tokens:
    return list_of_bytes(seed)


def list_of_bytes(data: bytes) -> Tokens:
    """The data in pieces of a few bytes, so that fields stay whole now and then."""
    return [data[at : at + 4] for at in range(0, len(data), 4)]


Change = Callable[[Tokens, Sequence[bytes], Random], Tokens]
"""Tokens made of others, which stay as they are: those of a seed are used again."""


def _several(
    tokens: Tokens, changes: Sequence[Change], seeds: Sequence[bytes], random: Random
) -> bytes:
    for _ in range(random.choice((1, 1, 1, 2, 2, 3, 4))):
        tokens = random.choice(changes)(tokens if any(tokens) else [b" "], seeds, random)
    return b"".join(tokens)


def _span(tokens: Tokens, random: Random, most: int = 30) -> tuple[int, int]:
    begin = random.randrange(len(tokens))
    return begin, min(len(tokens), begin + random.randint(1, most))


def _of_kind(tokens: Tokens, kind: re.Pattern[bytes], random: Random) -> int:
    """The place of a token of a kind, or of any token where there is none nearby."""
    begin = random.randrange(len(tokens))
    around = (*range(begin, min(begin + 200, len(tokens))), *range(max(begin - 200, 0), begin))
    return next((at for at in around if kind.match(tokens[at])), begin)


def _number(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    at = _of_kind(tokens, _NUMBER, random)
    return [*tokens[:at], random.choice(_NUMBERS), *tokens[at + 1 :]]


def _word(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    at = _of_kind(tokens, _WORD, random)
    return [*tokens[:at], random.choice(_WORDS), *tokens[at + 1 :]]


def _other_word(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    """A word, number or quotation where another one of the seed stood."""
    other = tokens[random.randrange(len(tokens))]
    at = random.randrange(len(tokens))
    return [*tokens[:at], other, *tokens[at + 1 :]]


def _in_quotes(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    at = _of_kind(tokens, re.compile(rb"[\"']"), random)
    quote = tokens[at][:1] if tokens[at][:1] in (b'"', b"'") else b'"'
    content = random.choice((*_WORDS, *_NUMBERS))
    return [*tokens[:at], quote + content + quote, *tokens[at + 1 :]]


def _without(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    begin, end = _span(tokens, random)
    return tokens[:begin] + tokens[end:]


def _repeated(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    begin, end = _span(tokens, random)
    size = max(sum(map(len, tokens[begin:end])), 1)
    copies = min(random.choice((2, 3, 30, MOST_COPIES)), LARGEST // size + 1)
    return tokens[:begin] + tokens[begin:end] * copies + tokens[end:]


def _numbered(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    """A span repeated with its words made different, as many names as a file can hold."""
    begin, end = _span(tokens, random)
    size = sum(map(len, tokens[begin:end])) + 4
    copies = min(random.choice((3, 30, MOST_COPIES)), LARGEST // size + 1)
    span = [(token, _WORD.match(token) is not None) for token in tokens[begin:end]]
    copied = [
        token + digits if is_word else token
        for digits in (b"%d" % number for number in range(copies))
        for token, is_word in span
    ]
    return tokens[:begin] + copied + tokens[end:]


def _nested(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    begin, end = _span(tokens, random)
    opening, closing = random.choice(_BRACKETS)
    depth = random.choice((2, 40, 200, DEEPEST))
    ends = random.choice((closing * depth, closing * depth, b""))
    return [*tokens[:begin], opening * depth, *tokens[begin:end], ends, *tokens[end:]]


def _swapped(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    (begin, end), (first, last) = sorted((_span(tokens, random), _span(tokens, random)))
    end = min(end, first)
    return [*tokens[:begin], *tokens[first:last], *tokens[end:first], *tokens[begin:end],
            *tokens[last:]]  # fmt: skip


def _spliced(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    """Lines of another seed between those of this one."""
    lines = random.choice(seeds).splitlines(keepends=True) or [b""]
    begin = random.randrange(len(lines))
    at = random.randrange(len(tokens))
    return [*tokens[:at], b"\n", *lines[begin : begin + random.randint(1, 8)], *tokens[at:]]


def _encoded(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    """The whole in another encoding, or with other ends of lines."""
    text = b"".join(tokens).decode("utf-8", errors="replace")
    name = random.choice(("utf-16", "utf-16-le", "utf-8-sig", "utf-32", "latin-1", "cp037"))
    return [random.choice((text.encode(name, errors="replace"), text.replace("\n", "\r").encode()))]


def _flipped(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    data = bytearray(b"".join(tokens))
    for _ in range(random.choice((1, 1, 4, 30))):
        data[_place(len(data), random)] ^= 1 << random.randrange(8)
    return list_of_bytes(bytes(data))


def _field(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    """A number of a header replaced by one that readers do not expect."""
    data = bytearray(b"".join(tokens))
    at = _place(len(data), random)
    field = random.choice(_FIELDS)[: random.choice((1, 2, 4))]
    data[at : at + len(field)] = field
    return list_of_bytes(bytes(data))


def _cut(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    return tokens[: random.randrange(len(tokens) + 1)]


def _foreign(tokens: Tokens, seeds: Sequence[bytes], random: Random) -> Tokens:
    at = random.randrange(len(tokens))
    return [*tokens[:at], random.randbytes(random.choice((1, 4, 300))), *tokens[at:]]


def _place(length: int, random: Random) -> int:
    """Where a byte is changed: every second time near the beginning, where formats have headers."""
    return random.randrange(min(length, 128) if random.random() < 0.5 else length)


_TEXT: tuple[Change, ...] = (
    _number, _number, _word, _word, _other_word, _other_word, _in_quotes, _without, _repeated,
    _numbered, _nested, _swapped, _spliced, _encoded, _flipped, _cut, _foreign,
)  # fmt: skip
_BINARY: tuple[Change, ...] = (
    _flipped, _flipped, _field, _field, _cut, _without, _repeated, _swapped, _foreign,
)  # fmt: skip
