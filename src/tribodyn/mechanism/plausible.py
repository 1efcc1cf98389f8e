"""Values of a mechanism that do not contradict each other, and yet hardly belong together, in words."""

import math
from collections.abc import Iterator, Mapping
from typing import Final, Protocol

import numpy as np

from tribodyn.cases.joint_keys import Wear
from tribodyn.cases.messages import Remarks
from tribodyn.mechanism.elements.element import ElementKeys
from tribodyn.mechanism.elements.stop import Stop
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.drives_and_loads import GIVEN, DriveKeys, LoadKeys
from tribodyn.mechanism.model.parts import JointKeys, SpringKeys
from tribodyn.mechanism.run_keys import RunKeys

_ROUNDED: Final = 1.0e-6  #: Share of a cycle by which rounded periods may miss whole multiples.
_LIGHT: Final = 1.0e-6  #: Mass over that of the heaviest body below which contacts are too fast for a run.
_SAMPLES: Final = 1001
_DEEP: Final = 1.0e-9  #: Angle [rad] or displacement [m] past a stop that is rounding.


class MechanismTables(Protocol):
    """Parts of a case that are checked."""

    @property
    def bodies(self) -> Mapping[str, BodyKeys]:
        """The bodies."""

    @property
    def joints(self) -> Mapping[str, JointKeys]:
        """The joints."""

    @property
    def drives(self) -> Mapping[str, DriveKeys]:
        """The drives."""

    @property
    def loads(self) -> Mapping[str, LoadKeys]:
        """The loads."""

    @property
    def springs(self) -> Mapping[str, SpringKeys]:
        """The springs."""

    @property
    def wear(self) -> Wear:
        """Wear of the joints."""

    @property
    def run(self) -> RunKeys:
        """Length and analysis."""

    @property
    def span(self) -> float:
        """Time that the drives run forward [s]."""

    def elements(self) -> Iterator[tuple[str, str, ElementKeys]]:
        """Yield table, name and keys of all elements."""


def of_mechanism(case: MechanismTables) -> Remarks:
    """Return remarks on period, loads, stops, masses, springs and wear of a case."""
    warnings, notes = _of_period(case)
    notes += _of_loads(case)
    warnings += [*_of_stops(case), *_of_masses(case), *_of_springs(case), *_of_wear(case)]
    return Remarks(tuple(warnings), tuple(notes))


def _of_period(case: MechanismTables) -> tuple[list[str], list[str]]:
    """Return warnings and notes of drives whose motion does not come again after ``run.period``."""
    warnings: list[str] = []
    notes: list[str] = []
    for name, drive in case.drives.items():
        period = drive.period
        if case.run.period is None or period is None:
            continue
        ratio = case.run.period / period
        whole = round(ratio)
        if whole < 1 or abs(ratio - whole) > _ROUNDED * ratio:
            warnings.append(
                f"run.period is {case.run.period:.6g} s, and drive {name} repeats after {period:.6g} s: "
                "cycles, lives and means over cycles count run.period. Leave it out, or give a multiple."
            )
        elif whole > 1:
            notes.append(f"A cycle is run.period: {whole} cycles of drive {name}.")
    return warnings, notes


def _of_loads(case: MechanismTables) -> Iterator[str]:
    """Yield the loads that name a joint and do not follow it; a function from Python may."""
    for name, load in case.loads.items():
        if load.along is not None and not load.joint_axes:
            yield (
                f"loads.{name}.along has no effect: no table of it follows a joint. Leave it out, or give "
                "a table over its angles or a function of its angle."
            )


def _of_stops(case: MechanismTables) -> Iterator[str]:
    """Yield the stops that the start or a drive is beyond."""
    stops = ((name, keys) for _, name, keys in case.elements() if isinstance(keys, Stop))
    for name, stop in stops:
        turns = stop.angle is not None
        at = stop.angle if stop.angle is not None else stop.position or 0.0
        side = 1.0 if stop.side == "above" else -1.0
        joint, unit = stop.joint, "deg" if turns else "mm"
        driven = [drive for drive in case.drives.values() if drive.joint == joint]
        low, high = _range(case, driven, "angle" if turns else "position")
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


def _range(case: MechanismTables, driven: list[DriveKeys], coordinate: str) -> tuple[float, float]:
    """Return between which values drives prescribe a coordinate of a joint; zeros where none does."""
    for drive in driven:
        of, level = GIVEN[drive.gives]
        if of == coordinate and level < 2:
            signal = drive.signal.over_run(case.span, rising=drive.gives == "angle")
            times = np.linspace(0.0, case.span, _SAMPLES)
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


def _of_springs(case: MechanismTables) -> Iterator[str]:
    """Yield the springs that do nothing."""
    for name, spring in case.springs.items():
        if spring.stiffness == spring.damping == 0.0:
            yield (
                f"Spring {name} has neither stiffness nor damping and does nothing: give "
                f"springs.{name}.stiffness or springs.{name}.damping."
            )


def _of_masses(case: MechanismTables) -> Iterator[str]:
    """Yield the bodies in joints with clearance that are much lighter than the heaviest body."""
    real = {body for joint in case.joints.values() if joint.real is not None for body in joint.between}
    heaviest = max(body.mass for body in case.bodies.values())
    for name, body in case.bodies.items():
        if name in real and body.mass < _LIGHT * heaviest:
            yield (
                f"Body {name} of {body.mass:.3g} kg is {body.mass / heaviest:.1g} times as heavy as the "
                "heaviest one: contacts in its joints vibrate so fast that a run may take hours, or stop. "
                f"Check bodies.{name}.mass and its unit, or make its joints ideal."
            )


def _of_wear(case: MechanismTables) -> Iterator[str]:
    """Yield that a depth limit has no effect where no joint wears."""
    real = (joint.real for joint in case.joints.values())
    if case.wear.depth_limit is not None and not any(keys and keys.contact == "surface" for keys in real):
        yield (
            "wear.depth_limit has no effect: no joint has a clearance in which surfaces wear. Give a joint "
            'a clearance whose contact is "surface", or leave it out.'
        )
