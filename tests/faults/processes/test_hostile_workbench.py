"""A workbench that is told nonsense and lies: by its own page, and by who is nobody."""

import asyncio
import importlib
import json
import logging
import random
import sys
from collections.abc import Iterator

import pytest
from tests.unit.workbench.host import SOON, Host, Page, Pretending, finished, hosting

from tribodyn.core import fork_server
from tribodyn.workbench.server_state import Rules
from tribodyn.workbench.work import Limits
from tribodyn.workbench.worker_pool import WorkerPool

SIZES = [pytest.param(600, id="some"), pytest.param(10_000, id="many", marks=pytest.mark.long)]
TEXTS = (
    *("", "37 um", "-5 um", "0 um", "1e999 um", "1e-300 m", "nan um", "inf", "1 um um um", "1 m^99999999"),
    *(
        "../../etc/passwd",
        "/etc/passwd",
        "file:///etc/passwd",
        "{{7*7}}",
        "<script>alert(1)</script>",
        "$(id)",
    ),
    *("__import__('os').system('id')", "'; DROP", "1,2,3", "[1, 2]", "((((", "\0", "\ud800", "\U0001f4a5 um"),
    *("9" * 400, "a" * 1999, "b" * 2001),
)
KEYS = (
    *("joint.clearance", "contact.law", "asperities.surface", "surfaces.bushing.surface", "title", "case"),
    *(
        "run.cycles",
        "wear.cycles",
        "solver.grid.theta",
        "run.output_interval",
        "solver.name",
        "joint",
        "",
        ".",
    ),
    *(
        "joint.liner.thickness",
        "__class__",
        "__proto__",
        "constructor",
        "joint.__dict__",
        "a.b.c.d.e",
        "$ref",
    ),
    *("case.title", "\ud800", "x" * 3000),
)
ODD = (None, True, -1, 2**32, 2**70, 1.5, 1e308, [], {}, [[]], "x", "0", {"a": {"b": []}})
NO_OBJECTS = ("[" * 5000, "{" * 5000, "9" * 5000, "null", "NaN", '""', "[]", "\ufeff{}", '{"type":' * 500)
KINDS = ("run", "drawn", "cancel", "pin", "unpin", "sweep", "slope", "hello", "eval", "", None, 7)
#: How events are named that touch the machine, as an audit hook is told.
WATCHED = ("open", "os.", "subprocess.", "shutil.")


class Watch:
    """What this process touches while it is watched."""

    def __init__(self) -> None:
        self.on = False
        self.touched: list[str] = []
        sys.addaudithook(self._hear)

    def _hear(self, event: str, arguments: tuple[object, ...]) -> None:
        if self.on and event.startswith(WATCHED):
            self.touched.append(f"{event} {arguments!r:.200}")


@pytest.fixture(scope="module")
def watch() -> Watch:
    # Units that few cases are written in are read from their file once, when the first is asked for.
    importlib.import_module("tribodyn.cases.known_units")
    return Watch()


def odd(source: random.Random) -> object:
    return source.choice((*ODD, source.choice(TEXTS), source.random()))


FIELDS = {
    "run": ("number", "values", "rest", "agreed"),
    "sweep": ("number", "key", "values", "from", "to", "points"),
    "slope": ("number", "key", "values"),
    "pin": ("run",),
    "drawn": ("number",),
}


def likely(name: str, source: random.Random) -> object:
    """Return what may stand in a field, though not always in one of this message."""
    if name == "values":
        return {key: source.choice(TEXTS) for key in source.sample(KEYS, source.randrange(3))}
    known = {
        "number": source.randrange(1000),
        "key": source.choice(KEYS),
        "points": 9,
        "run": "0123456789abcdef",
    }
    return known.get(name, source.choice((True, "20 um")))


def message(source: random.Random) -> str | bytes:
    """Return something that no page of ours would send, or that it might."""
    kind = source.choice(KINDS)
    said: dict[str, object] = {"type": kind}
    names = FIELDS.get(str(kind), ("number", "path"))
    for name in names if source.random() < 0.8 else (*names, "key", "path"):
        if source.random() < 0.95:
            said[name] = likely(name, source) if source.random() < 0.8 else odd(source)
    text = json.dumps(said)
    how = source.random()
    if how < 0.05:
        return text.encode()
    if how < 0.15:
        return text[: source.randrange(len(text))]
    if how < 0.2:
        return source.choice(NO_OBJECTS)
    return text


