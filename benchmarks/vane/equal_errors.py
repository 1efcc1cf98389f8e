"""The vane mechanism at equal errors: the general engine, the reduced model, the multibody code Exudyn.

    python -m benchmarks equal_errors

``vsv-free`` in the general engine, ``vsv`` in eight states and Exudyn describe one mechanism; faces and the
friction at the collar differ. So each has its error against a run of its own with far closer tolerances or
shorter steps: the median over rows 5 ms apart, of the vane angle and, where it is known, of the place of the
trunnion in its bushing. Root mean squares would tell of the moments after a reversal, when impacts come a
little earlier or later. With a point contact a spring along the axis stands for the faces.

Ratios are of times of the thread at equal errors of the angle, those of the general engine on logarithmic
lines between its tolerances. An error above that of its loosest tolerance is compared with the time of that
one, which favours the other. Times leave out compilation and making the model; they are the least of some,
which others disturb least.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from importlib import resources
from importlib.util import find_spec
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

import tribodyn as td
from benchmarks.vane.peers import EVERY, PART, with_exudyn
from benchmarks.vane.vsv_case import RTOL, one
from tribodyn.core import files
from tribodyn.integrate import integrate
from tribodyn.mechanism.mechanism_variables import observed
from tribodyn.mechanism.system import MechanismSystem

FloatArray = NDArray[np.float64]
Row = dict[str, Any]

GENERAL: Final = (1e-2, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6)
REDUCED: Final = (10.0, 3.0, 1.0, 0.3, 0.1, 0.03)  #: What all tolerances of ``vsv`` are multiplied by.
EXACT: Final = 1e-9
EXACT_REDUCED: Final = 1e-3
STEPS: Final = (1e-3, 5e-4, 2.5e-4, 1.25e-4)
FINEST: Final = 3.125e-5  #: Steps of Exudyn, and that of its reference [s].
#: Spring that holds the vane along its axis in place of its faces.
COLLAR: Final = {
    "between": ["ground", "vane"],
    "first_point": "0, 0, -1 m",
    "second_point": "0, 0, 390 mm",
    "stiffness": "1e6 N/m",
}
PASSES: Final = 3


@dataclass(frozen=True)
class Way:
    """A way to simulate the mechanism."""

    name: str  #: Shown in the table.
    #: ``solve(setting)`` returns the seconds of the thread and, every 5 ms, the vane angle [rad], shape
    #: (n_t,), and the place of the trunnion [m], shape (2, n_t), empty where it is not known.
    solve: Callable[[float], tuple[float, FloatArray, FloatArray]]
    #: Tolerances or steps, and that of the reference.
    settings: Sequence[float]
    finest: float


def case(contact: str, cycles: float) -> Any:
    """Return ``vsv-free`` over some cycles, with the rough contact of its surfaces or a point contact."""
    if contact == "surface":
        return td.load_case("vsv-free").replace({"run.cycles": cycles})
    folder = resources.files("tribodyn.mechanism") / "built_in"
    table = files.parse((folder / "vsv-free.toml").read_text(encoding="utf-8"))
    clearance = table["joints"]["trunnion"]["clearance"]
    for key in ("axial_upper", "flange"):
        del clearance[key]
    clearance["contact"], table["springs"] = "point-lankarani-nikravesh", {"collar": COLLAR}
    table["run"]["cycles"] = cycles
    del table["case"]
    return td.Mechanism(table.pop("title"), **table).case()


def general(contact: str, cycles: float, rtol: float) -> tuple[float, FloatArray, FloatArray]:
    """Run ``vsv-free``."""
    given = case(contact, cycles).replace({"solver.rtol": rtol})
    system = MechanismSystem(given)
    problem, times = system.problem(given.duration), _times(given.duration)
    begin = time.thread_time()
    solution = integrate(problem, rtol=rtol, output_times=times)
    seconds = time.thread_time() - begin
    assert solution.failure is None
    seen = observed(solution.rows[np.searchsorted(solution.t, times - 1e-9)], len(given.bodies)).couplings
    trunnion = list(given.joints).index("trunnion")
    return seconds, seen["joint_angle"][:, trunnion], seen["displacement"][:, trunnion, :2].T


def reduced(cycles: float, factor: float) -> tuple[float, FloatArray, FloatArray]:
    """Run ``vsv``."""
    done = one("mebdf", RTOL * factor, factor, cycles)
    at = np.searchsorted(done["t"], _times(done["duration"]) - 1e-9)
    columns = done["columns"]
    return done["seconds"], columns["theta_v"][at], np.stack([columns["e_x"][at], columns["e_y"][at]])


def exudyn(contact: str, cycles: float, step: float) -> tuple[float, FloatArray, FloatArray]:
    """Run Exudyn."""
    done = with_exudyn(contact, step, cycles)
    at = np.searchsorted(done["t"], _times(cycles * 2.0 * np.pi) - 1e-9)
    return done["seconds"], done["columns"]["theta_v"][at], np.empty((2, 0))


def _times(duration: float) -> FloatArray:
    return np.arange(1, int(duration / EVERY)) * EVERY


def _typical(difference: FloatArray) -> float | None:
    return float(np.median(np.abs(difference))) if difference.size else None


def measured(way: Way, passes: int) -> list[Row]:
    """Return and print time and errors at each setting."""
    _, angle, place = way.solve(way.finest)
    found = []
    for setting in way.settings:
        done = [way.solve(setting) for _ in range(passes)]
        row = {
            "setting": setting,
            "seconds": min(each[0] for each in done),
            "angle": _typical(done[0][1] - angle),
            "place": _typical(done[0][2] - place),
        }
        found.append(row)
        print(f"{way.name:36s} {setting:8.1e} {row['seconds']:8.4f} s", end="")
        known = "" if row["place"] is None else f"   place {row['place']:8.1e} m"
        print(f"   angle {row['angle']:8.1e} rad{known}", flush=True)
    return found


def time_at(rows: Sequence[Row], what: str, error: float) -> float:
    """Return the time [s] at an error, on logarithmic lines between settings and constant beyond them."""
    order = np.argsort([row[what] for row in rows])
    errors, seconds = (np.log([rows[k][key] for k in order]) for key in (what, "seconds"))
    return float(np.exp(np.interp(np.log(error), errors, seconds)))


def _ratios(name: str, ours: list[Row], others: list[Row]) -> list[Row]:
    """Return and print times of the other over those of the general engine at the other's errors."""
    found = []
    for row in others:
        ratio = row["seconds"] / time_at(ours, "angle", row["angle"])
        found.append({"angle": row["angle"], "ratio": ratio})
        print(
            f"at {row['angle']:.1e} rad {name} takes {ratio:.3g} times as long as the general engine, ",
            end="",
        )
        print(f"that {1.0 / ratio:.3g} times as long")
    return found


