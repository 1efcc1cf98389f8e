"""Variables of bodies and joints over time in a mechanism's results, and further inputs of a run."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mebdf.arrays import FloatArray
from tribodyn.core.problem import Floats, Following
from tribodyn.core.quantities import Table, names
from tribodyn.kernels.film.data import FilmData
from tribodyn.kernels.mechanism.observe import BODY, COUPLING, N_WHOLE, OF_SECOND, WHOLE
from tribodyn.mechanism.assembly.output_values import MOTION
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.assembly.pieces import motion_of_bodies, pieces_of
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import (
    BODIES,
    JOINTS,
    OIL,
    Observed,
    columns_of,
    of_parts,
    place_of,
)
from tribodyn.mechanism.results.derived_columns import INPUTS, OBSERVED, followed_by
from tribodyn.mechanism.results.fixed_joints import INPUTS as REACTION_INPUTS
from tribodyn.mechanism.run_keys import FEW_FRAMES, SMALL
from tribodyn.mechanisms.flash import has_conductors
from tribodyn.mechanisms.output_keys import instants_of
from tribodyn.mechanisms.workload import EVEN


def film_columns(couplings: Mapping[str, FloatArray], model: Model) -> dict[str, FloatArray]:
    """Return the observed quantities of films, each of shape (n_t, n_joints) or (n_t, n_joints, 3)."""
    found = {}
    for name in OIL if model.oiled else ():
        if name not in couplings:
            continue
        found[name] = np.full_like(couplings[name][:, : len(model.joints)], np.nan)
        found[name][:, model.oiled] = couplings[name][:, model.oiled]
    return found


def film_peaks(oil: Any, model: Model) -> dict[str, FloatArray]:
    """Return the largest or least values of each film at any step, each of shape (n_joints,).

    ``oil`` are the records of ``kernels/joints/film.py``.
    """
    found = {}
    for name in oil.dtype["peaks"].names if model.oiled else ():
        found[name] = np.full(len(model.joints), np.nan)
        found[name][model.oiled] = np.where(np.isfinite(oil["peaks"][name]), oil["peaks"][name], np.nan)
    return found


def film_coordinates(films: FilmData, model: Model) -> dict[str, ArrayLike]:
    """Return names of the joints with a film and places of its nodes; nothing without films."""
    if not model.oiled:
        return {}
    return {
        "film": [model.joints[number] for number in model.oiled],
        "film_angle": np.sort(_angles(films.wear_node.shape[1])),
        "film_row": np.arange(films.wear_node.shape[2], dtype=np.float64),
        "film_place": np.array(films.z_node),
    }


def film_maps(films: FilmData, pictures: Floats) -> dict[str, Floats]:
    """Return pressure fields of films by name, nothing without films.

    Of a film with a groove the field is zero: its nodes turn with the groove.

    ``films``: what kernels read of all films; ``pictures``: fields over the nodes of all films [Pa], shape
    (n_frames, n_nodes).
    """
    n, n_theta, n_z = films.wear_node.shape
    if not films.constants.size:
        return {}
    order = np.argsort(_angles(n_theta))
    maps = pictures.reshape(-1, n, n_z, n_theta).transpose(0, 1, 3, 2)[:, :, order]
    maps[:, films.constants["groove"] == 1] = 0.0
    return {"film_pressure_cycle": maps}


def _angles(n_theta: int) -> FloatArray:
    """Return the angles of a film's nodes [rad]: opposite to the push of their pressure on the shaft."""
    return np.asarray(np.mod(2.0 * np.pi * np.arange(n_theta) / n_theta + np.pi, 2.0 * np.pi))


#: Quantities in results of large models, beside the coordinates of loads, by default: those of a report.
OF_LARGE: Final = (
    *("position", "orientation", "velocity", "acceleration"),
    *("joint_angle", "displacement", "tilt_x", "tilt_y"),
    *("reaction_force", "reaction_moment", "drive_moment", "drive_force"),
    *("joint_friction", "pressure_max", "gap_min", *OIL),
)
#: Inputs of the forces and moments of elements.
_OF_LEGS: Final = ("reaction_force", "reaction_moment", "displacement", "relative_velocity")
_ALWAYS: Final = ("reaction_force", "drive_moment", "drive_force")
_OF_CLEARANCES: Final = ("tilt_x", "tilt_y", "joint_angle", "displacement", "pressure_max")
_OF_FLASH: Final = ("relative_velocity", "relative_rate", "gap_min")


