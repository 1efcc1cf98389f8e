"""``tribodyn workbench``: a page on this machine that runs a case while its values are turned."""

import sys
import threading
from argparse import ArgumentParser, Namespace
from contextlib import ExitStack
from typing import Final

from tribodyn.cli.console import Console, complain, show_json
from tribodyn.cli.interrupt import Interruption
from tribodyn.cli.options import add_case_arguments, changes, chosen_case
from tribodyn.core import fork_server
from tribodyn.core.errors import InputError

HELP = "open a page with sliders for the values of a case and live plots"
EXAMPLE = "tribodyn workbench slider-crank --set joints.wrist.clearance.radial='25 um'"
_CLOSING: Final = "closing the workbench"
_PORTS: Final = 65535
_MOST_WORKERS: Final = 256


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``workbench``."""
    add_case_arguments(parser, required=False)
    parser.add_argument(
        "--port", metavar="N", type=int, default=0, help="where it listens (default: any that is free)"
    )
    parser.add_argument(
        "--workers", metavar="N", type=int, help="processes that compute (default: one a processor, 2 to 4)"
    )
    parser.add_argument(
        "--no-browser",
        dest="browser",
        action="store_false",
        help="print the address with its key, which can be used once, instead of opening a browser",
    )


def execute(args: Namespace) -> int:
    """Serve the page until Ctrl-C."""
    args.case = first_case() if args.case is None else args.case
    fork_server.start(name=args.case, changes=changes(args))
    check_numbers(args)
    case = chosen_case(args)
    import asyncio

    from tribodyn.workbench.server import attended, listening, workers
    from tribodyn.workbench.variant import Origin

    listeners = listening(args.port)
    with Interruption(_CLOSING) as stop, ExitStack() as stack:
        served = attended(
            Origin(case, args.case, changes(args)),
            listeners,
            size=args.workers or workers(),
            opened=lambda address: _show(address, args, stack),
            stop=stop,
            log_error=complain,
        )
        asyncio.run(served)
    return 0


def _show(address: str, args: Namespace, stack: ExitStack) -> None:
    """Open the page, or say where it is; what is needed for that lasts as long as the stack."""
    from tribodyn.workbench.server import open_browser, pointer

    console = Console.of(args)
    console.note(f"the workbench of {args.case} is at {address.partition('?')[0]}; Ctrl-C ends it")
    if args.json:
        show_json({"address": address})
        sys.stdout.flush()
        return
    if not args.browser:
        print(f"open {address}", flush=True)
        return
    file = stack.enter_context(pointer(address))

    def show() -> None:
        if not open_browser(file):
            print(f"no browser was found; open {address}", flush=True)

    # Some browsers keep who opens them waiting.
    threading.Thread(target=show, daemon=True).start()


def first_case() -> str:
    """Return the name of the first built-in case."""
    from tribodyn.mechanisms.catalogue import built_in

    return next(iter(built_in()))


def check_numbers(args: Namespace) -> None:
    """Refuse a port or a number of workers that there cannot be."""
    if not 0 <= args.port <= _PORTS:
        raise InputError(f"given {args.port}; allowed: 0 to {_PORTS}", key="--port")
    if args.workers is not None and not 1 <= args.workers <= _MOST_WORKERS:
        raise InputError(f"given {args.workers}; allowed: 1 to {_MOST_WORKERS}", key="--workers")
