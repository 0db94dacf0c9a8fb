"""The body of a request as JSON, and in plain words what is wrong with it."""

from __future__ import annotations

import json
from typing import Any

from hri.core.errors import HriError
from hri.core.reading import parse_json


def read_body(body: bytes) -> Any:
    """What a body says. Raises HriError for one that is not JSON, or beyond its limits."""
    try:
        return parse_json(body)
    except UnicodeDecodeError as error:
        raise HriError(f"the body is not UTF-8 at byte {error.start} - send UTF-8") from error
    except json.JSONDecodeError as error:
        where = f"line {error.lineno}, column {error.colno}"
        raise HriError(f"the body is not JSON: {error.msg} ({where}) - correct it") from error
    except ValueError as error:
        raise HriError(f"the body is too much: {error} - send less") from error