METHODS = ("GET", "GET", "POST", "HEAD", "TRACE", "CONNECT", "get", "\0", "G" * 5000)
PATHS = (
    *(
        "/",
        "/socket",
        "/assets/a.js",
        "/assets/../../etc/passwd",
        "/assets/%00",
        "//evil",
        "*",
        "http://evil/",
    ),
    *("/download/result.nc", "/download/..%2f?run=x", "/?token=" + "a" * 43, "/?token=%ff", "\udcff", ""),
    "/?" + "x" * 20_000,
)
COOKIES = ("x=y", "=", ";;;", "a" * 9000, "tribodyn=\0")
MORE = (
    *("Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13", "Origin: null", "X: \udc80"),
    *("Content-Length: 99999999", "Content-Length: -1", "Transfer-Encoding: chunked", ": x", "no colon"),
)


def request(source: random.Random, host: Host) -> bytes:
    """Return what a stranger might send, some of it with the right cookie."""
    headers = [f"Host: {source.choice((f'127.0.0.1:{host.port}', 'evil', '', 'a' * 9000))}"]
    if source.random() < 0.5:
        headers.append(f"Cookie: {source.choice((host.cookie, *COOKIES))}")
    headers += source.sample(MORE, source.randrange(3))
    version = source.choice(("HTTP/1.1", "HTTP/1.0", "HTTP/9", ""))
    line = f"{source.choice(METHODS)} {source.choice(PATHS)} {version}"
    whole = "\r\n".join([line, *headers, "", ""]).encode("utf-8", "surrogateescape")
    return whole[: source.randrange(1, len(whole))] if source.random() < 0.1 else whole


async def asked(host: Host, content: bytes) -> bytes:
    """Send bytes to the server and return what it answers before it says no more."""
    reader, writer = await asyncio.open_connection("127.0.0.1", host.port)
    writer.write(content)
    writer.write_eof()
    try:
        return await asyncio.wait_for(reader.read(), SOON)
    except ConnectionError:
        return b""
    finally:
        writer.close()


async def fed(page: Page, number: int, source: random.Random) -> None:
    for _ in range(number):
        content = message(source)
        await page.socket.write_message(content, binary=isinstance(content, bytes))


async def drained(page: Page) -> None:
    """Receive messages until the answer to the last request."""
    while (said := await page.hear()) is not None:
        if getattr(said, "number", None) == 2**32 - 1:
            return
    raise AssertionError("the socket has ended")


@pytest.fixture
def quiet(caplog: pytest.LogCaptureFixture) -> Iterator[None]:
    """Let no program of the server's complain."""
    with caplog.at_level(logging.ERROR):
        yield
    assert [record.getMessage() for record in caplog.records] == []


@pytest.mark.usefixtures("quiet")
@pytest.mark.parametrize("number", SIZES)
def test_a_page_that_says_anything_is_answered_and_nothing_is_touched(number: int, watch: Watch) -> None:
    async def test() -> None:
        source = random.Random(number)
        async with hosting(Pretending(), rules=Rules(messages=10**6)) as host:
            page = await host.greeted()
            hearing = asyncio.create_task(drained(page))
            watch.on = True
            await fed(page, number, source)
            await page.run(2**32 - 1, {"joint.clearance": "33 um"}, rest=True)
            await asyncio.wait_for(hearing, SOON + number / 100)
            watch.on = False
            kinds = {said["type"] for said in page.heard}
            assert {"error", "refused"} <= kinds
            assert len(host.state.kept.frames) < 400
        assert watch.touched == []

    finished(test())


@pytest.mark.usefixtures("quiet")
@pytest.mark.parametrize("number", SIZES)
def test_strangers_are_refused_whatever_they_send(number: int, watch: Watch) -> None:
    async def test() -> None:
        source = random.Random(number)
        async with hosting() as host:
            watch.on = True
            for _ in range(number // 10):
                several = [request(source, host) for _ in range(10)]
                answers = await asyncio.gather(*(asked(host, content) for content in several))
                for content, answer in zip(several, answers, strict=True):
                    ours = (
                        host.cookie.encode() in content and f"Host: 127.0.0.1:{host.port}".encode() in content
                    )
                    status = answer.split(b" ", 2)[1:2]
                    assert ours or status in ([], [b"400"], [b"403"]), (content, answer)
                    assert b"Traceback" not in answer
            watch.on = False
            assert (await host.get("/")).code == 200
        assert watch.touched == []

    finished(test())


@pytest.mark.long
@pytest.mark.usefixtures("quiet")
def test_real_workers_outlive_ten_thousand_messages() -> None:
    async def test() -> None:
        fork_server.start(name="vsv")
        rules = Rules(messages=10**6, longest=SOON, unasked=5.0)
        async with hosting(WorkerPool(2, Limits()), rules=rules) as host:
            page = await host.greeted()
            hearing = asyncio.create_task(drained(page))
            source = random.Random(1)
            for _ in range(100):
                await fed(page, 100, source)
                await asyncio.sleep(0.5)
            await page.run(2**32 - 1, {"joint.clearance": "33 um"}, rest=True, agreed=True)
            await asyncio.wait_for(hearing, 10 * SOON)

    finished(test())
