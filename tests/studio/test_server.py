"""The server hands on what the robot does, and lets in only who may."""

import json
import struct
from contextlib import ExitStack, contextmanager, suppress

import httpx2 as httpx
import pytest
import trio
import trio.testing
from hypothesis import given, settings, strategies as st
from starlette.testclient import TestClient
from starlette.websockets import WebSocketDisconnect

from hri.core.errors import HriError
from hri.core.token import own_token
from hri.studio.access import Codes, Cookies
from hri.studio.commands import COMMANDS, LONGEST_TEXT
from hri.studio.event_memory import MOST_FLOOD, MOST_LINES, MOST_OTHERS
from hri.studio.guard import LONGEST_BODY
from hri.studio.hub import Hub, Page
from hri.studio.link import CAMERA, FACE, Unpacker, packed, packed_value
from hri.studio.page_socket import MOST_PAGES, MOST_PAGES_EACH
from hri.studio.request_queue import MOST_REQUESTS, MOST_STOPS
from hri.studio.server import Settings, Studio, _now

HOST = "http://127.0.0.1:8311"
LIVE = "ws://127.0.0.1:8311/api/v1/live"
OPEN = {name for name, command in COMMANDS.items() if command.is_open}
GOOD, USED = (Codes("secret").new() for _ in range(2))
GIVEN = {str: "hello", float: 1.0, bool: True}


class Robot:
    """The other end of the link, which answers everything."""

    def __init__(self):
        self.asked, self.hub, self.refuses = [], None, None

    async def send_all(self, data):
        ((_, content),) = Unpacker().feed(data)
        message = json.loads(content)
        self.asked.append(message)
        if "number" in message:
            is_code = message["with"].get("code") == GOOD
            result = is_code if message["command"] == "redeem" else None
            answer = {"answer": message["number"], "error": self.refuses, "result": result}
            self.tell(answer)

    def tell(self, message):
        if "topic" in message:
            self.hub._pass_on(message["topic"], json.dumps(message["value"]))
        else:
            self.hub._take(message, json.dumps(message))

    @property
    def obeyed(self):
        return [one["command"] for one in self.asked if one.get("command") in COMMANDS]


@pytest.fixture
def robot():
    made = Robot()
    made.hub = Hub(made)
    return made


@pytest.fixture
def app(robot):
    return Studio(robot.hub, Settings(8311, "secret", allows_remote=False)).app()


@contextmanager
def client(app, address="127.0.0.1", base=HOST, **more):
    with TestClient(app, base, backend="trio", client=(address, 5000), **more) as made:
        yield made


@pytest.fixture
def autojump_clock():
    return trio.testing.MockClock(autojump_threshold=0)


@pytest.fixture
def stranger(app):
    with client(app) as made:
        yield made


@pytest.fixture
def person(app):
    with client(app) as made:
        assert made.get(f"/?code={GOOD}").status_code == 200
        yield made


def arguments(name):
    return {key: GIVEN[argument.kind] for key, argument in COMMANDS[name].arguments.items()}


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_whoever_showed_a_code_may_ask_for_everything(person, robot, name):
    answer = person.post(f"/api/v1/{name}", json=arguments(name))
    assert (answer.status_code, answer.json()) == (200, {"result": None})
    assert robot.asked[-1]["command"] == name
    assert robot.asked[-1]["with"] == arguments(name)


@pytest.mark.parametrize("name", sorted(COMMANDS))
def test_a_stranger_may_stop_it_and_nothing_else(stranger, robot, name):
    answer = stranger.post(f"/api/v1/{name}", json=arguments(name))
    assert answer.status_code == (200 if name in OPEN else 401)
    assert robot.obeyed == ([name] if name in OPEN else [])


def test_another_machine_may_not_even_stop_it_without_the_token(robot):
    studio = Studio(robot.hub, Settings(8311, "secret", allows_remote=True)).app()
    with client(studio, "192.168.1.9", "http://192.168.1.7:8311") as far:
        assert far.post("/api/v1/stop").status_code == 401
        token = {"authorization": f"Bearer {own_token()}"}
        assert far.post("/api/v1/stop", headers=token).status_code == 200
    assert robot.obeyed == ["stop"]


def test_a_script_shows_the_token(stranger, robot):
    token = {"authorization": f"Bearer {own_token()}"}
    assert stranger.post("/api/v1/say", json={"text": "hi"}, headers=token).status_code == 200
    wrong = {"authorization": "Bearer " + 43 * "a"}
    assert stranger.post("/api/v1/say", json={"text": "hi"}, headers=wrong).status_code == 401
    assert robot.obeyed == ["say"]


