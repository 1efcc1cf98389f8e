"""A ring of N vanes in the general engine: processor time and memory of the parts of a run.

python -m benchmarks.ring           N = 5 to 80, one drive cycle each
python -m benchmarks.ring 40 1      one ring over one cycle, as JSON

Each vane is that of the built-in case ``vsv-free`` on the same synchronising ring: N + 3 bodies, 2 N + 4
joints, of which N trunnions have clearance. Each N has a process of its own. A part is the processor time of
what it names, and the memory that the process holds after it; peaks are those of the process until then.
Slopes are of log time over log N.
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
from numpy.typing import NDArray

from benchmarks.child import measured

NUMBERS: Final = (5, 10, 20, 40, 80)
MB: Final = 1024.0**2
#: Axial play below, so that no vane slides out of its bore: ``vsv-free`` has a face above alone.
LOWER_PLAY: Final = "50 um"


def case(n: int, cycles: float = 1.0) -> Any:
    """Return the case of a ring of ``n`` vanes."""
    import tribodyn as td
    from tribodyn.core import files

    folder = files("tribodyn.mechanism") / "built_in"
    table = files.parse((folder / "vsv-free.toml").read_text(encoding="utf-8"))
    for name in ("case", "title", "outputs"):
        table.pop(name)
    table["run"] = {"cycles": cycles, "output_interval": "2 ms"}
    vane, pin, trunnion = (
        table[kind].pop(name)
        for kind, name in (("bodies", "vane"), ("joints", "pin"), ("joints", "trunnion"))
    )
    trunnion["clearance"]["axial_lower"] = LOWER_PLAY
    loads, table["loads"] = table["loads"], {}
    for k in range(n):
        turn = _turn(2.0 * np.pi * k / n)
        table["bodies"][f"vane{k}"] = {
            **vane,
            "centre": _place(turn, vane["centre"]),
            "first_axis": turn[:, 0].tolist(),
            "second_axis": turn[:, 1].tolist(),
        }
        for name, joint, other in (("pin", pin, "ring"), ("trunnion", trunnion, "ground")):
            table["joints"][f"{name}{k}"] = {
                **joint,
                "between": [other, f"vane{k}"],
                "point": _place(turn, joint["point"]),
                "axis": (turn @ np.array(joint["axis"], dtype=float)).tolist(),
            }
        for name, load in loads.items():
            along = {"along": f"trunnion{k}"} if "along" in load else {}
            direction = (turn @ np.array(load["direction"], dtype=float)).tolist()
            table["loads"][f"{name}{k}"] = {**load, **along, "body": f"vane{k}", "direction": direction}
    return td.Mechanism(f"Ring of {n} vanes", **table).case()


def _turn(angle: float) -> NDArray[np.float64]:
    """Return the matrix of a turn about the axis of the ring, y."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


def _place(turn: NDArray[np.float64], text: str) -> str:
    """Return a place in mm, turned."""
    place = turn @ np.array([float(part) for part in text.replace("mm", "").split(",")])
    return ", ".join(f"{value:.12g}" for value in place) + " mm"


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


def one(n: int, cycles: float) -> dict[str, dict[str, float]]:
    """Return what the parts of a run of a ring take, compiled code loaded."""
    parts = Parts()
    with parts.part("imports"):
        import tribodyn as td
        from tribodyn.core.linear_algebra import one_thread
        from tribodyn.mechanisms.catalogue import MECHANISMS
        from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart
        from tribodyn.mechanisms.results import summarise
        from tribodyn.results.store import write_run
        from tribodyn.simulation.session import Session

        td.simulate(td.load_case("vsv-free").replace({"run.cycles": 0.01}))
    with parts.part("case"):
        ring = case(n, cycles)
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
    """Measure, print and return; ``quick``: a small ring over a hundredth of a cycle."""
    numbers, cycles = ((3, 5), 0.01) if quick else (NUMBERS, 1.0)
    found = {
        n: json.loads(measured(["-m", "benchmarks.ring", str(n), str(cycles)])["output"]) for n in numbers
    }
    slopes = {}
    print(f"{'part':26s}", *(f"{n:>12d} vanes" for n in numbers), "  slope")
    for name in found[numbers[0]]:
        seconds = [max(found[n][name]["seconds"], 1e-3) for n in numbers]
        slopes[name] = float(np.polyfit(np.log(numbers), np.log(seconds), 1)[0])
        cells = (f"{found[n][name]['seconds']:8.2f} s {found[n][name]['peak [MB]']:5.0f} MB" for n in numbers)
        print(f"{name:26s}", *cells, f"{slopes[name]:7.2f}", flush=True)
    for key in ("simulated [s]", "report [MB]", "result [MB]"):
        print(f"{key:26s}", *(f"{found[n]['whole'][key]:18.2f}" for n in numbers))
    return {"rings": {str(n): parts for n, parts in found.items()}, "slopes": slopes}


if __name__ == "__main__":
    if len(sys.argv) > 2:
        print(json.dumps(one(int(sys.argv[1]), float(sys.argv[2]))))
    else:
        run()
