"""What is behind the gate: the page, its assets, downloads and the socket."""

from __future__ import annotations

import asyncio
import traceback
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Final

from tornado.web import Application, HTTPError, RequestHandler
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from tribodyn.workbench.bench import DOWNLOADS, Bench
from tribodyn.workbench.crew import Failed, GivenUp, Job
from tribodyn.workbench.desk import Desk
from tribodyn.workbench.gate import TOKEN, Door, Keyring, argument_of
from tribodyn.workbench.guests import NEW
from tribodyn.workbench.messages import LARGEST
from tribodyn.workbench.visitor import Visitor

PAGE: Final = "page.html"
_FOLDERS: Final = ("tribodyn.report.assets", "tribodyn.workbench.assets")
"""Where assets are; of two with one name the later one is served."""
_KINDS: Final = {
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".svg": "image/svg+xml",
    ".html": "text/html; charset=utf-8",
    ".toml": "text/plain; charset=utf-8",
    ".nc": "application/x-netcdf",
}
_ARRIVED: Final = (
    b'<!doctype html><html lang="en"><meta charset="utf-8"><title>tribodyn</title>'
    b'<link rel="icon" href="data:,"><meta http-equiv="refresh" content="0; url=/">'
    b'<p><a href="/">The workbench</a></html>\n'
)
"""A page that goes on to ours: sent on at once, a browser from elsewhere would leave the cookie out."""
_ASK_AGAIN: Final = _ARRIVED.replace(b"url=/", b"url=/?token=" + NEW.encode())
"""A page that asks for itself again: what a link from elsewhere led to was asked without the cookie."""
_EMPTY, _FILLED = b'name="secret" content=""', b'name="secret" content="%s"'
"""Where the page is given its secret, without and with one."""
_BACKLOG: Final = 200_000_000
"""Bytes on their way to a page that does not read them, at most."""
_BURST: Final = 1.0
"""Time for which messages may come as fast as they like [s]."""


@dataclass
class House:
    """What all handlers share.

    Attributes
    ----------
    bench, door, keys
        See there.
    assets
        Content by name.
    complain
        Told of errors of our own.
    """

    bench: Bench
    door: Door
    keys: Keyring
    assets: Mapping[str, bytes]
    complain: Callable[[str], None]
    sockets: int = 0


def assets() -> dict[str, bytes]:
    """Return all that pages may be made of, by name."""
    found = {}
    for folder in _FOLDERS:
        for file in files(folder).iterdir():
            if _suffix(file.name) in (".js", ".css", ".svg", ".html"):
                found[file.name] = file.read_bytes()
    return found


def _suffix(name: str) -> str:
    return "." + name.rpartition(".")[2]


