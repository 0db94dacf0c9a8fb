"""Learn how sounds are spelled: what `hri/speech/pronunciation/sound_to_letter.npz` holds.

Letters and phones of each word are aligned by expectation maximization, in chunks of one or two
phones with one to four letters; over the chunks goes an n-gram with Witten-Bell smoothing (M.
Bisani and H. Ney, "Joint-sequence models for grapheme-to-phoneme conversion", Speech Communication
50, 2008). Beside it stands how likely phones follow each other in first names, a trigram.

Words: the CMU dictionary and a list of first names, which counts more, as `Lexicon` says them.

    python benchmarks/research/sound_to_letter/train.py grammars/first_names.txt
"""

from __future__ import annotations

import math
import random
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from hri.core.errors import HriError
from hri.speech.pronunciation.dictionary import DICTIONARY
from hri.speech.pronunciation.lexicon import load_lexicon, without_accents
from hri.speech.pronunciation.phones import PHONES, Phones, without_stress
from hri.speech.pronunciation.sound_to_letter import MODEL, ORDER, SCALE

LETTERS, SOUNDS = range(1, 5), range(1, 3)
"""How many of each a chunk has."""
SAMPLE, ROUNDS = 12_000, 5
"""Words and rounds of the expectation maximization."""
RAREST = 15
"""Times that a chunk is there, at least."""
LEAST = {1: 1, 2: 2, 3: 4, 4: 5}
"""How often chunks that are stored follow each other, by their number."""
NAMES = 4
"""How often a name is counted."""
SHARE = 0.02
"""Of the phone trigram, what goes to phones of any kind."""
_KEEPS = -1e30

Word = tuple[str, Phones]
Chunk = tuple[str, Phones]


def words(names: Sequence[str]) -> tuple[list[Word], list[Word]]:
    """Words of the dictionary, and names, all in plain small letters."""
    plain = [(word, phones) for word, phones in _dictionary() if word.isalpha()]
    lexicon, named = load_lexicon(), []
    for name in names:
        try:
            found = lexicon.pronunciations(name)
        except HriError:
            continue
        letters = "".join(filter(str.isalpha, without_accents(name)))
        if letters.isascii():
            named.append((letters, found[0]))
    return plain, named


def _dictionary() -> Iterator[Word]:
    for line in DICTIONARY.read_text(encoding="utf-8").splitlines():
        word, *phones = line.split()
        yield word.partition("(")[0], without_stress(tuple(phones))


def chunks(word: Word) -> Iterator[tuple[int, int, int, int, Chunk]]:
    """All that may stand together: from and to which letter and phone."""
    letters, phones = word
    for sound in range(len(phones)):
        for letter in range(len(letters)):
            for more in SOUNDS:
                for wide in LETTERS:
                    if sound + more <= len(phones) and letter + wide <= len(letters):
                        if more == 2 and wide > 3:
                            continue
                        chunk = letters[letter : letter + wide], phones[sound : sound + more]
                        yield letter, sound, letter + wide, sound + more, chunk


def learned(sample: Sequence[Word]) -> Mapping[Chunk, float]:
    """How likely each chunk is, natural log."""
    odds: Mapping[Chunk, float] = {}
    for _ in range(ROUNDS):
        counts: dict[Chunk, float] = defaultdict(float)
        for word in sample:
            _count(word, odds, counts)
        total = sum(counts.values())
        odds = {chunk: math.log(count / total) for chunk, count in counts.items() if count > 0.3}
    return odds


def _first_odds(chunk: Chunk) -> float:
    letters, phones = chunk
    return -1.0 - 1.5 * (len(letters) - 1) - 2.5 * (len(phones) - 1)


def _count(word: Word, odds: Mapping[Chunk, float], counts: dict[Chunk, float]) -> None:
    steps = []
    for letter, sound, to_letter, to_sound, chunk in chunks(word):
        odd = odds.get(chunk, _KEEPS) if odds else _first_odds(chunk)
        if odd > _KEEPS:
            steps.append(((letter, sound), (to_letter, to_sound), chunk, math.exp(odd)))
    before: dict[tuple[int, int], float] = defaultdict(float, {(0, 0): 1.0})
    for here, there, _, chance in steps:
        before[there] += before[here] * chance
    end = len(word[0]), len(word[1])
    if not before[end]:
        return
    after: dict[tuple[int, int], float] = defaultdict(float, {end: 1.0})
    for here, there, _, chance in reversed(steps):
        after[here] += chance * after[there]
    for here, there, chunk, chance in steps:
        counts[chunk] += before[here] * chance * after[there] / before[end]


def aligned(word: Word, odds: Mapping[Chunk, float]) -> list[Chunk]:
    """The likeliest chunks of a word; none where there are none."""
    best: dict[tuple[int, int], tuple[float, tuple[int, int], Chunk | None]] = {
        (0, 0): (0.0, (0, 0), None)
    }
    for letter, sound, to_letter, to_sound, chunk in chunks(word):
        if (here := best.get((letter, sound))) and chunk in odds:
            score, there = here[0] + odds[chunk], (to_letter, to_sound)
            if there not in best or score > best[there][0]:
                best[there] = score, (letter, sound), chunk
    place, found = (len(word[0]), len(word[1])), []
    if place not in best:
        return []
    while place != (0, 0):
        _, place, one = best[place]
        assert one is not None
        found.append(one)
    return found[::-1]


