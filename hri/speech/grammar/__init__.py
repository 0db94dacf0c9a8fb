"""Grammars: the sentences that can be heard, and their meanings."""

from hri.speech.grammar.grammar import Grammar
from hri.speech.grammar.loader import load_grammar, read_grammar
from hri.speech.grammar.matching import Parse, parse
from hri.speech.grammar.rules import Rule

__all__ = ["Grammar", "Parse", "Rule", "load_grammar", "parse", "read_grammar"]
