"""Predictions for held-back points: plateaus, impacts in a joint, loops, worn joints, pins."""

import math
from collections.abc import Iterator, Mapping
from typing import Final

import numpy as np
from scipy.special import stdtrit

from mebdf.arrays import FloatArray
from tribodyn.validation.base import Prediction
from tribodyn.validation.catalogue import ValidationSet, load, varied
from tribodyn.validation.sets import friction_damper_backlash as damper
from tribodyn.validation.sets import hip_simulator_wear as hip
from tribodyn.validation.sets import oblique_impact as oblique
from tribodyn.validation.sets import pin_on_disc_pps as pins
from tribodyn.validation.sets import screw_drive_friction as screw
from tribodyn.wear.archard import of_repeats

SPEEDS: Final = (20.0, 100.0)  #: Input speeds of the plateaus of the screw drives [rpm].
LAW_OF: Final = {"1": "Stribeck", "2": "Stribeck", "3": "Stribeck by direction"}  #: Law of each drive.
#: Displacement at which friction of a joint breaks away: the default, a tenth and ten times of it [m].
PRESLIDING: Final = (1e-6, 1e-7, 1e-5)
MASS: Final = 2.618e-4  #: Of the ball [kg].
_SHOT: Final = 1e-5  #: Time from the begin of a shot to its largest force [s].
_GAP: Final = 2e-4
_AFTER: Final = 9e-5  #: Time after which the ball has left the wall, beside that of its way there [s].
#: Band tensions of held-back loops of the damper by their frequency [lb].
TENSIONS: Final = {0.5: (22.0, 25.0, 70.0), 1.0: (22.0, 25.0, 35.0, 70.0, 80.0)}
ENERGY: Final = {0.5: 0.05, 1.0: 0.08}  #: Accepted difference of the energy of a loop by frequency.
_HEAD: Final = 14.0  #: Radius of a head that is 6 mm larger than that of the set ``clarke`` [mm].


def plateaus() -> Iterator[Prediction]:
    """Yield the steady torques of the three screw drives, both directions, at two speeds."""
    one = load("screw_drive_friction")
    reading = (
        "mean input torque while the speed is within 5 % of its set value, without the offset of the cell; "
        "at another speed the fitted law there"
    )
    for drive, name in LAW_OF.items():
        law, plain = (screw.fitted(one, drive, which) for which in (name, "Coulomb + viscous"))
        for way, sign in (("forward", 1.0), ("backward", -1.0)):
            for rpm in SPEEDS:
                speed = np.array([sign * math.radians(6.0 * rpm)])
                spread = one.value(f"spread_{drive}") / 100.0
                ends = []
                for found, which in ((law, name), (plain, "Coulomb + viscous")):
                    torque = abs(float(screw.LAWS[which][0](found.named, speed)[0]))
                    half = torque * math.hypot(spread, float(np.abs(found.residuals).max()))
                    ends.append((torque, torque - half, torque + half))
                name_of = f"drive {drive}, plateau {way} at {rpm:g} rpm"
                yield Prediction(one.name, name_of, "mN m", *ends[0], *ends[1], reading, spread * ends[0][0])


def in_a_joint(given: Mapping[str, float], angle: float, presliding: float) -> tuple[float, float, float]:
    """Return normal and tangential restitution [1] and spin [rad/s] of a ball that is shot against a bore."""
    incidence = math.radians(angle)
    across, along = math.cos(incidence), math.sin(incidence)
    force = MASS * given["speed"] / _SHOT
    changes = {
        "loads.shot.force.values": f"0, {force}, 0 N",
        "loads.shot.direction": f"[{across}, 0, {along}]",
        "joints.bore.clearance.friction_coefficient": given["friction"],
        "contact.restitution": given["restitution"],
        "friction.presliding": f"{presliding} m",
        "run.duration": f"{_GAP / (given['speed'] * across) + _AFTER} s",
    }
    run = ValidationSet("oblique_impact").simulated("joint.toml", changes)
    x, _, z = run["velocity"].values[-1, 0] / given["speed"]
    return abs(x) / across, z / along, abs(float(run["angular_velocity"].values[-1, 0, 1]))


def joint_rebounds() -> Iterator[Prediction]:
    """Yield rebound angles and spins with a joint of a mechanism; null model: the single sphere."""
    one = load("oblique_impact")
    inputs = [one.inputs[name] for name in ("friction", "restitution", "speed")]
    given = {name: known.value for name, known in one.inputs.items()}
    for row in one.rows("tangential_restitution.csv"):
        angle = float(row["impact_angle_from_normal_deg"])

        def rebound(values: Mapping[str, float], angle: float = angle) -> FloatArray:
            return _angle_and_spin(in_a_joint(values, angle, PRESLIDING[0]), angle)

        found = varied(rebound, inputs)
        softer = np.array([_angle_and_spin(in_a_joint(given, angle, d), angle) for d in PRESLIDING])
        lows = found.values - np.hypot(found.sides[0], found.values - softer.min(axis=0))
        highs = found.values + np.hypot(found.sides[1], softer.max(axis=0) - found.values)
        sphere = oblique.impact(given, angle, "compliant")
        null = math.degrees(sphere.angle(math.radians(angle))), sphere.spin
        readings = (
            ("rebound angle", "deg", "from the normal, by the velocities of the centre", 1.0),
            (
                "spin",
                "rad/s",
                "by a mark on the sphere over the flight after the impact",
                0.02 * found.values[1],
            ),
        )
        for k, (what, unit, reading, half) in enumerate(readings):
            ends = float(found.values[k]), float(lows[k]), float(highs[k])
            nulls = null[k], null[k] - half, null[k] + half
            name = f"{what} with a joint, {angle:.1f} deg"
            yield Prediction(one.name, name, unit, *ends, *nulls, reading, float(half))


