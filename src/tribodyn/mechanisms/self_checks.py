"""Self-checks of a run with a bushing, in plain words."""

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.followed_tables import FollowedTable
from tribodyn.core.quantities import Record
from tribodyn.joints.point_contact import Touch
from tribodyn.mechanisms.results import impact_time

ENERGY_LIMIT: Final = 0.01
GRID_LIMIT: Final = 0.005
#: Peak pressure over hardness: a third of the hardness is about the yield stress of the bulk (D. Tabor, The
#: hardness of metals, 1951).
HARDNESS_LIMIT: Final = 1.0 / 3.0
#: Real area of contact over the nominal one: beyond a few per cent asperities no longer deform one by one,
#: which every law here takes for granted.
AREA_LIMIT: Final = 0.1
#: Radial clearance over the combined rms roughness σ: 3 σ hold all but a thousandth of the heights.
ROUGH_LIMIT: Final = 3.0
_DAMPING: Final = 0.05  #: Share of the peak pressure that is damping; below it the grid hardly matters.
LIFT_OFF_LIMIT: Final = 0.001  #: Share of a run without the thrust collar; below it is only noted.
CLIP_LIMIT: Final = 0.02
LINER_LIMIT: Final = 0.05
#: Share of rejected steps among those tried; built-in cases and rough variations of them have 1 to 6 %.
REJECTED_LIMIT: Final = 0.2
#: Restarts over steps. The order grows step by step: twenty are few to get beyond the low ones.
RESTART_LIMIT: Final = 0.05
#: Advice that closes energy balances: absolute tolerances alone hold small slips and long ringing.
TIGHTEN: Final = "Tighten solver.rtol and all of solver.atol tenfold."


def extremes(*records: Record) -> dict[str, float]:
    """Return extremes over all accepted steps by name, SI units, from the records that kernels keep."""
    return {name: float(record[name]) for record in records for name in record.dtype.names}


#: Why surfaces come closer than a contact law reaches, after what presses them together.
TOO_CLOSE: Final = (
    "is too large for this law, or the grid too coarse for the edge of a tilted pin: more nodes along the "
    "axis show which"
)


_YIELD: Final = "lets the bodies under the asperities yield"
#: Remark on a run that elastic bodies carry where asperities alone do not.
YIELDED: Final = (
    "Asperities alone do not carry this run, or its grid is too coarse for the edge of a tilted pin: "
    "surfaces came closer than the contact law reaches. So it has elastic bodies under all asperities of "
    'which the case said nothing; with bulk = "none" it stops there.'
)


def yielding(key: str) -> str:
    """Return the advice to let the bodies under the asperities yield, by their key."""
    return f'; {key} = "conformal" {_YIELD}, and the run goes on there'


def may_yield(failure: str) -> bool:
    """Return whether a run stopped where elastic bodies under the asperities would let it go on."""
    return _YIELD in failure


def beyond_law(
    h_first: float,
    t_end: float,
    surfaces: str,
    cause: str = f"the load or the impact {TOO_CLOSE}",
    *,
    advice: str = "",
) -> str:
    """Return why a run stopped at ``t_end`` [s] that left the range of its contact law.

    ``h_first``: where its table begins, over σ [1]; ``t_end``: simulated time reached [s]; ``surfaces``:
    which ones, in words; ``cause``, ``advice``: what to say of it, and what helps.
    """
    return (
        f"stopped at t = {t_end:.6g} s: the surfaces of {surfaces} came closer than the contact law reaches "
        f"({h_first:g} sigma); {cause}{advice}"
    )


def instant(time: float, begins: Iterable[float] = (), impact_time: float = 0.0) -> str:
    """Return an instant in words, with the impact that it belongs to.

    ``time``: the instant [s]; NaN where it is not known; ``begins``: times of the start and of the reversals
    [s]; ``impact_time``: how long impacts last after each of them [s].
    """
    if math.isnan(time):
        return "at an unknown time"
    before = max((begin for begin in begins if begin <= time), default=-math.inf)
    words = f"at t = {time:.4g} s"
    if time > before + impact_time:
        return words
    event = f"the reversal at {before:.4g} s" if before > 0.0 else "the start"
    return f"{words}, in the impact after {event}"


