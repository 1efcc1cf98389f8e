"""Claims on the journal of section 4, dry and in oil."""

from __future__ import annotations

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from tribodyn.core.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import Claim, Finding, Trial
from tribodyn.papers.cheng_2022.claims.bounds import above, below
from tribodyn.papers.cheng_2022.runs import LAWS

_BEGUN: Final = 0.001
"""Contact has begun where its force exceeds this share of the final one."""
_INITIAL: Final = 0.1
"""The initial stage of contact lasts until its force is this share of the final one."""
_FALL: Final = (0.9, 0.1)
"""The fall of a force is timed between these shares of its largest value."""


def _dry(trial: Trial, law: str) -> xr.Dataset:
    return trial.runs.over_laws("journal-dry").sel(law=law)


def _oil(trial: Trial, law: str) -> xr.Dataset:
    return trial.runs.over_laws("journal-oil").sel(law=law)


def _size(run: xr.Dataset, name: str) -> FloatArray:
    return np.asarray(np.hypot(run[f"{name}x"].values, run[f"{name}y"].values))


def _halves(run: xr.Dataset, values: FloatArray) -> tuple[float, float]:
    """Return the largest value in the first half of the run and in the second."""
    early = run["time"].values < 0.5 * float(run["time"].values[-1])
    return float(values[early].max()), float(values[~early].max())


def late_motion(run: xr.Dataset) -> float:
    """Return the larger range of e_x and e_y in the last fifth of the run [% of the clearance]."""
    late = run["time"].values >= 0.8 * float(run["time"].values[-1])
    return float(max(100.0 * np.ptp(run[f"e_{axis}"].values[late]) for axis in "xy") / run.attrs["clearance"])


def dry_late_motion(trial: Trial, law: str) -> Finding:
    """Measure how far the dry journal moves in the last fifth of the run."""
    motion = late_motion(_dry(trial, law))
    return Finding(f"moves by {motion:.3g} % of the clearance in the last fifth of the run", motion)


def dry_ke_growth(trial: Trial) -> Finding:
    """Measure the largest eccentricity without damping, early and late."""
    run = _dry(trial, "ke")
    first, last = _halves(run, _size(run, "e_") * 1e6)
    return Finding(f"at most {first:.3f} µm in the first half, then {last:.3f} µm", last / first)


def dry_ke_penetrates(trial: Trial) -> Finding:
    """Measure the largest eccentricity over the clearance."""
    run = _dry(trial, "ke")
    largest = float(_size(run, "e_").max())
    return Finding(
        f"goes {largest * 1e6:.2f} µm from the centre of {run.attrs['clearance'] * 1e6:.3g}",
        largest / float(run.attrs["clearance"]),
    )


def dry_ke_rebound(trial: Trial) -> Finding:
    """Measure how far the journal rebounds beyond where it started, against the load."""
    run = _dry(trial, "ke")
    load = np.array([run[f"F_c{axis}"].values.mean() for axis in "xy"])
    along = np.hypot(*load) ** -1 * (load[0] * run["e_x"].values + load[1] * run["e_y"].values)
    beyond = 100.0 * float(along.max()) / float(run.attrs["clearance"])
    return Finding(f"at most {beyond:.2g} % of the clearance beyond where it started", beyond)


def dry_ke_force(trial: Trial) -> Finding:
    """Measure the largest contact force, early and late."""
    run = _dry(trial, "ke")
    first, last = _halves(run, _size(run, "F_c"))
    return Finding(f"at most {first:.4g} N in the first half, then {last:.4g} N", last / first)


def oil_settles(trial: Trial) -> Finding:
    """Measure how far the oiled journal moves in the last fifth of the run, the worse of both laws."""
    motions = [late_motion(_oil(trial, law)) for law in LAWS]
    each = ", ".join(f"{motion:.1g} % ({law.upper()})" for law, motion in zip(LAWS, motions, strict=True))
    return Finding(f"moves by {each} of the clearance in the last fifth of the run", max(motions))


def oil_same_path(trial: Trial) -> Finding:
    """Measure how far apart the two laws take the journal in oil."""
    rsdc, ke = (_oil(trial, law) for law in LAWS)
    apart = np.hypot(*(rsdc[f"e_{axis}"].values - ke[f"e_{axis}"].values for axis in "xy"))
    largest = 100.0 * float(apart.max()) / float(rsdc.attrs["clearance"])
    return Finding(f"never further apart than {largest:.2g} % of the clearance", largest)


