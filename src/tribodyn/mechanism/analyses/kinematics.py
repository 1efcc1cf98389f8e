"""Kinematic analysis: ideal joints follow the drives; forces follow by inverse dynamics.

Positions and velocities are those that joints and drives allow, freedoms that are left at rest. With the mass
matrix M, the constraints G and the forces Q at that state, accelerations a and reactions λ solve

    M a − Gᵀ λ = Q,   G a = γ,

so that reactions and drive efforts are those that the prescribed motion needs.
"""

from collections.abc import Callable

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import Problem, Solution
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism, in_body_axes, unreached
from tribodyn.mechanism.analyses.superposition import Asked
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.positions import DrivePath, walked


def require_motion(assembly: Assembly) -> None:
    """Refuse a mechanism whose drives prescribe no motion, or one that ideal joints cannot follow.

    Raises InputError if there is no drive by angle, position, speed or velocity; or clearances must take a
    misfit.
    """
    if not any(System(assembly.model.counterpart).drive_rows()):
        words = (
            "no drive prescribes a motion, so there are no positions to analyse; add one that gives an "
            "angle, a position, a speed or a velocity, or run the dynamic analysis"
        )
        raise InputError(words, key="drives")
    require_closing(assembly)


def require_closing(assembly: Assembly) -> None:
    """Refuse a mechanism whose ideal joints cannot follow its drives."""
    if assembly.strain:
        raise InputError(assembly.strain, key="run.analysis")


def follow_drives(
    assembly: Assembly,
    problem: Problem,
    times: FloatArray,
    picture_times: FloatArray,
    progress: Callable[[float], None] | None,
) -> Solution:
    """Return the motion of a mechanism of ideal joints along its drives, with its reactions.

    ``assembly``: of ideal joints; ``times``: rising, from 0 [s], shape (n_t,); ``picture_times``,
    ``progress``: as for :func:`tribodyn.mechanism.assembly.positions.walked`.
    """
    found = IdealMechanism(assembly).follow(times)
    states = in_body_axes(found)

    def known(number: int) -> FloatArray:
        if number >= len(states):
            raise IntegrationFailure(float(times[number]), unreached(times, found))
        return np.asarray(states[number])

    return walked(problem, DrivePath(times), known, picture_times, progress)


def of_drives(mechanism: IdealMechanism) -> Asked:
    """Return a unit rate of each drive, the others at rest, at any position, shape (n_rows, n_drives)."""
    system = mechanism.system
    rows = system.drive_rows()
    unit_rates = np.zeros((len(system.rows), len(rows)))
    for drive, (k, m, _) in enumerate(rows):
        unit_rates[system.rows.index((k, m)), drive] = system.model.joint(k).sign
    return lambda position: unit_rates
