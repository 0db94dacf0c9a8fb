"""The dictionaries of the natural voice in a fifth of the memory: hibari reads them into dicts."""

from __future__ import annotations

import ctypes
import gc
import marshal
import sys
from collections.abc import Mapping
from itertools import accumulate
from typing import Any

import numpy as np
from hibari import g2p


class Packed:
    """A dictionary of JSON values, packed into two blocks of bytes; `marshal` is the fastest."""

    def __init__(self, entries: Mapping[str, Any]) -> None:
        keys = sorted(entries)
        values = [marshal.dumps(entries[key]) for key in keys]
        self._keys = np.array([key.encode() for key in keys])
        self._values = b"".join(values)
        self._ends = np.fromiter(accumulate(map(len, values), initial=0), np.uint32)

    def get(self, key: str) -> Any:
        """What stands under a key, or None."""
        wanted = key.encode("utf-8", "replace")
        place = int(self._keys.searchsorted(wanted))
        if place == len(self._keys) or self._keys[place] != wanted:
            return None
        begin, end = self._ends[place : place + 2]
        return marshal.loads(self._values[begin:end])


class Pronouncer(g2p.G2P):  # type: ignore[misc]
    """Makes symbols of words as hibari does."""

    def __init__(self) -> None:
        # In turns, the largest first: the next one fits into the memory that it left.
        tagger = _read("tagger.json.gz")
        self.tagger = g2p.Tagger({**tagger, "weights": Packed(tagger.pop("weights"))})
        gold, silver = (Packed(_read(f"lexicon_us_{kind}.json.gz")) for kind in ("gold", "silver"))
        self.lexicon = g2p.Lexicon(gold, silver)
        self.tokenizer = g2p.Tokenizer(_read("tokenizer_exceptions.json"))
        self._oov, self.unk, self.british = None, "", False
        _give_back()


def _read(name: str) -> dict[str, Any]:
    entries: dict[str, Any] = g2p._load_json(name)
    return entries


def _give_back() -> None:
    """Return what is free to the system: of all C libraries, GNU's keeps 20 MB of it."""
    gc.collect()
    if sys.platform == "linux":
        getattr(ctypes.CDLL(None), "malloc_trim", lambda pad: None)(0)
