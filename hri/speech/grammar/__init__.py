"""Grammars: what can be heard, and what it means."""

from hri.speech.grammar.rules import Grammar, Rule, load_grammar, read_grammar

__all__ = ["Grammar", "Rule", "load_grammar", "read_grammar"]
