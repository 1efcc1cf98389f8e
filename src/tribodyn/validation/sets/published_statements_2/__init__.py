"""Sign and order of published effects: a gap, rest on friction, torque over clearance, oil, impacts."""

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate
from tribodyn.validation.base import Comparison, Curve, Outcome, Plot
from tribodyn.validation.catalogue import ValidationSet
from tribodyn.validation.sets.published_statements import torque_ratio

#: Velocities of the mass in the gap [mm/s]: the larger, the larger the amplitude.
VELOCITIES: Final = (10.0, 20.0, 50.0)
CLEARANCES: Final = ("5 um", "50 um", "350 um")  #: Radial clearances of a bushing.
PEAKS: Final = ("20 um", "40 um", "80 um")  #: Radial clearances of the wrist of the slider-crank.
_MASS: Final = 1.0
_STIFFNESS: Final = 1e3
_OIL: Final = {"joints.wrist.film.viscosity": "0.01 Pa s"}


def compare(one: ValidationSet) -> Outcome:
    """Return differences whose sign is stated."""
    order = replace(one.bands["order"], at_least=0.0)
    found = [frequency(one, velocity) for velocity in VELOCITIES]
    rows = []
    for k, velocity in enumerate(VELOCITIES[1:]):
        name = f"rise of the frequency over a gap, {VELOCITIES[k]:g} to {velocity:g} mm/s"
        rows.append(Comparison(name, "Hz", found[k + 1] - found[k], null=0.0, band=order))
    name = "standing pendulum, angle after 1 s without clearance less that with it"
    rows.append(Comparison(name, "deg", fall(one, "ideal") - fall(one, "dry"), null=0.0, band=order))
    given = {name: one.value(name) for name in ("friction", "load", "liner")}
    torques = [torque_ratio(given, float(text.split()[0]) * 1e-6) for text in CLEARANCES]
    growth = (torques[0] - torques[1]) - (torques[1] - torques[2])
    name = "torque / (mu W R), growth from 50 to 5 um less that from 350 to 50 um"
    rows.append(Comparison(name, "", growth, null=0.0, band=order))
    forces = [float(_force(_crank({"run.cycles": 1, **more})).max()) for more in ({}, _OIL)]
    name = "peak force of the wrist, dry less in oil"
    rows.append(Comparison(name, "N", forces[0] - forces[1], null=0.0, band=order))
    radial = "joints.wrist.clearance.radial"
    angles = [_angle_of_peak(_crank({radial: text, "run.cycles": 1})) for text in PEAKS]
    name = "crank angle of the largest force, range over three clearances"
    note = "The statement names fixed places of several impacts in a cycle."
    rows.append(Comparison(name, "deg", float(np.ptp(angles)), 0.0, null=0.0, note=note))
    return Outcome(tuple(rows), _plot(one, found))


def frequency(one: ValidationSet, velocity: float) -> float:
    """Return the frequency of a mass that crosses a gap at a velocity [Hz]."""
    gap = one.value("gap")
    keys: dict[str, object] = {
        "joints.guide.start_velocity": f"{velocity} mm/s",
        "stops.ahead.position": f"{gap} m",
        "stops.behind.position": f"{-gap} m",
    }
    run = one.simulated("gap.toml", keys)
    place = run["position"].values[:, 0, 0]
    begins = run["time"].values[1:][(place[:-1] < 0.0) & (place[1:] >= 0.0)]
    return float(1.0 / np.diff(begins).mean())


def by_hand(gap: float, velocity: float) -> float:
    """Return the frequency by flight and half a period of contact on each side [Hz]."""
    return 1.0 / (4.0 * gap / velocity + 2.0 * math.pi * math.sqrt(_MASS / _STIFFNESS))


def fall(one: ValidationSet, joint: str) -> float:
    """Return the angle of the standing pendulum after a second [deg], its joint ideal or dry."""
    keys = {"joints.pin.clearance.ideal": joint == "ideal", "friction.rest": joint != "ideal"}
    run = one.simulated("pendulum.toml", keys)
    return float(np.degrees(np.abs(run["joint_angle"].values[-1, 0])))


def _crank(changes: Mapping[str, object]) -> xr.Dataset:
    return simulate(load_case("slider-crank").replace(changes))


def _force(run: xr.Dataset) -> FloatArray:
    """Return the force of the wrist at output times [N]."""
    return np.asarray(np.linalg.norm(run["reaction_force"].sel(joint="wrist").values, axis=-1))


def _angle_of_peak(run: xr.Dataset) -> float:
    angle = run["joint_angle"].sel(joint="main").values[int(np.argmax(_force(run)))]
    return math.remainder(math.degrees(float(angle)), 360.0)


def _plot(one: ValidationSet, found: list[float]) -> Plot:
    hand = [by_hand(one.value("gap"), 1e-3 * velocity) for velocity in VELOCITIES]
    curves = Curve("computed", "computed", VELOCITIES, found), Curve("by hand", "null", VELOCITIES, hand)
    return Plot("velocity in the gap [mm/s]", "frequency [Hz]", curves)
