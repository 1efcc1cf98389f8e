"""Numbers of the vane mechanism with clearance in every joint."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np

from measures.base import Numbers
from tribodyn.papers.cheng_2022.claims import all_joints
from tribodyn.papers.cheng_2022.claims.all_joints import ONE, means
from tribodyn.papers.cheng_2022.claims.base import Trial
from tribodyn.papers.cheng_2022.runs import JOINTS, Runs

CLEARANCES: Final = (20, 40)  #: Clearances of the page [µm].


def factor(runs: Runs, clearance: float, guide: object = None) -> str:
    """Return how many times as much all joints err as the trunnion, with a length of the guide."""
    if guide is not None:
        runs = Runs(changes={"vsv-joints": {"joints.guide.clearance.length": guide}})
    return f"{all_joints.factor(Trial(runs, 'exact'), clearance).value:.1f}"


def alone(runs: Runs, clearance: float) -> dict[str, float]:
    """Return the mean angle error of each joint alone [deg]."""
    return {joint: means(Trial(runs, "exact"), clearance, (joint,))[0] for joint in JOINTS}


def of_one(runs: Runs, clearance: float, joint: str) -> str:
    """Return the mean angle error of one joint alone [deg]."""
    return f"{alone(runs, clearance)[joint]:.3f}"


def added(runs: Runs, clearance: float) -> str:
    """Return the sum of the mean angle errors of the joints alone [deg]."""
    return f"{sum(alone(runs, clearance).values()):.3f}"


def together(runs: Runs, clearance: float) -> str:
    """Return the mean angle error of all joints at once [deg]."""
    return f"{means(Trial(runs, 'exact'), clearance)[0]:.3f}"


def seven(runs: Runs, clearance: float) -> str:
    """Return seven times the mean angle error of the trunnion [deg]."""
    return f"{all_joints.SEVEN * alone(runs, clearance)[ONE]:.3f}"


def missed(runs: Runs, ways: slice) -> str:
    """Return by how much the sum of single errors misses that of all, at most [%]."""
    trial, off = Trial(runs, "exact"), []
    for at in CLEARANCES:
        whole = np.array(means(trial, at * 1e-6))
        parts = np.sum([means(trial, at * 1e-6, (joint,)) for joint in JOINTS], axis=0)
        off.append(np.abs(parts / whole - 1.0)[ways].max())
    return f"{100.0 * max(off):.1f}"


def over_trunnion(runs: Runs, joint: str) -> str:
    """Return the error of a joint over that of the trunnion at 20 µm."""
    errors = alone(runs, 20e-6)
    return f"{errors[joint] / errors[ONE]:.1f}"


def without_guide(runs: Runs, clearance: float) -> str:
    """Return how many times as much all joints but the guide err as the trunnion."""
    others = tuple(joint for joint in JOINTS if joint != "guide")
    return f"{means(Trial(runs, 'exact'), clearance, others)[0] / alone(runs, clearance)[ONE]:.1f}"


#: Numbers by name.
NUMBERS: Final[Numbers] = {
    **{
        f"factor of all joints but the guide, {at} µm": partial(without_guide, clearance=at * 1e-6)
        for at in CLEARANCES
    },
    **{f"factor of all joints, {at} µm": partial(factor, clearance=at * 1e-6) for at in CLEARANCES},
    **{
        f"factor of all joints, {at} µm, guide of {length}": partial(
            factor, clearance=at * 1e-6, guide=length
        )
        for at in CLEARANCES
        for length in ("5 mm", "10 mm", "20 mm", "40 mm")
    },
    **{
        f"error of {joint}, {at} µm [deg]": partial(of_one, clearance=at * 1e-6, joint=joint)
        for at in CLEARANCES
        for joint in JOINTS
    },
    **{
        f"{name}, {at} µm [deg]": partial(measure, clearance=at * 1e-6)
        for at in CLEARANCES
        for name, measure in (
            ("errors added", added),
            ("error of all joints", together),
            ("seven times the trunnion", seven),
        )
    },
    "errors do not add, both directions [%]": partial(missed, ways=slice(0, 1)),
    "errors do not add, each direction [%]": partial(missed, ways=slice(1, 3)),
    **{f"{joint} over trunnion": partial(over_trunnion, joint=joint) for joint in ("crank-pivot", "guide")},
}
