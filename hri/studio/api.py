"""The interface over HTTP as an OpenAPI document: a script can do all that the page does."""

from __future__ import annotations

from typing import Any

from hri.studio.commands import COMMANDS, FARTHEST, Argument, Command
from hri.studio.composer.routes import ROOT, ROUTES, Route
from hri.studio.type_export import schemas

_KINDS: dict[type, dict[str, Any]] = {
    str: {"type": "string", "minLength": 1},
    float: {"type": "number", "minimum": -FARTHEST, "maximum": FARTHEST},
    bool: {"type": "boolean"},
}
_ANSWERS = {
    "200": {"description": "done"},
    "400": {"description": "the arguments are wrong; `error` says how"},
    "401": {"description": "no cookie and no token"},
    "409": {
        "description": "the robot refuses, or has not answered yet; `error` says why. Where "
        "`will_be_done` is true, as for a stop, it is done as soon as the robot's loop goes on."
    },
}
_FOLDER = {"folder": "its folder, as /recordings names it, or a path"}
_RECORDINGS: dict[str, tuple[str, dict[str, str]]] = {
    "": ("the recordings that are known, the newest first", {}),
    "/about": (
        "a recording: where log, film and sound begin and end, in seconds of the log's `t`; "
        "`wrong` says what cannot be shown",
        _FOLDER,
    ),
    "/events": (
        "about a megabyte of its events; `next` is where the next part begins, `is_all` whether "
        "there is none now, `skipped` how many lines are not events",
        {**_FOLDER, "from": "the byte of the log to begin at, 0 unless given"},
    ),
    "/face": ("a JPEG of the face", {**_FOLDER, "t": "seconds of the log's `t`"}),
    "/sound": (
        "its sound as a WAV file, or the part that a header `Range` names",
        {**_FOLDER, "bytes": "where a file that still grows is taken to end; its end unless given"},
    ),
}
_FOUND = {
    **{code: _ANSWERS[code] for code in ("200", "400", "401")},
    "404": {"description": "there is no such recording, or it is damaged; `error` says which"},
}


def openapi() -> dict[str, Any]:
    """The document, OpenAPI 3.1."""
    paths: dict[str, Any] = {f"/api/v1/{name}": _path(name, c) for name, c in COMMANDS.items()}
    paths["/api/v1/state"] = _get("state", "the newest value of each topic", "State")
    paths["/api/v1/live"] = _get(
        "live",
        "a WebSocket. It sends text, each a LiveMessage, and pictures: a byte (2 for the face, 3 "
        "for the camera), the time (big-endian double, seconds), and a JPEG. It takes "
        '{"pictures": ["face", "camera"], "networks": ["moving"], "thumbnails": '
        '["seeing/camera.image"], "reasons": ["moving/gate.velocity"]}: the pictures, the networks '
        "whose values, the outputs whose small pictures, and the ports whose reasons are wanted. "
        "It also takes "
        '{"command": "stop", "number": 1, "press": "a"}, which needs no further connection; the '
        "Answer has the number.",
    )
    paths |= {f"/api/v1/recordings{name}": _reading(name) for name in _RECORDINGS}
    for route in ROUTES:
        paths.setdefault(ROOT + route.path, {})[route.method.lower()] = _network(route)
    return {
        "openapi": "3.1.0",
        "info": {"title": "hri studio", "version": "1"},
        "security": [{"token": []}, {"cookie": []}],
        "components": {
            "securitySchemes": {
                "token": {"type": "http", "scheme": "bearer", "description": "of `hri token`"},
                "cookie": {"type": "apiKey", "in": "cookie", "name": "hri_studio_PORT"},
            },
            "schemas": schemas(),
        },
        "paths": paths,
    }


def _path(name: str, command: Command) -> dict[str, Any]:
    properties = {
        key: {**_schema_of(argument), "description": argument.about}
        for key, argument in command.arguments.items()
    }
    schema = {"type": "object", "properties": properties, "additionalProperties": False}
    required = [key for key, one in command.arguments.items() if not one.is_optional]
    if required:
        schema["required"] = required
    post: dict[str, Any] = {
        "operationId": name,
        "summary": command.about,
        "requestBody": {"content": {"application/json": {"schema": schema}}},
        "responses": {**_ANSWERS, "200": {"description": command.answer}},
    }
    if command.is_open:
        post["description"] = "On this machine it needs neither cookie nor token."
    return {"post": post}


def _network(route: Route) -> dict[str, Any]:
    found: dict[str, Any] = {
        "operationId": f"networks{route.path.replace('/', '_')}_{route.method.lower()}",
        "summary": route.about,
        "responses": {**_FOUND, "409": {"description": "it cannot be done; `error` says why"}},
    }
    if route.method in ("PUT", "POST"):
        properties = {
            name: {"type": ["string", "null"] if name == "mark" else "string", "description": about}
            for name, about in route.arguments.items()
        }
        schema = {"type": "object", "properties": properties, "additionalProperties": False}
        found["requestBody"] = {"content": {"application/json": {"schema": schema}}}
    else:
        found["parameters"] = [
            {"name": name, "in": "query", "schema": {"type": "string"}, "description": about}
            for name, about in route.arguments.items()
        ]
    return found


def _schema_of(argument: Argument) -> dict[str, Any]:
    schema = _KINDS[argument.kind]
    return {**schema, "maxLength": argument.longest} if argument.kind is str else schema


def _get(name: str, about: str, schema: str = "LiveMessage") -> dict[str, Any]:
    content = {"application/json": {"schema": {"$ref": f"#/components/schemas/{schema}"}}}
    answers = {**_ANSWERS, "200": {"description": "the values", "content": content}}
    return {"get": {"operationId": name, "summary": about, "responses": answers}}


def _reading(name: str) -> dict[str, Any]:
    about, parameters = _RECORDINGS[name]
    optional = ("from", "bytes")
    get = {
        "operationId": f"recordings{name.replace('/', '_')}",
        "summary": about,
        "parameters": [
            {
                "name": key,
                "in": "query",
                "required": key not in optional,
                "schema": {"type": "string"}
                if key == "folder"
                else {"type": "number", "minimum": 0},
                "description": text,
            }
            for key, text in parameters.items()
        ],
        "responses": _FOUND,
    }
    return {"get": get}
