"""Handlers of requests that have passed access control: the page, its assets, downloads and the socket."""

import asyncio
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Final

from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from tribodyn.workbench.access import TOKEN, Endpoint, UserSession, argument_of
from tribodyn.workbench.description import DOWNLOADS
from tribodyn.workbench.messages import LARGEST
from tribodyn.workbench.page_session import PageSession
from tribodyn.workbench.server_state import ServerState
from tribodyn.workbench.variant import SAVED
from tribodyn.workbench.worker_pool import Failed, GivenUp, Job

PAGE: Final = "page.html"
#: Folders of assets; of two with one name the later one is served.
_FOLDERS: Final = ("tribodyn.report.assets", "tribodyn.workbench.assets")
_KINDS: Final = {
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".html": "text/html; charset=utf-8",
    ".toml": "text/plain; charset=utf-8",
    ".nc": "application/x-netcdf",
}
#: A page that leads to ours: a browser that is redirected from another site would leave the cookie out.
_ARRIVED: Final = (
    b'<!doctype html><html lang="en"><meta charset="utf-8"><title>tribodyn</title>'
    b'<link rel="icon" href="data:,"><meta http-equiv="refresh" content="0; url=/">'
    b'<p><a href="/">The workbench</a></html>\n'
)
#: Place of the secret in the page, without and with one.
_EMPTY, _FILLED = b'name="secret" content=""', b'name="secret" content="%s"'
_BACKLOG: Final = 200_000_000  #: Most bytes on their way to a page that does not read them.
_BURST: Final = 1.0  #: Time for which messages may come as fast as they like [s].


@dataclass
class ServerContext:
    """Objects that all handlers share."""

    #: See there.
    state: ServerState
    endpoint: Endpoint
    session: UserSession
    assets: Mapping[str, bytes]  #: Content by name.
    log_error: Callable[[str], None]  #: Called with internal errors.
    sockets: int = 0


def assets() -> dict[str, bytes]:
    """Return all assets of pages, by name."""
    found = {}
    for folder in _FOLDERS:
        for file in files(folder).iterdir():
            if _suffix(file.name) in (".js", ".css", ".svg", ".html"):
                found[file.name] = file.read_bytes()
    return found


def _suffix(name: str) -> str:
    return "." + name.rpartition(".")[2]


class _Handler(RequestHandler):
    """Common part of the handlers of plain requests and sockets."""

    context: ServerContext

    def initialize(self, context: ServerContext) -> None:
        """Store the objects that all handlers share."""
        self.context = context

    def set_default_headers(self) -> None:
        """Set the headers of every answer."""
        self.clear_header("Server")
        for name, value in self.application.settings["endpoint"].headers(self.request.host).items():
            self.set_header(name, value)

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Send the reason in one line."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")

    def log_exception(self, kind: Any, value: BaseException | None, trace: Any) -> None:
        """Report an internal error without the address of the request, which may contain secrets."""
        if not isinstance(value, HTTPError | WebSocketClosedError):
            self.context.log_error("".join(traceback.format_exception(kind, value, trace)))


class Page(_Handler):
    """``/``: the page, and the exchange of a token for a cookie."""

    def get(self) -> None:
        """Answer."""
        self.set_header("Content-Type", _KINDS[".html"])
        session, token = self.context.session, argument_of(self.request, TOKEN)
        page, name = self.context.assets[PAGE], self.context.endpoint.cookie
        if session.admits(token):
            self.set_cookie(name, session.admit(), path="/", httponly=True, samesite="Strict")
            # A browser gets the secret once.
            self.finish(page.replace(_EMPTY, _FILLED % session.secret.encode()))
        else:
            self.finish(page if token is None else _ARRIVED)


class Asset(_Handler):
    """``/assets/NAME``."""

    def get(self, name: str) -> None:
        """Answer with an asset of the list, never with a file by its path."""
        if name not in self.context.assets or name == PAGE:
            raise HTTPError(404)
        self.set_header("Content-Type", _KINDS[_suffix(name)])
        self.finish(self.context.assets[name])


class Download(_Handler):
    """``/download/NAME?run=ID``: files of a run, made on request."""

    async def get(self, name: str) -> None:
        """Answer."""
        toml = self.context.state.kept.cases.get(self.get_query_argument("run", ""))
        if name not in DOWNLOADS or toml is None:
            raise HTTPError(404)
        content = toml.encode() if name == SAVED else await self._made(name, toml)
        self.set_header("Content-Type", _KINDS[_suffix(name)])
        self.set_header("Content-Disposition", f'attachment; filename="{name}"')
        self.finish(content)

    async def _made(self, name: str, toml: str) -> bytes:
        state = self.context.state
        try:
            async with state.downloading:
                order = {"work": name, "case": toml}
                self.job = Job(order, state.rules.longest)
                return await state.pool.do(self.job)
        except Failed as error:
            raise HTTPError(500, reason=str(error).splitlines()[0][:200]) from None
        except GivenUp:
            raise HTTPError(503) from None

    def on_connection_close(self) -> None:
        """Stop the work for a browser that has gone."""
        if (job := getattr(self, "job", None)) is not None:
            self.context.state.pool.stop(job)


class Socket(_Handler, WebSocketHandler):
    """``/socket``: messages from and to a page."""

    session: PageSession | None = None
    free_at = 0.0
    backlog = 0

    def prepare(self) -> None:
        """Refuse a socket beyond the limit."""
        if self.context.sockets >= self.context.state.rules.sockets:
            raise HTTPError(503)

    def open(self, *_: str, **__: str) -> None:
        """Open the session of the page."""
        self.set_nodelay(True)
        self.context.sockets += 1
        self.session = PageSession(self.context.state, self._send, self.context.log_error)
        self.session.open()

    async def on_message(self, message: str | bytes) -> None:
        """Take a message; the next one is not read before this returns."""
        assert self.session is not None
        self.session.receive(message)
        loop, apart = asyncio.get_running_loop(), 1.0 / self.context.state.rules.messages
        self.free_at = max(self.free_at, loop.time() - _BURST) + apart
        if (wait := self.free_at - loop.time()) > 0.0:
            await asyncio.sleep(wait)

    def on_close(self) -> None:
        """Close the session of the page."""
        if self.session is not None:
            self.context.sockets -= 1
            self.session.close()
            self.session = None

    def _send(self, message: str | bytes) -> None:
        """Send without waiting; close the socket of a page that does not read."""
        if self.backlog + len(message) > _BACKLOG:
            self.close(1008, "read what you are sent")
            return
        try:
            sent = self.write_message(message, binary=isinstance(message, bytes))
        except WebSocketClosedError:
            return
        self.backlog += len(message)
        asyncio.ensure_future(sent).add_done_callback(lambda done: self._arrived(done, len(message)))

    def _arrived(self, done: asyncio.Future[None], length: int) -> None:
        self.backlog -= length
        if not done.cancelled():
            done.exception()  # the page has gone


class Nothing(_Handler):
    """Any other address."""

    def prepare(self) -> None:
        """Answer that there is none."""
        raise HTTPError(404)


def application(context: ServerContext) -> Application:
    """Return all routes; access control comes before them."""
    shared = {"context": context}
    return Application(
        [
            (r"/", Page, shared),
            (r"/assets/([A-Za-z0-9_.-]+)", Asset, shared),
            (r"/download/([a-z.]+)", Download, shared),
            (r"/socket", Socket, shared),
        ],
        default_handler_class=Nothing,
        default_handler_args=shared,
        endpoint=context.endpoint,
        log_function=lambda handler: None,
        websocket_max_message_size=LARGEST,
    )
