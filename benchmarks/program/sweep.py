"""How much faster a sweep is on two workers than on one, and how much faster this machine lets it be.

    python -m benchmarks.program.sweep                   # some ten minutes
    python -m benchmarks.program.sweep --blocks          # many points without their whole results, alone

The time is that of ``tribodyn.studies.sweep`` as a whole, from the call to the merged dataset, with all files
and the start and end of its processes: of the first sweep of a process, with points of several lengths, and
of a later one, whose workers are forked from a process that is there already. Beside it stand the command
``tribodyn sweep`` from its start to its end, imports, figures and reports included, and what the machine
gives: the same points in one plain process and in two at once, without files or a start. One and two
take turns, and the shortest time of each counts. Many points keep a line each, and workers get several in one
call: of these, the processor time of a point, and again two workers beside one and plain processes.
"""

from __future__ import annotations

import argparse
import json
import multiprocessing
import subprocess
import sys
import tempfile
import time
from multiprocessing.synchronize import Barrier
from statistics import median
from typing import Any

from tribodyn.cases import Case
from tribodyn.core.platforms import version
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.results.store import FEW_POINTS
from tribodyn.studies import sweep
from tribodyn.studies.work import compute

#: Points of a sweep, and of one in blocks, in whose time the start of workers counts little.
POINTS, MANY = 16, 400
TARGET = 1.8
ROUNDS = 2
#: Drive cycles of a point. The more, the less the start of the workers counts.
TWO, FIFTY = "12.566 s", "314.16 s"
FIRST, LATER, PLAIN, COMMAND = "first sweep", "later sweep", "plain processes", "command"
FIRST_FIFTY = "first sweep, 50 cycles"
#: What is timed; points of two cycles unless it says otherwise.
KINDS = (FIRST, LATER, PLAIN, COMMAND, FIRST_FIFTY)


def case_and_clearances(duration: str, points: int) -> tuple[Case, list[str]]:
    """Return what is swept, and where."""
    case = load_case("vsv").replace({"run.duration": duration})
    return case, [f"{20.0 + 24.0 * i / points:.6g} um" for i in range(points)]


def timed(workers: int, duration: str, points: int = POINTS) -> float:
    """Return the wall time [s] of a sweep of which nothing is known yet."""
    case, clearances = case_and_clearances(duration, points)
    with tempfile.TemporaryDirectory() as folder:
        began = time.perf_counter()
        found = sweep(case, {"joint.clearance": clearances}, workers=workers, directory=folder)
        elapsed = time.perf_counter() - began
    assert found.sizes["joint.clearance"] == points
    assert found.attrs["points_failed"] == 0
    return elapsed


