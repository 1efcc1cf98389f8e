"""Claims on the error of the vane with clearance in every joint: section 5.3.

The paper multiplies the error of one joint by seven. Here every joint has its clearance, and each alone, in
the built-in case ``vsv-joints``; the ideal mechanism is the same one without any.
"""

from collections.abc import Iterable
from functools import partial
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import SLOW, STRICT, Claim, Finding, Trial, near, of_instants
from tribodyn.papers.cheng_2022.runs import JOINTS, forward, is_smooth

ONE: Final = "trunnion"  #: The joint that the paper gives a clearance.
SEVEN: Final = 7.0


def errors(trial: Trial, clearance: float, real: Iterable[str] = JOINTS) -> tuple[FloatArray, FloatArray]:
    """Return times [s] and the error of the vane angle [deg] with clearance in some joints."""
    angle, ideal = (
        trial.runs.joints(clearance, joints)["joint_angle"].sel(joint=ONE) for joints in (real, ())
    )
    return angle["time"].values, np.degrees(angle.values - ideal.values)


def means(trial: Trial, clearance: float, real: Iterable[str] = JOINTS) -> tuple[float, float, float]:
    """Return the mean size of the error in smooth motion [deg]: of both directions, forward, back."""
    time, error = errors(trial, clearance, real)
    clock = trial.vsv(clearance)
    quiet = is_smooth(clock, time)
    ahead = np.interp(time, clock["time"].values, forward(clock).astype(float)) > 0.5
    ways = (quiet, quiet & ahead, quiet & ~ahead)
    whole, there, back = (float(np.mean(np.abs(error[way]))) for way in ways)
    return whole, there, back


def angle_error(trial: Trial, clearance: float) -> Finding:
    """Measure the mean size of the angle error with clearance in all joints."""
    whole, there, back = means(trial, clearance)
    alone = {joint: means(trial, clearance, (joint,)) for joint in JOINTS}
    split = ", ".join(f"{joint} {value[0]:.3f}" for joint, value in alone.items())
    total, ahead, behind = (sum(value[way] for value in alone.values()) for way in range(3))
    text = (
        f"{whole:.3f} ° ({there:.3f} forward, {back:.3f} back); each joint alone: {split}, together "
        f"{total:.3f} ({ahead:.3f}, {behind:.3f})"
    )
    return Finding(text, whole)


def factor(trial: Trial, clearance: float) -> Finding:
    """Measure the mean angle error of all joints over that of the trunnion alone."""
    whole, one = means(trial, clearance), means(trial, clearance, (ONE,))
    ratios = [of_all / of_one for of_all, of_one in zip(whole, one, strict=True)]
    return Finding(f"{ratios[0]:.2f} times ({ratios[1]:.2f} forward, {ratios[2]:.2f} back)", ratios[0])


def speed_error(trial: Trial, clearance: float) -> Finding:
    """Measure the size of the speed error with clearance in all joints, over all instants."""
    time, error = errors(trial, clearance)
    return of_instants(time, error, trial.vsv(clearance))


def claims(clearance: float, angle: float, speed: float, sentence: str) -> tuple[Claim, ...]:
    """Return the paper's claims on all joints at a clearance [m], by the errors of one [deg, deg/s]."""
    at = f"{clearance * 1e6:g} µm"
    return (
        Claim(
            f"angle error of all joints, {at}", (sentence,),
            f"at {at} it is about {SEVEN * angle:.3g}° with clearance in all joints", "smooth motion",
            near(SEVEN * angle, "°", STRICT), partial(angle_error, clearance=clearance), reason=_SIZES,
            formulations="exact", leave=SLOW,
        ),
        Claim(
            f"factor of all joints, {at}", (sentence,),
            f"at {at} all joints err seven times as much as one", "smooth motion",
            near(SEVEN, "times", STRICT), partial(factor, clearance=clearance), reason=_FACTOR,
            formulations="exact", leave=SLOW,
        ),
        Claim(
            f"speed error of all joints, {at}", (sentence,),
            f"at {at} it is about {SEVEN * speed:.3g} °/s with clearance in all joints", "smooth motion",
            near(SEVEN * speed, "°/s", STRICT), partial(speed_error, clearance=clearance), reason=_SIZES,
            formulations="exact", leave=SLOW,
        ),
    )  # fmt: skip


_SIZES: Final = "case vsv-joints; sizes of all joints but the trunnion are assumed"
_FACTOR: Final = (
    "Eq. 11 counts six joints, whose errors add up; each but the pin errs more than the trunnion, the guide "
    "of the ring the more the shorter it is assumed"
)
