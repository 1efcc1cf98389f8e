"""A workbench in the loop of a test, with a pool that pretends to compute, and a page that talks to it."""

from __future__ import annotations

import asyncio
import json
import shutil
import struct
import sys
from collections.abc import AsyncIterator, Callable, Coroutine, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import asynccontextmanager, contextmanager
from dataclasses import dataclass, field
from typing import Any

from tornado.httpclient import AsyncHTTPClient, HTTPRequest, HTTPResponse
from tornado.httpserver import HTTPServer
from tornado.websocket import WebSocketClientConnection, websocket_connect

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.views.encode import packed
from tribodyn.workbench import messages
from tribodyn.workbench.access import AccessControl, Endpoint, UserSession
from tribodyn.workbench.handlers import PAGE, ServerContext, application
from tribodyn.workbench.server import listening
from tribodyn.workbench.server_state import Rules, ServerState
from tribodyn.workbench.variant import Origin
from tribodyn.workbench.work import Limits
from tribodyn.workbench.worker_pool import GivenUp, Job, WorkerPool

THE_PAGE = b'<!doctype html><meta name="secret" content="">the page'
#: The command as a process that ends with the one that began it, however that ends; on Linux.
TRIBODYN = [
    *(["setpriv", "--pdeathsig", "TERM"] if shutil.which("setpriv") else []),
    *(sys.executable, "-m", "tribodyn"),
]
SOON = 300.0  #: Time after which a test that waits has failed, however busy the machine is [s].


class Pretending(WorkerPool):
    """A pool without processes: every picture takes a little while, and holds one array.

    Attributes
    ----------
    made, given_up
        Orders that came to their end, and those that did not.
    """

    def __init__(self, seconds: float = 0.0) -> None:
        super().__init__(1, Limits())
        self.seconds = seconds
        self.made: list[Mapping[str, Any]] = []
        self.given_up: list[Mapping[str, Any]] = []

    async def start(self) -> None:
        self.workers = [None]  # type: ignore[list-item]

    async def end(self) -> None:
        self._threads.shutdown()

    async def do(self, job: Job) -> bytes:
        asyncio.get_running_loop().call_later(self.seconds, job.settle, self._content(job))
        try:
            content = await job.answer
        except (GivenUp, asyncio.CancelledError):
            self.given_up.append(job.order)
            raise
        self.made.append(job.order)
        job.took = self.seconds
        return content

    def stop(self, job: Job, verdict: Exception | None = None) -> None:
        job.settle(verdict or GivenUp())

    def _content(self, job: Job) -> bytes:
        if job.order["work"] != "picture":
            return b"a file"
        shown = {"results": {"a": 1.0}, "failure": "", "sections": {"one": {"x": packed([1.0, 2.0])}}}
        return messages.body({**job.order["header"], **shown})


@dataclass
class Answer:
    """A frame as a page reads it."""

    number: int
    flags: int
    header: dict[str, Any]
    data: bytes


def unframed(content: bytes) -> Answer:
    magic, number, length, flags = struct.unpack_from("<IIII", content)
    assert magic == messages.MAGIC
    assert length % 8 == 0
    return Answer(number, flags, json.loads(content[16 : 16 + length]), content[16 + length :])


@dataclass
class Page:
    """A page with a socket; it says that it has drawn unless told not to."""

    socket: WebSocketClientConnection
    draws: bool = True
    ended: bool = False
    heard: list[dict[str, Any]] = field(default_factory=list)

    async def say(self, kind: str, **fields: Any) -> None:
        await self.socket.write_message(json.dumps({"type": kind, **fields}))

    async def hear(self) -> dict[str, Any] | Answer | None:
        """Return the next thing that the server says; None at the end."""
        said = await asyncio.wait_for(self.socket.read_message(), SOON)
        if said is None:
            self.ended = True
            return None
        if isinstance(said, str):
            self.heard.append(json.loads(said))
            return self.heard[-1]
        answer = unframed(said)
        if self.draws:
            await self.say("drawn", number=answer.number)
        return answer

    async def until(self, kind: str) -> dict[str, Any]:
        """Return the next message of a kind."""
        while (said := await self.hear()) is not None:
            if isinstance(said, dict) and said["type"] == kind:
                return said
        raise AssertionError(f"the socket ended before a message {kind}")

    async def picture(self) -> Answer:
        """Return the next frame."""
        while (said := await self.hear()) is not None:
            if isinstance(said, Answer):
                return said
        raise AssertionError("the socket ended before a frame")

    async def leave(self) -> None:
        """Close the socket."""
        self.socket.close()
        self.draws = False
        while not self.ended and await self.hear() is not None:
            pass

    async def run(self, number: int, values: Mapping[str, Any] = {}, **more: Any) -> None:
        await self.say("run", number=number, values=dict(values), **more)


