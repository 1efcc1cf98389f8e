"""Claims on the journal of section 4, dry and in oil."""

from functools import partial
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.papers.cheng_2022.claims.base import (
    FIRST,
    REVIEWED,
    VARIED,
    Claim,
    Finding,
    Trial,
    above,
    below,
    listed,
)
from tribodyn.papers.cheng_2022.journal import over_laws, run_of
from tribodyn.papers.cheng_2022.runs import LAWS

LOAD: Final = (200.0, 100.0)  #: Load along X and Y in section 4.1 [N].
_BEGUN: Final = 0.001  #: Contact has begun where its force exceeds this share of the final one.
_INITIAL: Final = 0.1  #: The initial stage of contact lasts until its force is this share of the final one.
_FALL: Final = (0.9, 0.1)  #: The fall of a force is timed between these shares of its largest value.


def _dry(trial: Trial, law: str) -> xr.Dataset:
    return over_laws(trial.runs, "journal-dry").sel(law=law)


def _oil(trial: Trial, law: str) -> xr.Dataset:
    return over_laws(trial.runs, "journal-oil").sel(law=law)


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
    """Measure the range of the dry journal in the last fifth of the run."""
    motion = late_motion(_dry(trial, law))
    return Finding(f"moves by {motion:.3g} % of the clearance in the last fifth of the run", motion)


def dry_first_impact(trial: Trial) -> Finding:
    """Measure the largest contact force with RSDC over the load."""
    force = _size(_dry(trial, "rsdc"), "F_c")
    load = float(np.hypot(*LOAD))
    return Finding(f"{force.max():.4g} N at the first impact, load {load:.4g} N", float(force.max()) / load)


def dry_energy_decays(trial: Trial) -> Finding:
    """Measure the kinetic energy with RSDC at the end over its largest."""
    energy = _dry(trial, "rsdc")["energy_kinetic"].values
    share = 100.0 * float(energy[-1] / energy.max())
    return Finding(f"{share:.2g} % of {energy.max() * 1e3:.3g} mJ", share)


def dry_ke_energy(trial: Trial) -> Finding:
    """Measure the growth of the largest kinetic energy with KE, from the first half to the second."""
    run = _dry(trial, "ke")
    first, last = _halves(run, run["energy_kinetic"].values * 1e3)
    return Finding(f"at most {first:.4g} mJ, then {last:.4g} mJ", 100.0 * (last / first - 1.0))


def dry_ke_growth(trial: Trial) -> Finding:
    """Measure the largest eccentricity with KE in the second half over that in the first."""
    run = _dry(trial, "ke")
    first, last = _halves(run, _size(run, "e_") * 1e6)
    return Finding(f"at most {first:.3f} µm in the first half, then {last:.3f} µm", last / first)


def dry_ke_penetrates(trial: Trial) -> Finding:
    """Measure the largest eccentricity with KE over the clearance."""
    run = _dry(trial, "ke")
    largest = float(_size(run, "e_").max())
    return Finding(
        f"goes {largest * 1e6:.2f} µm from the centre of {run.attrs['clearance'] * 1e6:.3g}",
        largest / float(run.attrs["clearance"]),
    )


def dry_ke_rebound(trial: Trial) -> Finding:
    """Measure the largest distance beyond the start, against the load, with KE."""
    run = _dry(trial, "ke")
    load = np.array([run[f"F_c{axis}"].values.mean() for axis in "xy"])
    along = np.hypot(*load) ** -1 * (load[0] * run["e_x"].values + load[1] * run["e_y"].values)
    beyond = 100.0 * float(along.max()) / float(run.attrs["clearance"])
    return Finding(f"at most {beyond:.2g} % of the clearance beyond where it started", beyond)


def dry_ke_force(trial: Trial) -> Finding:
    """Measure the largest contact force with KE in the second half over that in the first."""
    run = _dry(trial, "ke")
    first, last = _halves(run, _size(run, "F_c"))
    return Finding(f"at most {first:.4g} N in the first half, then {last:.4g} N", last / first)


def oil_settles(trial: Trial) -> Finding:
    """Measure the range of the oiled journal in the last fifth of the run, the larger of both laws."""
    motions = [late_motion(_oil(trial, law)) for law in LAWS]
    each = ", ".join(f"{motion:.1g} % ({law.upper()})" for law, motion in zip(LAWS, motions, strict=True))
    return Finding(f"moves by {each} of the clearance in the last fifth of the run", max(motions))


def oil_same_path(trial: Trial) -> Finding:
    """Measure the largest distance between the paths of the two laws in oil."""
    rsdc, ke = (_oil(trial, law) for law in LAWS)
    apart = np.hypot(*(rsdc[f"e_{axis}"].values - ke[f"e_{axis}"].values for axis in "xy"))
    largest = 100.0 * float(apart.max()) / float(rsdc.attrs["clearance"])
    return Finding(f"never further apart than {largest:.2g} % of the clearance", largest)


