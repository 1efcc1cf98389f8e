"""Kinematic analysis: ideal joints follow the drives; forces follow by inverse dynamics.

Positions and velocities are those that joints and drives allow, freedoms that are left at rest. With the mass
matrix M, the constraints G and the forces Q at that state, accelerations a and reactions λ solve

    M a − Gᵀ λ = Q,   G a = γ,

so that reactions and drive efforts are those that the prescribed motion needs.
"""

from collections.abc import Callable, Sequence

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError, IntegrationFailure
from tribodyn.core.problem import Problem, Solution
from tribodyn.mechanism.analyses.ideal_motion import IdealMechanism, in_body_axes, unreached
from tribodyn.mechanism.analyses.superposition import responses
from tribodyn.mechanism.assembly.assembly import Assembly
from tribodyn.mechanism.assembly.closing import System
from tribodyn.mechanism.assembly.output_values import Output
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


def velocity_ratios(assembly: Assembly, outputs: Sequence[Output], times: FloatArray) -> FloatArray:
    """Return the rates of outputs for a unit rate of each drive, the others at rest.

    ``outputs``: of it; ``times``: rising, from 0 [s], shape (n_t,). Returns in the units of output and drive,
    shape (n_t, n_outputs, n_drives); NaN where joints do not close.
    """
    mechanism = IdealMechanism(assembly)
    rows = mechanism.system.drive_rows()
    unit_rates = np.zeros((len(mechanism.system.rows), len(rows)))
    for drive, (k, m, _) in enumerate(rows):
        unit_rates[mechanism.system.rows.index((k, m)), drive] = assembly.model.joint(k).sign
    return responses(mechanism, outputs, times, lambda position: unit_rates)
