"""The register of predictions: numbers stated before the measured values are seen.

``predictions.toml`` holds one entry for each number: the set, the day, the hash of the inputs and data that
it was computed from, value and interval. This module computes them anew, so that a test finds any entry that
was changed. An entry is never changed or removed; a better model adds entries with a later date.
"""

from __future__ import annotations

import hashlib
import math
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.resources import files
from typing import Any, Final

import numpy as np

from tribodyn.cases.units import number_in
from tribodyn.validation.catalogue import ValidationSet, load
from tribodyn.validation.sets.journal_peak_pressure import compare as peak
from tribodyn.validation.sets.oblique_impact import compare as oblique
from tribodyn.validation.sets.screw_drive_friction import laws as screw
from tribodyn.validation.sets.servo_play import compare as play
from tribodyn.validation.vary import varied

FILE: Final = "predictions.toml"
HELD_LOAD: Final = 450.0
"""Load of the points of the bearing that are held back [N]."""
HELD_SPEEDS: Final = (250.0, 500.0, 650.0)
COUPLED_TORQUE: Final = 0.294
"""Torque on two coupled servos [N m]."""
_START: Final = (0.9, 1.3)
"""Start torque over friction at rest: static friction grows with the time at rest, which is not known."""
_STOP: Final = (0.85, 1.15)


@dataclass(frozen=True)
class Prediction:
    """A number stated before its measured value is seen.

    Attributes
    ----------
    set, name, unit
        Validation set, what it is, and its unit.
    value, low, high
        Value and interval.
    """

    set: str
    name: str
    unit: str
    value: float
    low: float
    high: float


def register() -> list[dict[str, Any]]:
    """Return the entries of the register, in the order of their entry."""
    text = (files(__package__) / FILE).read_text(encoding="utf-8")
    return list(tomllib.loads(text)["prediction"])


def fingerprint(one: ValidationSet) -> str:
    """Return the hash of the inputs and data files of a set."""
    digest = hashlib.sha256(repr(sorted(one.table.get("inputs", {}).items())).encode())
    for file in sorted(one.folder.iterdir(), key=lambda entry: entry.name):
        if file.name.endswith(".csv"):
            digest.update(file.name.encode())
            digest.update(file.read_bytes())
    return digest.hexdigest()


def computed() -> Iterator[Prediction]:
    """Compute every prediction."""
    yield from _peak_pressures(load("journal_peak_pressure"))
    yield from _servos(load("servo_play"))
    yield from _rebounds(load("oblique_impact"))
    yield from _screws(load("screw_drive_friction"))


def _peak_pressures(one: ValidationSet) -> Iterator[Prediction]:
    """Peak pressure by the film, and by the measured ratios of peak to mean pressure over the load."""
    places = [(speed, HELD_LOAD) for speed in HELD_SPEEDS]
    result = varied(lambda given: peak.peaks(given, places), one.inputs.values())
    measured = {
        (float(row["speed_rpm"]), float(row["load_N"])): float(row["peak_pressure_measured_kPa"])
        for row in one.rows("peak_pressure.csv")
    }
    for k, speed in enumerate(HELD_SPEEDS):
        value, half = float(result.values[k]), float(result.half_widths[k])
        name = f"peak pressure, {speed:g} rpm, {HELD_LOAD:g} N"
        yield Prediction(one.name, f"{name}, film", "kPa", value, value - half, value + half)
        straight = 2.0 * measured[speed, 300.0] - measured[speed, 150.0]
        ratio = HELD_LOAD * measured[speed, 300.0] / 300.0
        power = measured[speed, 300.0] * 1.5 ** math.log2(measured[speed, 300.0] / measured[speed, 150.0])
        yield Prediction(
            one.name,
            f"{name}, extrapolated",
            "kPa",
            power,
            0.9 * min(straight, ratio),
            1.1 * max(ratio, power),
        )


def _servos(one: ValidationSet) -> Iterator[Prediction]:
    """Two servos on one lever: half the compliance; play between none and that of one, none if preloaded."""
    found = play.fitted(one, play.SINGLE)
    single, band = found.named, number_in(one.inputs["dead_band"].high, "deg")
    (_, most), (soft, stiff) = play.interval(found, "play"), play.interval(found, "compliance")
    swing = single["compliance"] * COUPLED_TORQUE
    free = 0.5 * single["play"] + single["dead_band"]
    least, largest = soft * COUPLED_TORQUE, stiff * COUPLED_TORQUE
    yield Prediction(one.name, "coupled servos, released deviation", "deg", free, 0.0, most + band)
    yield Prediction(
        one.name, "coupled servos, loaded deviation", "deg", free + swing, least, most + band + largest
    )
    idle = 0.5 * single["dead_band"]
    yield Prediction(one.name, "preloaded servos, released deviation", "deg", idle, 0.0, band)
    yield Prediction(
        one.name, "preloaded servos, loaded deviation", "deg", idle + swing, least, band + largest
    )


def _rebounds(one: ValidationSet) -> Iterator[Prediction]:
    """Rebound angle and spin with tangential compliance; intervals by inputs and the accepted restitution."""
    angles = [float(row["impact_angle_from_normal_deg"]) for row in one.rows("tangential_restitution.csv")]
    result = varied(
        lambda given: np.array([_rebound(given, angle) for angle in angles]).ravel(), one.inputs.values()
    )
    values, halves = (part.reshape(-1, 2) for part in (result.values, result.half_widths))
    given = {name: known.value for name, known in one.inputs.items()}
    for angle, (out, spin), (of_out, of_spin) in zip(angles, values, halves, strict=True):
        band = one.bands["sliding" if angle >= oblique.SLIDING else "compliant"].absolute
        assert band is not None
        tangent = math.tan(math.radians(out)) + band * math.tan(math.radians(angle)) / given["restitution"]
        of_out = math.hypot(of_out, math.degrees(math.atan(tangent)) - out)
        slide = given["speed"] * math.sin(math.radians(angle))
        of_spin = math.hypot(of_spin, 2.5 * slide * band / (0.5 * given["diameter"]))
        yield Prediction(one.name, f"rebound angle, {angle:.1f} deg", "deg", out, out - of_out, out + of_out)
        yield Prediction(one.name, f"spin, {angle:.1f} deg", "rad/s", spin, spin - of_spin, spin + of_spin)


def _rebound(given: Any, angle: float) -> tuple[float, float]:
    after = oblique.impact(given, angle, "compliant")
    return math.degrees(after.angle(math.radians(angle))), after.spin


def _screws(one: ValidationSet) -> Iterator[Prediction]:
    """Torque at start and stop: the fitted law at rest."""
    for drive, name in (("1", "Stribeck"), ("2", "Stribeck"), ("3", "Stribeck by direction")):
        given = screw.fitted(one, drive, name).named
        law, _ = screw.LAWS[name]
        for way, sign in (("forward", 1.0), ("backward", -1.0)):
            torque = abs(float(law(given, np.array([sign * 1e-9]))[0]))
            for event, (low, high) in (("start", _START), ("stop", _STOP)):
                quantity = f"drive {drive}, {event} torque {way}"
                yield Prediction(one.name, quantity, "mN m", torque, low * torque, high * torque)