def test_a_wrong_code_gives_no_cookie_and_costs_the_robot_nothing(stranger, robot):
    for code in ("bad", "", USED, USED, f"x{GOOD}", GOOD[:-1]):
        assert stranger.get(f"/?code={code}").status_code == 200
    assert not stranger.cookies
    assert stranger.get("/api/v1/state").status_code == 401
    asked = [one["with"]["code"] for one in robot.asked]
    assert asked == [USED]  # once, and about no guess at all


@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:9999"])
def test_a_page_of_another_site_does_nothing(person, robot, origin):
    for name in ("stop", "say"):
        foreign = {"origin": origin}
        assert person.post(f"/api/v1/{name}", json=arguments(name), headers=foreign).is_error
    with (
        pytest.raises(WebSocketDisconnect),
        person.websocket_connect(LIVE, headers={"origin": origin}),
    ):
        pass
    assert robot.obeyed == []


def test_a_foreign_name_for_this_machine_does_nothing(app, robot):
    with client(app, base="http://evil.example:8311") as made:
        assert made.post("/api/v1/stop").status_code == 403
    assert robot.obeyed == []


@pytest.mark.parametrize(
    ("command", "given", "why"),
    [
        ("say", {}, '"text" must be a text'),
        ("say", {"text": ""}, '"text" must be a text'),
        ("say", {"text": "x" * (LONGEST_TEXT + 1)}, '"text" must be a text'),
        ("say", {"text": "x", "volume": 1}, 'say takes no "volume"'),
        ("visitor_go", {"x": "1", "y": 2}, '"x" must be a number'),
        ("visitor_go", {"x": True, "y": 2}, '"x" must be a number'),
        ("visitor_go", {"x": 1e9, "y": 2}, '"x" must be a number'),
        ("mute", {"on": 1}, '"on" must be true or false'),
        ("stop", ["x"], "the body must be a JSON object"),
    ],
)
def test_wrong_arguments_are_refused_in_a_line(person, robot, command, given, why):
    answer = person.post(f"/api/v1/{command}", json=given)
    assert answer.status_code == 400
    assert answer.json()["error"].startswith(why)
    assert robot.obeyed == []


@settings(max_examples=100)
@given(st.sampled_from(sorted(COMMANDS)), st.binary(max_size=300))
def test_junk_never_breaks_the_server(name, body):
    robot = Robot()
    robot.hub = Hub(robot)
    studio = Studio(robot.hub, Settings(8311, "secret", allows_remote=False)).app()
    with client(studio, raise_server_exceptions=True) as made:
        made.cookies.set("hri_studio_8311", body.hex())
        answer = made.post(f"/api/v1/{name}", content=body)
        assert answer.status_code in (200, 400, 401)
    assert set(robot.obeyed) <= OPEN


@pytest.mark.parametrize(
    ("body", "why"),
    [
        (b'{"text": ' + b"9" * 5000 + b"}", "the body is too much: an integer of 5000 digits - "),
        (b'{"text": -' + b"9" * 301 + b"}", "the body is too much: an integer of "),
        (b"[" * 60_000, "the body is too much: its brackets are nested too deeply - "),
        (b'{"text": "\xff"}', "the body is not UTF-8 at byte 10 - send UTF-8"),
        (b'{"text" 1}', "the body is not JSON: Expecting ':' delimiter (line 1, column 9) - "),
    ],
    ids=["digits", "more digits", "brackets", "bytes", "colon"],
)
@pytest.mark.parametrize("path", ["say", "networks/check"])
def test_a_body_that_cannot_be_read_is_explained_in_plain_words(person, robot, body, why, path):
    answer = person.post(f"/api/v1/{path}", content=body)
    assert answer.status_code == 400
    assert answer.json()["error"].startswith(why)
    assert robot.obeyed == []


@pytest.mark.parametrize("name", ["a" * 300 + ".js", "\u00fc" * 200 + ".css", "a" * 5000 + ".svg"])
def test_a_file_that_cannot_exist_is_not_found(app, name):
    with client(app, raise_server_exceptions=True) as made:
        assert made.get(f"/{name}").status_code == 404


def test_a_body_that_is_too_long_is_refused(person, robot):
    long = b'{"text":"' + b"x" * LONGEST_BODY + b'"}'
    assert person.post("/api/v1/say", content=long).status_code == 403
    assert person.post("/api/v1/say", content=iter([long])).status_code == 400
    assert robot.obeyed == []


def test_what_the_robot_refuses_comes_back_as_a_line(person, robot):
    robot.refuses = "this room is real"
    answer = person.post("/api/v1/visitor_nod", json={})
    assert (answer.status_code, answer.json()) == (409, {"error": "this room is real"})


