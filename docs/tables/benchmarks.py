"""Tables of times: what ``python -m benchmarks`` found, as it is stored in ``docs/_static``."""

from __future__ import annotations

import csv
from typing import Final

from tables.markdown import STATIC, Found, Lines, head, row, seconds, stored

SOURCE: Final = STATIC / "benchmarks.json"
KERNEL_GRID: Final = "256 × 32"

#: Name of a peer, what is aimed at, and the least ratio of times.
AIMS: Final = (
    ("bdf", "10 times as fast as SciPy's BDF with the same compiled functions", 10.0),
    ("BDF, NumPy", "25 times as fast as SciPy's BDF with NumPy", 25.0),
    ("cvode-native", "no slower than CVODE called natively", 1.0),
    ("Exudyn, point contact", "10 times as fast as Exudyn with its point contact", 10.0),
    ("Exudyn, surface contact", "100 times as fast as Exudyn with our surface contact", 100.0),
)


def verdict(text: str, kept: bool) -> str:
    """Return a number, marked where it misses its goal."""
    return text if kept else f"**{text}**"


def goals(found: Found) -> Lines:
    """Give what is aimed at, and what was measured; what is missed is bold."""
    yield from head("aim", "measured")
    kernel, vsv, command = found["joint_kernel"][KERNEL_GRID], found["vsv"], found["command"]
    per_node = 1e3 * kernel["with Jacobian"] / kernel["nodes in contact"]
    speed, default = vsv["speed"]["median"], vsv["runs"][0]
    yield row(
        f"joint kernel with Jacobian, {KERNEL_GRID}: at most 15 ns a node in contact",
        verdict(f"{per_node:.1f} ns", per_node <= 15.0),
    )
    yield row("two cycles: 60 times as fast as the mechanism", verdict(f"{speed:.0f} times", speed >= 60.0))
    yield row(
        "accuracy: vane angle 1e-5° and contact force 0.5 % far from reversals, angle 5e-5° before",
        verdict(
            f"{default['angle']:.0e}°, {100 * default['force']:.2g} %, {default['angle 50-100 ms']:.0e}°",
            default["accurate"],
        ),
    )
    for name, aim, least in AIMS:
        for peer in vsv["peers"]:
            if peer["name"] == name:
                ratio = verdict(f"{peer['ratio']:.3g} times", peer["ratio"] >= least)
                yield row(aim, f"{ratio} ({peer['setting']})")
    many = found["long_run"]["400"]
    yield row("400 cycles one by one in 90 s", verdict(f"{many['seconds']:.0f} s", many["seconds"] < 90.0))
    growth = many["peak memory [MB]"] - found["long_run"]["10"]["peak memory [MB]"]
    more, rows = max(0.0, growth), many["result [MB]"]
    yield row(
        "no more memory for 400 cycles than for 10", f"{more:.0f} MB more, for a result of {rows:.0f} MB"
    )
    for name, key, most in (
        ("help", "seconds", 0.5),
        ("second run", "seconds", 15.0),
        ("first run", "seconds", 20.0),
    ):
        taken = command[name][key]
        yield row(f"command line, {name}: {most:g} s", verdict(seconds(taken), taken < most))
    memory = command["second run"]["peak memory [MB]"]
    yield row("peak memory of a run: 600 MB", verdict(f"{memory:.0f} MB", memory < 600.0))
    if "sweep" in found:
        ratios = found["sweep"]["ratios"]
        lengths = [(2, "first sweep"), (50, "first sweep, 50 cycles")]
        measured = [
            f"{verdict(f'{ratios[name]:.2f} times', ratios[name] >= 1.8)} with points of {cycles} cycles"
            for cycles, name in lengths
        ]
        yield row("sweep of 16 points, 2 workers 1.8 times as fast as 1", ", ".join(measured))


def kernel(found: Found) -> Lines:
    """Give the joint kernels over the grid."""
    yield from head("grid", "nodes in contact", "wrench [ns]", "with Jacobian [ns]", "NumPy / wrench")
    for grid, value in found["joint_kernel"].items():
        if not isinstance(value, dict):
            continue
        nodes_in = value["nodes in contact"]
        wrench, jacobian = (1e3 * value[name] / nodes_in for name in ("wrench", "with Jacobian"))
        ratio = value["numpy"] / value["wrench"]
        yield row(grid, f"{nodes_in:.0f}", f"{wrench:.1f}", f"{jacobian:.1f}", f"{ratio:.0f}")


def integrators(found: Found) -> Lines:
    """Give the runs at falling tolerances."""
    yield from head(
        "integrator",
        "`rtol`",
        "`atol`",
        "steps",
        "right-hand sides",
        "time",
        "angle",
        "force",
        "accurate enough",
    )
    for run in found["vsv"]["runs"]:
        yield row(
            f"`{run['solver']}`",
            f"{run['rtol']:.0e}",
            f"× {run['atol']:g}",
            f"{run['steps']}",
            f"{run['rhs']}",
            f"{run['seconds']:.2f} s",
            f"{run['angle']:.0e}°",
            f"{run['force']:.0e}",
            "yes" if run["accurate"] else "no",
        )


