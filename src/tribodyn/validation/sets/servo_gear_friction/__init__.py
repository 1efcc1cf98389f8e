"""Fitted friction and droop of a geared servo joint."""

import math
from dataclasses import replace
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.studies.least_squares import FitParameter, LeastSquares, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

VOLTAGES: Final = np.array([8.0, 10.0, 12.0])
"""Supply voltages [V]."""
_DIRECT: Final = ("yes", "partly")


def compare(one: ValidationSet) -> Outcome:
    """Return friction floor with its interval, friction per torque, and droop at three voltages."""
    direct = direct_measurements(one)
    floor, plain = friction_floor(np.log(direct)), friction_floor(direct)
    low, high = (math.exp(end) for end in floor.interval("floor"))
    of_both = max(low, plain.interval("floor")[0]), min(high, plain.interval("floor")[1])
    value = math.exp(floor.named["floor"])
    at_hold = float(_at_voltages(one, "friction mobilised at a hold, no load")[2])
    units = one.value("unit_low"), one.value("unit_high")
    slopes = _at_voltages(one, "friction per carried torque")
    slope_units = one.value("slope_low"), one.value("slope_high")
    four = replace(one.bands["floor"], at_least=units[0], at_most=units[1])
    rows = [
        Comparison(
            "friction floor, fitted value",
            "N m",
            value,
            sum(units) / 2.0,
            u_computed=0.5 * (high - low),
            u_measured=0.5 * (units[1] - units[0]),
            null=at_hold,
            band=four,
            not_judged="The logarithm was chosen with the values known, and the verdict rests on it: without "
            f"it the fitted value is {plain.named['floor']:.3f} N m, outside the band.",
        ),
        Comparison(
            "friction floor, interval",
            "N m",
            value,
            u_computed=0.5 * (high - low),
            null=at_hold,
            spread=of_both,
            band=one.bands["floor_interval"],
            note="Judged is what the intervals of both fits, with and without the logarithm, have in common.",
        ),
        Comparison(
            "friction per carried torque, mean of three voltages",
            "N m per N m",
            float(slopes.mean()),
            sum(slope_units) / 2.0,
            u_computed=float(np.ptp(slopes)) / 2.0,
            u_measured=0.5 * (slope_units[1] - slope_units[0]),
            null=float(slopes[-1]),
        ),
    ]
    measured = _at_voltages(one, "droop")
    computed = droop(measured)
    rows += [
        Comparison(
            f"droop at {voltage:g} V",
            "deg per N m",
            float(computed[k]),
            float(measured[k]),
            u_measured=one.value("method_error") * float(measured[k]),
            null=float(measured.mean()),
            band=one.bands["droop"],
        )
        for k, voltage in enumerate(VOLTAGES)
    ]
    width = one.value("method_error") * measured
    points = Curve("measured", "measured", VOLTAGES, measured, width)
    curve = Curve("inverse to the voltage", "computed", VOLTAGES, computed)
    return Outcome(tuple(rows), Plot("supply voltage [V]", "droop [deg per N m]", (points, curve)))


def direct_measurements(one: ValidationSet) -> FloatArray:
    """Return the friction floor by each direct method [N m], shape (n,)."""
    rows = [row for row in one.rows("coulomb_by_method.csv") if row["direct"] in _DIRECT]
    return np.array([float(row["coulomb_torque_N_m"]) for row in rows])


def friction_floor(measured: FloatArray) -> LeastSquares:
    """Return the fit of one friction floor to measured values, or to their logarithms, shape (n,)."""
    return fit(lambda given: given["floor"] - measured, [FitParameter("floor", -5.0, 1.0)], starts=1)


def droop(measured: FloatArray) -> FloatArray:
    """Return the droop c/V with c from relative least squares [deg per N m], shape (3,)."""
    found = fit(
        lambda given: given["constant"] / VOLTAGES / measured - 1.0,
        [FitParameter("constant", 1.0, 100.0)],
        starts=1,
    )
    return np.asarray(found.named["constant"] / VOLTAGES)


def _at_voltages(one: ValidationSet, quantity: str) -> FloatArray:
    """Return the measured values of a quantity at :data:`VOLTAGES`, shape (3,)."""
    (row,) = [row for row in one.rows("friction_by_voltage.csv") if row["quantity"] == quantity]
    return np.array([float(row[f"at_{voltage:.0f}V"]) for voltage in VOLTAGES])