def test_pages_have_strict_headers_and_nothing_else_is_served(stranger):
    page = stranger.get("/")
    assert "default-src 'self'" in page.headers["content-security-policy"]
    assert page.headers["x-content-type-options"] == "nosniff"
    for name in ("/studio.js", "/studio.css", "/icon.svg"):
        assert stranger.get(name).status_code == 200
    for name in ("/server.py", "/..%2fserver.py", "/missing.js", "/index.md"):
        assert stranger.get(name).status_code == 404


def test_the_interface_is_described(stranger):
    document = stranger.get("/api/v1/openapi.json").json()
    assert document["openapi"] == "3.1.0"
    for name, command in COMMANDS.items():
        post = document["paths"][f"/api/v1/{name}"]["post"]
        assert post["summary"] == command.about
        schema = post["requestBody"]["content"]["application/json"]["schema"]
        assert set(schema["properties"]) == set(command.arguments)


def test_a_page_gets_the_newest_values_and_then_what_changes(person, robot):
    robot.tell({"topic": "base", "value": 1})
    robot.tell({"topic": "base", "value": 2})
    robot.tell({"event": {"t": 1.0, "event": "person.seen"}})
    with person.websocket_connect(LIVE) as page:
        assert page.receive_json() == {"topic": "base", "value": 2}
        assert page.receive_json()["event"]["event"] == "person.seen"
        page.send_json({"pictures": ["face", "nonsense"]})
        page.send_json({"pictures": ["face"]})
        person.post("/api/v1/hush")  # after it the wish has come through
        assert {"wanted": ["face"]} in robot.asked
    assert robot.asked[-1] == {"wanted": []}


def test_strangers_see_nothing(stranger):
    with pytest.raises(WebSocketDisconnect), stranger.websocket_connect(LIVE):
        pass
    assert stranger.get("/api/v1/state").status_code == 401


@pytest.mark.parametrize(
    "text", ["", "{", "[]", '"command"', '{"pictures": 5}', '{"pictures": [[]]}', "x" * 999]
)
def test_a_page_that_talks_nonsense_is_sent_away(person, text):
    with person.websocket_connect(LIVE) as page:
        page.send_text(text)
        with pytest.raises(WebSocketDisconnect):
            page.receive_json()


def test_pages_are_counted_and_one_cookie_does_not_take_them_all(app):
    def cookie():
        return {"cookie": f"hri_studio_8311={Cookies('secret').new(_now())}"}

    first, second, third = (cookie() for _ in range(3))
    with client(app) as made, ExitStack() as pages:

        def look(proof):
            return made.websocket_connect(LIVE, headers=proof)

        for proof in (first, second):
            for _ in range(MOST_PAGES_EACH):
                pages.enter_context(look(proof))
            with pytest.raises(WebSocketDisconnect), look(proof):
                pass
        assert 2 * MOST_PAGES_EACH == MOST_PAGES
        with pytest.raises(WebSocketDisconnect), look(third):
            pass


def test_a_page_stops_the_robot_over_its_open_link_and_does_nothing_else_there(person, robot):
    with person.websocket_connect(LIVE) as page:
        page.send_json({"command": "stop", "number": 5})
        assert page.receive_json() == {"answer": 5, "error": None}
        robot.refuses = "it has no base"
        page.send_json({"command": "stop", "number": 6})
        assert page.receive_json() == {"answer": 6, "error": "it has no base"}
    assert robot.obeyed == ["stop", "stop"]


def test_the_same_press_by_two_ways_stops_the_robot_once(person, robot):
    with person.websocket_connect(LIVE) as page:
        page.send_json({"command": "stop", "number": 1, "press": "a"})
        assert page.receive_json() == {"answer": 1, "error": None}
        person.post("/api/v1/release")  # before the slower way
        assert person.post("/api/v1/stop", json={"press": "a"}).json() == {"result": None}
        assert person.post("/api/v1/stop", json={"press": "b"}).json() == {"result": None}
    assert robot.obeyed == ["stop", "release", "stop"]


@pytest.mark.parametrize(
    "message",
    [
        {"command": "stop", "number": 1, "press": 5},
        {"command": "stop", "number": 1, "speed": "x"},
        {"command": "release", "number": 1},
        {"command": "stop"},
        {"command": "stop", "number": "1"},
        {"command": ["stop"], "number": 1},
    ],
)
def test_another_command_over_the_link_of_a_page_is_nonsense(person, robot, message):
    with person.websocket_connect(LIVE) as page:
        page.send_json(message)
        with pytest.raises(WebSocketDisconnect):
            page.receive_json()
    assert robot.obeyed == []


