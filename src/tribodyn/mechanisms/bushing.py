"""The clearance joint that a case describes, what results hold of it, and the state of its wear."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases import groups
from tribodyn.cases.rough import BushingCase
from tribodyn.contact import Liner, SurfacePair
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.core.problem import skip
from tribodyn.joints import BushingJoint, EntryMemory, Friction, Grid, contact_table
from tribodyn.joints.bushing import joint_report, joint_wrench, new_memory
from tribodyn.joints.point_contact import Touch
from tribodyn.joints.shapes import Cylinder
from tribodyn.kernels.joints.bushing import BushingData
from tribodyn.wear import resampled

#: Observed quantities that reach the user under the names of the balance instead.
_NOT_STORED: Final = ("work_", "heat_")
_SAMPLES: Final = 24


@dataclass(frozen=True)
class Bearing:
    """A shaft in a bore with its surfaces, apart from the mechanism around it."""

    #: Keys of its contact law, and the surfaces that the law takes.
    contact: groups.Contact
    pair: SurfacePair
    geometry: Cylinder  #: Its dimensions at the temperatures of the run.
    liner: Liner | None  #: Elastic sleeve of the bore; None where there is none.
    friction: Friction  #: Its friction.


def bearings(case: BushingCase) -> dict[str, Bearing]:
    """Return the one shaft in a bore of a case, by the name of its table."""
    joint = case.joint
    return {
        "joint": Bearing(
            contact=case.contact,
            pair=case.surface_pair,
            geometry=case.temperature.dimensions(joint, case.surfaces),
            liner=joint.liner.layer(case.surfaces.bushing),
            friction=Friction(joint.friction_coefficient, joint.friction, joint.slip_velocity),
        )
    }


def grid_of(case: BushingCase) -> tuple[int, int]:
    """Return the joint's numbers of nodes around and along at the temperatures of the run, edges apart."""
    (bearing,) = bearings(case).values()
    return _grid(case, bearing)


def _grid(case: BushingCase, bearing: Bearing) -> tuple[int, int]:
    return case.solver.grid.resolved(bearing.geometry.clearance, bearing.pair.roughness_rms)


def bushing_of(case: BushingCase) -> BushingJoint:
    """Return the clearance joint of a case with its tabulated contact law."""
    (bearing,) = bearings(case).values()
    contact = bearing.contact
    return BushingJoint(
        geometry=bearing.geometry,
        friction=bearing.friction,
        entry=EntryMemory(contact.onset_separation, contact.least_entry_velocity, contact.tensile_clip),
        grid=Grid(*_grid(case, bearing)),
        roughness=bearing.pair.roughness_rms,
        table=contact_table(
            case.joint.contact,
            contact.law_of(bearing.pair),
            bearing.geometry,
            onset=contact.onset_separation,
            smoothing_width=contact.smoothing_width,
            liner=bearing.liner,
        ),
        contact=case.joint.contact,
        liner=bearing.liner,
        form=case.joint.form.form(),
    )


def bushing_facts(case: BushingCase) -> dict[str, object]:
    """Return the attributes of a result on the joint, SI units."""
    geometry = case.temperature.dimensions(case.joint, case.surfaces)
    return {
        "contact_law": case.contact.law,
        "clearance": geometry.clearance,
        "assembly_clearance": case.joint.clearance,
        "roughness": case.surface_pair.roughness_rms,
        "joint_length": geometry.length,
    }


def of_temperature(case: BushingCase, clearance: FloatArray | None = None) -> list[str]:
    """Return the effect of a case's temperatures, one sentence; nothing where they change nothing.

    ``clearance`` is that over the rows of a run [m], where it changes.
    """
    if clearance is not None and clearance.size:
        return [of_clearances(float(clearance[0]), float(clearance[-1]), float(clearance.min()))]
    hot = case.temperature.dimensions(case.joint, case.surfaces).clearance
    found = {
        path: values
        for path, values in case.temperature.properties_at_start.items()
        if attrgetter(path)(case) == values[1]
    }
    words = of_heat(case.joint.clearance, hot, found)
    return [words] if words else []


def of_clearances(begin: float, end: float, least: float) -> str:
    """Return that a clearance follows temperatures, from its values at begin and end and its least [m]."""
    first, last, lowest = (f"{1e6 * clearance:.4g} um" for clearance in (begin, end, least))
    return (
        f"Temperatures take the clearance from {first} to {last}; it is {lowest} at least. Radius, length, "
        "contact law, friction and wear coefficient stay those of the start."
    )


def of_heat(cold: float, hot: float, material: Mapping[str, tuple[float, float]]) -> str:
    """Return that the clearance [m] is another one in the run; an empty text where it is not.

    ``material`` are values of the bushing at assembly and in the run, by keys.
    """
    if hot == cold:
        return ""
    words = f"At the temperatures of the run the clearance is {hot * 1e6:.4g} um, not {cold * 1e6:.4g} um."
    changed = [f"{path} by {100.0 * (b / a - 1.0):+.3g} %" for path, (a, b) in material.items() if a != b]
    return f"{words} Of the material change {', '.join(changed)}." if changed else words