def fall_time(run: xr.Dataset) -> float:
    """Return the time in which the force of the film falls from 90 to 10 % of its largest value [ms]."""
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
    """Measure the fall time of the film force with KE over that with RSDC."""
    rsdc, ke = (fall_time(_oil(trial, law)) for law in LAWS)
    return Finding(f"from 90 to 10 % in {rsdc:.2f} ms with RSDC, in {ke:.2f} ms with KE", ke / rsdc)


def oil_film_gives_way(trial: Trial) -> Finding:
    """Measure the largest difference of film and contact force from the load, after contact."""
    missed = [_missed(_oil(trial, law)) for law in LAWS]
    return Finding(f"together at most {listed(np.array(missed), '%')} off the load", max(missed))


def _missed(run: xr.Dataset) -> float:
    carried = np.array([run[f"F_c{axis}"].values + run[f"F_o{axis}"].values for axis in "xy"])
    touching = _size(run, "F_c") > _BEGUN * _size(run, "F_c")[-1]
    off = np.hypot(*(carried[:, touching] + np.array(LOAD)[:, None]))
    return float(100.0 * off.max() / np.hypot(*LOAD))


def oil_damps_more(trial: Trial) -> Finding:
    """Measure the heat of the film over that of contact damping, with RSDC in oil."""
    run = _oil(trial, "rsdc")
    film, contact = (abs(float(run[f"energy_{name}"].values[-1])) * 1e3 for name in ("film", "damping"))
    return Finding(f"{film:.3g} mJ in the film, {contact:.2g} mJ in the contact", film / contact)


def oil_first_contact(trial: Trial) -> Finding:
    """Measure the contact force with RSDC over that with KE in the initial stage of contact, at most."""
    rsdc, ke = (_size(_oil(trial, law), "F_c") for law in LAWS)
    initial = (rsdc > _BEGUN * rsdc[-1]) & (rsdc < _INITIAL * rsdc[-1])
    ratio = float((rsdc[initial] / ke[initial]).max())
    return Finding(f"at most {100.0 * (ratio - 1.0):.0f} % larger with RSDC, at the same instant", ratio)


def oil_balance(trial: Trial) -> Finding:
    """Measure the difference of the final contact forces from the load, the larger of both laws."""
    runs = [_oil(trial, law) for law in LAWS]
    missed = [
        abs(abs(float(run[f"F_c{axis}"].values[-1])) / load - 1.0)
        for run in runs
        for axis, load in zip("xy", LOAD, strict=True)
    ]
    return Finding(f"{100.0 * max(missed):.1g} % off the load", 100.0 * max(missed))


def oil_carries_soon(trial: Trial) -> Finding:
    """Measure the time until the film carries 90 % of the load, over that until contact begins, at most."""
    shares = [_soon(_oil(trial, law)) for law in LAWS]
    return Finding(f"after {listed(np.array(shares), '%')} of the time", max(shares))


def _soon(run: xr.Dataset) -> float:
    time, contact = run["time"].values, _size(run, "F_c")
    carries = time[int(np.argmax(_size(run, "F_o") > 0.9 * np.hypot(*LOAD)))]
    return float(100.0 * carries / time[int(np.argmax(contact > _BEGUN * contact[-1]))])


def oil_smooth(trial: Trial) -> Finding:
    """Measure the turns of e_x or e_y by a thousandth of the clearance, the most of both laws."""
    turns = [_turns(_oil(trial, law), axis) for law in LAWS for axis in "xy"]
    return Finding(f"{max(turns)} times", float(max(turns)))


def _turns(run: xr.Dataset, axis: str) -> int:
    """Return the number of times that a coordinate turns back by a thousandth of the clearance."""
    least, turns, way = 1e-3 * float(run.attrs["clearance"]), 0, 0.0
    extreme = float(run[f"e_{axis}"].values[0])
    for place in run[f"e_{axis}"].values:
        if way * (place - extreme) >= 0.0 and way != 0.0:
            extreme = place
        elif abs(place - extreme) > least:
            turns, way, extreme = turns + (way != 0.0), float(np.sign(place - extreme)), place
    return turns


def oil_by_viscosity(trial: Trial) -> Finding:
    """Measure the heat of the film over that of contact damping, with a tenth of the viscosity."""
    shares = []
    thin = run_of(trial.runs, "journal-oil", {"joints.bearing.film.viscosity": "0.001 Pa s"})
    for run in (_oil(trial, "rsdc"), thin):
        film, contact = (abs(float(run[f"energy_{name}"].values[-1])) for name in ("film", "damping"))
        shares.append(film / contact)
    text = (
        f"{shares[0]:.3g} times the heat of the contact, with a tenth of the viscosity {shares[1]:.3g} times"
    )
    return Finding(text, shares[1] / shares[0])


