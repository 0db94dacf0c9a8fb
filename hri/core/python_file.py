"""Python files of the user, imported by their path."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

from hri.core.errors import AuthoringError, HriError, Place, did_you_mean


def load_module(name: str, path: Path, search: list[str] | None = None) -> ModuleType:
    """The file as a module of that name; `search` are the folders of a package.

    While it is imported it finds the files beside it.
    Raises HriError when it cannot be read or fails, AuthoringError with the place of a mistake in
    its Python.
    """
    spec = importlib.util.spec_from_file_location(name, path, submodule_search_locations=search)
    if spec is None or spec.loader is None or not path.is_file():
        raise HriError(f"{path}: no Python file is there - check the path")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    sys.path.append(str(path.parent))
    try:
        with _told(path):
            spec.loader.exec_module(module)
    except BaseException:
        # Half a module: the next who asks for it must not find it.
        sys.modules.pop(name, None)
        raise
    finally:
        sys.path.remove(str(path.parent))
    return module


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Make one clear error of whatever a file raises."""
    try:
        yield
    except SyntaxError as error:
        place = Place(Path(error.filename or path), error.lineno or 1, error.offset or 1)
        raise AuthoringError(place, error.msg, "fix the Python here") from error
    except ImportError as error:
        raise HriError(f"{path}: {error} - install it, or fix the import") from error
    except SystemExit as error:
        what = "it ends the program while it is imported"
        raise HriError(f"{path}: {what} - leave that to the code that runs it") from error
    except Exception as error:
        raise HriError(f"{path}: {type(error).__name__}: {error} - fix this file") from error


OF_FILE = "hri_file_"
"""Begins the name of a module that `load_class` makes of a file; its path follows."""


def class_named(module: str, name: str) -> Any:
    """A class of a module, or of the file that such a module was made of in another process.

    Raises what importing raises, and `load_class`.
    """
    if module.startswith(OF_FILE):
        return load_class(Path(module.removeprefix(OF_FILE)), name)
    return getattr(importlib.import_module(module), name)


def load_class(path: Path, name: str) -> Any:
    """A class of a file; each file is run once: twice would make two classes of each.

    Raises what `load_module` raises, HriError when it has no such class.
    """
    path = path.resolve()
    called = f"{OF_FILE}{path}"
    module = sys.modules.get(called) or load_module(called, path)
    found = vars(module).get(name)
    if not isinstance(found, type):
        classes = [key for key, value in vars(module).items() if isinstance(value, type)]
        own = [key for key in classes if vars(module)[key].__module__ == module.__name__]
        raise HriError(f'{path}: no class "{name}" - {did_you_mean(name, own or classes)}')
    return found
