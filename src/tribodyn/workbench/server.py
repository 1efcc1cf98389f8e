"""The server of one person: it listens to this machine only."""

from __future__ import annotations

import asyncio
import logging
import os
import socket
import tempfile
import webbrowser
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from tornado.httpserver import HTTPServer
from tornado.netutil import bind_sockets

from tribodyn.core import machine
from tribodyn.core.errors import InputError
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.workbench.bench import Bench, Rules
from tribodyn.workbench.crew import Crew
from tribodyn.workbench.gate import TOKEN, Door, Gate, Keyring, OnePerson
from tribodyn.workbench.handlers import House, application, assets
from tribodyn.workbench.variant import Origin
from tribodyn.workbench.visitor import Visitor
from tribodyn.workbench.worker import Limits

ADDRESS: Final = "127.0.0.1"
NAMES: Final = ("127.0.0.1", "localhost")
"""What a browser of this machine may call it."""
_LISTEN: Final = 0.2
"""Time between two looks at whether to stop [s]."""
_LARGEST_HEADER: Final = 16_384
_WORKERS: Final = 2
"""Workers by default, at least: one for what is dragged, one for what nobody waits for."""
_MOST_WORKERS: Final = 4


def workers() -> int:
    """Return how many workers one person gets by default."""
    return min(max(machine.processors(), _WORKERS), _MOST_WORKERS)


def listening(port: int, address: str = ADDRESS) -> socket.socket:
    """Return a socket that listens, by default to this machine only; port 0 stands for any that is free.

    Raises
    ------
    InputError
        The port cannot be had.
    """
    try:
        return bind_sockets(port, address, family=socket.AF_INET)[0]
    except OSError as error:
        reason = f"port {port} cannot be had: {error.strerror}; allowed: another one, or 0 for any"
        raise InputError(reason, key="--port") from None


async def attended(
    origin: Origin,
    listener: socket.socket,
    *,
    size: int,
    opened: Callable[[str], None],
    stop: Callable[[], bool],
    complain: Callable[[str], None],
    rules: Rules | None = None,
) -> None:
    """Serve one person until ``stop`` is true.

    Parameters
    ----------
    origin
        The case.
    listener
        From :func:`listening`.
    size
        How many workers.
    opened
        Called with the address when the server listens; it holds the token.
    stop
        Asked several times a second.
    complain
        Told of errors of our own.
    """
    chosen = rules or Rules()
    port = listener.getsockname()[1]
    door = Door("http", frozenset(f"{name}:{port}" for name in NAMES), f"tribodyn-{port}")
    person = OnePerson(Visitor(chosen.room))
    bench = Bench(origin, MECHANISMS[origin.case.kind()], Crew(size, Limits()), chosen)
    opened_at = f"http://{ADDRESS}:{port}/?{TOKEN}={person.token}"
    await serve(bench, door, person, listener, lambda: opened(opened_at), stop, complain)


async def serve(
    bench: Bench,
    door: Door,
    keys: Keyring,
    listener: socket.socket,
    opened: Callable[[], None],
    stop: Callable[[], bool],
    complain: Callable[[str], None],
) -> None:
    """Serve whoever has a key, until ``stop`` is true; see :func:`attended`."""
    _silence()
    house = House(bench, door, keys, assets(), complain)
    server = HTTPServer(
        Gate(door, keys, application(house)),
        max_header_size=_LARGEST_HEADER,
        max_body_size=0,
        idle_connection_timeout=300,
    )
    server.add_socket(listener)
    warm = asyncio.create_task(bench.warm())
    try:
        opened()
        while not stop():
            await asyncio.sleep(_LISTEN)
    finally:
        server.stop()
        warm.cancel()
        await bench.crew.end()
        await server.close_all_connections()


def _silence() -> None:
    """Keep addresses out of all logs: a token can stand in one."""
    logger = logging.getLogger("tornado")
    logger.addHandler(logging.NullHandler())
    logger.propagate = False


@contextmanager
def pointer(address: str) -> Iterator[Path]:
    """Have a file for the eyes of this user that sends a browser to an address.

    A command line could be read by all users of the machine.
    """
    handle, name = tempfile.mkstemp(suffix=".html", prefix="tribodyn-")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(
                '<!doctype html><meta charset="utf-8"><meta name="referrer" content="no-referrer">'
                f'<meta http-equiv="refresh" content="0; url={address}"><title>tribodyn</title>\n'
            )
        yield Path(name)
    finally:
        with suppress(OSError):
            os.unlink(name)


def open_browser(path: Path) -> bool:
    """Open a file in the user's browser; tell whether one was found."""
    try:
        return webbrowser.open(path.as_uri())
    except (OSError, webbrowser.Error):
        return False
