"""What was heard of each clip, kept in files, so that other judgments can be tried in seconds.

`SET-LEVEL.jsonl` has a line for each clip: what was said and meant, and its pieces of speech.
`SET-LEVEL.npz` has the arrays that these name: of "12.0" the network's `12.0.posteriors`, natural
logs [frames, 40] of the part that sounds, and `12.0.samples`, all of the piece, 16 kHz.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.speech.slot_clips import GRAMMARS, Kind, Saying
from hri.bench.speech.samples import Clip
from hri.core.signals import Samples
from hri.hal.recognizer import Segment
from hri.speech.recognizers.ctc.conformer import load_network
from hri.speech.recognizers.ctc.hesitations import hesitations
from hri.speech.recognizers.ctc.loudness import leveled, noise_of, sounding
from hri.speech.understanding import Heard

_TIMES = ("start", "end", "number", "quiet", "noise_db", "level_db")
"""Of a segment, beside its sound."""


@dataclass(frozen=True, eq=False)
class Listened:
    """A clip, the pieces of speech in it, and what was made of each."""

    saying: Saying
    pieces: Sequence[Segment]
    heard: Sequence[Heard]
    again: Sequence[Segment] = ()
    """Pieces of the same order in other noise."""
    heard_again: Sequence[Heard] = ()


class Dump:
    """Writes what was heard of the clips of one set at one level of noise."""

    def __init__(self, folder: Path, name: str) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self._file = folder / name
        self._rows: list[str] = []
        self._arrays: dict[str, NDArray[Any]] = {}

    def add(self, one: Listened) -> None:
        """Take a clip."""
        saying, number = one.saying, len(self._rows)
        row = {
            "number": number,
            "set": saying.set,
            "kind": saying.kind,
            "condition": saying.condition,
            "voice": saying.clip.voice,
            "text": saying.clip.sentence,
            "clip": saying.clip.name,
            "meant": saying.meant,
            "same": saying.same,
            "pieces": [self._piece(f"{number}.{n}", p) for n, p in enumerate(one.pieces)],
            "again": [self._piece(f"{number}.again.{n}", p) for n, p in enumerate(one.again)],
            "heard": [_told(heard) for heard in one.heard],
        }
        self._rows.append(json.dumps(row))

    def _piece(self, key: str, segment: Segment) -> dict[str, Any]:
        assert segment.samples is not None
        sound = leveled(segment.samples)
        part = sounding(sound)
        posteriors = load_network("").posteriors(sound[part])
        self._arrays[f"{key}.posteriors"] = posteriors.astype(np.float16)
        self._arrays[f"{key}.samples"] = segment.samples
        parts = hesitations(sound[part], posteriors)
        return {
            "key": key,
            "noise": noise_of(sound),
            "hesitations": [[part.start, part.stop] for part in parts],
            "segment": {name: getattr(segment, name) for name in _TIMES},
        }

    def write(self) -> None:
        """Write both files."""
        self._file.with_name(f"{self._file.name}.jsonl").write_text("\n".join(self._rows) + "\n")
        with self._file.with_name(f"{self._file.name}.npz").open("wb") as file:
            np.savez(file, allow_pickle=False, **self._arrays)


def dumped(folder: Path, set_: str, level: str) -> Iterator[Listened]:
    """What `Dump` wrote, without what was heard. Raises OSError when there is none."""
    name = folder / file_name(set_, level)
    with np.load(name.with_name(f"{name.name}.npz")) as arrays:
        for line in name.with_name(f"{name.name}.jsonl").read_text().splitlines():
            row = json.loads(line)
            saying = _saying(row)
            pieces, again = (
                [_segment(piece, arrays) for piece in row[key]] for key in ("pieces", "again")
            )
            if row["kind"] == "orders":
                saying = replace(saying, other=saying.clip)
            yield Listened(saying, pieces, (), again)


def file_name(set_: str, level: str) -> str:
    """Of the files of a set at a level of noise, without what is behind the dot."""
    return f"{set_}-{level.replace(' ', '')}"


def _saying(row: Mapping[str, Any]) -> Saying:
    kind: Kind = row["kind"]
    assert row["set"] in GRAMMARS
    nothing: Samples = np.zeros(0, np.int16)
    clip = Clip(row["clip"], nothing, row["text"], voice=row["voice"])
    return Saying(clip, row["set"], kind, row["condition"], row["meant"], row["same"])


def _segment(piece: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> Segment:
    return Segment(**piece["segment"], samples=arrays[f"{piece['key']}.samples"])


def _told(heard: Heard) -> dict[str, Any]:
    told = asdict(heard)
    return {key: told[key] for key in _TOLD if key in told}


_TOLD = ("text", "rule", "tags", "confidence", "alternatives", "reason", "detail", "sure", "unsure")
