"""Who may come in: the one gate before all routes, for plain requests and for sockets.

A page of another site that is open in the same browser can make the browser send requests here, but neither
with our name as the host it asks, nor with our cookie, nor, to a socket, without saying where it comes from.
Another user of the machine can send what he likes but knows neither token nor cookie. Should a browser send
him the cookie, it opens nothing without the secret that the page holds.
"""

from __future__ import annotations

import hashlib
import secrets
from dataclasses import dataclass, field
from hmac import compare_digest
from http.cookies import CookieError
from typing import Final, Protocol

from tornado.httputil import HTTPHeaders, HTTPMessageDelegate, HTTPServerRequest, ResponseStartLine
from tornado.routing import Router
from tornado.web import Application

from tribodyn.workbench.visitor import Visitor

TOKEN, SECRET = "token", "secret"
"""Names in addresses: of what the browser is opened with, and of what only the page holds."""
_SHOWN: Final = ("/", "/assets/")
"""How addresses begin of what holds no secret: the page and what it is made of."""
_BYTES: Final = 32
_REFUSED: Final = b"403: this is not for you\n"


class Keyring(Protocol):
    """Who has which key."""

    @property
    def welcoming(self) -> bool:
        """Whether somebody without any key may ask for the page: another one has looked at who it is."""
        ...

    def visitor(self, cookie: str) -> Visitor | None:
        """Return whose cookie it is."""
        ...

    def admits(self, token: str | None) -> bool:
        """Tell whether somebody without a cookie may have one."""
        ...

    def admit(self) -> str:
        """Return the cookie of who was admitted."""
        ...


@dataclass
class OnePerson:
    """One person: a token that is traded once for a cookie.

    Attributes
    ----------
    who
        The person.
    token
        What the browser is opened with.
    """

    who: Visitor
    token: str = field(default_factory=lambda: secrets.token_urlsafe(_BYTES))
    _cookie: str = field(default_factory=lambda: secrets.token_urlsafe(_BYTES))
    _traded: bool = False
    welcoming: bool = False

    def visitor(self, cookie: str) -> Visitor | None:
        """Return the person, if it is their cookie."""
        return self.who if same(cookie, self._cookie) else None

    def admits(self, token: str | None) -> bool:
        """Tell whether this is the token, for the first time."""
        return token is not None and same(token, self.token) and not self._traded

    def admit(self) -> str:
        """Return the cookie; the token is worth nothing from now on."""
        self._traded = True
        return self._cookie


def same(given: str, wanted: str) -> bool:
    """Tell whether two secrets are the same, in a time that does not tell how far they are."""
    first, second = (hashlib.sha256(text.encode("utf-8", "replace")).digest() for text in (given, wanted))
    return compare_digest(first, second)


@dataclass(frozen=True)
class Door:
    """Where the server is reached.

    Attributes
    ----------
    scheme
        ``http``, or ``https`` where a proxy speaks it.
    hosts
        What may stand in the header Host: names with ports, as browsers write them.
    cookie
        Name of the cookie.
    """

    scheme: str
    hosts: frozenset[str]
    cookie: str

    def headers(self, host: str = "") -> dict[str, str]:
        """Return the headers of an answer to who asked for a host by its right name, or of a refusal.

        They name no other host: whoever knows under which name the cookie is kept could have it sent to them.
        """
        socket = "wss" if self.scheme == "https" else "ws"
        connect = f"'self' {socket}://{host}" if host else "'none'"
        return {
            "Content-Security-Policy": (
                "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; "
                f"connect-src {connect}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
            ),
            "X-Content-Type-Options": "nosniff",
            "X-Frame-Options": "DENY",
            "Cross-Origin-Opener-Policy": "same-origin",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Referrer-Policy": "no-referrer",
            "Cache-Control": "no-store",
        }

    def cookie_of(self, request: HTTPServerRequest) -> str:
        """Return the cookie of a request, empty where there is none."""
        try:
            found = request.cookies.get(self.cookie)
        except CookieError:
            return ""
        return "" if found is None else str(found.value)


class Gate(Router):
    """Lets through to the application only requests from our own page.

    Parameters
    ----------
    door
        Where the server is reached.
    keys
        Who may come in.
    application
        What is behind.
    """

    def __init__(self, door: Door, keys: Keyring, application: Application) -> None:
        self.door, self.keys, self.application = door, keys, application

    def find_handler(self, request: HTTPServerRequest, **options: object) -> HTTPMessageDelegate | None:
        """Return what answers a request."""
        if not self._may_pass(request):
            assert request.connection is not None
            return _Refusal(request, self.door)
        return self.application.find_handler(request, **options)

    def _may_pass(self, request: HTTPServerRequest) -> bool:
        headers = request.headers
        host = headers.get("Host", "")
        if request.method != "GET" or host not in self.door.hosts:
            return False
        # A browser says with every upgrade where it comes from, and with what scripts of other sites send.
        origin = headers.get("Origin") or headers.get("Sec-WebSocket-Origin")
        if origin is None and "Upgrade" in headers:
            return False
        if origin is not None and origin != f"{self.door.scheme}://{host}":
            return False
        visitor = self.keys.visitor(self.door.cookie_of(request))
        if visitor is not None:
            return _is_shown(request.path) or same(argument_of(request, SECRET) or "", visitor.secret)
        if request.path != "/" or "Upgrade" in headers:
            return False
        return self.keys.welcoming or self.keys.admits(argument_of(request, TOKEN))


def _is_shown(path: str) -> bool:
    page, assets = _SHOWN
    return path == page or path.startswith(assets)


def argument_of(request: HTTPServerRequest, name: str) -> str | None:
    """Return what the address of a request says under a name, once."""
    values = request.query_arguments.get(name, [])
    return values[0].decode("utf-8", "replace") if len(values) == 1 else None


class _Refusal(HTTPMessageDelegate):
    """The answer to who may not come in."""

    def __init__(self, request: HTTPServerRequest, door: Door) -> None:
        assert request.connection is not None
        self.connection, self.door = request.connection, door
        self.content = None if request.method == "HEAD" else _REFUSED

    def finish(self) -> None:
        """Send it when the request is whole."""
        headers = HTTPHeaders(self.door.headers())
        headers["Content-Type"] = "text/plain; charset=utf-8"
        headers["Content-Length"] = str(len(_REFUSED))
        headers["Connection"] = "close"
        self.connection.write_headers(ResponseStartLine("HTTP/1.1", 403, "Forbidden"), headers, self.content)
        self.connection.finish()
