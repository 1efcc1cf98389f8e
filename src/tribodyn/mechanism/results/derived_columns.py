"""Columns that follow from observed ones: coordinates of tables, efforts and power of drives, springs."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.cases.case import unit
from tribodyn.cases.followed_tables import FollowedTable
from tribodyn.kernels import dense
from tribodyn.mechanism.assembly.output_values import Motion, observing
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.elements.element import Leg
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import Observed
from tribodyn.mechanism.model.drives_and_loads import LoadKeys
from tribodyn.mechanism.model.output_declarations import OutputKeys
from tribodyn.mechanisms.mechanism_protocol import ByPart, plain
from tribodyn.results.reading import column, entries, settled
from tribodyn.results.summary import KeyResult

if TYPE_CHECKING:
    import xarray as xr

_Z: Final = 2
#: Coordinate of a joint, or of the load itself, that a table follows, by its knots.
OBSERVED: Final = {
    "angles": "joint_angle",
    "positions": "displacement",
    "speeds": "relative_rate",
    "velocities": "relative_velocity",
}


def followed(case: MechanismCase, couplings: Mapping[str, FloatArray], table: FollowedTable) -> FloatArray:
    """Return the coordinate of a load's table, shape (n_t,): that of a joint with its speed, or its own.

    ``couplings`` are observed of all couplings, shape (n_t, n_couplings) or (n_t, n_couplings, size) each.
    """
    if not table.follows:
        return _opposed(case, couplings, table)
    return coordinate(case, couplings, table.follows, table.over)


def coordinate(case: MechanismCase, couplings: Mapping[str, FloatArray], joint: str, over: str) -> FloatArray:
    """Return a coordinate of a joint or its rate, by a name of ``OBSERVED``, shape (n_t,)."""
    own = couplings[OBSERVED[over]][:, list(case.joints).index(joint)]
    return np.asarray(case.joints[joint].sign * (own if own.ndim == 1 else own[:, _Z]))


def followed_by(load: LoadKeys) -> Iterator[str]:
    """Yield the variables of a result that force and moment of a load follow."""
    if load.along is not None:
        yield from (OBSERVED[over] for over in load.joint_axes)
    if load.frame == "motion":
        yield from ("velocity", "angular_velocity")


def _opposed(case: MechanismCase, couplings: Mapping[str, FloatArray], table: FollowedTable) -> FloatArray:
    """Return the speed that a load opposes, shape (n_t,)."""
    name = table.path.split(".")[1]
    place = len(case.joints) + len(case.springs) + list(case.loads).index(name)
    twist = couplings[OBSERVED[table.over]][:, place]
    direction = case.loads[name].direction
    if direction is None:
        return np.asarray(np.linalg.norm(twist, axis=1))
    return np.asarray(np.abs(dense.product(twist, np.array(unit(direction, "direction")))))


#: Efforts of drives, and the keys of their limits.
LIMITS: Final = {"drive_moment": "torque_limit", "drive_force": "force_limit"}


def drive_limits(case: MechanismCase) -> dict[str, FloatArray]:
    """Return the most that the drives of joints may give, shape (n_joints,), NaN without a limit."""
    found = {}
    for effort, key in LIMITS.items():
        limits = {drive.joint: getattr(drive, key) for drive in case.drives.values() if getattr(drive, key)}
        if limits:
            found[f"{effort}_limit"] = np.array([limits.get(joint, np.nan) for joint in case.joints])
    return found


def transmitted(model: Model, couplings: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return force [N] and moment [N m] of elements, each of shape (n_t, n_elements); nothing without any."""
    if not model.elements:
        return {}
    forces, moments, first = [], [], model.first_leg
    for element in model.elements:
        force = moment = np.zeros(len(couplings["reaction_force"]))
        for equation in element.equations:
            last, of = first + len(equation.legs) - 1, first + element.keys.MOMENT_OF
            if of <= last:  # losses of a gear act on its first wheel alone
                force = force + _along(equation.legs[-1], couplings, last)
                turns = equation.legs[element.keys.MOMENT_OF].about != 0.0
                moment = moment + (couplings["reaction_moment"][:, of, 2] if turns else np.nan)
            first = last + 1
        forces.append(force)
        moments.append(moment)
    return {"element_force": np.stack(forces, axis=-1), "element_moment": np.stack(moments, axis=-1)}


def _along(leg: Leg, couplings: Mapping[str, FloatArray], number: int) -> FloatArray:
    """Return the force of a leg along its direction [N], shape (n_t,); NaN for a moment alone."""
    force = couplings["reaction_force"][:, number]
    if leg.measure == "coordinate":
        along = leg.along if leg.reported is None else leg.reported
        found = dense.product(force, along) if np.any(along) else np.full(len(force), np.nan)
        return np.asarray(found)
    way = couplings["displacement" if leg.measure == "distance" else "relative_velocity"][:, number]
    size = np.linalg.norm(way, axis=-1)
    return np.asarray(np.sum(force * way, axis=-1) / np.where(size > 0.0, size, 1.0))


