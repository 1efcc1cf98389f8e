"""Access control before all routes, for plain requests and for sockets.

A page of another site that is open in the same browser can make the browser send requests here, but neither
with our name as the host it asks, nor with our cookie, nor, to a socket, without saying where it comes from.
Another user of the machine can send anything but has neither token nor cookie. If a browser sends the cookie
there, it gives no access without the secret of the page.
"""

import hashlib
import secrets
from dataclasses import dataclass, field
from hmac import compare_digest
from http.cookies import CookieError
from typing import Final

from tornado.httputil import HTTPHeaders, HTTPMessageDelegate, HTTPServerRequest, ResponseStartLine
from tornado.routing import Router
from tornado.web import Application

#: Names in addresses: of the token that the browser is opened with, and of the secret of the page.
TOKEN, SECRET = "token", "secret"
_SHOWN: Final = ("/", "/assets/")  #: Beginnings of addresses without secrets: the page and its assets.
_BYTES: Final = 32
_REFUSED: Final = b"403: this page is open in another browser. `tribodyn workbench` opens one for this.\n"


@dataclass
class UserSession:
    """Session of the user: a token that can be exchanged once for a cookie and the secret of the page."""

    #: What the browser is opened with.
    token: str = field(default_factory=lambda: secrets.token_urlsafe(_BYTES))
    #: What a browser sends with every request from then on.
    cookie: str = field(default_factory=lambda: secrets.token_urlsafe(_BYTES))
    #: Held by the pages alone, and part of every request for more than the page. A browser sends a cookie to
    #: every port of the name that it came from, but gives this to pages of this port alone.
    secret: str = field(default_factory=lambda: secrets.token_urlsafe(_BYTES))
    _used: bool = False

    def has(self, cookie: str) -> bool:
        """Return whether this is the cookie."""
        return same(cookie, self.cookie)

    def admits(self, token: str | None) -> bool:
        """Return whether this is the token, at its first use."""
        return token is not None and same(token, self.token) and not self._used

    def admit(self) -> str:
        """Return the cookie; the token is invalid from now on."""
        self._used = True
        return self.cookie


def same(given: str, wanted: str) -> bool:
    """Return whether two secrets are equal, in a time that does not depend on where they differ."""
    first, second = (hashlib.sha256(text.encode("utf-8", "replace")).digest() for text in (given, wanted))
    return compare_digest(first, second)


@dataclass(frozen=True)
class Endpoint:
    """Address of the server."""

    hosts: frozenset[str]  #: What may stand in the header Host: names with ports, as browsers write them.
    cookie: str  #: Name of the cookie.

    def headers(self, host: str = "") -> dict[str, str]:
        """Return the headers of an answer to a request with a valid host, or of a refusal.

        They name no other host: whoever has the name under which the cookie is kept could receive it.
        """
        connect = f"'self' ws://{host}" if host else "'none'"
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


class AccessControl(Router):
    """Passes to the application only requests from the page of this server.

    ``endpoint``: address of the server; ``session``: session of the user; ``application``: answers requests
    that pass.
    """

    def __init__(self, endpoint: Endpoint, session: UserSession, application: Application) -> None:
        self.endpoint, self.session, self.application = endpoint, session, application

    def find_handler(self, request: HTTPServerRequest, **options: object) -> HTTPMessageDelegate | None:
        """Return the handler of a request."""
        if not self._may_pass(request):
            assert request.connection is not None
            return _Refusal(request, self.endpoint)
        return self.application.find_handler(request, **options)

    def _may_pass(self, request: HTTPServerRequest) -> bool:
        headers = request.headers
        host = headers.get("Host", "")
        if request.method != "GET" or host not in self.endpoint.hosts:
            return False
        # A browser states the origin with every upgrade, and with requests by scripts of other sites.
        origin = headers.get("Origin") or headers.get("Sec-WebSocket-Origin")
        if origin is None and "Upgrade" in headers:
            return False
        if origin is not None and origin != f"http://{host}":
            return False
        if self.session.has(self.endpoint.cookie_of(request)):
            return _is_shown(request.path) or same(argument_of(request, SECRET) or "", self.session.secret)
        if request.path != "/" or "Upgrade" in headers:
            return False
        return self.session.admits(argument_of(request, TOKEN))


def _is_shown(path: str) -> bool:
    page, assets = _SHOWN
    return path == page or path.startswith(assets)


def argument_of(request: HTTPServerRequest, name: str) -> str | None:
    """Return the value of an argument in the address of a request, if it occurs once."""
    values = request.query_arguments.get(name, [])
    return values[0].decode("utf-8", "replace") if len(values) == 1 else None


class _Refusal(HTTPMessageDelegate):
    """The answer to a request without access."""

    def __init__(self, request: HTTPServerRequest, endpoint: Endpoint) -> None:
        assert request.connection is not None
        self.connection, self.endpoint = request.connection, endpoint
        self.content = None if request.method == "HEAD" else _REFUSED

    def finish(self) -> None:
        """Send it when the request is whole."""
        headers = HTTPHeaders(self.endpoint.headers())
        headers["Content-Type"] = "text/plain; charset=utf-8"
        headers["Content-Length"] = str(len(_REFUSED))
        headers["Connection"] = "close"
        self.connection.write_headers(ResponseStartLine("HTTP/1.1", 403, "Forbidden"), headers, self.content)
        self.connection.finish()