@dataclass
class Host:
    """A server that listens, and how to reach it."""

    state: ServerState
    context: ServerContext
    session: UserSession
    port: int
    complaints: list[str]
    pages: list[Page] = field(default_factory=list)

    @property
    def origin(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def cookie(self) -> str:
        return f"tribodyn-{self.port}={self.session.cookie}"

    @property
    def secret(self) -> str:
        return f"secret={self.session.secret}"

    async def get(self, path: str, headers: Mapping[str, str] | None = None, **more: Any) -> HTTPResponse:
        """Ask for a path; by default with the cookie."""
        asked = {"Cookie": self.cookie} if headers is None else dict(headers)
        request = HTTPRequest(
            self.origin + path, headers=asked, follow_redirects=False, request_timeout=SOON, **more
        )
        return await AsyncHTTPClient().fetch(request, raise_error=False)

    async def open(self, headers: Mapping[str, str] | None = None, path: str = "") -> Page:
        """Open a socket; by default as our own page does."""
        asked = {"Cookie": self.cookie, "Origin": self.origin} if headers is None else dict(headers)
        address = f"ws://127.0.0.1:{self.port}{path or f'/socket?{self.secret}'}"
        request = HTTPRequest(address, headers=asked)
        self.pages.append(Page(await websocket_connect(request, max_message_size=10**8)))
        return self.pages[-1]

    async def greeted(self) -> Page:
        """Open a socket and wait until the state is ready."""
        page = await self.open()
        await page.until("hello")
        await asyncio.wait_for(self.state.ready.wait(), SOON)
        return page


@asynccontextmanager
async def hosting(
    pool: WorkerPool | None = None, case: str = "vsv", rules: Rules | None = None
) -> AsyncIterator[Host]:
    """Serve while the block runs; no error of our own may be told of."""
    chosen = rules or Rules()
    listeners = listening(0)
    port = listeners[0].getsockname()[1]
    hosts = frozenset((f"127.0.0.1:{port}", f"ours.localhost:{port}"))
    endpoint = Endpoint(hosts, f"tribodyn-{port}")
    session = UserSession()
    origin = Origin(load_case(case), case)
    state = ServerState(origin, pool or Pretending(), chosen)
    complaints: list[str] = []
    context = ServerContext(state, endpoint, session, {PAGE: THE_PAGE, "a.js": b"1"}, complaints.append)
    server = HTTPServer(AccessControl(endpoint, session, application(context)), max_body_size=0)
    server.add_sockets(listeners)
    warm = asyncio.create_task(state.warm())
    host = Host(state, context, session, port, complaints)
    try:
        yield host
    finally:
        for page in host.pages:
            await page.leave()
        server.stop()
        warm.cancel()
        await state.pool.end()
        await server.close_all_connections()
    assert complaints == []


@contextmanager
def own_loop() -> Iterator[Callable[[Coroutine[Any, Any, None]], None]]:
    """Have an event loop in a thread of its own: a browser may hold the loop of this one."""
    with ThreadPoolExecutor(1) as thread:
        runner = asyncio.Runner()
        try:
            yield lambda test: thread.submit(runner.run, test).result()
        finally:
            thread.submit(runner.close).result()


def finished(test: Coroutine[Any, Any, None]) -> None:
    """Run a test to its end."""
    with own_loop() as run:
        run(test)


def in_loop(test: Callable[..., Coroutine[Any, Any, None]]) -> Callable[[], None]:
    """Make a test of a coroutine."""

    def run() -> None:
        finished(asyncio.wait_for(test(), 6 * SOON))

    run.__name__, run.__doc__ = test.__name__, test.__doc__
    return run