def grams(
    sequences: Sequence[tuple[Sequence[int], int]],
) -> dict[tuple[int, ...], tuple[float, float]]:
    """Of chunks after each other: log of how likely the last one is, and of what is left to
    shorter ones behind them.
    """
    counts: list[Counter[tuple[int, ...]]] = [Counter() for _ in range(ORDER + 1)]
    for sequence, times in sequences:
        padded = (0, *sequence, 0)
        for size in range(1, ORDER + 1):
            for end in range(max(size, 2), len(padded) + 1):
                counts[size][padded[end - size : end]] += times
    kept = [{g: n for g, n in counts[s].items() if n >= LEAST[s]} for s in range(1, ORDER + 1)]
    total = sum(kept[0].values())
    chance = {gram: count / total for gram, count in kept[0].items()}
    left: dict[tuple[int, ...], float] = {}
    for size in range(2, ORDER + 1):
        sums: Counter[tuple[int, ...]] = Counter()
        kinds: Counter[tuple[int, ...]] = Counter()
        for gram, count in counts[size].items():
            sums[gram[:-1]] += count
            kinds[gram[:-1]] += 1
        spread: dict[tuple[int, ...], float] = defaultdict(float)
        shorter: dict[tuple[int, ...], float] = defaultdict(float)
        for gram, count in kept[size - 1].items():
            before = gram[:-1]
            share = kinds[before] / (kinds[before] + sums[before])
            chance[gram] = (1 - share) * count / sums[before] + share * chance.get(gram[1:], 1e-7)
            spread[before] += chance[gram]
            shorter[before] += chance.get(gram[1:], 1e-7)
        for before in spread:
            left[before] = max(1 - spread[before], 1e-4) / max(1 - shorter[before], 1e-4)
    return {
        gram: (math.log(chance[gram]), math.log(left.get(gram, 1.0))) for gram in sorted(chance)
    }


def trigram(named: Sequence[Word], plain: Sequence[Word]) -> np.ndarray:
    """[before the last, last, phone] Natural log, 0 being the beginning and the end."""
    size = len(PHONES) + 1
    index = {phone: number + 1 for number, phone in enumerate(PHONES)}
    counts = np.zeros((size, size, size))
    for sequence, times in [(named, 10.0), (plain, 0.3)]:
        for _, phones in sequence:
            padded = [0, 0, *(index[phone] for phone in phones), 0]
            for one, two, three in zip(padded, padded[1:], padded[2:], strict=False):
                counts[one, two, three] += times
    single = counts.sum((0, 1)) + 1.0
    chance = single / single.sum()
    pairs = counts.sum(0)
    kinds = (pairs > 0).sum(1, keepdims=True)
    two = (pairs + 10 * kinds * chance) / (pairs.sum(1, keepdims=True) + 10 * kinds + 1e-9)
    two[kinds[:, 0] == 0] = chance
    kinds = (counts > 0).sum(2, keepdims=True)
    three = (counts + 10 * kinds * two) / (counts.sum(2, keepdims=True) + 10 * kinds + 1e-9)
    three = np.where(kinds == 0, two, three)
    return np.log((1 - SHARE) * three + SHARE / size)


def main() -> None:
    """Train and store."""
    lines = Path(sys.argv[1]).read_text(encoding="utf-8").lower().splitlines()
    plain, named = words([line for line in lines if line and not line.startswith("#")])
    chance = random.Random(1)
    odds = learned([*chance.sample(plain, SAMPLE), *named])
    sequences = [(aligned(word, odds), 1) for word in plain]
    sequences += [(aligned(word, odds), NAMES) for word in named]
    times = Counter(chunk for sequence, _ in sequences for chunk in sequence)
    known = sorted(chunk for chunk, count in times.items() if count >= RAREST)
    number = {chunk: index + 1 for index, chunk in enumerate(known)}
    numbered = [
        ([number[chunk] for chunk in sequence], count)
        for sequence, count in sequences
        if sequence and all(chunk in number for chunk in sequence)
    ]
    found = grams(numbered)
    table = np.zeros((len(found), ORDER), np.uint16)
    for row, gram in zip(table, found, strict=True):
        row[: len(gram)] = gram
    scores = np.array(list(found.values()))
    np.savez_compressed(
        MODEL,
        chunks=np.array([f"{letters} {' '.join(phones)}" for letters, phones in known]),
        sizes=np.array([len(gram) for gram in found], np.uint8),
        grams=table,
        scores=np.clip(np.round(-scores * SCALE), -255, 255).astype(np.int16),
        phones=np.clip(np.round(-trigram(named, plain) * SCALE), 0, 255).astype(np.uint8),
    )
    print(len(known), "chunks,", len(found), "grams,", MODEL.stat().st_size, "bytes")


if __name__ == "__main__":
    main()
