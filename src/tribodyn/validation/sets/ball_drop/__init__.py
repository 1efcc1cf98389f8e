"""Restitution returned by damping factors against the restitution requested."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tribodyn.contact import DAMPING_FACTORS, SurfacePair, law, tabulate
from tribodyn.contact.bounce import bounce
from tribodyn.joints.point_contact import point_table
from tribodyn.joints.shapes import Points
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

JUDGED: Final = "calibrated"  #: The factor that is judged at every height.
_FORCE: Final = 100.0  #: Largest force of the undamped impact [N]; the restitution does not depend on it.
#: Surfaces of the impact; neither they nor the radius change the restitution.
_PAIR: Final = SurfacePair(
    young_modulus=(70e9, 70e9),
    poisson_ratio=(0.3, 0.3),
    roughness=(1e-6, 1e-6),
    hardness=1e9,
    asperity_density=1e11,
    asperity_radius=1e-5,
)


#: A ball in a race so much larger that it is a plane.
_BALL = Points(radius=0.02, clearance=1.0, length=1.0, heights=(0.0,))


def compare(one: ValidationSet) -> Outcome:
    """Return the restitution at every height, and the largest deviation of every other factor."""
    heights = one.rows("drop_heights.csv")
    requested = [float(row["restitution"]) for row in heights]
    systematic = one.value("systematic")
    returned = [restitution(JUDGED, e) for e in requested]
    judged, band = [], one.bands["restitution"]
    for row, e, value in zip(heights, requested, returned, strict=True):
        name, width = f"{row['ball']}, {row['release_height_cm']} cm", float(row["restitution_se"])
        reading = float(np.hypot(systematic, width))
        judged.append(Comparison(name, "", value, e, u_measured=reading, null=e, band=band))
    others = [_factor(one, name, requested) for name in DAMPING_FACTORS if name not in (JUDGED, "none")]
    return Outcome((*judged, *others), _plot(heights, requested, returned, systematic))


def restitution(factor: str, requested: float) -> float:
    """Return the restitution of one impact under a damping factor [1].

    A ball hits a plane; a dashpot, which has no point contact, is put between rough plates.
    """
    if DAMPING_FACTORS[factor].dashpot:
        plates = law("linear", _PAIR, damping_factor=factor, restitution=requested)
        return bounce(tabulate(plates)).restitution
    ball = law("linear", _PAIR, damping_factor=factor, restitution=requested)
    table = point_table("point-lankarani-nikravesh", ball, _BALL, points=1)
    return bounce(table, onset=0.0, design_pressure=_FORCE).restitution


def _factor(one: ValidationSet, name: str, requested: Sequence[float]) -> Comparison:
    deviation = max(abs(restitution(name, e) - e) for e in requested)
    elastic = 1.0 - min(requested)
    return Comparison(f"{name}, largest deviation", "", deviation, null=elastic, band=one.bands["factor"])


def _plot(
    heights: Sequence[dict[str, str]], requested: list[float], returned: list[float], width: float
) -> Plot:
    speeds = [float(row["impact_speed_m_s"]) for row in heights]
    curves = []
    for ball in dict.fromkeys(row["ball"] for row in heights):
        at = [k for k, row in enumerate(heights) if row["ball"] == ball]
        x, y = [speeds[k] for k in at], [requested[k] for k in at]
        curves.append(Curve(f"{ball}, measured", "measured", x, y, [width] * len(at)))
        curves.append(Curve(f"{ball}, {JUDGED}", "computed", x, [returned[k] for k in at]))
    return Plot("impact speed [m/s]", "restitution", tuple(curves))