def fall_time(run: xr.Dataset) -> float:
    """Return how long the force of the film takes from 90 to 10 % of its largest value [ms]."""
    time, force = run["time"].values * 1e3, _size(run, "F_o")
    start = int(force.argmax())
    late, falling = time[start:], force[start:] / force[start]
    passed = [int(np.argmax(falling < share)) for share in _FALL]
    at = [
        np.interp(-share, -falling[k - 1 : k + 1], late[k - 1 : k + 1])
        for share, k in zip(_FALL, passed, strict=True)
    ]
    return float(at[1] - at[0])


def oil_film_falls(trial: Trial) -> Finding:
    """Measure how much longer the force of the film takes to fall with KE."""
    rsdc, ke = (fall_time(_oil(trial, law)) for law in LAWS)
    return Finding(f"from 90 to 10 % in {rsdc:.2f} ms with RSDC, in {ke:.2f} ms with KE", ke / rsdc)


def oil_first_contact(trial: Trial) -> Finding:
    """Measure how much larger the contact force is with RSDC in the initial stage of contact."""
    rsdc, ke = (_size(_oil(trial, law), "F_c") for law in LAWS)
    initial = (rsdc > _BEGUN * rsdc[-1]) & (rsdc < _INITIAL * rsdc[-1])
    ratio = float((rsdc[initial] / ke[initial]).max())
    return Finding(f"at most {100.0 * (ratio - 1.0):.0f} % larger with RSDC, at the same instant", ratio)


def oil_balance(trial: Trial) -> Finding:
    """Measure what the final contact forces miss of the load, the worse of both laws."""
    runs = [_oil(trial, law) for law in LAWS]
    missed = [
        abs(abs(float(run[f"F_c{axis}"].values[-1])) / load - 1.0)
        for run in runs
        for axis, load in zip("xy", (200.0, 100.0), strict=True)
    ]
    return Finding(f"{100.0 * max(missed):.1g} % off the load", 100.0 * max(missed))


_KEPT: Final = (
    "the force of KE follows from the position, so energy is kept; a coarse fixed step makes it grow"
)

CLAIMS: Final = (
    Claim(
        "dry RSDC rests", "4.1, Fig. 8", "dry, with RSDC e_x and e_y finally remain constant",
        below(1.0, "% of the clearance"), partial(dry_late_motion, law="rsdc"), mechanism=False,
    ),
    Claim(
        "dry KE oscillates", "4.1, Fig. 8", "dry, the result with KE is oscillatory",
        above(1.0, "% of the clearance"), partial(dry_late_motion, law="ke"), mechanism=False,
    ),
    Claim(
        "dry KE grows", "4.1, Fig. 8", "dry, with KE the oscillation intensifies",
        above(1.01, "times"), dry_ke_growth, _KEPT, mechanism=False,
    ),
    Claim(
        "dry KE rebounds further", "4.1",
        "with KE the rebound is greater than the distance of the initial state",
        above(1.0, "% of the clearance"), dry_ke_rebound, _KEPT, mechanism=False,
    ),
    Claim(
        "dry KE penetrates", "4.1, Fig. 8", "with KE the deviation grows beyond the radial clearance",
        above(1.0, "clearances", by="the paper"), dry_ke_penetrates, _KEPT, mechanism=False,
    ),
    Claim(
        "dry KE force", "4.1, Fig. 8", "with KE the contact force becomes extremely large in the end",
        above(2.0, "times", partly=1.1), dry_ke_force, _KEPT, mechanism=False,
    ),
    Claim(
        "oil settles", "4.2, Fig. 9", "in oil the calculation is stable with both laws",
        below(1.0, "% of the clearance"), oil_settles, mechanism=False,
    ),
    Claim(
        "oil same path", "4.2, Fig. 9", "in oil the trajectories of both laws almost coincide",
        below(2.0, "% of the clearance", partly=5.0), oil_same_path, mechanism=False,
    ),
    Claim(
        "oil film falls", "4.2, Fig. 9",
        "after contact the film force falls rapidly with RSDC, slowly with KE",
        above(1.5, "times", partly=1.0), oil_film_falls,
        "the film falls as the journal comes to rest, which damping delays", mechanism=False,
    ),
    Claim(
        "oil first contact", "4.2, Fig. 9",
        "in the initial stage of contact the force is significant with RSDC, very small with KE",
        above(2.0, "times", partly=1.5), oil_first_contact,
        "in oil the journal touches slowly, and what damping adds is small", mechanism=False,
    ),
    Claim(
        "oil balance", "4.2, Fig. 9", "in oil the final contact forces balance the external loads",
        below(1.0, "%"), oil_balance, mechanism=False,
    ),
)  # fmt: skip
"""Claims on section 4."""
