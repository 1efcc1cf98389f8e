"""Server of one user on this machine."""

import asyncio
import errno
import logging
import os
import secrets
import socket
import tempfile
import webbrowser
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Final

from tornado.httpserver import HTTPServer

from tribodyn.core import platforms
from tribodyn.core.errors import InputError
from tribodyn.workbench.access import TOKEN, AccessControl, Endpoint, UserSession
from tribodyn.workbench.handlers import ServerContext, application, assets
from tribodyn.workbench.server_state import Rules, ServerState
from tribodyn.workbench.variant import Origin
from tribodyn.workbench.work import Limits
from tribodyn.workbench.worker_pool import WorkerPool

ADDRESS: Final = "127.0.0.1"
_ADDRESS_6: Final = "::1"
_ATTEMPTS: Final = 20
_BACKLOG: Final = 128
_NAME_BYTES: Final = 16
_LISTEN: Final = 0.2  #: Time between two looks at whether to stop [s].
_LARGEST_HEADER: Final = 16_384
_WORKERS: Final = 2  #: Workers by default, at least: one for what is dragged, one for what nobody waits for.
_MOST_WORKERS: Final = 4


def workers() -> int:
    """Return the number of workers by default."""
    return min(max(platforms.processors(), _WORKERS), _MOST_WORKERS)


def own_name() -> str:
    """Return a name of this machine that nobody can guess.

    Browsers send a cookie to every port of the name that it came from. Whoever else serves something on this
    machine would be sent ours under a name that he knows. Every name that ends in ``.localhost`` means this
    machine, where browsers do not ask the system.
    """
    return f"{secrets.token_hex(_NAME_BYTES)}.localhost" if platforms.KNOWS_LOCAL_NAMES else ADDRESS


def listening(port: int) -> list[socket.socket]:
    """Return sockets that listen to this machine only, one for each kind of address, at the same port.

    Had somebody else the other address, browsers might take it for ours.

    ``port``: 0 stands for any that is free. Raises InputError if the port cannot be had.
    """
    for attempt in range(1, _ATTEMPTS + 1):
        (first,) = _bound(port, ADDRESS, socket.AF_INET)
        try:
            return [first, *_bound(first.getsockname()[1], _ADDRESS_6, socket.AF_INET6)]
        except InputError:
            first.close()
            if port or attempt == _ATTEMPTS:
                raise
    raise AssertionError


def _bound(port: int, address: str, family: socket.AddressFamily) -> list[socket.socket]:
    """Return a socket that listens; none where there are no such addresses."""
    try:
        made = socket.create_server((address, port), family=family, backlog=_BACKLOG)
    except OSError as error:
        if address == _ADDRESS_6 and error.errno in (errno.EADDRNOTAVAIL, errno.EAFNOSUPPORT):
            return []
        reason = f"port {port} cannot be had: {error.strerror}; allowed: another one, or 0 for any"
        raise InputError(reason, key="--port") from None
    made.setblocking(False)
    return [made]


async def attended(
    origin: Origin,
    listeners: Sequence[socket.socket],
    *,
    size: int,
    opened: Callable[[str], None],
    stop: Callable[[], bool],
    log_error: Callable[[str], None],
    rules: Rules | None = None,
) -> None:
    """Serve one person until ``stop`` is true.

    ``listeners``: from :func:`listening`; ``size``: how many workers; ``opened``: called with the address
    when the server listens; it holds the token; ``stop``: asked several times a second; ``log_error``: called
    with internal errors.
    """
    chosen = rules or Rules()
    port, name = listeners[0].getsockname()[1], own_name()
    endpoint = Endpoint(frozenset((f"{name}:{port}", f"{ADDRESS}:{port}")), f"tribodyn-{port}")
    session = UserSession()
    state = ServerState(origin, WorkerPool(size, Limits()), chosen)
    opened_at = f"http://{name}:{port}/?{TOKEN}={session.token}"
    await serve(state, endpoint, session, listeners, lambda: opened(opened_at), stop, log_error)


async def serve(
    state: ServerState,
    endpoint: Endpoint,
    session: UserSession,
    listeners: Sequence[socket.socket],
    opened: Callable[[], None],
    stop: Callable[[], bool],
    log_error: Callable[[str], None],
) -> None:
    """Serve pages until ``stop`` is true; see :func:`attended`."""
    _silence()
    platforms.give_back_large_blocks()
    context = ServerContext(state, endpoint, session, assets(), log_error)
    server = HTTPServer(
        AccessControl(endpoint, session, application(context)),
        max_header_size=_LARGEST_HEADER,
        max_body_size=0,
        idle_connection_timeout=300,
    )
    server.add_sockets(listeners)
    warm = asyncio.create_task(state.warm())
    try:
        opened()
        while not stop():
            await asyncio.sleep(_LISTEN)
    finally:
        server.stop()
        warm.cancel()
        await state.pool.end()
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
    """Open a file in the user's browser; return whether one was found."""
    try:
        return webbrowser.open(path.as_uri())
    except (OSError, webbrowser.Error):
        return False
