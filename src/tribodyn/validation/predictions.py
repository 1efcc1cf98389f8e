"""The register of predictions: numbers stated before the measured values are seen.

``predictions.toml`` holds one entry for each number: the set, the day, the hash of the inputs and data that
it was computed from, value and interval. This module computes the newest anew, so that a test finds any entry
that was changed. An entry is never changed or removed; a better model adds entries with a later date. Entries
since 2026-11-26 state how the value is read, the level of the interval with both sides, the null model with
its interval, and what would refute them.
"""

import hashlib
import math
import sys
import tomllib
from collections.abc import Iterator, Mapping
from importlib.resources import files
from typing import Any, Final

import numpy as np

from tribodyn.cases.units import number_in
from tribodyn.validation.base import Prediction
from tribodyn.validation.catalogue import ValidationSet, Varied, load, varied
from tribodyn.validation.held_back import held_back
from tribodyn.validation.sets import journal_peak_pressure as peak
from tribodyn.validation.sets import oblique_impact as oblique
from tribodyn.validation.sets import screw_drive_friction as screw
from tribodyn.validation.sets import servo_play as play

FILE: Final = "predictions.toml"
HELD_LOAD: Final = 450.0  #: Load of the points of the bearing that are held back [N].
HELD_SPEEDS: Final = (250.0, 500.0, 650.0)
COUPLED_TORQUE: Final = 0.294  #: Torque on two coupled servos [N m].
#: Start torque over friction at rest: static friction grows with the time at rest, which is not known.
_START: Final = (0.9, 1.3)
_STOP: Final = (0.85, 1.15)


_NUMBERS: Final = ("value", "low", "high", "null", "null_low", "null_high")
#: Level of all intervals: ends of bands of inputs and half widths of data are those of 95 % intervals.
LEVEL: Final = 0.95


def register() -> list[dict[str, Any]]:
    """Return the entries of the register, in the order of their entry."""
    text = (files(__package__) / FILE).read_text(encoding="utf-8")
    return list(tomllib.loads(text)["prediction"])


def fingerprint(one: ValidationSet) -> str:
    """Return the hash of the inputs and data files of a set."""
    digest = hashlib.sha256(repr(sorted(one.table.get("inputs", {}).items())).encode())
    for file in sorted(one.data.iterdir(), key=lambda entry: entry.name):
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
    yield from held_back()


def new_entries(day: str) -> Iterator[str]:
    """Yield the entries of a day, as the register holds them, for predictions that have none of that day."""
    there = {entry["name"] for entry in register() if str(entry["date"]) == day}
    for one in computed():
        if one.name in there:
            continue
        numbers = {key: getattr(one, key) for key in (*_NUMBERS, "half_width")}
        lines = [f'set = "{one.set}"', f'name = "{one.name}"', f'unit = "{one.unit}"', f"date = {day}"]
        lines += [f'hash = "{fingerprint(load(one.set))}"']
        lines += [f"{key} = {numbers[key]:.5g}" for key in _NUMBERS]
        lines += [f"level = {LEVEL}", f'reading = "{one.reading}"', f"half_width = {one.half_width:.5g}"]
        yield "\n".join(["", "[[prediction]]", *lines, f'refuted_by = "{one.refuted_by}"', ""])


def _peak_pressures(one: ValidationSet) -> Iterator[Prediction]:
    """Peak pressure by the film; null model: the measured ratios of peak to mean pressure over the load."""
    places = [(speed, HELD_LOAD) for speed in HELD_SPEEDS]
    result = varied(lambda given: peak.peaks(given, places), one.inputs.values())
    measured = {
        (float(row["speed_rpm"]), float(row["load_N"])): float(row["peak_pressure_measured_kPa"])
        for row in one.rows("peak_pressure.csv")
    }
    gauge = one.value("gauge") / 1e3
    reading = "largest gauge pressure of the middle plane at this speed and load, to one step of the gauge"
    for k, speed in enumerate(HELD_SPEEDS):
        straight = 2.0 * measured[speed, 300.0] - measured[speed, 150.0]
        ratio = HELD_LOAD * measured[speed, 300.0] / 300.0
        power = measured[speed, 300.0] * 1.5 ** math.log2(measured[speed, 300.0] / measured[speed, 150.0])
        null = power, 0.9 * min(straight, ratio), 1.1 * max(ratio, power)
        name = f"peak pressure, {speed:g} rpm, {HELD_LOAD:g} N, film"
        yield Prediction(one.name, name, "kPa", *_interval(result, k), *null, reading, gauge)


def _interval(result: Varied, k: int) -> tuple[float, float, float]:
    """Return a value and the ends of its interval."""
    value, (below, above) = float(result.values[k]), result.sides_at(k)
    return value, value - below, value + above


