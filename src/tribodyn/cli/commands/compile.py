"""``tribodyn compile``: compile the equations of cases before their first run."""

from __future__ import annotations

import time
from argparse import ArgumentParser, Namespace
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

from tribodyn.cli.console import Console, show_json
from tribodyn.cli.progress import CASES, progress
from tribodyn.core.errors import TribodynError
from tribodyn.core.platforms import processors

if TYPE_CHECKING:
    from tribodyn.cases import Case

HELP = "compile the equations of cases ahead of their first run"
EXAMPLE = "tribodyn compile slider-crank.toml"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the arguments of ``compile``."""
    parser.add_argument(
        "cases",
        metavar="CASE",
        nargs="*",
        help="a built-in case or a TOML file (default: all built-in cases, which are of every kind)",
    )


def execute(args: Namespace) -> int:
    """Compile the missing kernels; report the time of each case."""
    from mebdf.compiled.cache import folder
    from tribodyn.kernels.jit import SOURCES
    from tribodyn.mechanisms.catalogue import built_in, load_case

    console = Console.of(args)
    cases = {name: load_case(name) for name in args.cases or built_in()}
    kept = folder(SOURCES)
    if kept is None:
        raise TribodynError("compiled equations cannot be kept: no folder for caches can be written to")
    seconds = _compile(cases, console)
    if args.json:
        show_json({"folder": str(kept), "seconds": seconds})
        return 0
    for name in cases:
        console.say(
            f"{name}: " + (f"compiled in {seconds[name]:.0f} s" if name in seconds else "was compiled")
        )
    console.say(f"compiled equations are kept in {kept}")
    return 0


def _compile(cases: dict[str, Case], console: Console) -> dict[str, float]:
    """Compile cases on all processors; return the times [s] of those that were not compiled."""
    from tribodyn.simulation import load_equations, prepare
    from tribodyn.simulation.compilation import PROCESSES

    missing = {name: case for name, case in cases.items() if not load_equations(case)}
    seconds: dict[str, float] = {}
    if not missing:
        return seconds
    with (
        progress(len(missing), console, CASES) as shown,
        ThreadPoolExecutor(max(processors() // PROCESSES, 1)) as pool,
    ):
        shown.note(f"compiling the equations of {', '.join(missing)}")
        for name, taken in zip(missing, pool.map(_compiled, missing.values()), strict=True):
            prepare(missing[name])
            seconds[name] = taken
            shown(len(seconds))
    return seconds


def _compiled(case: Case) -> float:
    """Compile a case in other processes and return how long it took [s]."""
    from tribodyn.simulation.compilation import compile_elsewhere

    began = time.monotonic()
    compile_elsewhere(case)
    return time.monotonic() - began
