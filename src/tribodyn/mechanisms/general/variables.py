"""What results of a mechanism hold beside what every result has: of the whole, each body, each joint."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from tribodyn.core.arrays import FloatArray
from tribodyn.core.quantities import TIME, Table, names
from tribodyn.kernels.joints.surface.quantities import PEAKS
from tribodyn.kernels.mechanism.quantities import BODY, COUPLING, WHOLE
from tribodyn.results.variables import FRAME, JUMP, STAGE, Variable, described

AXES: Final = ("x", "y", "z")
ENTRIES: Final = ("w", *AXES)
_VECTOR: Final = ("axis",)
_QUATERNION: Final = ("entry",)
_MAP: Final = ("surface", "row", "column")


@dataclass(frozen=True)
class Kept:
    """A variable made of observed quantities of one body or joint.

    Attributes
    ----------
    entries
        Their names; one for each component.
    units, long_name
        As of a :class:`Variable`.
    dims
        Of the components; none of a number.
    of_second
        Whether it is told of the second body of a joint: observed of the shaft, it changes its sign where
        that body carries the socket.
    """

    entries: tuple[str, ...]
    units: str
    long_name: str
    dims: tuple[str, ...] = ()
    of_second: bool = False

    def variable(self, part: str) -> Variable:
        """Return what a reader needs to know about it, over the bodies or the joints."""
        return Variable(self.units, self.long_name, (*TIME, part, *self.dims))

    def values(self, observed: Mapping[str, FloatArray]) -> FloatArray:
        """Return its values, shape (n_t, n) or (n_t, n, n_components)."""
        if not self.dims:
            return observed[self.entries[0]]
        return np.stack([observed[entry] for entry in self.entries], axis=-1)


def _vector(prefix: str, units: str, long_name: str, *, of_second: bool = False) -> Kept:
    return Kept(tuple(f"{prefix}{axis}" for axis in AXES), units, long_name, _VECTOR, of_second)


def _number(entry: str, units: str, long_name: str, *, of_second: bool = False) -> Kept:
    return Kept((entry,), units, long_name, (), of_second)


BODIES: Final[dict[str, Kept]] = {
    "position": _vector("", "m", "mass centre of the body"),
    "orientation": Kept(
        tuple(f"p_{i}" for i in range(4)), "1", "quaternion that turns the body from the drawing", _QUATERNION
    ),
    "velocity": _vector("v_", "m s-1", "velocity of the mass centre"),
    "angular_velocity": _vector("omega_", "rad s-1", "angular velocity of the body, global axes"),
    "acceleration": _vector("a_", "m s-2", "acceleration of the mass centre"),
    "angular_acceleration": _vector("alpha_", "rad s-2", "angular acceleration of the body, global axes"),
}
"""Of each body."""
JOINTS: Final[dict[str, Kept]] = {
    "joint_angle": _number(
        "angle", "rad", "angle of the second body about the axis, from the drawing", of_second=True
    ),
    "displacement": _vector("d_", "m", "displacement of the shaft in its socket, axes of the joint"),
    "tilt_x": _number("tilt_x", "rad", "tilt of the shaft in its socket about the x of the joint"),
    "tilt_y": _number("tilt_y", "rad", "tilt of the shaft in its socket about the y of the joint"),
    "relative_velocity": _vector(
        "u_", "m s-1", "velocity of the second body in the joint, axes of the joint", of_second=True
    ),
    "relative_rate": _vector(
        "w_", "rad s-1", "angular velocity of the second body in the joint, axes of the joint", of_second=True
    ),
    "reaction_force": _vector(
        "F_", "N", "reaction force of the joint on the second body, axes of the joint", of_second=True
    ),
    "reaction_moment": _vector(
        "M_", "N m", "reaction moment on the second body at the shaft, axes of the joint", of_second=True
    ),
    "reaction_force_global": _vector(
        "R_", "N", "reaction force of the joint on the second body, global axes", of_second=True
    ),
    "reaction_moment_global": _vector(
        "T_", "N m", "reaction moment on the second body at the shaft, global axes", of_second=True
    ),
    "drive_moment": _number(
        "drive_moment",
        "N m",
        "moment of the drives of the joint on the second body, about the axis",
        of_second=True,
    ),
    "drive_force": _number(
        "drive_force",
        "N",
        "force of the drives of the joint on the second body, along the axis",
        of_second=True,
    ),
    "joint_damping": _number("damping", "J", "heat of damping in the joint"),
    "joint_friction": _number("friction", "J", "heat of friction in the joint"),
    "joint_energy": _number("stored", "J", "energy stored in the joint"),
    "contact_force": _vector("c_", "N", "normal contact force on the shaft, axes of the joint"),
    "pressure_max": _number("pressure_max", "Pa", "largest contact pressure in the joint"),
    "gap_min": _number("gap_min", "m", "smallest gap in the joint, negative where mean surfaces overlap"),
    "friction_power": _number("friction_power", "W", "power that friction turns into heat in the joint"),
    "damping_power": _number("damping_power", "W", "power that damping turns into heat in the joint"),
}
"""Of each joint."""


@dataclass(frozen=True)
class Observed:
    """Rows of a run by the names of what they hold.

    Attributes
    ----------
    whole
        Of the mechanism, each of shape (n_t,).
    bodies
        Each of shape (n_t, n_bodies).
    couplings
        Of joints, springs and loads, in this order, each of shape (n_t, n_couplings).
    """

    whole: Mapping[str, FloatArray]
    bodies: Mapping[str, FloatArray]
    couplings: Mapping[str, FloatArray]


def observed(rows: FloatArray, n_bodies: int) -> Observed:
    """Return what rows of shape (n_t, n_observed) hold."""
    whole, bodies, couplings = np.split(rows, np.cumsum([len(WHOLE), n_bodies * len(BODY)]), axis=1)
    return Observed(
        dict(zip(names(WHOLE), whole.T, strict=True)), _parts(bodies, BODY), _parts(couplings, COUPLING)
    )


def place(name: str, coupling: int, n_bodies: int) -> int:
    """Return where an observed quantity of a coupling stands in a row."""
    return len(WHOLE) + n_bodies * len(BODY) + coupling * len(COUPLING) + names(COUPLING).index(name)


def _parts(rows: FloatArray, table: Table) -> dict[str, FloatArray]:
    values = rows.reshape(rows.shape[0], rows.shape[1] // len(table), len(table))
    return {name: values[..., i] for i, name in enumerate(names(table))}


OF_CYCLE: Final[dict[str, Variable]] = {
    "wear_pressure_max": Variable("Pa", "largest contact pressure in the cycle, impacts included", JUMP),
    "wear_force_mean": Variable("N", "largest mean force in a joint with clearance", JUMP),
}
"""What a wear campaign writes down about each cycle."""

VARIABLES: Final[dict[str, Variable]] = {
    "body": Variable("", "name of the body", ("body",), named=True, names="bodies"),
    "joint": Variable("", "name of the joint", ("joint",), named=True, names="joints"),
    "surface": Variable("", "joint and surface of it", ("surface",), named=True),
    "axis": Variable("", "component of a vector", _VECTOR, named=True, names=AXES),
    "entry": Variable("", "entry of a quaternion", _QUATERNION, named=True, names=ENTRIES),
    "row": Variable("1", "number of the row of nodes", ("row",)),
    "column": Variable("1", "number of the node in its row", ("column",)),
    "row_place": Variable(
        "m", "place of the row on its surface: height, radius of a face, arc of a ball", ("surface", "row")
    ),
    "column_angle": Variable("rad", "angle of the node about the axis of the joint", ("surface", "column")),
    **{name: kept.variable("body") for name, kept in BODIES.items()},
    **{name: kept.variable("joint") for name, kept in JOINTS.items()},
    "clearance": Variable("m", "radial clearance of the joint; none where it is ideal", ("joint",)),
    **{
        quantity.name: Variable(quantity.unit, f"{quantity.meaning}, of each surface", ("surface",))
        for quantity in PEAKS
    },
    "hardness_share": Variable("1", "largest contact pressure over the hardness", ("surface",)),
    "real_area_share": Variable("1", "real over nominal area of contact at the smallest gap", ("surface",)),
    "grid_force_error": Variable(
        "1", "largest error of the contact force on the chosen grid, over the largest force", ("surface",)
    ),
    "pressure_at_rest": Variable(
        "Pa", "peak pressure of surfaces at rest where that of the run was largest", ("surface",)
    ),
    **described(WHOLE),
    "energy_in": Variable("J", "work of drives and loads since the start"),
    "energy_damping": Variable("J", "heat of dampers and of damping in contact"),
    "energy_friction": Variable("J", "heat of friction since the start"),
    "energy_residual": Variable("J", "what the energy ledger misses"),
    "pressure_cycle": Variable("Pa", "contact pressure over one cycle", (*FRAME, *_MAP)),
    "wear_depth": Variable("m", "wear depth, after the campaign or, estimated, after this run", _MAP),
    "stage_depth": Variable("m", "wear depth, selected", (*STAGE, *_MAP)),
    **OF_CYCLE,
}
"""By name."""
