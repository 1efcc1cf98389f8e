"""Variables of a mechanism's results beside those of every result: of the whole, each body, each joint."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import TIME, Table, names, slices
from tribodyn.kernels.film.report import FILM, FILM_PEAKS
from tribodyn.kernels.joints.surface.data import PEAKS, PLASTIC
from tribodyn.kernels.mechanism.observe import BODY, COUPLING, N_BODY, N_COUPLING, N_WHOLE, WHOLE
from tribodyn.mechanism.model.reversals import PEAKS as REVERSAL_PEAKS
from tribodyn.results.variables import (
    FRAME,
    JUMP,
    OUTPUTS,
    OUTPUTS_OF_CYCLE,
    STAGE,
    Variable,
    described,
    of_reversals_described,
)

AXES: Final = ("x", "y", "z")
ENTRIES: Final = ("w", *AXES)
_VECTOR: Final = ("axis",)
_ELEMENT: Final = (*TIME, "element")
_SPRING: Final = (*TIME, "spring")
_CAUSE: Final = (*TIME, "output", "joint", "cause")
_MODE: Final = (*TIME, "mode")
_RATIO: Final = (*TIME, "output", "drive")
_QUATERNION: Final = ("entry",)
#: Dimensions of a quantity by its number of components.
_COMPONENTS: Final = {1: (), 3: _VECTOR, 4: _QUATERNION}
_MAP: Final = ("surface", "row", "column")


BODIES: Final = names(BODY)  #: Variables of each body.
#: Variables of each joint; the works of all couplings together are the energy balance of the whole.
JOINTS: Final = tuple(name for name in names(COUPLING) if name != "joint_work")
#: Those of its oil film, which results hold where a joint has one.
OIL: Final = (*names(FILM), "film_power", "joint_film")


@dataclass(frozen=True)
class Observed:
    """Rows of a run by the names of what they hold."""

    whole: Mapping[str, FloatArray]  #: Of the mechanism, each of shape (n_t,).
    bodies: Mapping[str, FloatArray]  #: Each of shape (n_t, n_bodies) or (n_t, n_bodies, size).
    #: Of joints, springs and loads, in this order, each of shape (n_t, n_couplings) or (n_t, n_couplings,
    #: size).
    couplings: Mapping[str, FloatArray]


def observed(rows: FloatArray, n_bodies: int) -> Observed:
    """Return the quantities in rows of shape (n_t, n_observed)."""
    whole, bodies, couplings = np.split(rows, np.cumsum([N_WHOLE, n_bodies * N_BODY]), axis=1)
    of_couplings = of_parts(couplings, COUPLING, couplings.shape[1] // N_COUPLING)
    return Observed(
        dict(zip(names(WHOLE), whole.T, strict=True)), of_parts(bodies, BODY, n_bodies), of_couplings
    )


def columns_of(name: str, coupling: int, n_bodies: int) -> tuple[int, ...]:
    """Return the columns of the rows with an observed quantity of a coupling."""
    first, within = N_WHOLE + n_bodies * N_BODY + coupling * N_COUPLING, slices(COUPLING)[name]
    return tuple(range(first + within.start, first + within.stop))


def place_of(name: str, body: int) -> tuple[int, ...]:
    """Return the columns of the rows with an observed quantity of a body."""
    first, within = N_WHOLE + body * N_BODY, slices(BODY)[name]
    return tuple(range(first + within.start, first + within.stop))


def of_parts(rows: FloatArray, table: Table, n: int) -> dict[str, FloatArray]:
    """Return the quantities of n bodies or couplings, each of shape (n_t, n) or (n_t, n, size)."""
    values = rows.reshape(rows.shape[0], n, sum(quantity.size for quantity in table))
    where = slices(table)
    return {
        q.name: values[..., where[q.name]] if q.size > 1 else values[..., where[q.name].start] for q in table
    }


def _variables(table: Table, part: str) -> dict[str, Variable]:
    """Return the descriptions of quantities of bodies or couplings."""
    return {q.name: Variable(q.unit, q.meaning, (*TIME, part, *_COMPONENTS[q.size])) for q in table}


#: Force or moment of an element; see its kind for sign and place.
OF_ELEMENTS: Final[dict[str, Variable]] = {
    "element_force": Variable("N", "force of an element, such as teeth, thread, rod, spring", _ELEMENT),
    "element_moment": Variable(
        "N m", "moment of an element: on the second wheel, pinion, nut, or body of the joint", _ELEMENT
    ),
}

#: Variables for comparison with the ideal motion.
OF_OUTPUTS: Final[dict[str, Variable]] = {
    **OUTPUTS,
    "drive": Variable("", "name of the drive", ("drive",), named=True, names="drives"),
    "cause": Variable("", "what an estimated error is divided into", ("cause",), named=True),
    "error_estimate": Variable(
        "1", "error that a joint causes, by superposition, in the unit of the output", _CAUSE
    ),
    "output_ratio": Variable("1", "rate of the output for a unit rate of one drive, SI units", _RATIO),
}

#: Of small vibrations about positions at rest.
OF_MODES: Final[dict[str, Variable]] = {
    "mode": Variable("", "number of the mode", ("mode",), named=True, parts="modes"),
    "natural_frequency": Variable("Hz", "natural frequency of the mode", _MODE),
    "damping_ratio": Variable("1", "damping ratio of the mode, below zero where it grows", _MODE),
    "mode_shape": Variable(
        "1",
        "displacement of the mass centre at a modal mass of one kilogram, global axes",
        (*_MODE, "body", "axis"),
    ),
    "mode_rotation": Variable(
        "rad m-1",
        "rotation of the body at a modal mass of one kilogram, global axes",
        (*_MODE, "body", "axis"),
    ),
    "mode_share": Variable("1", "share of the body in the kinetic energy of the mode", (*_MODE, "body")),
}

#: Numbers of each cycle that a wear campaign keeps.
OF_CYCLE: Final[dict[str, Variable]] = {
    "wear_pressure_max": Variable("Pa", "largest contact pressure in the cycle, impacts included", JUMP),
    "wear_roughness": Variable("m", "largest combined rms roughness of a joint in the cycle", JUMP),
    "wear_force_mean": Variable("N", "largest mean force in a joint with clearance", JUMP),
    **OUTPUTS_OF_CYCLE,
}

#: By name.
VARIABLES: Final[dict[str, Variable]] = {
    "body": Variable("", "name of the body", ("body",), named=True, names="bodies"),
    "joint": Variable("", "name of the joint", ("joint",), named=True, names="joints"),
    "element": Variable("", "name of the element", ("element",), named=True, names="elements"),
    **OF_ELEMENTS,
    "beam_stress": Variable(
        "Pa", "largest normal stress at the ends of a beam, of tension and bending", (*TIME, "joint")
    ),
    "spring": Variable("", "name of the spring", ("spring",), named=True, names="springs"),
    "spring_force": Variable("N", "force of a spring and its damper; it pushes its ends apart", _SPRING),
    "spring_length": Variable("m", "distance of the ends of a spring", _SPRING),
    "spring_energy": Variable("J", "energy stored in a spring", _SPRING),
    **OF_OUTPUTS,
    **OF_MODES,
    "surface": Variable("", "joint and surface of it", ("surface",), named=True),
    "axis": Variable("", "component of a vector", _VECTOR, named=True, names=AXES),
    "entry": Variable("", "entry of a quaternion", _QUATERNION, named=True, names=ENTRIES),
    "row": Variable("1", "number of the row of nodes", ("row",)),
    "column": Variable("1", "number of the node in its row", ("column",)),
    "row_place": Variable(
        "m", "place of the row on its surface: height, radius of a face, arc of a ball", ("surface", "row")
    ),
    "column_angle": Variable("rad", "angle of the node about the axis of the joint", ("surface", "column")),
    **_variables(BODY, "body"),
    **{name: known for name, known in _variables(COUPLING, "joint").items() if name in JOINTS},
    "clearance": Variable("m", "radial clearance of the joint; none where it is ideal", ("joint",)),
    "flash_temperature": Variable(
        "K", "how much warmer than the surfaces their asperities get, an estimate", ("joint",)
    ),
    **{
        quantity.name: Variable(quantity.unit, f"{quantity.meaning}, of each surface", ("surface",))
        for quantity in (*PEAKS, PLASTIC)
    },
    **{
        quantity.name: Variable(quantity.unit, f"{quantity.meaning}, of each joint", ("joint",))
        for quantity in FILM_PEAKS
    },
    "hardness_share": Variable("1", "largest contact pressure over the hardness", ("surface",)),
    "roughness": Variable("m", "combined rms roughness in this run, of each surface", ("surface",)),
    "real_area_share": Variable("1", "real over nominal area of contact at the smallest gap", ("surface",)),
    "grid_force_error": Variable(
        "1", "largest error of the contact force on the chosen grid, over the largest force", ("surface",)
    ),
    "pressure_at_rest": Variable(
        "Pa", "peak pressure of surfaces at rest where that of the run was largest", ("surface",)
    ),
    **of_reversals_described(REVERSAL_PEAKS, ("joint",)),
    **described(WHOLE),
    "drive_moment_limit": Variable("N m", "most that the motor of the joint may give", ("joint",)),
    "drive_force_limit": Variable("N", "most that the actuator of the joint may give", ("joint",)),
    "drive_power": Variable("W", "power of drives, motors and controllers of the joint", (*TIME, "joint")),
    "energy_in": Variable("J", "work of drives and loads since the start"),
    "energy_loads": Variable("J", "work of loads since the start"),
    "energy_expansion": Variable("J", "work of temperatures and of widening on contacts since the start"),
    "energy_damping": Variable("J", "heat of dampers and of damping in contact"),
    "energy_friction": Variable("J", "heat of friction since the start"),
    "energy_film": Variable("J", "heat of oil films since the start"),
    "energy_residual": Variable("J", "error of the energy balance"),
    "pressure_cycle": Variable("Pa", "contact pressure over one cycle", (*FRAME, *_MAP)),
    "film": Variable("", "joint with an oil film", ("film",), named=True),
    "film_angle": Variable(
        "rad", "angle of the nodes of a film about the axis of the joint", ("film_angle",)
    ),
    "film_row": Variable("1", "number of the row of nodes of a film", ("film_row",)),
    "film_place": Variable("m", "height of the nodes of a film", ("film", "film_row")),
    "film_pressure_cycle": Variable(
        "Pa", "pressure of an oil film over one cycle", (*FRAME, "film", "film_angle", "film_row")
    ),
    "guide_contact": Variable(
        "1",
        "contact between flat walls: 0 nowhere, 1 at one corner, 2 on one face, 3 on opposite faces",
        (*TIME, "joint"),
    ),
    "radial_clearance": Variable("m", "radial clearance at the temperatures of the time", (*TIME, "joint")),
    "wear_depth": Variable("m", "wear depth, after the campaign or, estimated, after this run", _MAP),
    "partner_wear_depth": Variable("m", "part of wear_depth worn off the partner of the bushing", _MAP),
    "stage_depth": Variable("m", "wear depth, selected", (*STAGE, *_MAP)),
    **OF_CYCLE,
}
