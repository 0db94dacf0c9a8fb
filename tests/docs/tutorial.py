"""A tutorial of docs/tutorials: its page, its programs, and what the page says they print.

On a page a block ```python or ```xml is an excerpt of a file, ```text is what a program prints. In
the latter `…` stands for what varies within a line, and a line of its own for any count of lines.
"""

from __future__ import annotations

import re
import textwrap
from types import ModuleType

from hri.core import paths
from hri.core.python_file import load_module

FOLDER = paths.house() / "docs" / "tutorials"


class Tutorial:
    """One folder."""

    def __init__(self, name: str) -> None:
        self.folder = FOLDER / name
        self.page = (self.folder / "README.md").read_text()

    def load(self, program: str) -> ModuleType:
        """A program as a module, freshly imported."""
        path = self.folder / program
        return load_module(f"{self.folder.name}.{path.stem}".replace("-", "_"), path)

    def blocks(self, language: str) -> list[str]:
        """The blocks of the page in that language."""
        return re.findall(rf"^```{language}\n(.*?)^```", self.page, re.DOTALL | re.MULTILINE)

    def prints(self, printed: str, block: int = 0) -> bool:
        """Whether the page shows exactly this as what a program prints."""
        shown = re.escape(self.blocks("text")[block])
        pattern = re.sub(r"^…\\\n", "(?:.*\n)*", shown, flags=re.MULTILINE).replace("…", ".*")
        return re.fullmatch(pattern, printed) is not None

    def strangers(self, language: str = "python") -> list[str]:
        """Excerpts that stand in no file of the folder, and in none that the page links to."""
        suffix = {"python": "py", "xml": "xml"}[language]
        linked = re.findall(rf"\]\(([^)]+\.{suffix})\)", self.page)
        files = {
            *self.folder.rglob(f"*.{suffix}"),
            *((self.folder / link).resolve() for link in linked),
        }
        sources = [file.read_text() for file in files]
        return [
            excerpt
            for excerpt in self.blocks(language)
            if not any(
                textwrap.indent(excerpt, " " * depth) in source
                for source in sources
                for depth in range(0, 13, 2)
            )
        ]
