#!/usr/bin/env python3
"""Refuse circles between modules: each import of theirs, for types only as well, leads one way.

import-linter's `acyclic_siblings` asks the same of packages, which is more than is needed here.
"""

from __future__ import annotations

import sys
from pathlib import Path

import grimp

APPS = Path(__file__).parents[1] / "apps"


def circles(graph: grimp.ImportGraph) -> list[set[str]]:
    """The modules of each circle: those that lead back to themselves, with all on the way."""
    left = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    while ends := {module for module, imported in left.items() if not imported & left.keys()}:
        left = {module: imported for module, imported in left.items() if module not in ends}
    found: list[set[str]] = []
    for module in sorted(left):
        after = graph.find_upstream_modules(module)
        around = {module} | {
            other for other in after if module in graph.find_upstream_modules(other)
        }
        if len(around) > 1 and around not in found:
            found.append(around)
    return found


def main() -> int:
    """Print the circles; exit status 1 when there are any."""
    sys.path.append(str(APPS))
    found = circles(graph := grimp.build_graph("hri", "benchmarks", "companion"))
    for circle in found:
        print("circle of imports - move what they share into a module below all of them:")
        for module in sorted(circle):
            for other in sorted(graph.find_modules_directly_imported_by(module) & circle):
                print(f"  {module} imports {other}")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