_KEPT: Final = (
    "the force of KE follows from the position, so energy is kept; a coarse fixed step makes it grow: that "
    "the paper's step did is an inference"
)

#: Claims on section 4.
CLAIMS: Final = (
    Claim(
        "dry RSDC rests", ("J1", "J4"), "dry, with RSDC e_x and e_y finally remain constant", "whole",
        below(1.0, "% of the clearance", since=FIRST), partial(dry_late_motion, law="rsdc"),
        formulations="alike",
    ),
    Claim(
        "dry first impact", ("J4",), "dry, the contact forces increase sharply at the initial contact",
        "whole", above(2.0, "times", partly=1.0, since=REVIEWED), dry_first_impact, formulations="alike",
    ),
    Claim(
        "dry energy decays", ("J7",), "dry, damping dissipates the kinetic energy of the journal", "whole",
        below(1.0, "%", partly=10.0, since=REVIEWED), dry_energy_decays, formulations="alike",
    ),
    Claim(
        "dry KE oscillates", ("J2",), "dry, the result with KE is oscillatory", "whole",
        above(1.0, "% of the clearance", since=FIRST), partial(dry_late_motion, law="ke"),
        formulations="alike",
    ),
    Claim(
        "dry KE grows", ("J2",), "dry, with KE the oscillation intensifies", "whole",
        above(1.01, "times", since=FIRST, origin=1.0), dry_ke_growth, _KEPT, formulations="alike",
    ),
    Claim(
        "dry KE energy kept", ("J8",), "without damping the kinetic energy is conserved or even increases",
        "whole", above(-1.0, "%", partly=-10.0, since=REVIEWED), dry_ke_energy, formulations="alike",
    ),
    Claim(
        "dry KE rebounds further", ("J5",),
        "with KE the rebound is greater than the distance of the initial state", "whole",
        above(1.0, "% of the clearance"), dry_ke_rebound, _KEPT, formulations="alike",
    ),
    Claim(
        "dry KE penetrates", ("J3", "J6"), "with KE the deviation grows beyond the radial clearance",
        "whole", above(1.0, "clearances", by="the paper"), dry_ke_penetrates, _KEPT, formulations="alike",
    ),
    Claim(
        "dry KE force", ("J6",), "with KE the contact force becomes extremely large in the end", "whole",
        above(2.0, "times", partly=1.1, origin=1.0), dry_ke_force, _KEPT, formulations="alike",
    ),
    Claim(
        "oil settles", ("O1", "O6", "O8"), "in oil the calculation is stable with both laws", "whole",
        below(1.0, "% of the clearance", since=FIRST), oil_settles, formulations="alike",
    ),
    Claim(
        "oil same path", ("O2", "A1", "K2"), "in oil the trajectories of both laws almost coincide", "whole",
        below(2.0, "% of the clearance", partly=5.0, since=FIRST), oil_same_path, formulations="alike",
    ),
    Claim(
        "oil smooth curves", ("O2",), "in oil the deviations are smooth curves", "whole",
        below(1.0, "turns", since=VARIED), oil_smooth, formulations="alike",
    ),
    Claim(
        "oil carries soon", ("O9",), "the oil rapidly produces the support forces", "whole",
        below(10.0, "% of the time until contact", partly=50.0, since=VARIED), oil_carries_soon,
        formulations="alike",
    ),
    Claim(
        "oil by viscosity", ("O7",), "the oil damps because of its viscosity", "whole",
        below(0.5, "times", partly=0.9, since=VARIED), oil_by_viscosity, formulations="alike",
    ),
    Claim(
        "oil film gives way", ("O3",), "the film forces are reduced as the contact forces grow", "whole",
        below(5.0, "%", partly=20.0, since=REVIEWED), oil_film_gives_way, formulations="alike",
    ),
    Claim(
        "oil film falls", ("O4",),
        "after contact the film force falls rapidly with RSDC, slowly with KE", "whole",
        above(1.5, "times", partly=1.0, origin=1.0), oil_film_falls,
        "the film falls as the journal comes to rest, which damping delays", formulations="alike",
    ),
    Claim(
        "oil first contact", ("O5",),
        "in the initial stage of contact the force is significant with RSDC, very small with KE", "whole",
        above(2.0, "times", partly=1.5, origin=1.0), oil_first_contact,
        "in oil the journal touches slowly, and what damping adds is small", formulations="alike",
    ),
    Claim(
        "oil balance", ("O6",), "in oil the final contact forces balance the external loads", "whole",
        below(1.0, "%"), oil_balance, formulations="alike",
    ),
    Claim(
        "oil damps more", ("O7", "K2"), "oil damps more than the materials of the friction pair", "whole",
        above(1.0, "times", by="the paper", since=REVIEWED), oil_damps_more, formulations="alike",
    ),
)  # fmt: skip