def run(quick: bool = False) -> dict[str, Any]:
    """Measure, print ratios and return everything; ``quick``: over a moment, for nothing but a trial."""
    whole, part, passes = (0.02, 0.02, 1) if quick else (1.0, PART, PASSES)
    settings = GENERAL[:2] if quick else GENERAL
    rough = measured(Way("vsv-free", partial(general, "surface", whole), settings, EXACT), passes)
    small = measured(Way("vsv", partial(reduced, whole), REDUCED, EXACT_REDUCED), passes)
    found: dict[str, Any] = {"vsv-free": rough, "vsv": small, "ratios": {"vsv": _ratios("vsv", rough, small)}}
    if find_spec("exudyn") is None:
        print("without Exudyn: pip install tribodyn[bench]")
        return found
    for contact, cycles in (("surface", part), ("point", whole)):
        name = f"Exudyn, {contact} contact"
        ours = measured(
            Way(f"vsv-free, {contact} contact", partial(general, contact, cycles), settings, EXACT), passes
        )
        theirs = measured(
            Way(name, partial(exudyn, contact, cycles), STEPS[:1] if quick else STEPS, FINEST), 1
        )
        found |= {f"vsv-free against {contact}": ours, name: theirs}
        found["ratios"][name] = _ratios(name, ours, theirs)
    return found


if __name__ == "__main__":
    run()