def _angle_and_spin(after: tuple[float, float, float], angle: float) -> FloatArray:
    normal, tangential, spin = after
    return np.array([math.degrees(math.atan(tangential * math.tan(math.radians(angle)) / normal)), spin])


def damper_loops() -> Iterator[Prediction]:
    """Yield energies of held-back loops over that without play, and the error of an earthquake."""
    one = load("friction_damper_backlash")
    given = damper.fitted(one, damper.FITTED)
    known = {float(text): damper.loop(one, f"loop_0p5Hz_{text}lb.csv") for text in damper.JULY}
    shape = known[35.0]
    reading = "energy of the mean loop over the sum of its plateaus times twice the amplitude"
    for frequency, tensions in TENSIONS.items():
        for tension in tensions:
            forces = {
                name: float(np.interp(tension, list(known), [loop.plateaus[name] for loop in known.values()]))
                for name in ("plus", "minus")
            }
            record = damper.DamperRecord(shape.time * 0.5 / frequency, shape.displacement, shape.force)
            rectangle = 2.0 * record.amplitude * sum(forces.values())
            value = damper.computed(given | forces, record).energy / rectangle
            without = damper.computed(given | forces | {"play": 1e-3}, record).energy / rectangle
            ends = value * (1.0 - ENERGY[frequency]), value * (1.0 + ENERGY[frequency])
            name = f"July, {frequency:g} Hz, {tension:g} lb, energy over that without play"
            yield Prediction(one.name, name, "1", value, *ends, 1.0, without, 1.0, reading, 0.01)
    row, most = damper.earthquake_rows(one)[0], one.bands["earthquake"].at_most
    assert most is not None
    low = 2.0 * row.computed - most
    reading = "the same fit and free place at the start, for each of the three other earthquakes"
    name = "held earthquakes, error of the force over that without play"
    yield Prediction(one.name, name, "1", row.computed, low, most, 1.0, 1.0, 1.0, reading, 0.02)


def worn_joints() -> Iterator[Prediction]:
    """Yield the ratio of volumes of two heads; null models: no effect, and the square of the diameter."""
    one = load("hip_simulator_wear")
    pairs = [
        (hip.cycle(_HEAD, changes=c), hip.cycle(hip.CLARKE, changes=c)) for c in ((), *hip.ends(one).values())
    ]
    ratios = [float(large.attrs["worn_volume"] / small.attrs["worn_volume"]) for large, small in pairs]
    precision = math.sqrt(2.0) * 0.09
    low, high = min(ratios) * (1.0 - precision), max(ratios) * (1.0 + precision)
    square = (_HEAD / hip.CLARKE) ** 2
    reading = "ratio of the mean wear rates of both heads on one machine, each to 9 %"
    name = "clarke, wear of a 28 mm head over that of 22 mm"
    yield Prediction(one.name, name, "1", ratios[0], low, high, 1.0, 1.0, square, reading, 0.05)


def equal_pins() -> Iterator[Prediction]:
    """Yield the factor between equal runs with 45 % PTFE, and the rate without PTFE at the larger load."""
    one = load("pin_on_disc_pps")

    def rates(share: str, load: str) -> list[float]:
        rows = [pins.table_row(one, share, load, run) for run in ("1", "2")]
        return [float(row["rate_last_half_um_per_m"]) for row in rows]

    pairs = [rates(*which) for which in (*pins.REPEATED, ("0", "60N"))]
    deviation = math.sqrt(float(np.mean([0.5 * math.log(a / b) ** 2 for a, b in pairs])))
    largest = math.exp(float(stdtrit(len(pairs), 0.975)) * deviation * math.sqrt(2.0))
    usual = math.exp(0.6745 * deviation * math.sqrt(2.0))
    reading = "larger over smaller rate of the last half of two runs of one condition"
    for load_name in ("60 N", "98 N"):
        name = f"45 % PTFE, {load_name}, factor between equal runs"
        yield Prediction(one.name, name, "1", usual, 1.0, largest, 1.0, 1.0, 1.1, reading, 0.02)
    known = rates("0", "60N")
    middle, (low, high) = math.exp(float(np.mean(np.log(known)))), of_repeats(known)
    by_load = float(pins.LOADS["100N"]) / float(pins.LOADS["60N"])
    name, value = "0 % PTFE, 98 N, rate of the last half", middle * by_load
    reading = "slope of the loss of height over the last half of the distance"
    ends = value * low, value * high
    yield Prediction(one.name, name, "um/m", value, *ends, middle, min(known), max(known), reading, 0.02)


def held_back() -> Iterator[Prediction]:
    """Yield all of them."""
    for family in (plateaus, joint_rebounds, damper_loops, worn_joints, equal_pins):
        yield from family()
