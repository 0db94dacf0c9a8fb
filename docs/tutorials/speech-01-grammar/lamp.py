"""What a grammar makes of sentences, without a sound."""

from pathlib import Path

from hri.speech import load_grammar
from hri.speech.grammar.matching import parse

SENTENCES = (
    "please switch on the lamp",
    "Make it blue!",
    "dim the light by twenty five percent",
    "switch the lamp",
)


def main() -> None:
    """Print what each sentence means."""
    lamp = load_grammar(Path(__file__).with_name("lamp.jsgf"))
    for sentence in SENTENCES:
        found = parse(lamp, sentence)
        if found is None:
            print(f"{sentence!r}: not understood")
        else:
            print(f"{sentence!r}: {found.rule} {dict(found.tags)}")


if __name__ == "__main__":
    main()