def of_plastic(share: float, when: str) -> list[str]:
    """Return a remark on the largest share of a contact that carried the hardness; nothing without one."""
    words = (
        f"Up to {100 * share:.2g} % of the contact area carried the hardness {when}: the bulk flows there. "
        "The pressure is bounded by the hardness; what stays deformed is not computed, nor wear of it."
    )
    return [words] if share > 0.0 else []


def of_load(loading: Mapping[str, float], when: str) -> list[str]:
    """Return remarks on the load on the surfaces; empty texts without any.

    ``loading``: from :func:`tribodyn.mechanisms.bushing.loading`; ``when``: the instant of the largest
    pressure in words, see :func:`instant`.
    """
    hardness, area = loading["hardness_share"], loading["real_area_share"]
    return [
        f"The contact pressure reached {100 * hardness:.2g} % of the hardness {when}: above a third of it "
        "the bulk yields, not asperities alone."
        if hardness > HARDNESS_LIMIT
        else "",
        _of_real_area(area, when) if area > AREA_LIMIT else "",
    ]


def _of_real_area(area: float, when: str) -> str:
    """Return a remark on a real area of contact, over the nominal one."""
    if area > 1.0:
        return (
            "The contact law has left its range: where the surfaces came closest it gives more real area of "
            f"contact than there is. The pressure was largest {when}; do not use contact forces of such "
            "instants."
        )
    return (
        f"The real area of contact reached {100 * area:.2g} % of the nominal one where the surfaces came "
        f"closest (largest pressure {when}): above {100 * AREA_LIMIT:g} % asperities do not deform one by "
        "one, as contact laws have it."
    )


def of_damping_pressure(pressure: float, at_rest: float) -> str:
    """Return a remark on a peak pressure where surfaces at rest would carry ``at_rest`` [Pa]."""
    if not 0.0 < at_rest < (1.0 - _DAMPING) * pressure:
        return ""
    return (
        f"Surfaces at rest would carry {at_rest * 1e-6:.3g} MPa where the pressure was largest: the rest of "
        f"{pressure * 1e-6:.3g} MPa is damping at single points, and more on a finer grid."
    )


def of_reversals(every: FloatArray, turns: FloatArray, *, period: float, t_end: float, carried: bool) -> str:
    """Report the reversals of a drive cycle that a run does not hold with the impacts that follow them.

    ``every``: reversals of a cycle [s], shape (n,); ``turns``: the start and the reversals that were reached
    [s], shape (m,); ``period``: time of a cycle [s]; ``t_end``: simulated time reached [s]; ``carried``:
    whether the start is a reversal, because the run continues from another one.
    """
    settling = impact_time(period)
    held = turns[(turns + settling <= t_end) & ((turns > 0.0) | carried)]
    phases = np.mod(held + 0.5 * settling, period) - 0.5 * settling
    missing = [t for t in every if not np.any(np.abs(phases - t) < 0.5 * settling)]
    if not missing:
        return ""
    return (
        f"Of the {every.size} reversals of a drive cycle the run holds {every.size - len(missing)} with the "
        "impacts that follow: peaks after the others may be larger."
    )


def of_lift_off(share: float) -> str:
    """Return a remark on a thrust collar that carried nothing for a share of the run."""
    return f"The thrust collar carried nothing for {100 * share:.2g} % of the run: lift-off is not modelled."