class _Handler(RequestHandler):
    """What plain requests and sockets have in common."""

    house: House

    def initialize(self, house: House) -> None:
        """Take what all handlers share."""
        self.house = house

    def set_default_headers(self) -> None:
        """Set the headers of every answer."""
        self.clear_header("Server")
        for name, value in self.application.settings["door"].headers(self.request.host).items():
            self.set_header(name, value)

    def write_error(self, status_code: int, **kwargs: Any) -> None:
        """Say in a line what is wrong."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")

    def log_exception(self, kind: Any, value: BaseException | None, trace: Any) -> None:
        """Tell of an error of our own, without the address of the request, in which secrets can be."""
        if not isinstance(value, HTTPError | WebSocketClosedError):
            self.house.complain("".join(traceback.format_exception(kind, value, trace)))

    @property
    def visitor(self) -> Visitor:
        """Who asks; the gate has made sure that there is somebody."""
        found = self.house.keys.visitor(self.house.door.cookie_of(self.request))
        if found is None:
            raise HTTPError(403)
        return found


class Page(_Handler):
    """``/``: the page, and the trade of a token for a cookie."""

    def get(self) -> None:
        """Answer."""
        self.set_header("Content-Type", _KINDS[".html"])
        keys, token = self.house.keys, argument_of(self.request, TOKEN)
        known = keys.visitor(self.house.door.cookie_of(self.request)) is not None
        if keys.admits(token):
            cookie = keys.admit()
            self._set_cookie(cookie)
            self.finish(self._page_of(keys.visitor(cookie)))
        elif known:
            self.finish(self.house.assets[PAGE] if token is None else _ARRIVED)
        elif keys.welcoming and token is None:
            self.finish(_ASK_AGAIN)
        else:
            raise HTTPError(403)

    def _page_of(self, visitor: Visitor | None) -> bytes:
        """Return the page with the secret, which a browser is given once."""
        assert visitor is not None
        return self.house.assets[PAGE].replace(_EMPTY, _FILLED % visitor.secret.encode())

    def _set_cookie(self, value: str) -> None:
        secure = self.house.door.scheme == "https"
        self.set_cookie(
            self.house.door.cookie, value, path="/", httponly=True, samesite="Strict", secure=secure
        )


class Asset(_Handler):
    """``/assets/NAME``."""

    def get(self, name: str) -> None:
        """Answer with what stands in the list, and never with a file by its path."""
        if name not in self.house.assets or name == PAGE:
            raise HTTPError(404)
        self.set_header("Content-Type", _KINDS[_suffix(name)])
        self.finish(self.house.assets[name])


class Download(_Handler):
    """``/download/NAME?run=ID``: files of a run, made when they are asked for."""

    async def get(self, name: str) -> None:
        """Answer."""
        toml = self.visitor.cases.get(self.get_query_argument("run", ""))
        if name not in DOWNLOADS or toml is None:
            raise HTTPError(404)
        content = toml.encode() if name == "case.toml" else await self._made(name, toml)
        self.set_header("Content-Type", _KINDS[_suffix(name)])
        self.set_header("Content-Disposition", f'attachment; filename="{name}"')
        self.finish(content)

    async def _made(self, name: str, toml: str) -> bytes:
        bench = self.house.bench
        try:
            async with self.visitor.downloading:
                order = {"work": name, "case": toml}
                self.job = Job(order, bench.rules.longest, budget=self.visitor.budget)
                return await bench.crew.do(self.job)
        except Failed as error:
            raise HTTPError(500, reason=str(error).splitlines()[0][:200]) from None
        except GivenUp:
            raise HTTPError(503) from None

    def on_connection_close(self) -> None:
        """Give up what nobody waits for any more."""
        if (job := getattr(self, "job", None)) is not None:
            self.house.bench.crew.stop(job)


class Socket(_Handler, WebSocketHandler):
    """``/socket``: the conversation with a page."""

    desk: Desk | None = None
    free_at = 0.0
    backlog = 0

    def prepare(self) -> None:
        """Refuse a socket too many."""
        rules = self.house.bench.rules
        if self.house.sockets >= rules.sockets or self.visitor.sockets >= rules.each:
            raise HTTPError(503)

    def open(self, *_: str, **__: str) -> None:
        """Greet the page."""
        self.set_nodelay(True)
        self.guest = self.visitor
        self.house.sockets += 1
        self.guest.sockets += 1
        self.desk = Desk(self.house.bench, self.guest, self._send, self.house.complain)
        self.desk.open()

    async def on_message(self, message: str | bytes) -> None:
        """Take a message; the next one is not read before this returns."""
        assert self.desk is not None
        self.desk.hear(message)
        loop, apart = asyncio.get_running_loop(), 1.0 / self.house.bench.rules.messages
        self.free_at = max(self.free_at, loop.time() - _BURST) + apart
        if (wait := self.free_at - loop.time()) > 0.0:
            await asyncio.sleep(wait)

    def on_close(self) -> None:
        """Forget the page."""
        if self.desk is not None:
            self.house.sockets -= 1
            self.guest.sockets -= 1
            self.desk.close()
            self.desk = None

    def _send(self, message: str | bytes) -> None:
        """Send without waiting; a page that does not read is left."""
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
            done.exception()  # the page has gone: nobody need be told


class Nothing(_Handler):
    """Whatever else is asked for."""

    def prepare(self) -> None:
        """Say that it is not there."""
        raise HTTPError(404)


def application(house: House) -> Application:
    """Return all routes. The gate stands before them."""
    shared = {"house": house}
    return Application(
        [
            (r"/", Page, shared),
            (r"/assets/([A-Za-z0-9_.-]+)", Asset, shared),
            (r"/download/([a-z.]+)", Download, shared),
            (r"/socket", Socket, shared),
        ],
        default_handler_class=Nothing,
        default_handler_args=shared,
        door=house.door,
        log_function=lambda handler: None,
        websocket_max_message_size=LARGEST,
    )