def loading(law: ContactLaw, touch: Touch, pressure: float, separation: float) -> dict[str, float]:
    """Return the load measures of two surfaces, by name; NaN where the contact is at points.

    ``law``, ``touch``: their contact law, and the surfaces; ``pressure``: largest contact pressure [Pa];
    ``separation``: smallest gap [m]. Returns ``hardness_share``, the pressure over the hardness of the
    bushing, and ``real_area_share``, the real area of contact over the nominal one where the gap was
    smallest; NaN where the contact law has none.
    """
    if not touch.over_surface:
        return {"hardness_share": math.nan, "real_area_share": math.nan}
    area = law.real_area_fraction(np.array([touch.asperity_separation(separation)]))
    return {"hardness_share": pressure / law.pair.hardness, "real_area_share": float(area[0])}


def _at(data: BushingData, clearance: FloatArray | None, row: int) -> BushingData:
    """Return the joint with the clearance of a row."""
    return data if clearance is None else data._replace(clearance=float(clearance[row]))


def _attitude(rows: Mapping[str, FloatArray], row: int) -> FloatArray:
    """Return the state of a row without its velocities, shape (8,)."""
    y = np.zeros(8)
    y[:4] = [rows[name][row] for name in ("e_x", "e_y", "phi_x", "phi_y")]
    return y


def force_parts(rows: Mapping[str, FloatArray]) -> dict[str, FloatArray]:
    """Return the observed columns that are stored, each of shape (n_t,), with the damping force [N]."""
    stored = {name: values for name, values in rows.items() if not name.startswith(_NOT_STORED)}
    return stored | {
        "F_dx": rows["F_cx"] - rows["F_kx"],
        "F_dy": rows["F_cy"] - rows["F_ky"],
        "friction_power": -rows["friction_power"],
    }


def on_finer_grid(
    joint: BushingJoint,
    data: BushingData,
    rows: Mapping[str, FloatArray],
    wear: FloatArray | None = None,
    clearance: FloatArray | None = None,
) -> dict[str, float]:
    """Return the errors of a run against a grid four times finer; NaN where the caller wants to stop.

    They are ``grid_force_error``, the largest error of the contact force on the run's grid at some of its
    attitudes, without their velocities, over the largest force [1]; and ``pressure_at_rest``, the peak
    pressure of surfaces at rest where that of the run was largest [Pa]. The finer grid resolves the edge:
    what the peak of the run has more is damping. Both are 0 without rows.

    ``joint``: on the run's grid; ``data``: what the kernels of the run read of it, with its wear; ``rows``:
    columns of the run, of which the attitudes are used; ``wear``: depth at the nodes during the run [m],
    shape (n_z + 2, n_theta), none by default; ``clearance``: of each row [m], by default that of the joint.
    """
    found = dict.fromkeys(("grid_force_error", "pressure_at_rest"), math.nan)
    if not rows["e_x"].size:
        return dict.fromkeys(found, 0.0)
    if skip():
        return found
    finer = replace(joint, grid=Grid(4 * joint.grid.theta, 4 * joint.grid.z))
    fine = finer.data(None if wear is None else resampled(wear, joint.z, finer.z, finer.grid.theta))
    row = int(np.argmax(rows["p_max"]))
    at_rest = joint_report(_at(fine, clearance, row), _attitude(rows, row))
    found["pressure_at_rest"] = float(at_rest["p_max"])
    found["grid_force_error"] = _force_error(data, fine, rows, clearance)
    return found


def _force_error(
    coarse: BushingData, fine: BushingData, rows: Mapping[str, FloatArray], clearance: FloatArray | None
) -> float:
    """Return the largest error of the force on a coarse grid over the largest force [1]; NaN if stopped."""
    chosen = np.unique(np.linspace(0, rows["e_x"].size - 1, _SAMPLES).astype(int)).tolist()
    forces = []
    for data in (fine, coarse):
        memory = new_memory(data)
        for row in chosen:
            if skip():
                return math.nan
            forces.append(joint_wrench(_at(data, clearance, row), _attitude(rows, row), memory=memory)[:2])
    exact, found = np.split(np.array(forces), 2)
    pairs = np.stack([exact, found - exact], axis=1)
    largest, error = np.fmax.reduce(portable.hypot(*np.transpose(pairs)), axis=1, initial=0.0)
    return float(error / largest) if largest > 0.0 else 0.0


@dataclass(frozen=True)
class Carried:
    """State that a run hands on to the next one, which begins at its end in the drive's cycle."""

    state: FloatArray  #: The states, shape (n,).
    entry_velocity: FloatArray  #: Memory of contact: δ̇₋ at the nodes [m/s], in the shape of the nodes.


@dataclass(frozen=True)
class Worn:
    """The joints that a run is made with."""

    depth: FloatArray  #: Wear depth at the nodes [m], in their shape.
    carried: Carried | None = None  #: Where the run continues from; None for the start of the case.


@dataclass(frozen=True)
class WearNodes:
    """The nodes of all that wears."""

    area: FloatArray  #: Area that each node stands for [m²], in the shape of the nodes.
    roughness: float  #: The least combined rms roughness σ among them [m].
    n_states: int  #: Length of the state that :class:`Carried` hands on.
