"""Clips of noise, and what was heard in them."""

import numpy as np

from hri.bench.speech.flite_voices import RATE
from hri.bench.speech.listening import Heard
from hri.bench.speech.samples import Clip


def piece(words, tags=(), is_accepted=True, rule="", latency_s=0.01):
    return Heard(is_accepted, words, rule, dict(tags), 0.9, "", latency_s)


def noise(name, sentence="", slots=(), seconds=0.2):
    chance = np.random.default_rng(len(name))
    samples = chance.normal(0, 1000, round(seconds * RATE)).astype(np.int16)
    return Clip(name, samples, sentence, dict(slots), "slt" if sentence else "")
