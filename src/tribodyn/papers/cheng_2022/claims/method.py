"""Claims on the equations and their solution: sections 1, 2.2, 2.3 and 3."""

import json
from typing import Any, Final

import numpy as np

from tribodyn.mechanisms.catalogue import load_case
from tribodyn.papers.cheng_2022.claims.base import NARROW, SLOW, VARIED, Claim, Finding, Trial, above, below
from tribodyn.papers.cheng_2022.runs import smooth

#: Degrees of freedom of the joints of the case ``vsv-joints``; the ball on the pin slides in a slot.
_FREEDOMS: Final = {"revolute": 1, "spherical": 3, "cylindrical": 2, "pin-slot": 4}
_LINK_SPINS: Final = 1  #: The drag link between two balls turns about itself, which is not counted.
_CYCLE: Final = "6.283 s"
_OTHERS: Final = ("bdf", "radau")  #: Solvers that ``mebdf`` is compared with.


def mobility(trial: Trial) -> Finding:
    """Measure the degrees of freedom by Eq. 11, joints counted in the case vsv-joints, less one."""
    case: Any = load_case("vsv-joints")
    freedoms = [_FREEDOMS[joint.type] for joint in case.joints.values()]
    found = 6 * (len(case.bodies) + 1 - len(freedoms) - 1) + sum(freedoms) - _LINK_SPINS
    return Finding(f"M = {found}", float(abs(found - 1)))


def collar_in_balance(trial: Trial) -> Finding:
    """Measure the largest difference of F_cz from G_v over G_v."""
    case: Any = load_case("vsv")
    weight = case.mechanism.vane_mass * case.mechanism.gravity
    off = 100.0 * float(np.abs(smooth(trial.vsv())["F_cz"].values / weight - 1.0).max())
    return Finding(f"up to {off:.3g} % off", off)


def fewer_evaluations(trial: Trial) -> Finding:
    """Measure the evaluations of the right-hand side by mebdf over the fewest of bdf and radau."""
    runs = {
        name: trial.vsv(NARROW, {"solver.name": name, "run.duration": _CYCLE}) for name in ("mebdf", *_OTHERS)
    }
    counts = {name: json.loads(run.attrs["solver"])["rhs_evaluations"] for name, run in runs.items()}
    text = ", ".join(f"{name} {count}" for name, count in counts.items())
    return Finding(text, counts["mebdf"] / min(counts[name] for name in _OTHERS))


#: Claims on equations and solution.
CLAIMS: Final = (
    Claim(
        "tangential damping", ("I2",), "tangential damping may be ignored", "whole",
        above(0.0, by="the paper", since=VARIED),
        reason="neither the paper nor we have a model of it to compare with",
    ),
    Claim(
        "one degree of freedom", ("G1",), "M = 1 by Eq. 11", "whole",
        below(0.5, "off", by="the paper", since=VARIED), mobility, formulations="alike",
    ),
    Claim(
        "F_cz balances G_v", ("B1",), "F_cz is always in balance with G_v", "smooth motion",
        below(5.0, "%", partly=25.0, since=VARIED), collar_in_balance,
        "a pin without friction is loaded normal to itself, and so has a part along Z", margin=True,
    ),
    Claim(
        "MEBDF efficient", ("N1",), "MEBDF is stable and efficient", "whole",
        below(1.0, "times", partly=2.0, by="the paper", since=VARIED), fewer_evaluations, leave=SLOW,
    ),
)  # fmt: skip