def is_large(case: MechanismCase) -> bool:
    """Return whether results of a case hold less over time unless they are asked for more."""
    return len(case.joints) > SMALL


def frames(case: MechanismCase) -> int:
    """Return the number of pressure fields of a cycle."""
    return case.results.frames or (FEW_FRAMES if is_large(case) else EVEN)


def kept(case: MechanismCase) -> tuple[str, ...]:
    """Return the quantities of bodies and joints that results of a case hold over time."""
    every = (*BODIES, *JOINTS)
    if case.results.quantities is not None:
        return tuple(name for name in every if name in case.results.quantities)
    if not is_large(case):
        return every
    wanted = {*OF_LARGE, *chain.from_iterable(map(followed_by, case.loads.values()))}
    return tuple(name for name in every if name in wanted)


def not_kept(case: MechanismCase) -> list[str]:
    """Return those that they do not hold."""
    there = {*kept(case), *(() if case.oiled else OIL)}
    return [name for name in (*BODIES, *JOINTS) if name not in there]


def note(case: MechanismCase) -> list[str]:
    """Return a note on the quantities that a result of a large model lacks, in words."""
    left_out = not_kept(case)
    if not left_out or case.results.quantities is not None:
        return []
    return [
        f"The model has {len(case.joints)} joints: the result does not keep {', '.join(left_out)}; "
        "results.quantities chooses what it keeps."
    ]


def columns(model: Model, found: Observed) -> dict[str, FloatArray]:
    """Return the quantities of bodies and joints over time, which come before springs and loads.

    Kernels observe all of the shaft.
    """
    signs = np.array([joint.sign for joint in model.case.joints.values()])
    known = [name for name in JOINTS if name not in OIL and name in found.couplings]
    of_joints = {name: found.couplings[name][:, : signs.size] for name in known}
    for name in OF_SECOND & of_joints.keys() if np.any(signs < 0.0) else ():
        of_joints[name] = of_joints[name] * signs.reshape(-1, *(1,) * (of_joints[name].ndim - 2))
    of_bodies = motion_of_bodies(model.pieces, found.bodies)
    every = {**of_bodies, **of_joints, **film_columns(found.couplings, model)}
    chosen = {*kept(model.case)}
    return {name: values for name, values in every.items() if name in chosen}


@dataclass(frozen=True)
class Layout:
    """Columns of a row that a run keeps."""

    #: Numbers of pieces, of joints, and of springs, loads and legs of elements.
    n_bodies: int
    n_joints: int
    n_others: int
    #: Quantities kept of each.
    bodies: Table
    joints: Table
    others: Table

    @property
    def size(self) -> int:
        """Numbers of a row that are kept."""
        return N_WHOLE + sum(n * sum(quantity.size for quantity in table) for n, table in self._parts)

    @cached_property
    def places(self) -> NDArray[np.intp] | None:
        """Places of the numbers in a row, rising; None for all."""
        if (self.bodies, self.joints, self.others) == (BODY, COUPLING, COUPLING):
            return None
        return np.fromiter(self._places(), dtype=np.intp)

    def _places(self) -> Iterator[int]:
        yield from range(N_WHOLE)
        for body in range(self.n_bodies):
            for quantity in self.bodies:
                yield from place_of(quantity.name, body)
        for coupling in range(self.n_joints + self.n_others):
            for quantity in self.joints if coupling < self.n_joints else self.others:
                yield from columns_of(quantity.name, coupling, self.n_bodies)

    def observed(self, rows: FloatArray) -> Observed:
        """Return the quantities in rows (n_t, size); joints alone where others do not keep a quantity."""
        sizes = [n * sum(q.size for q in table) for n, table in self._parts]
        ends = np.cumsum([N_WHOLE, *sizes])
        whole, *parts = (rows[:, a:b] for a, b in zip([0, *ends[:-1]], ends, strict=True))
        bodies, joints, others = (
            of_parts(own, table, n) for own, (n, table) in zip(parts, self._parts, strict=True)
        )
        if self.joints == self.others:
            joints = of_parts(rows[:, ends[1] :], self.joints, self.n_joints + self.n_others)
        elif self.n_others:
            joints |= {name: np.concatenate([joints[name], own], axis=1) for name, own in others.items()}
        return Observed(dict(zip(names(WHOLE), whole.T, strict=True)), bodies, joints)

    @property
    def _parts(self) -> tuple[tuple[int, Table], ...]:
        return (self.n_bodies, self.bodies), (self.n_joints, self.joints), (self.n_others, self.others)


