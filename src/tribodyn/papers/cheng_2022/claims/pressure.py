"""Claims on where the trunnion bears at 20 µm: section 5.2, Fig. 15."""

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import FIRST, VARIED, Claim, Finding, Trial, above, below
from tribodyn.papers.cheng_2022.claims.forces import CAUSE, NO_M_AIR

ZONE: Final = 0.05  #: Contact is where the pressure exceeds this share of its peak.
SHARES: Final = (0.02, ZONE, 0.1)  #: Other shares that are tried: the paper gives none.


def contact_arc(
    theta: FloatArray, pressure: FloatArray, middle: float, share: float = ZONE
) -> tuple[float, float]:
    """Return the beginning and the end of contact, unrolled around ``middle`` [deg].

    They are the first and last angle at which the pressure passes the ``share`` of its peak. Between two
    nodes its logarithm is a straight line, since pressure falls by a factor with each part of σ. ``theta``:
    angles of the nodes [rad], evenly around; ``pressure``: the largest at each [Pa]; shapes (n_theta,).
    """
    angle = (np.degrees(theta) - middle + 180.0) % 360.0 - 180.0
    order = np.argsort(angle)
    angle, level = angle[order], np.log(np.maximum(pressure[order] / (share * pressure.max()), 1e-30))
    inside = np.flatnonzero(level > 0.0)
    first, last = int(inside[0]), int(inside[-1])
    return (
        middle + _crossing(angle, level, first, first - 1),
        middle + _crossing(angle, level, last, last + 1),
    )


def _crossing(angle: FloatArray, level: FloatArray, inner: int, outer: int) -> float:
    """Return the zero of the level between two neighbouring nodes; the inner one at the seam."""
    if not 0 <= outer < angle.size:
        return float(angle[inner])
    share = level[inner] / (level[inner] - level[outer])
    return float(angle[inner] + share * (angle[outer] - angle[inner]))


def zone(trial: Trial, way: float, ends: tuple[float, float]) -> Finding:
    """Measure the distance of the ends of contact from the paper's, in the run's snapshots."""
    arcs = [_ends(trial, way, ends, share) for share in SHARES]
    first, last = arcs[SHARES.index(ZONE)]
    off = max(abs(first - ends[0]), abs(last - ends[1]))
    spread = ", ".join(
        f"{max(abs(one[0] - ends[0]), abs(one[1] - ends[1])):.1f}° at {100.0 * share:g} %"
        for one, share in zip(arcs, SHARES, strict=True)
    )
    return Finding(f"{first % 360.0:.1f}° to {last % 360.0:.1f}°: off by {spread} of the peak", off)


def _ends(trial: Trial, way: float, ends: tuple[float, float], share: float) -> tuple[float, float]:
    """Return the first and the last angle of contact in the snapshots of one direction [deg]."""
    run = trial.vsv()
    shown = run["pressure"].values[run["snapshot_direction"].values == way]
    middle = 0.5 * (ends[0] + ends[1])
    arcs = [contact_arc(run["theta"].values, one.max(axis=1), middle, share) for one in shown]
    return min(arc[0] for arc in arcs), max(arc[1] for arc in arcs)


def edge_shares(shown: xr.Dataset) -> FloatArray:
    """Return the largest pressure in the middle half of the bushing over the peak of each snapshot [%]."""
    pressure, z = shown["pressure"].values, shown["z"].values
    inner = pressure[:, :, np.abs(z) < 0.25 * np.ptp(z)]
    return np.asarray(100.0 * inner.max(axis=(1, 2)) / pressure.max(axis=(1, 2)))


def at_the_edges(trial: Trial) -> Finding:
    """Measure the largest pressure in the middle half of the bushing over the peak."""
    shares = edge_shares(trial.vsv())
    text = ", ".join(f"{share:.2g}" for share in shares)
    return Finding(f"up to {text} % of the peak in the six snapshots", float(shares.max()))


