"""The template ``vsv-ring`` with N vanes: processor time and memory of the parts of a run.

python -m benchmarks ring                            rigid and elastic levers, N = 10, 20, 40, one cycle each
python -m benchmarks.mechanisms.ring 40 elastic 1    one ring over one cycle, as JSON

Each vane has a trunnion with clearance, a lever and a pin on the unison ring. Each N has a process of its
own. A part is the processor time of what it names, and the memory that the process holds after it; peaks are
those of the process until then. Slopes are of log time over log N. Asked of 40 vanes: an integration 1.5
times as fast as they move, 1 with elastic levers, slopes up to 1.1, and 400 MB.
"""

from __future__ import annotations

import json
import resource
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

import numpy as np

from benchmarks.child import measured

NUMBERS: Final = (10, 20, 40)
LEVERS: Final = {"rigid": "", "elastic": 'elastic = "beam"\n'}
MB: Final = 1024.0**2


def case(n: int, levers: str, cycles: float) -> Any:
    """Return the case of a ring of ``n`` vanes."""
    from tribodyn.mechanism.descriptor import TEMPLATES
    from tribodyn.mechanisms.catalogue import parse_case

    text = TEMPLATES["vsv-ring"].text.replace(LEVERS["elastic"], LEVERS[levers])
    return parse_case(text, "ring").replace({"pattern.vanes.count": n, "run.cycles": cycles})


class Parts:
    """Processor time and memory of the parts of a run."""

    def __init__(self) -> None:
        self.found: dict[str, dict[str, float]] = {}

    @contextmanager
    def part(self, name: str) -> Iterator[None]:
        """Measure what the block does."""
        begin = time.process_time()
        yield
        status = Path("/proc/self/statm").read_text(encoding="ascii").split()
        self.found[name] = {
            "seconds": time.process_time() - begin,
            "memory [MB]": int(status[1]) * resource.getpagesize() / MB,
            "peak [MB]": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0,
        }


def one(n: int, levers: str, cycles: float) -> dict[str, dict[str, float]]:
    """Return what the parts of a run of a ring take, compiled code loaded."""
    parts = Parts()
    with parts.part("imports"):
        import tribodyn as td
        from tribodyn.core.environment import one_thread
        from tribodyn.mechanisms.catalogue import MECHANISMS
        from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart
        from tribodyn.mechanisms.results import summarise
        from tribodyn.results.store import write_run
        from tribodyn.simulation.session import Session

        td.simulate(td.load_case("vsv-free").replace({"run.cycles": 0.01}))
    with parts.part("case"):
        ring = case(n, levers, cycles)
    mechanism = MECHANISMS["mechanism"]
    session: Any = Session(ring, mechanism, mechanism.system(ring))
    with one_thread(), tempfile.TemporaryDirectory() as folder:
        with parts.part("assembly"):
            session.system.assembly  # noqa: B018  # found once and kept
        with parts.part("start"):
            session.system.start()
        with parts.part("integration"):
            run: FinishedRun = session.integrated(ring.duration)
        with parts.part("rows and checks"):
            gathered = session.system.gather(run)
        del gathered
        with parts.part("rows, checks and dataset"):
            dataset = session.dataset(run, ResultPart())
        del run
        with parts.part("key results"):
            summary = summarise(dataset)
        with parts.part("files"):
            write_run(dataset, folder, summary)
        with parts.part("figures"):
            from tribodyn.report import draw_all, write

            draw_all(dataset, Path(folder) / "figures")
        with parts.part("report"):
            page = write(dataset, folder)
        size = page.stat().st_size / MB
        result = (Path(folder) / "result.nc").stat().st_size / MB
    parts.found["whole"] = {
        "seconds": sum(
            row["seconds"] for name, row in parts.found.items() if name not in ("imports", "rows and checks")
        ),
        "memory [MB]": 0.0,
        "peak [MB]": max(row["peak [MB]"] for row in parts.found.values()),
        "simulated [s]": ring.duration,
        "report [MB]": size,
        "result [MB]": result,
    }
    return parts.found


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print and return; ``quick``: two small rings over a hundredth of a cycle."""
    numbers, cycles = ((2, 3), 0.01) if quick else (NUMBERS, 1.0)
    return {levers: _compared(levers, numbers, cycles) for levers in LEVERS}


def _compared(levers: str, numbers: tuple[int, ...], cycles: float) -> dict[str, Any]:
    """Return, and print, the parts of rings of several sizes."""
    command = ["-m", "benchmarks.mechanisms.ring"]
    found = {
        n: json.loads(measured([*command, str(n), levers, str(cycles)])["output"].splitlines()[-1])
        for n in numbers
    }
    slopes = {}
    print(f"\n{levers + ' levers':26s}", *(f"{n:>12d} vanes" for n in numbers), "  slope")
    for name in found[numbers[0]]:
        seconds = [max(found[n][name]["seconds"], 1e-3) for n in numbers]
        slopes[name] = float(np.polyfit(np.log(numbers), np.log(seconds), 1)[0])
        cells = (f"{found[n][name]['seconds']:8.2f} s {found[n][name]['peak [MB]']:5.0f} MB" for n in numbers)
        print(f"{name:26s}", *cells, f"{slopes[name]:7.2f}", flush=True)
    for key in ("simulated [s]", "report [MB]", "result [MB]"):
        print(f"{key:26s}", *(f"{found[n]['whole'][key]:18.2f}" for n in numbers))
    speeds = [found[n]["whole"]["simulated [s]"] / found[n]["integration"]["seconds"] for n in numbers]
    print(f"{'integration over time':26s}", *(f"{speed:18.2f}" for speed in speeds))
    return {"rings": {str(n): parts for n, parts in found.items()}, "slopes": slopes}


if __name__ == "__main__":
    if len(sys.argv) > 3:
        print(json.dumps(one(int(sys.argv[1]), sys.argv[2], float(sys.argv[3]))))
    else:
        run()