def peers(found: Found) -> Lines:
    """Give the ratios of times from alternated pairs."""
    yield from head("peer", "tolerances or step", "over", "time / MEBDF", "range", "error of the angle")
    for peer in found["vsv"]["peers"]:
        yield row(
            peer["name"],
            peer["setting"],
            f"{peer['cycles']:g} cycles",
            f"{peer['ratio']:.3g}",
            f"{peer['least']:.3g} to {peer['most']:.3g}",
            f"{peer['angle']:.0e}°",
        )


def tolerances(found: Found) -> Lines:
    """Give what accuracy costs, with the ratio of each time to that of the tolerance before."""
    yield from head(
        "`rtol`", "alone: time", "steps", "angle", "force", "with absolute: time", "steps", "angle", "force"
    )
    by = {(run["changed"], run["rtol"]): run for run in found["vsv"]["tolerances"]}
    before: dict[str, float] = {}
    for rtol in sorted({rtol for _, rtol in by}, reverse=True):
        cells = [f"{rtol:.0e}"]
        for what in ("rtol", "all"):
            run = by[what, rtol]
            times = f" (× {run['seconds'] / before[what]:.2f})" if what in before else ""
            before[what] = run["seconds"]
            cells += [
                f"{run['seconds']:.2f} s{times}",
                f"{run['steps']}",
                f"{run['angle']:.0e}°",
                f"{run['force']:.0e}",
            ]
        yield row(*cells)


def mechanism(found: Found) -> Lines:
    """Give the free slider-crank by us and by Exudyn."""
    yield from head("program", "tolerance or step", "time", "error of the slider's place")
    for name in ("ours", "exudyn"):
        for run in found["mechanism"][name]:
            time, error = f"{1e3 * run['seconds']:.0f} ms", f"{1e6 * run['error']:.2g} µm"
            yield row("tribodyn" if name == "ours" else "Exudyn", run["setting"], time, error)


def equal_errors(found: Found) -> Lines:
    """Give times at equal errors over those of the general engine."""
    yield from head("beside `vsv-free`", "error of the vane angle", "time over ours")
    for name, ratios in found["equal_errors"]["ratios"].items():
        for value in ratios:
            yield row(name, f"{value['angle']:.0e} rad", f"{value['ratio']:.2g}")


def film(found: Found) -> Lines:
    """Give the film solver beside a general sparse one."""
    yield from head("journal", "structured", "SuperLU", "ratio", "difference of forces")
    for name in ("no tilt", "tilt"):
        value = found["film"][name]
        ours, theirs = value["ours [ms]"], value["SuperLU [ms]"]
        yield row(
            name, f"{ours:.2f} ms", f"{theirs:.1f} ms", f"{value['ratio']:.1f}", f"{value['difference']:.0e}"
        )


def growth(found: Found) -> Lines:
    """Give cost over grid, clearance and number of cycles."""
    yield from head("what grows", "size", "time", "steps", "right-hand sides")
    for what in ("grid", "clearance", "cycles"):
        for value in found["growth"][what]:
            yield row(
                what, value["name"], f"{value['seconds']:.3f} s", f"{value['steps']}", f"{value['rhs']}"
            )


def command(found: Found) -> Lines:
    """Give what the command line takes."""
    yield from head("command", "clock", "processor", "peak memory")
    for name, title in (
        ("help", "`tribodyn --help`"),
        ("first run", "`tribodyn run vsv`, the first ever, in an empty home"),
        ("second run", "`tribodyn run vsv` after that, figures and report included"),
    ):
        value = found["command"][name]
        clock, processor = value["seconds"], value["processor seconds"]
        yield row(title, seconds(clock), seconds(processor), f"{value['peak memory [MB]']:.0f} MB")


def sweep(found: Found) -> Lines:
    """Give what 16 points take on one worker and on two."""
    yield from head("16 points", "cycles a point", "on 1", "on 2", "ratio")
    for name, title, cycles in (
        ("first sweep", "`studies.sweep`, the first of a process", 2),
        ("first sweep, 50 cycles", "the same", 50),
        ("later sweep", "a later sweep of the process", 2),
        ("plain processes", "plain processes, without files and start", 2),
        ("command", "`tribodyn sweep`, imports, figures and reports included", 2),
    ):
        one, two = (min(found["sweep"]["seconds"][name][workers]) for workers in ("1", "2"))
        yield row(title, str(cycles), f"{one:.1f} s", f"{two:.1f} s", f"{one / two:.2f}")


def machines(found: Found) -> Lines:
    """Give where and how undisturbed the benchmarks were run."""
    yield from head("benchmark", "measured on", "programs running before it began (load)")
    for name, value in found.items():
        yield row(f"`{name}`", value["on"], f"{value['load']:.1f}")


def options() -> Lines:
    """Give times with other options of LLVM over those of the library as it is built."""
    with (STATIC / "llvm_options.csv").open(encoding="utf-8", newline="") as file:
        first, *lines = csv.reader(file)
    yield from head(*(f"`{name}`" if name not in ("options", "MB") else name for name in first))
    yield from (
        row(name, size, *(f"{float(ratio):.2f}" for ratio in ratios)) for name, size, *ratios in lines
    )


#: Tables by name.
TABLES: Final = {"options": options} | {
    table.__name__: stored(SOURCE, table)
    for table in (
        goals,
        kernel,
        integrators,
        peers,
        tolerances,
        mechanism,
        equal_errors,
        film,
        growth,
        command,
        sweep,
        machines,
    )
}
