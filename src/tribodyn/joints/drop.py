"""The bounce test on a bushing: a shaft thrown against it, and the restitution that comes out.

The shaft flies along X, untilted, without friction and loads, from the onset of contact into the bushing
and out again. Other than those of the plate of :mod:`tribodyn.contact.bounce`, its points enter contact one
after the other, each with its own entry velocity.
"""

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.bounce import undamped_depth
from tribodyn.core.errors import InputError
from tribodyn.joints.bushing import BushingJoint, contact_energy, new_memory
from tribodyn.joints.point_contact import SURFACE
from tribodyn.kernels.joints.bushing import update_entry_velocity, wrench
from tribodyn.kernels.joints.pose import F_X, N_WRENCH

_MOST_STEPS: Final = 20_000
#: In σ at the first speed: points that enter contact take the speed at the end of a step.
_LONGEST_STEP: Final = 0.05


@dataclass(frozen=True)
class Drop:
    """Result of one drop of a shaft."""

    restitution: float  #: Speed on leaving the onset over that on arriving [1]; 0 if the shaft sticks.
    peak_force: float  #: Largest contact force [N].
    least_separation: float  #: Smallest gap between the mean planes [m].


def drop(joint: BushingJoint, *, mass: float, speed: float) -> Drop:
    """Throw a shaft of a mass [kg] against its bushing with a speed at the onset of contact [m/s]."""
    from scipy.integrate import DOP853

    data = replace(joint, friction=replace(joint.friction, coefficient=0.0)).data()
    memory, out = new_memory(data), np.empty(N_WRENCH)
    pose = memory.scratch.pose
    onset = onset_eccentricity(joint)

    def motion(_: float, y: FloatArray) -> FloatArray:
        pose.d_x, pose.v_x = y
        wrench(data, memory, pose, out)
        return np.array([y[1], out[F_X] / mass])

    sigma = joint.roughness
    solver = DOP853(
        motion,
        0.0,
        np.array([onset, speed]),
        math.inf,
        rtol=1e-8,
        atol=np.array([1e-9 * sigma, 1e-9 * speed]),  # type: ignore[arg-type]
        max_step=_LONGEST_STEP * sigma / speed,
        first_step=1e-3 * sigma / speed,
    )
    deepest, force = onset, 0.0
    for _ in range(_MOST_STEPS):
        solver.step()
        e, v = solver.y
        if e <= onset:
            # Out there is no force to speak of: the speed at the end of the step is that of leaving.
            return Drop(-float(v) / speed, force, joint.geometry.clearance - deepest)
        pose.d_x, pose.v_x = e, v
        update_entry_velocity(data, memory, pose, 0.0)
        deepest, force = max(deepest, float(e)), max(force, -float(motion(0.0, solver.y)[1]) * mass)
    return Drop(0.0, force, joint.geometry.clearance - deepest)


def onset_eccentricity(joint: BushingJoint) -> float:
    """Return the eccentricity at which contact begins [m]."""
    gap = joint.entry.onset * joint.roughness if joint.contact == SURFACE else 0.0
    if gap >= joint.geometry.clearance:
        raise InputError("in so small a clearance the shaft always touches", key="joint.clearance")
    return joint.geometry.clearance - gap


def design_speed(joint: BushingJoint, *, mass: float, pressure: float) -> float:
    """Return the speed at the onset with which a shaft would reach a pressure without damping [m/s].

    The mass is in kg; the pressure [Pa] is that at the deepest line of a contact over the surface.
    """
    deepest = joint.geometry.clearance - undamped_depth(joint.table, pressure) * joint.roughness
    energy = stored_energy(joint, deepest) - stored_energy(joint, onset_eccentricity(joint))
    if energy <= 0.0:
        raise InputError(f"{pressure:g} Pa are reached above the onset", key="contact.design_pressure")
    return math.sqrt(2.0 * energy / mass)


def stored_energy(joint: BushingJoint, eccentricity: float) -> float:
    """Return the energy stored in the contact of an untilted shaft [J]."""
    y = np.zeros(8)
    y[0] = eccentricity
    return contact_energy(joint.data(), y)