def test_a_page_that_reads_slowly_gets_the_newest_and_fills_nothing(robot):
    async def run():
        page = Page(wanted=frozenset({"face"}))
        await robot.hub.add(page)
        count = 5 * MOST_OTHERS
        for number in range(count):
            robot.tell({"topic": "base", "value": number})
            for name in ("x", "odometry", "speech.heard"):
                robot.tell({"event": {"t": number, "event": name}})
            robot.hub._show(FACE, struct.pack(">d", number) + b"jpeg")
            robot.hub._show(CAMERA, struct.pack(">d", number) + b"jpeg")
        found = page.take()
        assert len(found) == 1 + MOST_OTHERS + MOST_FLOOD + MOST_LINES + 1
        assert json.loads(found[0]) == {"topic": "base", "value": count - 1}
        assert found[-1] == bytes((FACE,)) + struct.pack(">d", count - 1) + b"jpeg"

    trio.run(run)


def test_a_page_that_comes_later_sees_the_conversation_as_the_first_does(person, robot):
    said = [{"t": t, "event": "speech.said", "text": str(t)} for t in range(MOST_LINES)]
    for event in said:
        robot.tell({"event": event})
        for _ in range(10):
            robot.tell({"event": {"t": event["t"], "event": "odometry"}})
            robot.tell({"event": {"t": event["t"], "event": "x"}})
    with person.websocket_connect(LIVE) as page:
        found = [page.receive_json()["event"] for _ in range(MOST_LINES + MOST_OTHERS)]
    assert [one for one in found if one["event"] == "speech.said"] == said
    assert found == sorted(found, key=lambda one: one["t"])
    assert "odometry" not in {one["event"] for one in found}


class Frozen:
    """A robot whose process is held up, so that nothing is read of what is sent to it."""

    def __init__(self):
        self.goes_on, self.read = trio.Event(), []

    async def send_all(self, data):
        await self.goes_on.wait()
        self.read += [json.loads(content)["command"] for _, content in Unpacker().feed(data)]


def test_a_stop_reaches_a_robot_that_was_held_up_though_others_fill_the_way(autojump_clock):
    async def ask(hub, command):
        with suppress(HriError):
            await hub.ask(command, {})

    async def run():
        robot = Frozen()
        hub = Hub(robot)
        async with trio.open_nursery() as nursery:
            for _ in range(2 * MOST_REQUESTS):
                nursery.start_soon(ask, hub, "say")
            await trio.testing.wait_all_tasks_blocked()
            for _ in range(2 * MOST_STOPS):
                nursery.start_soon(ask, hub, "stop")
            await trio.sleep(60)
            robot.goes_on.set()
        assert len(robot.read) <= MOST_STOPS + 1
        assert "stop" in robot.read

    trio.run(run, clock=autojump_clock)


def test_a_code_waits_for_a_robot_that_is_still_starting(app, robot, autojump_clock):
    answered = robot.tell
    robot.tell = lambda message: trio.lowlevel.spawn_system_task(tell_late, message)

    async def tell_late(message):
        await trio.sleep(20)
        answered(message)

    async def run():
        transport = httpx.ASGITransport(app, client=("127.0.0.1", 5000))
        async with httpx.AsyncClient(transport=transport, base_url=HOST) as made:
            return await made.get(f"/?code={GOOD}")

    answer = trio.run(run, clock=autojump_clock)
    assert answer.status_code == 303
    assert "set-cookie" in answer.headers


def test_a_robot_that_does_not_answer_is_an_error_and_not_a_wait(app, robot, autojump_clock):
    robot.tell = lambda message: None

    async def run():
        transport = httpx.ASGITransport(app, client=("127.0.0.1", 5000))
        async with httpx.AsyncClient(transport=transport, base_url=HOST) as made:
            return await made.post("/api/v1/stop")

    answer = trio.run(run, clock=autojump_clock)
    assert answer.status_code == 409
    assert answer.json() == {
        "error": "the robot does not answer - "
        "it stops as soon as its loop goes on, unless it has ended",
        "will_be_done": True,
    }


def test_the_stream_of_the_robot_is_followed_to_its_end(robot):
    class Stream:
        def __init__(self):
            self.parts = [packed_value("about", 1), packed(FACE, 9 * b"x")]

        def __aiter__(self):
            return self

        async def __anext__(self):
            if not self.parts:
                raise StopAsyncIteration
            return self.parts.pop(0)

    hub = Hub(Stream())
    trio.run(hub.follow)
    assert hub.values == {"about": "1"}