def _servos(one: ValidationSet) -> Iterator[Prediction]:
    """Two servos on one lever: half the compliance; play between none and that of one, none if preloaded.

    Null model: the deviation of one servo.
    """
    found = play.fitted(one, play.SINGLE)
    single, band = found.named, number_in(one.inputs["dead_band"].high, "deg")
    (_, most), (soft, stiff) = play.interval(found, "play"), play.interval(found, "compliance")
    swing = single["compliance"] * COUPLED_TORQUE
    free, idle = 0.5 * single["play"] + single["dead_band"], 0.5 * single["dead_band"]
    least, largest = soft * COUPLED_TORQUE, stiff * COUPLED_TORQUE
    alone = play.measured(one, play.SINGLE)
    for pair, state, value, low, high in (
        ("coupled", "released", free, 0.0, most + band),
        ("coupled", "loaded", free + swing, least, most + band + largest),
        ("preloaded", "released", idle, 0.0, band),
        ("preloaded", "loaded", idle + swing, least, band + largest),
    ):
        error = number_in(one.inputs[f"{state}_error"].value, "deg")
        null = alone[state], alone[state] - error, alone[state] + error
        name = f"{pair} servos, {state} deviation"
        reading = "range of the deviation over the alternations of the torque, as recomputed for one servo"
        yield Prediction(one.name, name, "deg", value, low, high, *null, reading, error)


def _rebounds(one: ValidationSet) -> Iterator[Prediction]:
    """Rebound angle and spin with tangential compliance; intervals by inputs and the accepted restitution.

    Null model: momentum and Coulomb's law.
    """
    angles = [float(row["impact_angle_from_normal_deg"]) for row in one.rows("tangential_restitution.csv")]
    impacts = varied(
        lambda given: np.array([_rebound(given, angle) for angle in angles]).ravel(), one.inputs.values()
    )
    nulls = varied(
        lambda given: np.array([_null_rebound(given, angle) for angle in angles]).ravel(),
        [one.inputs[name] for name in ("friction", "restitution", "speed", "diameter")],
    )
    given = {name: known.value for name, known in one.inputs.items()}
    for k, angle in enumerate(angles):
        band = one.bands["sliding" if angle >= oblique.SLIDING else "compliant"].absolute
        assert band is not None
        (out, spin), below, above = (x.reshape(-1, 2)[k] for x in (impacts.values, *impacts.sides))
        tangent = math.tan(math.radians(out)) + band * math.tan(math.radians(angle)) / given["restitution"]
        slide = given["speed"] * math.sin(math.radians(angle))
        accepted = math.degrees(math.atan(tangent)) - out, 2.5 * slide * band / (0.5 * given["diameter"])
        low, high = np.hypot(below, accepted), np.hypot(above, accepted)
        readings = (
            ("rebound angle", "deg", out, "from the normal, by the velocities of the centre", 1.0),
            ("spin", "rad/s", spin, "by a mark on the sphere over the flight after the impact", 0.02 * spin),
        )
        for j, (name, unit, value, reading, half) in enumerate(readings):
            interval = float(value), float(value - low[j]), float(value + high[j])
            null = _interval(nulls, 2 * k + j)
            yield Prediction(
                one.name, f"{name}, {angle:.1f} deg", unit, *interval, *null, reading, float(half)
            )


def _rebound(given: Any, angle: float) -> tuple[float, float]:
    after = oblique.impact(given, angle, "compliant")
    return math.degrees(after.angle(math.radians(angle))), after.spin


def _null_rebound(given: Mapping[str, float], angle: float) -> tuple[float, float]:
    """Return rebound angle [deg] and spin [rad/s] by momentum and Coulomb's law."""
    kept, tangent = oblique.by_momentum(given, angle), math.tan(math.radians(angle))
    slide = given["speed"] * math.sin(math.radians(angle))
    spin = 2.5 * slide * (1.0 - kept) / (0.5 * given["diameter"])
    return math.degrees(math.atan(kept * tangent / given["restitution"])), spin


def _screws(one: ValidationSet) -> Iterator[Prediction]:
    """Torque at start and stop: the fitted law at rest; null model: Coulomb and viscous friction at rest."""
    reading = (
        "largest input torque of the start, or the last one before the stop, without the offset of the cell"
    )
    for drive, name in (("1", "Stribeck"), ("2", "Stribeck"), ("3", "Stribeck by direction")):
        spread = one.value(f"spread_{drive}") / 100.0
        for way, sign in (("forward", 1.0), ("backward", -1.0)):
            torque, plain = (_at_rest(one, drive, law, sign) for law in (name, "Coulomb + viscous"))
            null = plain, plain * (1.0 - spread), plain * (1.0 + spread)
            for event, (low, high) in (("start", _START), ("stop", _STOP)):
                quantity = f"drive {drive}, {event} torque {way}"
                interval = torque, low * torque, high * torque
                yield Prediction(one.name, quantity, "mN m", *interval, *null, reading, spread * torque)


def _at_rest(one: ValidationSet, drive: str, name: str, sign: float) -> float:
    """Return the torque of a fitted law at the least speed of a direction [mN m]."""
    law, _ = screw.LAWS[name]
    return abs(float(law(screw.fitted(one, drive, name).named, np.array([sign * 1e-9]))[0]))


if __name__ == "__main__":
    sys.stdout.writelines(new_entries(sys.argv[1]))