def of_contact(
    touch: Touch,
    *,
    separation: float,
    clipped: float,
    grid_error: float,
    grid: tuple[int, int],
    keys: str = "solver.grid.theta and solver.grid.z",
) -> list[str]:
    """Return remarks on a contact, whatever is joined by it; empty texts without any.

    ``separation``: least distance of the mean planes [m]; ``clipped``: share of the contact area where the
    tensile clip acts, mean over time; ``grid_error``: largest error of the contact force on the run's grid,
    as a fraction; NaN where it is not known; ``grid``: nodes around and along; ``keys``: which keys of the
    case set them.
    """
    surface = touch.over_surface
    depth = touch.asperity_separation(separation) if surface else math.inf
    return [
        of_clearance(touch),
        f"On the chosen grid the contact force is off by up to {100 * grid_error:.2g} %: "
        f"raise {keys} from {grid[0]} and {grid[1]}."
        if grid_error > GRID_LIMIT
        else "",
        f"The mean planes of the surfaces came within {depth:.2g} sigma of each other: below 0 the "
        "statistical contact law is outside its range."
        if depth < 0.0
        else "",
        *_of_liner(touch, separation),
        f"The tension cut-off acted on {100 * clipped:.2g} % of the contact area on average: "
        "damping is strong against stiffness there."
        if clipped > CLIP_LIMIT
        else "",
        ""
        if surface
        else "The contact is at a point of each end of the bushing: there is no pressure field and no wear.",
    ]


def of_clearance(touch: Touch) -> str:
    """Return a remark on a clearance that rough surfaces fill; an empty text without one."""
    if not (touch.over_surface and touch.clearance < ROUGH_LIMIT * touch.roughness):
        return ""
    return (
        f"This is a press fit: the radial clearance of {1e6 * touch.clearance:.3g} um is "
        f"{touch.clearance / touch.roughness:.2g} times the combined roughness, and below {ROUGH_LIMIT:g} "
        "the surfaces touch all around. Give a larger clearance or smoother surfaces."
    )


def named(name: str, messages: Iterable[str]) -> list[str]:
    """Return sentences about a contact, each with its name before it; empty ones are left out."""
    return [f"In {name} {text[0].lower()}{text[1:]}" for text in messages if text]


def _of_liner(touch: Touch, separation: float) -> list[str]:
    """Return a remark on the layer under the asperities."""
    if touch.liner is None or not math.isfinite(touch.bore_radius):
        return []
    half_width = touch.half_width(separation)
    return [
        f"Half the contact is {half_width / touch.liner.thickness:.2g} times as wide as its liner is thick: "
        "with this Poisson's ratio that is too little for a thin layer, and pressures are only roughly right."
        if touch.liner.error(half_width) > LINER_LIMIT
        else ""
    ]


def of_tables(
    tables: Iterable[FollowedTable], times: FloatArray, coordinate: Callable[[FollowedTable], FloatArray]
) -> list[str]:
    """Return the tables over angles or positions that a run leaves.

    ``tables``: of the case; ``times``: of the rows [s], shape (n_t,); ``coordinate``: returns the values at
    the rows of what a table follows, shape (n_t,).
    """
    messages = []
    for table in tables:
        if table.over != "times":
            (low, high), values = table.reach, coordinate(table)
            outside = np.flatnonzero((values < low) | (values > high))[:1]
            messages += [table.warning(float(times[row]), past=bool(values[row] > high)) for row in outside]
    return messages


def of_steps(statistics: Mapping[str, float]) -> list[str]:
    """Return remarks on the integration; empty texts without any.

    ``statistics``: cost of the integration, by the names of :class:`~tribodyn.core.problem.Statistics`;
    restarts at times that are known before are expected and do not count.
    """
    steps, rejected, restarts = (statistics[name] for name in ("steps", "rejected", "restarts"))
    return [
        f"The integrator threw away {100 * rejected / (steps + rejected):.2g} % of the steps it tried: "
        "something switches faster than it can follow, and short peaks may be missed. Look for what is sharp "
        "in the case, and see whether a tighter solver.rtol changes the result."
        if rejected > REJECTED_LIMIT * (steps + rejected)
        else "",
        f"The integration started anew every {steps / restarts:.2g} steps: most of them are taken with "
        "low orders. See whether a tighter solver.rtol changes the result."
        if restarts > RESTART_LIMIT * steps > 0.0
        else "",
    ]
