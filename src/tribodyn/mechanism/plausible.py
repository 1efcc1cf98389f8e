"""Values of a mechanism that do not contradict each other, and yet hardly belong together, in words."""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

import numpy as np

from tribodyn.cases.joint_keys import Wear
from tribodyn.cases.messages import Remarks
from tribodyn.mechanism.elements.stop import Stop
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.drives_and_loads import GIVEN, DriveKeys, LoadKeys
from tribodyn.mechanism.model.parts import JointKeys, SpringKeys
from tribodyn.mechanism.run_keys import RunKeys

_ROUNDED: Final = 1.0e-6  #: Share of a cycle by which rounded periods may miss whole multiples.
_LIGHT: Final = 1.0e-6  #: Mass over that of the heaviest body below which contacts are too fast for a run.
_SAMPLES: Final = 1001
_FINE: Final = 1.0e-5  #: Force over the weight of the heaviest body that rounding may always make.
_GRAVITY: Final = 9.81  #: [m/s²].
_DEEP: Final = 1.0e-9  #: Angle [rad] or displacement [m] past a stop that is rounding.


def of_mechanism(case: Any) -> Remarks:
    """Return remarks on period, loads, stops, masses, springs and wear of a case."""
    warnings, notes = _of_period(case.drives, case.run)
    notes += _of_loads(case.loads)
    stops = {name: keys for _, name, keys in case.elements() if isinstance(keys, Stop)}
    warnings += [
        *_of_stops(stops, case.drives.values(), case.span),
        *_of_masses(case.bodies, case.joints),
        *_of_springs(case.springs),
        *_of_rounding(case.bodies, case.joints, case.springs, case.solver.rtol),
        *_of_wear(case.wear, case.joints.values()),
    ]
    return Remarks(tuple(warnings), tuple(notes))


def _of_period(drives: Mapping[str, DriveKeys], run: RunKeys) -> tuple[list[str], list[str]]:
    """Return warnings and notes of drives whose motion does not come again after ``run.period``."""
    warnings: list[str] = []
    notes: list[str] = []
    for name, drive in drives.items():
        period = drive.period
        if run.period is None or period is None:
            continue
        ratio = run.period / period
        whole = round(ratio)
        if whole < 1 or abs(ratio - whole) > _ROUNDED * ratio:
            warnings.append(
                f"run.period is {run.period:.6g} s, and drive {name} repeats after {period:.6g} s: "
                "cycles, lives and means over cycles count run.period. Leave it out, or give a multiple."
            )
        elif whole > 1:
            notes.append(f"A cycle is run.period: {whole} cycles of drive {name}.")
    return warnings, notes


def _of_loads(loads: Mapping[str, LoadKeys]) -> Iterator[str]:
    """Yield the loads that name a joint and do not follow it; a function from Python may."""
    for name, load in loads.items():
        if load.along is not None and not load.joint_axes:
            yield (
                f"loads.{name}.along has no effect: no table of it follows a joint. Leave it out, or give "
                "a table over its angles or a function of its angle."
            )


def _of_stops(stops: Mapping[str, Stop], drives: Iterable[DriveKeys], span: float) -> Iterator[str]:
    """Yield the stops that the start or a drive is beyond."""
    for name, stop in stops.items():
        turns = stop.angle is not None
        at = stop.angle if stop.angle is not None else stop.position or 0.0
        side = 1.0 if stop.side == "above" else -1.0
        joint, unit = stop.joint, "deg" if turns else "mm"
        driven = [drive for drive in drives if drive.joint == joint]
        low, high = _range(span, driven, "angle" if turns else "position")
        first, farthest = _first(driven), high if side > 0.0 else low
        begins = f"stop {name} blocks values of {joint} {stop.side} {_in(at, unit)}"
        if side * (first - at) > _DEEP:
            yield (
                f"{begins}, and {joint} starts at {_in(first, unit)}, inside it: it is pushed out with the "
                "force of that indentation. Move the stop, or give the other side."
            )
        elif side * (farthest - at) > _DEEP:
            yield (
                f"{begins}, and its drive moves {joint} to {_in(farthest, unit)}: the drive presses against "
                "the stop with all that this takes. Move the stop, or drive by a torque or force."
            )


