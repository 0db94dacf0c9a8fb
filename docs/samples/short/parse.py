"""Find out what a sentence means: its rule and its tags."""

from hri.speech import load_grammar, parse

meaning = parse(load_grammar("companion"), "go forward two meters")
print(meaning.rule, dict(meaning.tags))
