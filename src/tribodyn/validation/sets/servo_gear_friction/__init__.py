"""Fitted friction and droop of a geared servo joint."""

import math
from dataclasses import replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.studies.least_squares import FitParameter, LeastSquares, fit
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet

VOLTAGES: Final = np.array([8.0, 10.0, 12.0])  #: Supply voltages [V].
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
    half, unit = 0.5 * (high - low), "N m"
    why = (
        "The logarithm was chosen with the values known, and the verdict rests on it: without "
        f"it the fitted value is {plain.named['floor']:.3f} N m, outside the band."
    )
    note = "Judged is what the intervals of both fits, with and without the logarithm, have in common."
    known = sum(units) / 2.0, half, 0.5 * (units[1] - units[0]), at_hold
    slope, scatter = float(slopes.mean()), float(np.ptp(slopes)) / 2.0
    sloped = sum(slope_units) / 2.0, scatter, 0.5 * (slope_units[1] - slope_units[0]), float(slopes[-1])
    judged = None, half, 0.0, at_hold, one.bands["floor_interval"], of_both
    rows = [
        Comparison("friction floor, fitted value", unit, value, *known, four, not_judged=why),
        Comparison("friction floor, interval", unit, value, *judged, note=note),
        Comparison("friction per carried torque, mean of three voltages", "N m per N m", slope, *sloped),
    ]
    measured = _at_voltages(one, "droop")
    computed, mean = droop(measured), float(measured.mean())
    for voltage, value, droops in zip(VOLTAGES, computed.tolist(), measured.tolist(), strict=True):
        name, error = f"droop at {voltage:g} V", one.value("method_error") * droops
        rows.append(Comparison(name, "deg per N m", value, droops, 0.0, error, mean, one.bands["droop"]))
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
