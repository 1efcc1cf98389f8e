"""Many visitors, of whom a proxy has made sure who they are: each has a cookie, and what is kept for it."""

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
"""What a browser asks with that has shown to have no cookie."""
_BYTES: Final = 32


@dataclass
class _Guest:
    """A visitor, and when it was last seen."""

    visitor: Visitor
    seen: float


@dataclass
class Guests:
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
    welcoming: bool = True
    _guests: OrderedDict[bytes, _Guest] = field(default_factory=OrderedDict)

    def visitor(self, cookie: str) -> Visitor | None:
        """Return whose cookie it is."""
        found = self._guests.get(_digest(cookie))
        if found is None:
            return None
        found.seen = self.clock()
        return found.visitor

    def admits(self, token: str | None) -> bool:
        """Tell whether somebody without a cookie may have one."""
        return token == NEW

    def admit(self) -> str:
        """Return the cookie of a new visitor.

        Raises
        ------
        HTTPError
            503: there is no room for another.
        """
        self._forget()
        if len(self._guests) >= self.most:
            raise HTTPError(503)
        cookie = secrets.token_urlsafe(_BYTES)
        self._guests[_digest(cookie)] = _Guest(Visitor(self.room), self.clock())
        return cookie

    def _forget(self) -> None:
        """Forget visitors who are gone; where there is no more room, who was seen longest ago first."""
        gone = [name for name, guest in self._guests.items() if not guest.visitor.sockets]
        gone.sort(key=lambda name: self._guests[name].seen)
        for name in gone:
            old = self.clock() - self._guests[name].seen > self.stay
            if old or len(self._guests) >= self.most:
                del self._guests[name]


def _digest(cookie: str) -> bytes:
    """Return what a cookie is looked up by, so that the time of a look-up tells nothing about others."""
    return hashlib.sha256(cookie.encode("utf-8", "replace")).digest()
