"""`make docs` writes the reference of all public classes."""

import importlib
import inspect
import pkgutil
from pathlib import Path

import pdoc
import pytest

import hri.behavior
import hri.hal


@pytest.mark.proves("P05")
@pytest.mark.parametrize("package", [hri.hal, hri.behavior])
def test_the_reference_lists_every_class_of_a_layer(package, tmp_path):
    pdoc.pdoc(package.__name__, output_directory=tmp_path)
    files = Path(tmp_path).rglob("*.html")
    pages = {".".join(f.relative_to(tmp_path).with_suffix("").parts): f.read_text() for f in files}
    for found in pkgutil.iter_modules(package.__path__, f"{package.__name__}."):
        if found.ispkg:
            continue
        module = importlib.import_module(found.name)
        for name, cls in inspect.getmembers(module, inspect.isclass):
            if cls.__module__ == found.name and not name.startswith("_"):
                assert f'id="{name}"' in pages[found.name], name
