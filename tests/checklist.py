"""Which test proves which row of docs/checklist.md; a plugin of pytest.

A test names its rows with the marker `proves`. `pytest --checklist` writes the document. A run of
the whole suite fails when a row has no test, or the document names other tests.
"""

from __future__ import annotations

import tomllib
from collections import defaultdict
from pathlib import Path

import pytest

ROWS = Path(__file__).with_name("checklist.toml")
DOCUMENT = Path(__file__).parents[1] / "docs" / "checklist.md"
HEAD = """\
# What is proven

The platform is the one of 2003, rebuilt. Each row is a thing that it could do; beside it are the
tests that show ours doing it. `make checklist` writes this page from the markers in the tests.
"""


class Checklist:
    """Collects what the tests of a run prove."""

    def __init__(self, is_writing: bool) -> None:
        self.is_writing = is_writing
        self.tables = tomllib.loads(ROWS.read_text())
        self.rows = {id for table in self.tables.values() for id in table if id != "title"}
        self.proofs: dict[str, set[str]] = defaultdict(set)
        self.broken: dict[str, set[str]] = defaultdict(set)
        self.of_test: dict[str, set[str]] = {}
        self.is_whole = False
        self.complaints: list[str] = []

    def pytest_collection_modifyitems(
        self, config: pytest.Config, items: list[pytest.Item]
    ) -> None:
        option = config.option
        paths = [str(word).partition("::")[0] for word in config.invocation_params.args]
        is_chosen = option.keyword or option.markexpr or option.lf or option.collectonly
        self.is_whole = not is_chosen and not any(Path(path).exists() for path in paths)
        for item in items:
            rows = {row for mark in item.iter_markers("proves") for row in mark.args}
            if unknown := rows - self.rows:
                raise pytest.UsageError(f"{item.nodeid} proves unknown rows {sorted(unknown)}")
            test = item.nodeid.partition("[")[0]
            self.of_test.setdefault(item.nodeid, set()).update(rows)
            for row in rows:
                self.proofs[row].add(test)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        if report.failed:
            for row in self.of_test.get(report.nodeid, ()):
                self.broken[row].add(report.nodeid.partition("[")[0])

    def pytest_sessionfinish(self, session: pytest.Session, exitstatus: int) -> None:
        if self.is_writing:
            DOCUMENT.write_text(self.document())
        elif self.is_whole and exitstatus == pytest.ExitCode.OK:
            self._complain()
            if self.complaints:
                session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        for complaint in self.complaints:
            terminalreporter.write_line(f"docs/checklist.md: {complaint}", red=True)

    def _complain(self) -> None:
        for table, rows in self.tables.items():
            missing = [id for id in rows if id != "title" and not self.proofs[id]]
            if missing and table != "later":
                self.complaints.append(f"no test proves {', '.join(missing)}")
        if not DOCUMENT.is_file() or DOCUMENT.read_text() != self.document():
            self.complaints.append("not up to date - run `make checklist`")

    def document(self) -> str:
        """The page, in Markdown."""
        parts = [HEAD]
        for table in self.tables.values():
            lines = [f"## {table['title']}", "", "| row | what | proven by |", "|---|---|---|"]
            for id, what in table.items():
                if id != "title":
                    lines.append(f"| {id} | {what} | {self._proof(id)} |")
            parts.append("\n".join(lines) + "\n")
        return "\n".join(parts)

    def _proof(self, id: str) -> str:
        working = self.proofs[id] - self.broken[id]
        if not working:
            return "**nothing yet**"
        return "<br>".join(sorted(f"`{test.removeprefix('tests/')}`" for test in working))
