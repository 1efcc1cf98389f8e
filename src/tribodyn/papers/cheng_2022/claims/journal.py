"""Claims on the journal of section 4, dry and in oil."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, truth
from tribodyn.papers.cheng_2022.runs import Runs

_AT_REST: Final = 0.01
"""A journal that moves less than this share of the clearance has settled."""
_SAME: Final = 0.02
"""Paths that differ by less than this share of the clearance almost coincide."""


def _eccentricity(run: xr.Dataset, law: str) -> FloatArray:
    one = run.sel(law=law)
    return np.asarray(np.hypot(one["e_x"].values, one["e_y"].values))


def _force(run: xr.Dataset, law: str) -> FloatArray:
    one = run.sel(law=law)
    return np.asarray(np.hypot(one["F_cx"].values, one["F_cy"].values))


def _last_motion(run: xr.Dataset, law: str) -> float:
    """Return the range of the eccentricity in the last fifth of the run over the clearance."""
    late = run["time"].values >= 0.8 * float(run["time"].values[-1])
    return float(np.ptp(_eccentricity(run, law)[late]) / run.attrs["clearance"])


def _late(motion: float) -> str:
    return f"moves by {100.0 * motion:.2g} % of the clearance in the last fifth of the run"


def _settles(run: xr.Dataset, law: str) -> Finding:
    last = _last_motion(run, law)
    return truth(last < _AT_REST, _late(last))


def dry_rsdc_settles(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure whether the damped journal comes to rest."""
    return _settles(runs.over_laws("journal-dry"), "rsdc")


def dry_ke_oscillates(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure whether the journal without damping goes on moving."""
    last = _last_motion(runs.over_laws("journal-dry"), "ke")
    return truth(last >= _AT_REST, _late(last))


def dry_ke_grows(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure the largest eccentricity without damping, early and late."""
    run = runs.over_laws("journal-dry")
    path = _eccentricity(run, "ke") * 1e6
    early = run["time"].values < 0.5 * float(run["time"].values[-1])
    first, last = float(path[early].max()), float(path[~early].max())
    return truth(last > 1.01 * first, f"at most {first:.3f} µm in the first half, then {last:.3f} µm")


def oil_both_settle(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure whether both laws settle in oil."""
    run = runs.over_laws("journal-oil")
    findings = [_settles(run, law) for law in ("rsdc", "ke")]
    return Finding("; ".join(f.text for f in findings), min(f.score for f in findings))


def oil_same_path(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure how far apart the two laws take the journal in oil."""
    run = runs.over_laws("journal-oil")
    apart = [run[f"e_{axis}"].sel(law="rsdc").values - run[f"e_{axis}"].sel(law="ke").values for axis in "xy"]
    largest = float(np.hypot(*apart).max() / run.attrs["clearance"])
    return truth(
        largest < _SAME,
        f"never further apart than {100.0 * largest:.2g} % of the clearance",
        partly=largest < 0.05,
    )


def oil_rsdc_first(runs: Runs, formulation: str, friction: float | None) -> Finding:
    """Measure when the contact force exceeds a hundredth of its final value."""
    run = runs.over_laws("journal-oil")
    time, start = run["time"].values * 1e3, {}
    for law in ("rsdc", "ke"):
        force = _force(run, law)
        start[law] = float(time[np.argmax(force > 0.01 * force[-1])])
    text = f"contact begins at {start['rsdc']:.2f} ms with RSDC, at {start['ke']:.2f} ms with KE"
    return truth(start["rsdc"] < start["ke"], text)


CLAIMS: Final = (
    Claim("dry RSDC settles", "4.1, Fig. 8", "dry, RSDC settles after the first contact", dry_rsdc_settles),
    Claim("dry KE oscillates", "4.1, Fig. 8", "dry, KE oscillates and does not settle", dry_ke_oscillates),
    Claim(
        "dry KE grows", "4.1, Fig. 8", "dry, the oscillation of KE grows until the journal penetrates",
        dry_ke_grows,
        "the force of KE follows from the position, so energy is kept; a coarse fixed step makes it grow",
    ),
    Claim("oil settles", "4.2, Fig. 9", "in oil both laws settle", oil_both_settle),
    Claim("oil, one path", "4.2, Fig. 9", "in oil the paths of both laws almost coincide", oil_same_path),
    Claim("oil, RSDC first", "4.2, Fig. 9", "in oil contact forces appear earlier with RSDC", oil_rsdc_first),
)  # fmt: skip
"""Claims of section 4."""