def swept(workers: int, duration: str, rounds: int) -> list[float]:
    """Return the wall times [s] of the first sweeps of a process."""
    command = [sys.executable, "-m", "benchmarks.program.sweep", "--duration", duration]
    command += ["--workers", str(workers), "--rounds", str(rounds)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    seconds: list[float] = json.loads(done.stdout)
    return seconds


def command(workers: int) -> float:
    """Return the wall time [s] of the command."""
    _, clearances = case_and_clearances(TWO, POINTS)
    with tempfile.TemporaryDirectory() as folder:
        said = ["sweep", "vsv", "--set", f"run.duration={TWO}", "--quiet", "-o", folder]
        said += ["--vary", f"joint.clearance={','.join(clearances)}"]
        began = time.perf_counter()
        subprocess.run(
            [sys.executable, "-m", "tribodyn", *said, "--workers", str(workers)],
            stderr=subprocess.DEVNULL,
            check=True,
        )
        return time.perf_counter() - began


def plain(processes: int, duration: str, points: int = POINTS, keep: bool = True) -> float:
    """Return the wall time [s] in which plain processes compute the points, beginning when all are ready."""
    context = multiprocessing.get_context("spawn")
    gate, done = context.Barrier(processes), context.SimpleQueue()
    asked = duration, points, keep
    started = [
        context.Process(target=_computing, args=(i, processes, asked, gate, done)) for i in range(processes)
    ]
    for process in started:
        process.start()
    seconds = [done.get() for _ in started]
    for process in started:
        process.join()
    return float(max(seconds))


def _computing(first: int, step: int, asked: tuple[str, int, bool], gate: Barrier, done: Any) -> None:
    """Compute every so manieth point and send the wall time [s] back."""
    duration, points, keep = asked
    case, clearances = case_and_clearances(duration, points)
    changes = [{"joint.clearance": clearance} for clearance in clearances]
    own = version("tribodyn")
    compute(case, changes[:1], own, keep)
    gate.wait()
    began = time.perf_counter()
    outcomes = compute(case, changes[first::step], own, keep)
    done.put(time.perf_counter() - began)
    assert not any(outcome.failure for outcome in outcomes)


def blocks(rounds: int, points: int = MANY, duration: str = TWO) -> dict[str, Any]:
    """Return, and print, what points cost of which only key results are kept."""
    case, clearances = case_and_clearances(duration, points)
    seconds = []
    for clearance in clearances[:POINTS]:
        began = time.process_time()
        compute(case, [{"joint.clearance": clearance}], version("tribodyn"), keep_result=False)
        seconds.append(time.process_time() - began)
    # The first one loads what all need.
    least, middle = min(seconds[1:]), median(seconds[1:])
    print(f"processor time of a point: {1e3 * least:.0f} ms least, {1e3 * middle:.0f} ms median", flush=True)
    times: dict[str, dict[str, list[float]]] = {"sweep": {"1": [], "2": []}, "plain": {"1": [], "2": []}}
    for workers in (1, 2) * rounds:
        times["sweep"][str(workers)].append(timed(workers, duration, points))
        times["plain"][str(workers)].append(plain(workers, duration, points, keep=False))
    ratios = {kind: min(found["1"]) / min(found["2"]) for kind, found in times.items()}
    told = ", ".join(f"{kind} {ratio:.2f}" for kind, ratio in ratios.items())
    print(f"{points} points in blocks, 2 workers over 1: {told}", flush=True)
    return {"point [s]": {"least": least, "median": middle}, "seconds": times, "ratios": ratios}


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: three points over a moment, without starting workers."""
    if quick:
        few = {"0": [timed(0, "0.1 s", 3)]}
        return {"points": 3, "seconds": few, "blocks": blocks(1, FEW_POINTS + 1, "0.1 s")}
    return measure(ROUNDS)


def measure(rounds: int) -> dict[str, Any]:
    """Return the wall times [s] by what ran and on how many, and the ratios of the shortest, one over two."""
    times: dict[str, dict[str, list[float]]] = {kind: {"1": [], "2": []} for kind in KINDS}
    for number in range(rounds):
        for workers in (1, 2) if number % 2 == 0 else (2, 1):
            first, later = swept(workers, TWO, 2)
            found = {FIRST: first, LATER: later, PLAIN: plain(workers, TWO), COMMAND: command(workers)}
            found[FIRST_FIFTY] = swept(workers, FIFTY, 1)[0]
            for kind, seconds in found.items():
                times[kind][str(workers)].append(seconds)
            told = ", ".join(f"{kind} {seconds:.2f} s" for kind, seconds in found.items())
            print(f"on {workers}: {told}", flush=True)
    ratios = {kind: min(found["1"]) / min(found["2"]) for kind, found in times.items()}
    for kind, ratio in ratios.items():
        print(f"{kind:26s} {POINTS} points on 2 are {ratio:.2f} times as fast as on 1")
    print(f"asked of a sweep: {TARGET}; more than the plain processes no sweep can reach here")
    return {"points": POINTS, "seconds": times, "ratios": ratios, "blocks": blocks(rounds)}


def main(arguments: list[str] | None = None) -> None:
    """Print the times and their ratios."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--duration", default=TWO, help="simulated time of each point, with --workers")
    parser.add_argument("--rounds", type=int, default=ROUNDS, help="how often each is timed")
    parser.add_argument("--workers", type=int, help="only print the times of sweeps on so many, as JSON")
    parser.add_argument("--blocks", action="store_true", help="many points in blocks alone")
    options = parser.parse_args(arguments)
    if options.blocks:
        blocks(options.rounds)
    elif options.workers is not None:
        print(json.dumps([timed(options.workers, options.duration) for _ in range(options.rounds)]))
    else:
        measure(options.rounds)


if __name__ == "__main__":
    main()
