"""Sessions of many visitors whom a proxy has authenticated: each has a cookie and its own stored runs."""

from __future__ import annotations

import hashlib
import secrets
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

from tornado.web import HTTPError

from tribodyn.workbench.visitor import Visitor

NEW: Final = "new"
"""Token of a browser that has shown to have no cookie."""
_BYTES: Final = 32


@dataclass
class _Session:
    """A visitor, and when it was last active."""

    visitor: Visitor
    seen: float


@dataclass
class Sessions:
    """Visitors by their cookies.

    Attributes
    ----------
    room
        Size of the frames kept for each [bytes].
    most
        How many there may be.
    stay
        Time after which one without an open page may be forgotten [s].
    clock
        Returns the time [s].
    """

    room: int
    most: int = 100
    stay: float = 3600.0
    clock: Callable[[], float] = time.monotonic
    authenticated_elsewhere: bool = True
    _sessions: OrderedDict[bytes, _Session] = field(default_factory=OrderedDict)

    def visitor(self, cookie: str) -> Visitor | None:
        """Return whose cookie it is."""
        found = self._sessions.get(_digest(cookie))
        if found is None:
            return None
        found.seen = self.clock()
        return found.visitor

    def admits(self, token: str | None) -> bool:
        """Return whether a browser without a cookie may have one."""
        return token == NEW

    def admit(self) -> str:
        """Return the cookie of a new visitor.

        Raises
        ------
        HTTPError
            503: there is no room for another.
        """
        self._forget()
        if len(self._sessions) >= self.most:
            raise HTTPError(503)
        cookie = secrets.token_urlsafe(_BYTES)
        self._sessions[_digest(cookie)] = _Session(Visitor(self.room), self.clock())
        return cookie

    def _forget(self) -> None:
        """Remove sessions without an open page: expired ones, and the oldest if there is no room."""
        gone = [name for name, session in self._sessions.items() if not session.visitor.sockets]
        gone.sort(key=lambda name: self._sessions[name].seen)
        for name in gone:
            old = self.clock() - self._sessions[name].seen > self.stay
            if old or len(self._sessions) >= self.most:
                del self._sessions[name]


def _digest(cookie: str) -> bytes:
    """Return the key of a cookie: the time of a look-up reveals nothing about other cookies."""
    return hashlib.sha256(cookie.encode("utf-8", "replace")).digest()
