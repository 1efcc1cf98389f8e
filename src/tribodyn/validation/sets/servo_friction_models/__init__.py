"""Torque of the friction library against the published formulas, model by model."""

import math
from collections.abc import Callable, Mapping
from itertools import product
from typing import Final

import numpy as np

from tribodyn.friction import FrictionLimit
from tribodyn.validation.base import Comparison, Outcome
from tribodyn.validation.catalogue import ValidationSet

SPEEDS: Final = (-5.0, -1.0, -0.2, -0.01, 0.0, 0.05, 0.5, 3.0)
TORQUES: Final = (-2.0, -0.7, 0.0, 0.3, 2.0)

Parameters = Mapping[str, float]


def compare(one: ValidationSet) -> Outcome:
    """Return the largest difference of torque for each actuator, over its models, speeds and torques."""
    largest: dict[str, float] = {}
    for row in one.rows("parameters.csv"):
        given = {key: float(text) for key, text in row.items() if text and key not in ("actuator", "model")}
        difference = _difference(library(given), REFERENCES[row["model"]], given)
        largest[row["actuator"]] = max(largest.get(row["actuator"], 0.0), difference)
    return Outcome(
        tuple(
            Comparison(f"{actuator}, largest difference", "N m", value, band=one.bands["formula"])
            for actuator, value in largest.items()
        )
    )


def library(given: Parameters) -> FrictionLimit:
    """Return the friction law with published parameters; those that a model lacks are zero."""
    both = given.get("load_friction_base", 0.0), given.get("load_friction_stribeck", 0.0)
    return FrictionLimit(
        coulomb=given["friction_base"],
        viscous=given["friction_viscous"],
        stribeck=given.get("friction_stribeck", 0.0),
        stribeck_speed=given.get("dtheta_stribeck", 1.0),
        stribeck_exponent=given.get("alpha", 2.0),
        motor_load=given.get("load_friction_motor", both[0]),
        external_load=given.get("load_friction_external", both[0]),
        motor_load_stribeck=given.get("load_friction_motor_stribeck", both[1]),
        external_load_stribeck=given.get("load_friction_external_stribeck", both[1]),
        motor_load_quadratic=given.get("load_friction_motor_quad", 0.0),
        external_load_quadratic=given.get("load_friction_external_quad", 0.0),
    )


def _difference(law: FrictionLimit, reference: Callable[..., float], given: Parameters) -> float:
    places = np.array(list(product(SPEEDS, TORQUES, TORQUES)))
    computed = law(*places.T)
    expected = np.array([reference(given, *map(float, place)) for place in places])
    return float(np.abs(computed - expected).max())


def _m1(p: Parameters, w: float, motor: float, load: float) -> float:
    return p["friction_viscous"] * abs(w) + p["friction_base"]


def _decay(p: Parameters, w: float) -> float:
    return math.exp(-math.pow(abs(w / p["dtheta_stribeck"]), p["alpha"]))


def _m2(p: Parameters, w: float, motor: float, load: float) -> float:
    return _m1(p, w, motor, load) + _decay(p, w) * p["friction_stribeck"]


def _m3(p: Parameters, w: float, motor: float, load: float) -> float:
    return _m1(p, w, motor, load) + p["load_friction_base"] * abs(motor - load)


def _m4(p: Parameters, w: float, motor: float, load: float) -> float:
    at_rest = p["friction_stribeck"] + p["load_friction_stribeck"] * abs(motor - load)
    return _m3(p, w, motor, load) + _decay(p, w) * at_rest


def _m5(p: Parameters, w: float, motor: float, load: float) -> float:
    carried = abs(p["load_friction_motor"] * motor - p["load_friction_external"] * load)
    at_rest = abs(p["load_friction_motor_stribeck"] * motor - p["load_friction_external_stribeck"] * load)
    return _m2(p, w, motor, load) + carried + _decay(p, w) * at_rest


def _m6(p: Parameters, w: float, motor: float, load: float) -> float:
    base = _m5(p, w, motor, load)
    if motor * load > 0.0 or (motor == 0.0 and load == 0.0):
        return base
    if abs(motor) > abs(load):
        return base + _decay(p, w) * p["load_friction_external_quad"] * load**2
    if abs(motor) < abs(load):
        return base + _decay(p, w) * p["load_friction_motor_quad"] * motor**2
    return base


#: The six models, each written out separately.
REFERENCES: Final = {"m1": _m1, "m2": _m2, "m3": _m3, "m4": _m4, "m5": _m5, "m6": _m6}
