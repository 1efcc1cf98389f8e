"""What the run of a journal says about its own trustworthiness, in plain words."""

from __future__ import annotations

from tribodyn.core.arrays import FloatArray
from tribodyn.joints import SURFACE, BushingJoint
from tribodyn.kernels.journal import ledger
from tribodyn.simulation.checks import CLIP_LIMIT, ENERGY_LIMIT, GRID_LIMIT


def warnings(
    extremes: FloatArray, joint: BushingJoint, *, residual: float, grid_error: float, t_end: float
) -> list[str]:
    """Return what a user should know before trusting the numbers, one sentence each.

    Parameters
    ----------
    extremes
        Peaks over all accepted steps, see ``kernels/journal/ledger.py``.
    joint
        The bushing.
    residual
        Energy residual as a fraction.
    grid_error
        Largest error of the contact force on the run's grid, as a fraction.
    t_end
        Simulated time reached [s].
    """
    depth = float(extremes[ledger.LEAST_SEPARATION]) / joint.roughness
    clipped = float(extremes[ledger.CLIPPED]) / t_end if t_end > 0.0 else 0.0
    messages = {
        f"the energy ledger misses {100 * residual:.2g} %: tighten solver.rtol.": residual > ENERGY_LIMIT,
        f"on the chosen grid the contact force is off by up to {100 * grid_error:.2g} %: raise "
        "solver.grid.": grid_error > GRID_LIMIT,
        f"the mean planes of the surfaces came within {depth:.2g} sigma of each other: below 0 the "
        "statistical contact law is outside its range.": depth < 0.0 and joint.contact == SURFACE,
        "the contact is at a point of each end of the bushing: there is no pressure field.": joint.contact
        != SURFACE,
        f"the clip of tensile pressure acted on {100 * clipped:.2g} % of the contact area on average: "
        "damping is strong against stiffness there.": clipped > CLIP_LIMIT,
    }
    return [text for text, applies in messages.items() if applies]