def stresses(model: Model, couplings: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the largest normal stress at the ends of beams [Pa], shape (n_t, n_joints); nothing without any.

    It is that of tension and bending at corners of the section, or around a round one; NaN of other joints.
    """
    found = np.full((len(couplings["reaction_force"]), len(model.joints)), np.nan)
    keys: Any
    for k, keys in enumerate(model.case.joints.values()):
        if keys.section_moduli is None:
            continue
        force, moment = couplings["reaction_force"][:, k], couplings["reaction_moment"][:, k, :2]
        other = moment + keys.beam_length * np.stack([-force[:, 1], force[:, 0]], axis=1)
        ends = np.abs(np.stack([moment, other]))[..., ::-1] / keys.section_moduli
        bending = np.linalg.norm(ends, axis=2) if len(keys.section_moduli) == 1 else ends.sum(axis=2)
        found[:, k] = bending.max(axis=0) + np.abs(force[:, 2]) / keys.section_area
    return {"beam_stress": found} if np.isfinite(found).any() else {}


#: Rates of joints that power is computed from, beside the efforts of drives.
INPUTS: Final = ("relative_rate", "relative_velocity")


def with_motors(model: Model, found: Observed) -> Observed:
    """Return rows whose moments and forces of drives contain those of motors and controllers."""
    couplings, leg = found.couplings, model.first_leg
    efforts = {name: couplings[name].copy() for name in ("drive_moment", "drive_force")}
    for element in model.elements:
        if element.keys.IS_DRIVE:
            joint = element.keys.named_joints["joint"][0]
            number, sign = model.joints.index(joint), model.case.joints[joint].sign
            efforts["drive_moment"][:, number] += sign * couplings["reaction_moment"][:, leg, _Z]
            efforts["drive_force"][:, number] += sign * couplings["reaction_force"][:, leg, _Z]
        leg += len(element.legs)
    return replace(found, couplings={**couplings, **efforts})


def power_columns(model: Model, couplings: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the power of the drives of each joint [W], shape (n_t, n_joints), and the work of loads [J].

    Those that the mechanism has: ``couplings`` are of rows with motors.
    """
    case, n, found = model.case, len(model.joints), {}
    if case.has_drives:
        moment, force = couplings["drive_moment"][:, :n], couplings["drive_force"][:, :n]
        rate, velocity = (couplings[name][:, :n, _Z] for name in INPUTS)
        found["drive_power"] = moment * rate + force * velocity
    if case.loads:
        found["energy_loads"] = np.sum(couplings["joint_work"][:, n : model.first_leg], axis=1)
    return found


def spring_columns(model: Model, motion: Motion) -> dict[str, FloatArray]:
    """Return force [N], length [m] and energy [J] of springs, shape (n_t, n_springs); nothing without any."""
    found = []
    for name, spring in model.case.springs.items():
        ends = list(zip(spring.between, spring.points, strict=True))
        (body, point), (reference, other) = ends if ends[0][0] != GROUND else ends[::-1]
        keys = OutputKeys(
            body=body, reference=reference, quantity="distance", point=point, reference_point=other
        )
        observed = observing(model.pieces, name, keys)
        length = observed.value(observed.components(motion))
        longer = length - (spring.drawn_length if spring.length is None else spring.length)
        force = spring.stiffness * longer + spring.damping * observed.rate(motion)
        found.append((-force, length, 0.5 * spring.stiffness * longer**2))
    names = ("spring_force", "spring_length", "spring_energy")
    return {
        name: np.stack(parts, axis=1) for name, parts in zip(names, zip(*found, strict=True), strict=False)
    }


def _number(
    label: str, unit: str, meaning: str, variable: str, reduce: Callable[[FloatArray], float]
) -> ByPart:
    """Return a number of each spring."""

    def made(spring: str) -> KeyResult:
        def compute(dataset: "xr.Dataset") -> float:
            k = [plain(str(name)) for name in entries(dataset, "spring")].index(plain(spring))
            return float(reduce(settled(dataset, column(dataset, variable)[:, k])))

        return KeyResult(label, unit, "Springs", meaning, compute).of_part(spring)

    return made


#: Key results of each spring, by what stands before its name.
BY_SPRING: Final[dict[str, ByPart]] = {
    "spring_push_max_N": _number(
        "Push, peak",
        "N",
        "Largest force that pushes its ends apart.",
        "spring_force",
        lambda force: max(np.max(force), 0.0),
    ),
    "spring_pull_max_N": _number(
        "Pull, peak",
        "N",
        "Largest force that pulls its ends together.",
        "spring_force",
        lambda force: max(np.max(-force), 0.0),
    ),
    "spring_length_min_mm": _number(
        "Length, least", "mm", "Shortest it gets.", "spring_length", lambda length: 1e3 * np.min(length)
    ),
    "spring_length_max_mm": _number(
        "Length, peak", "mm", "Longest it gets.", "spring_length", lambda length: 1e3 * np.max(length)
    ),
    "spring_energy_max_J": _number(
        "Energy, peak", "J", "Largest energy that it stores.", "spring_energy", np.max
    ),
}