def snapshots_differ(trial: Trial) -> Finding:
    """Measure the range of the peak pressures of the run's snapshots over the least."""
    shown = trial.vsv()
    peaks = shown["pressure"].values.max(axis=(1, 2)) * 1e-6
    ends = shown["z"].values[shown["pressure"].values.max(axis=1).argmax(axis=1)]
    text = ", ".join(f"{p:.3g} ({'top' if z > 0.0 else 'bottom'})" for p, z in zip(peaks, ends, strict=True))
    return Finding(f"peaks {text} MPa", 100.0 * float(np.ptp(peaks) / peaks.min()))


def interference_in_x(trial: Trial) -> Finding:
    """Measure the peak pressure within 45° of the X direction over that elsewhere, the least of snapshots."""
    run = trial.vsv()
    near = np.abs(np.cos(run["theta"].values)) > np.sqrt(0.5)
    shown = run["pressure"].values.max(axis=2)
    least = float((shown[:, near].max(axis=1) / shown[:, ~near].max(axis=1)).min())
    return Finding(f"at least {least:.3g} times", least)


def axial_distribution(trial: Trial) -> Finding:
    """Measure the range of the height of the pressure's centre over the snapshots, over the length."""
    run = trial.vsv()
    along, z = run["pressure"].values.sum(axis=1), run["z"].values
    centre = (along * z).sum(axis=1) / along.sum(axis=1)
    share = 100.0 * float(np.ptp(centre) / np.ptp(z))
    return Finding(f"its centre moves by {share:.3g} % of the length", share)


def snapshots_by_m_air(trial: Trial) -> Finding:
    """Measure the range of the peak pressures of the snapshots without M_air over that with it."""
    loaded, free = (
        float(np.ptp(trial.vsv(more=more)["pressure"].values.max(axis=(1, 2)))) * 1e-6
        for more in ({}, NO_M_AIR)
    )
    return Finding(f"{loaded:.3g} MPa with M_air, {free:.3g} MPa without", free / loaded)


_LEVER: Final = (
    "with the lever moment, which the paper's printed rows leave out, the two ends bear on opposite sides"
)
_THRESHOLD: Final = (
    f"the paper does not say from which pressure on it counts contact, which decides here; {_LEVER}"
)
_OFF: Final = below(15.0, "° off", partly=30.0, since=FIRST)

#: Claims on the contact pressure.
CLAIMS: Final = (
    Claim(
        "zone forward", ("P2",), "forward contact occurs at 300° to 45°", "smooth motion",
        _OFF, partial(zone, way=1.0, ends=(-60.0, 45.0)), _THRESHOLD,
    ),
    Claim(
        "zone reverse", ("P3",), "reverse contact occurs at 135° to 225°", "smooth motion",
        _OFF, partial(zone, way=-1.0, ends=(135.0, 225.0)), _THRESHOLD,
    ),
    Claim(
        "contact at the edges", ("P1", "K3"), "the contact areas are concentrated at the edge",
        "smooth motion", below(5.0, "%", partly=20.0, since=FIRST), at_the_edges,
        "without the lever moment the trunnion hardly tilts about Y, and bears along more of its length",
    ),
    Claim(
        "snapshots differ", ("P4",),
        "pressure values and axial distribution differ between the six positions", "smooth motion",
        above(10.0, "%"), snapshots_differ,
    ),
    Claim(
        "axial distribution differs", ("P4",), "the axial distribution differs between the six positions",
        "smooth motion", above(10.0, "% of the length", partly=2.0, since=VARIED), axial_distribution,
    ),
    Claim(
        "snapshots by M_air", ("P4",), "the reversal of the drag causes the differences of the pressure",
        "smooth motion", CAUSE, snapshots_by_m_air,
    ),
    Claim(
        "interference in X", ("F2",), "the interference is more serious along X", "smooth motion",
        above(1.0, "times", by="the paper", since=VARIED), interference_in_x,
    ),
)  # fmt: skip
