"""What the network learned about the talk of other people, laid over its weights.

As it comes, the network falls silent as soon as others talk in the background: 12 dB below the
speaker they cost it half of all sentences. So it was taught by itself: what it hears in clean
speech is what it should hear when the same speech lies under noise (knowledge distillation:
G. Hinton, O. Vinyals, J. Dean, "Distilling the knowledge in a neural network", 2015), and from the
phones that were said (A. Graves et al., "Connectionist temporal classification", 2006). The change
of a matrix is the product of two narrow ones (E. Hu et al., "LoRA", 2021), that of anything
smaller is written out; `adaptation.npz` beside this file holds them as 16-bit floats. How to make
it again, and from whose speech: benchmarks/adaptation/README.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from hri.core.errors import HriError
from hri.core.fetch.archive import BROKEN, check_members
from hri.core.reading import opened
from hri.speech.recognizers.ctc.weights import Tensor

FILE = Path(__file__).with_name("adaptation.npz")
LARGEST = 20_000_000
"""Bytes of the file, and of all that is packed in it."""
TALL, WIDE = ".tall", ".wide"
"""Ends of the names of the two factors of a matrix's change."""


def adapted(tensors: Mapping[str, Tensor], file: Path = FILE) -> dict[str, Tensor]:
    """The tensors with the changes of a file added, those it does not name as they are.

    Raises HriError when the file does not belong to this network or cannot be read.
    """
    result = dict(tensors)
    try:
        with opened(file, "adaptation", LARGEST) as raw, np.load(raw) as changes:
            check_members(changes.zip, LARGEST)
            for key in changes.files:
                if key.endswith(WIDE):
                    continue
                name = key.removesuffix(TALL)
                change = changes[key].astype(np.float32)
                if key.endswith(TALL):
                    change = change @ changes[name + WIDE].astype(np.float32)
                result[name] = tensors[name] + change.reshape(tensors[name].shape)
    except (OSError, KeyError, TypeError, AttributeError, MemoryError, *BROKEN) as error:
        raise HriError(f"{file}: no adaptation of this network: {error} - reinstall hri") from error
    return result
