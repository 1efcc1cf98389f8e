"""The bounce test: a plate thrown against the other surface, and the restitution that comes out.

A plate of mass m per area arrives at the onset separation with the speed v₀ and leaves it with e·v₀. All its
points enter contact at once, so δ̇₋ = v₀, and with w = −(dh/dt)/v₀ and time in units of σ/v₀

    dh*/dτ = −w,   dw/dτ = −max(P_k + C w, 0) / 2E₀,   E₀ = m v₀²/2σ.

So e depends on the law and on E₀ alone: speed and mass enter only together, as the energy per area. E₀ is
found from the pressure that the same impact would reach without damping.
"""

from dataclasses import dataclass
from typing import Final

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.contact.contact_law import DESIGN_PRESSURE
from tribodyn.core.errors import InputError
from tribodyn.core.remembered import ContactTable
from tribodyn.kernels.lookup import pressure_and_damping, stored_energy

_LONGEST: Final = 1.0e9  #: Time in units of σ/v₀ after which a plate is taken to stick.


@dataclass(frozen=True)
class Bounce:
    """Result of one bounce."""

    restitution: float  #: Speed on leaving the onset over that on arriving [1]; 0 if the plate sticks.
    deepest: float  #: Smallest separation h* [1].
    peak_pressure: float  #: Largest contact pressure P_c [Pa].


def bounce(
    table: ContactTable,
    *,
    onset: float = 4.0,
    design_pressure: float = DESIGN_PRESSURE,
    scale: float = 1.0,
    clip: bool = True,
) -> Bounce:
    """Throw a plate against the other surface.

    ``onset``: separation h* at which contact begins [1]; ``design_pressure``: pressure that the impact would
    reach without damping [Pa]; ``scale``: factor on the damping; ``clip``: whether the total pressure is kept
    from becoming tensile.
    """
    from scipy.integrate import solve_ivp

    depth = undamped_depth(table, design_pressure)
    if depth >= onset:
        raise InputError(
            f"{design_pressure:g} Pa are reached above the onset of contact", key="contact.design_pressure"
        )
    energy = stored_energy(table, depth) - stored_energy(table, onset)

    def total(h_star: float, w: float) -> float:
        stiffness, _, damping, _ = pressure_and_damping(table, h_star)
        pressure = float(stiffness + scale * damping * w)
        return max(pressure, 0.0) if clip else pressure

    def motion(_: float, state: FloatArray) -> list[float]:
        return [-state[1], -total(state[0], state[1]) / (2.0 * energy)]

    def leaves(_: float, state: FloatArray) -> float:
        return float(state[0] - onset)

    leaves.terminal, leaves.direction = True, 1.0  # type: ignore[attr-defined]
    run = solve_ivp(motion, (0.0, _LONGEST), [onset, 1.0], "LSODA", events=leaves, rtol=1.0e-9, atol=1.0e-11)
    assert run.y_events is not None
    left = run.y_events[0]
    return Bounce(
        restitution=-float(left[0, 1]) if left.size else 0.0,
        deepest=float(run.y[0].min()),
        peak_pressure=max(total(h, w) for h, w in run.y.T),
    )


def undamped_depth(table: ContactTable, pressure: float) -> float:
    """Return the separation h* at which the stiffness pressure is ``pressure`` [Pa]."""
    from scipy.optimize import brentq

    def excess(h_star: float) -> float:
        return float(pressure_and_damping(table, h_star)[0]) - pressure

    highest = excess(table.h_first) + pressure
    if not highest > pressure > 0.0:
        raise InputError(
            f"must lie between 0 and {highest:.3g} Pa, which this contact carries, not {pressure:g}",
            key="contact.design_pressure",
        )
    return float(brentq(excess, table.h_first, table.h_last, xtol=1.0e-13))


def calibrating_scale(
    table: ContactTable, restitution: float, *, onset: float = 4.0, design_pressure: float = DESIGN_PRESSURE
) -> float:
    """Return the factor on the damping with which the design impact returns ``restitution`` [1].

    ``table``, ``onset``, ``design_pressure``: as for :func:`bounce`; ``restitution``: what is wanted, 0 < e ≤
    1.
    """
    from scipy.optimize import brentq

    if restitution == 1.0:
        return 0.0

    def excess(logarithm: float) -> float:
        scale = float(portable.exp(logarithm))
        made = bounce(table, onset=onset, design_pressure=design_pressure, scale=scale)
        return made.restitution - restitution

    low, high = -1.0, 1.0
    while excess(low) < 0.0:
        low -= 2.0
    while excess(high) > 0.0:
        high += 2.0
    return float(portable.exp(brentq(excess, low, high, xtol=1.0e-7)))
