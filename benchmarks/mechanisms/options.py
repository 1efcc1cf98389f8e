"""What elastic bodies and friction at rest cost: runs with and without them, in turns in one process.

    python -m benchmarks options      # some two minutes

Of each round the runs with and without an option follow each other; the ratio of their processor times is
the median over rounds. Steps are those of the integration and do not vary. The last case is a block on an
incline that holds, beside one that slides for as long.
"""

from __future__ import annotations

import json
import time
from statistics import median
from typing import Any, Final

import tribodyn as td
from tribodyn.cases.case import Case

ROUNDS: Final = 7
BUILT_IN: Final = ("slider-crank", "vsv-joints")
BULK, REST, HOLDS = "elastic bodies", "friction at rest", "holding, beside sliding"
#: Largest ratio of times that is aimed at.
AIMS: Final = {BULK: 1.1, REST: 1.3, HOLDS: 1.0}


def changes(case: Case, option: str) -> dict[str, object]:
    """Return the keys of an option for all joints with clearance, friction or not."""
    if option == REST:
        return {"friction.rest": True}
    real = [name for name, joint in case.joints.items() if joint.clearance is not None]  # type: ignore[attr-defined]
    return {f"joints.{name}.clearance.bulk": "conformal" for name in real}


def incline(coefficient: float, duration: str) -> Case:
    """Return a block on an incline of a fifth, with friction that holds at rest."""
    block = td.Mechanism(
        "Block", gravity="0, 0, -9.81 m/s^2", friction={"rest": True}, run={"duration": duration}
    )
    block.body("block", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    block.prismatic("face", "ground", "block", point="0, 0, 0 mm", axis=[1, 0, -0.2])
    block.friction("rubbing", joint="face", friction_coefficient=coefficient)
    return block.case()


def pairs(*, quick: bool) -> list[tuple[str, str, Case, Case]]:
    """Return name, option and the cases without and with it."""
    found = []
    for name in BUILT_IN:
        case = td.load_case(name)
        case = case.replace({"run.cycles": 0.1}) if quick else case
        none = {key: "none" for key in changes(case, BULK)}
        found.append((name, BULK, case.replace(none), case.replace(changes(case, BULK))))
        found.append((name, REST, case, case.replace(changes(case, REST))))
    duration = "1 s" if quick else "10 s"
    return [*found, ("block on an incline", HOLDS, incline(0.1, duration), incline(0.25, duration))]


def taken(case: Case) -> tuple[float, int]:
    """Return processor time [s] and steps of a run."""
    began = time.process_time()
    result = td.simulate(case)
    assert result.attrs["failure"] == "", result.attrs["failure"]
    return time.process_time() - began, int(json.loads(result.attrs["solver"])["steps"])


def run(*, quick: bool = False) -> dict[str, Any]:
    """Print and return the ratios of times and steps."""
    rows = []
    for name, option, plain, optional in pairs(quick=quick):
        taken(plain), taken(optional)
        rounds = [(taken(plain), taken(optional)) for _ in range(1 if quick else ROUNDS)]
        times = [after[0] / before[0] for before, after in rounds]
        row = {
            "case": name,
            "option": option,
            "time": median(times),
            "times": times,
            "steps": rounds[0][1][1] / rounds[0][0][1],
            "aim": AIMS[option],
        }
        print(
            f"{name}, {option}: {row['time']:.2f} times the time, {row['steps']:.2f} times the steps",
            flush=True,
        )
        rows.append(row)
    return {"rows": rows}
