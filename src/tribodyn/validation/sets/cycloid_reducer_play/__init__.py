"""Play, friction and stiffness of a reducer, fitted to its loops of deflection over torque."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.studies.least_squares import FitParameter, LeastSquares, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot, rms
from tribodyn.validation.catalogue import ValidationSet

FRICTION: Final = FitParameter("friction", 0.1, 10.0)
PLAY: Final = FitParameter("play", 0.1, 5.0)
STIFFNESS: Final = FitParameter("stiffness", 50.0, 2000.0)
#: Friction [N m], play [deg], stiffness [N m/rad], zero of the deflection [deg].
ZERO: Final = FitParameter("zero", -2.0, 2.0)
START: Final = {"friction": 2.0, "play": 1.5, "stiffness": 300.0, "zero": 0.0}
_RATE: Final = 4.0  #: Change of the torque over time [N m/s].
_PAUSE: Final = 1e-4  #: Least time between two rows, over that of 1 N m.
_FAR: Final = 90.0  #: Angle at which the table of the spring ends [deg].
_SAMPLES: Final = 2000
_STIFF_ROWS: Final = 4  #: Every so many of the rows of the stiffness test is used.


@dataclass(frozen=True)
class ReducerLoop:
    """Torque [N m] and deflection [deg] in the order of the record, shapes (n,)."""

    torque: FloatArray
    deflection: FloatArray

    def crossings(self, of: FloatArray, over: FloatArray) -> FloatArray:
        """Return the values of one quantity where the other changes its sign around the loop."""
        of, over = (np.append(values, values[0]) for values in (of, over))
        at = np.flatnonzero(np.diff(np.sign(over)))
        share = over[at] / (over[at] - over[at + 1])
        return np.asarray(of[at] + share * (of[at + 1] - of[at]))


def record(one: ValidationSet, test: str, every: int = 1) -> ReducerLoop:
    """Return a loop of the baseline after running in."""
    names = ("motor_torque_at_output_Nm", "deflection_deg")
    return ReducerLoop(*one.columns(f"baseline_{test}_after_run_in.csv", *names, every=every))


def computed(given: Mapping[str, float], loop: ReducerLoop) -> FloatArray:
    """Return the deflection in the second of two passes of a record [deg], shape (n,)."""
    torque, n = np.tile(loop.torque, 2), loop.torque.size
    times = np.append(0.0, np.cumsum(np.abs(np.diff(torque)) + _PAUSE)) / _RATE
    half = 0.5 * given["play"]
    most = given["stiffness"] * math.radians(_FAR - half)
    changes = {
        "torsion_springs.gears.torque.angles": f"{-_FAR}, {-half}, {half}, {_FAR} deg",
        "torsion_springs.gears.torque.values": f"{-most}, 0, 0, {most} N m",
        "frictions.motor.normal_load": f"{given['friction']} N",
        "drives.motor.torque.times": f"{', '.join(map(repr, times.tolist()))} s",
        "drives.motor.torque.values": f"{', '.join(map(repr, torque.tolist()))} N m",
        "run.duration": f"{times[-1]} s",
        "run.output_interval": f"{times[-1] / _SAMPLES} s",
    }
    run = ValidationSet("cycloid_reducer_play").simulated("reducer.toml", changes)
    angle = np.degrees(run["joint_angle"].values[:, 0])
    return np.asarray(np.interp(times[n:], run["time"].values, angle) + given["zero"])


def fitted(loop: ReducerLoop, free: tuple[FitParameter, ...], held: Mapping[str, float]) -> LeastSquares:
    """Return the fit of some parameters to a loop, the others being held; residuals in degrees."""
    return fit(
        lambda given: computed({**held, **given}, loop) - loop.deflection,
        free,
        start={name: value for name, value in START.items() if name not in held},
        step=1e-2,
        tolerance=1e-3,
    )


def compare(one: ValidationSet) -> Outcome:
    """Return play, friction and stiffness, and the errors of the fitted loop with and without play."""
    play, stiff = record(one, "play"), record(one, "stiffness", _STIFF_ROWS)
    stiffness = fitted(stiff, (FRICTION, PLAY, STIFFNESS, ZERO), {}).named["stiffness"]
    found = fitted(play, (FRICTION, PLAY, ZERO), {"stiffness": stiffness})
    without = fitted(play, (FRICTION, STIFFNESS, ZERO), {"play": 1e-3})
    authors = next(row for row in one.rows("play_friction_stiffness.csv") if row["reducer"] == "baseline")
    at_rest = play.crossings(play.deflection, play.torque)
    crossed = play.crossings(play.torque, play.deflection)
    rises = np.diff(stiff.torque, prepend=0.0) > 0.0
    outer = rises & (stiff.torque > 0.4 * stiff.torque[rises].max())
    slope = math.degrees(float(np.polyfit(stiff.deflection[outer], stiff.torque[outer], 1)[0]))
    width, half = float(np.ptp(at_rest)), 0.5 * float(np.ptp(crossed))
    rows = []
    for name, unit, value, column, null in (
        ("play", "deg", found.named["play"], "play_deg", width),
        ("friction", "N m", found.named["friction"], "coulomb_friction_Nm", half),
        ("stiffness", "N m/rad", stiffness, "stiffness_Nm_per_rad", slope),
    ):
        label, own = f"{name}, baseline after running in", float(authors[column])
        rows.append(Comparison(label, unit, value, own, null=null, band=one.bands[name]))
    error, missed = (rms(fit.residuals) for fit in (found, without))
    name = "fitted loop of the play test, root mean square error"
    rows.append(Comparison(name, "deg", error, null=missed, band=one.bands["loop"]))
    name = "the same without play"
    rows.append(Comparison(name, "deg", missed, 0.0, null=missed, band=one.bands["without_play"]))
    return Outcome(tuple(rows), _plot(play, {**found.named, "stiffness": stiffness}))


def _plot(loop: ReducerLoop, given: Mapping[str, float]) -> Plot:
    torque, values = loop.torque, computed(given, loop)
    measured = Curve("measured", "measured", torque, loop.deflection)
    return Plot("torque [N m]", "deflection [deg]", (measured, Curve("fitted", "computed", torque, values)))
