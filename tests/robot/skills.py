"""What the tests of skills share: an app that takes skills, and skills to plug in."""

from pathlib import Path

GRAMMAR = "#JSGF V1.0;\ngrammar {name};\npublic <{rule}> = {words};\n"


def skill(folder: Path, name: str, **files: str) -> Path:
    """A skill of these files; "replies" is `replies.toml`, and so on."""
    place = folder / "skills" / name
    place.mkdir(parents=True)
    files = {"skill": 'about = "A skill."\n', **files}
    suffixes = {"grammar": ".jsgf", "tasks": ".py", "page": ".md"}
    names = {"page": "README"}
    for file, text in files.items():
        (place / (names.get(file, file) + suffixes.get(file, ".toml"))).write_text(text)
    return place


def with_rule(folder: Path, name: str, rule: str, words: str, reply: str, **more: str) -> Path:
    """A skill with one command."""
    grammar = GRAMMAR.format(name=name, rule=rule, words=words)
    return skill(folder, name, grammar=grammar, replies=f"[reply.{rule}]\n{reply}\n", **more)
