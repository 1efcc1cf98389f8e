"""Claims on where the trunnion bears at 20 µm: section 5.2, Fig. 15."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import above, below
from tribodyn.papers.cheng_2022.pressure import data as pictures

ZONE: Final = 0.05
"""Contact is where the pressure exceeds this share of the picture's peak."""


def contact_arc(theta: FloatArray, pressure: FloatArray, middle: float) -> tuple[float, float]:
    """Return where contact begins and ends, unrolled around ``middle`` [deg].

    Parameters
    ----------
    theta
        Angles of the nodes [rad], evenly around, shape (n_theta,).
    pressure
        Largest pressure at each angle [Pa], shape (n_theta,).
    middle
        Angle about which the circle is unrolled [deg].

    Returns
    -------
    tuple
        First and last angle at which the pressure passes the share :data:`ZONE` of its peak. Between two
        nodes its logarithm is a straight line, since pressure falls by a factor with each part of σ.
    """
    angle = (np.degrees(theta) - middle + 180.0) % 360.0 - 180.0
    order = np.argsort(angle)
    angle, level = angle[order], np.log(np.maximum(pressure[order] / (ZONE * pressure.max()), 1e-30))
    inside = np.flatnonzero(level > 0.0)
    first, last = int(inside[0]), int(inside[-1])
    return (
        middle + _crossing(angle, level, first, first - 1),
        middle + _crossing(angle, level, last, last + 1),
    )


def _crossing(angle: FloatArray, level: FloatArray, inner: int, outer: int) -> float:
    """Return where the level passes zero between two neighbouring nodes; the inner one at the seam."""
    if not 0 <= outer < angle.size:
        return float(angle[inner])
    share = level[inner] / (level[inner] - level[outer])
    return float(angle[inner] + share * (angle[outer] - angle[inner]))


def zone(trial: Trial, way: float, ends: tuple[float, float]) -> Finding:
    """Measure how far the contact of one direction reaches beyond or stays short of ``ends`` [deg]."""
    shown = pictures(trial.runs, trial.formulation)
    middle = 0.5 * (ends[0] + ends[1])
    arcs = [
        contact_arc(shown["theta"].values, one.max(axis=1), middle)
        for one in shown["pressure"].values[shown["snapshot_direction"].values == way]
    ]
    first, last = min(arc[0] for arc in arcs), max(arc[1] for arc in arcs)
    off = float(max(abs(first - ends[0]), abs(last - ends[1])))
    return Finding(f"{first % 360.0:.1f}° to {last % 360.0:.1f}°", off)


def edge_shares(shown: xr.Dataset) -> FloatArray:
    """Return the largest pressure in the middle half of the bushing over the peak of each picture [%]."""
    pressure, z = shown["pressure"].values, shown["z"].values
    inner = pressure[:, :, np.abs(z) < 0.25 * np.ptp(z)]
    return np.asarray(100.0 * inner.max(axis=(1, 2)) / pressure.max(axis=(1, 2)))


def at_the_edges(trial: Trial) -> Finding:
    """Measure the pressure in the middle half of the bushing, each picture by its own peak."""
    shares = edge_shares(pictures(trial.runs, trial.formulation))
    text = ", ".join(f"{share:.2g}" for share in shares)
    return Finding(
        f"the middle half carries up to {text} % of the peak in the six pictures", float(shares.max())
    )


def pictures_differ(trial: Trial) -> Finding:
    """Measure how far the peak pressures of the six pictures are apart."""
    shown = pictures(trial.runs, trial.formulation)
    peaks = shown["pressure"].values.max(axis=(1, 2)) * 1e-6
    ends = shown["z"].values[shown["pressure"].values.max(axis=1).argmax(axis=1)]
    text = ", ".join(f"{p:.3g} ({'top' if z > 0.0 else 'bottom'})" for p, z in zip(peaks, ends, strict=True))
    return Finding(f"peaks {text} MPa", 100.0 * float(np.ptp(peaks) / peaks.min()))


_LEVER: Final = (
    "with the lever moment, which the paper's printed rows leave out, the two ends bear on opposite sides"
)

CLAIMS: Final = (
    Claim(
        "zone forward", "5.2, Fig. 15 (a–c)", "forward contact occurs at 300° to 45°",
        below(15.0, "° off", partly=30.0), partial(zone, way=1.0, ends=(-60.0, 45.0)), _LEVER,
    ),
    Claim(
        "zone reverse", "5.2, Fig. 15 (d–f)", "reverse contact occurs at 135° to 225°",
        below(15.0, "° off", partly=30.0), partial(zone, way=-1.0, ends=(135.0, 225.0)), _LEVER,
    ),
    Claim(
        "contact at the edges", "5.2, Fig. 15", "the contact areas are concentrated at the edge",
        below(5.0, "%", partly=20.0), at_the_edges,
        "without the lever moment the trunnion hardly tilts about Y, and bears along more of its length",
    ),
    Claim(
        "pictures differ", "5.2, Fig. 15",
        "pressure values and axial distribution differ between the pictures",
        above(10.0, "%"), pictures_differ,
    ),
)  # fmt: skip
"""Claims on the contact pressure."""
