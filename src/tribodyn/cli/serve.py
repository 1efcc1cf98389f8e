"""``tribodyn serve``: the workbench for many, behind a proxy that knows who they are."""

from __future__ import annotations

import re
from argparse import ArgumentParser, Namespace
from typing import Final

from tribodyn.cli.choosing import add_changes, changes, chosen_case
from tribodyn.cli.console import Console, complain
from tribodyn.cli.interrupt import Interruption
from tribodyn.cli.workbench import check_numbers, first_case
from tribodyn.core import fork_server
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given

HELP = "serve the workbench to many, behind a proxy that authenticates them"
_CLOSING: Final = "closing the server"
_PORT: Final = 8000
_HOST: Final = re.compile(r"[a-z0-9]([a-z0-9.-]*[a-z0-9])?(:[0-9]{1,5})?", re.ASCII)


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``serve``."""
    parser.add_argument(
        "hosts",
        metavar="HOST",
        nargs="+",
        help="the public name as browsers have it in their address, such as vanes.example.org",
    )
    parser.add_argument(
        "--case", metavar="CASE", help="a built-in case or a TOML file (default: the first built-in one)"
    )
    add_changes(parser)
    parser.add_argument(
        "--listen",
        metavar="ADDRESS",
        default="127.0.0.1",
        help="where the proxy finds it (default: 127.0.0.1); who else reaches it goes past the proxy",
    )
    parser.add_argument("--port", metavar="N", type=int, default=_PORT, help=f"(default: {_PORT})")
    parser.add_argument(
        "--workers",
        metavar="N",
        type=int,
        help="processes that compute (default: one a processor, at least 2)",
    )


def execute(args: Namespace) -> int:
    """Serve until Ctrl-C."""
    args.case = first_case() if args.case is None else args.case
    fork_server.start(name=args.case, changes=changes(args))
    check_numbers(args)
    for host in args.hosts:
        if not _HOST.fullmatch(host):
            words = f"{as_given(host)}; allowed: a name in small letters, with a port where it is not 443"
            raise InputError(words, key="HOST")
    case = chosen_case(args)
    import asyncio

    from tribodyn.workbench.server import many, public, workers
    from tribodyn.workbench.variant import Origin

    listeners = public(args.listen, args.port)
    port = listeners[0].getsockname()[1]
    console = Console.of(args)
    hosts = ", ".join(f"https://{host}/" for host in args.hosts)
    with Interruption(_CLOSING) as stop:
        served = many(
            Origin(case, args.case, changes(args)),
            listeners,
            frozenset(args.hosts),
            size=args.workers or workers(many=True),
            opened=lambda: console.note(f"serving {args.case} at {args.listen}:{port} for {hosts}"),
            stop=stop,
            log_error=complain,
        )
        asyncio.run(served)
    return 0