def _range(span: float, driven: list[DriveKeys], coordinate: str) -> tuple[float, float]:
    """Return between which values drives prescribe a coordinate of a joint; zeros where none does."""
    for drive in driven:
        of, level = GIVEN[drive.gives]
        if of == coordinate and level < 2:
            signal = drive.signal.over_run(span, rising=drive.gives == "angle")
            times = np.linspace(0.0, span, _SAMPLES)
            values = np.array([signal.at(float(t)) for t in times])
            if level == 1:
                steps = 0.5 * (values[1:] + values[:-1]) * np.diff(times)
                values = np.concatenate([[0.0], np.cumsum(steps)])
            return float(values.min()), float(values.max())
    return 0.0, 0.0


def _first(driven: list[DriveKeys]) -> float:
    """Return the coordinate of a joint at the start: zero, or what a drive prescribes there."""
    given = (drive for drive in driven if GIVEN[drive.gives][1] == 0)
    return next((drive.signal.signal().at(0.0) for drive in given), 0.0)


def _in(value: float, unit: str) -> str:
    return f"{math.degrees(value):.4g} deg" if unit == "deg" else f"{1e3 * value:.4g} mm"


def _of_springs(springs: Mapping[str, SpringKeys]) -> Iterator[str]:
    """Yield the springs that do nothing."""
    for name, spring in springs.items():
        if spring.stiffness == spring.damping == 0.0:
            yield (
                f"Spring {name} has neither stiffness nor damping and does nothing: give "
                f"springs.{name}.stiffness or springs.{name}.damping."
            )


def _of_rounding(
    bodies: Mapping[str, BodyKeys],
    joints: Mapping[str, JointKeys],
    springs: Mapping[str, SpringKeys],
    rtol: float,
) -> Iterator[str]:
    """Yield the stiffest spring or beam where rounding of positions makes forces beyond the tolerance."""
    found = [(spring.stiffness, f"springs.{name}.stiffness") for name, spring in springs.items()]
    for name, joint in joints.items():
        if joint.type == "beam":
            keys: Any = joint
            body, piece, _ = name.partition(":")
            key = f"bodies.{body}.beam.young_modulus" if piece else f"joints.{name}.axial_rigidity"
            found.append((keys.axial_rigidity / keys.beam_length, key))
    stiffness, key = max(found, default=(0.0, ""))
    size = max(np.linalg.norm(body.centre) for body in bodies.values())
    force = float(np.finfo(float).eps * size) * stiffness
    if force > max(rtol, _FINE) * _GRAVITY * max(body.mass for body in bodies.values()):
        yield (
            f"{key} is a stiffness of {stiffness:.2g} N/m: the rounding of positions alone changes its force "
            f"by {force:.1g} N, and a run may make no progress. Check the unit, or take a rigid part."
        )


def _of_masses(bodies: Mapping[str, BodyKeys], joints: Mapping[str, JointKeys]) -> Iterator[str]:
    """Yield the bodies in joints with clearance that are much lighter than the heaviest body."""
    real = {body for joint in joints.values() if joint.real is not None for body in joint.between}
    heaviest = max(body.mass for body in bodies.values())
    for name, body in bodies.items():
        if name in real and body.mass < _LIGHT * heaviest:
            yield (
                f"Body {name} of {body.mass:.3g} kg is {body.mass / heaviest:.1g} times as heavy as the "
                "heaviest one: contacts in its joints vibrate so fast that a run may take hours, or stop. "
                f"Check bodies.{name}.mass and its unit, or make its joints ideal."
            )


def _of_wear(wear: Wear, joints: Iterable[JointKeys]) -> Iterator[str]:
    """Yield that a depth limit has no effect where no joint wears."""
    real = (joint.real for joint in joints)
    if wear.depth_limit is not None and not any(keys and keys.contact == "surface" for keys in real):
        yield (
            "wear.depth_limit has no effect: no joint has a clearance in which surfaces wear. Give a joint "
            'a clearance whose contact is "surface", or leave it out.'
        )