def layout_of(case: MechanismCase) -> Layout:
    """Return the columns that a run of a case keeps: all where its result holds all."""
    n_legs = sum(len(one.legs) for _, _, keys in case.elements() for one in keys.equations(case.joints))
    pieces = pieces_of(case)
    counts = len(pieces.members), len(case.joints), len(case.springs) + len(case.loads) + n_legs
    if not not_kept(case):
        return Layout(*counts, BODY, COUPLING, COUPLING)
    chosen = {*kept(case)} - {*(() if case.oiled else OIL)}
    fixed = REACTION_INPUTS if pieces.joints else ()
    others = {*_opposed(case), *(_OF_LEGS if n_legs else ()), *(["joint_work"] if case.loads else []), *fixed}
    joints = chosen | {*_read_of_joints(case)} | others
    moves = case.outputs or case.springs or case.run.analysis == "vibrations"
    return Layout(
        *counts,
        _of(BODY, chosen | {*(BODIES if pieces.joints else MOTION if moves else ())}),
        _of(COUPLING, joints),
        _of(COUPLING, others),
    )


def _of(table: Table, chosen: set[str]) -> Table:
    return tuple(quantity for quantity in table if quantity.name in chosen)


def _read_of_joints(case: MechanismCase) -> Iterator[str]:
    """Yield quantities that are computed from joints after a run, whatever its result holds."""
    yield from _ALWAYS
    yield from INPUTS if case.has_drives else ()
    real = [*case.real.values()]
    yield from _OF_CLEARANCES if real else ()
    yield from _OF_FLASH if any(has_conductors(case.of_pair(keys).surfaces) for keys in real) else ()
    yield from ("film_pressure_max",) if case.oiled else ()
    yield from (OBSERVED[table.over] for table in case.followed() if table.follows)
    yield from (OBSERVED[f"{at.kind}s"] for at in instants_of(case.outputs) if at.kind != "time")
    if case.outputs and case.run.analysis == "kinematic":
        yield from ("reaction_moment", "relative_rate")


def _opposed(case: MechanismCase) -> Iterator[str]:
    """Yield the speeds of bodies that loads oppose."""
    for table in case.followed():
        if table.over in ("speeds", "velocities") and not table.follows:
            yield OBSERVED[table.over]


def following(model: Model, period: float, times: FloatArray) -> Following | None:
    """Return the intervals in which rows follow the steps: shafts may strike faster than output times see.

    ``period``: time of one cycle [s]; ``times``: of the other rows, from 0 to the end [s], shape (n_t,).
    """
    most, n_bodies, duration = model.case.run.step_rows, len(model.bodies), float(times[-1])
    if not model.clearances or most == 0:
        return None
    driven = [model.joints.index(drive.joint) for drive in model.case.drives.values()]
    watched = (
        *(columns_of("reaction_force", k, n_bodies) for k in range(len(model.joints))),
        *(columns_of("pressure_max", k, n_bodies) for k in model.real),
        *(columns_of("film_pressure_max", k, n_bodies) for k in model.oiled),
        *(columns_of(f"drive_{name}", k, n_bodies) for k in driven for name in ("moment", "force")),
    )
    n = min(max(round(duration / period), 1), times.size)
    edges = np.linspace(0.0, duration, n + 1)
    return Following(np.column_stack([edges[:-1], edges[1:]]), max(most, 2 * len(watched) + 1), watched)
