"""The clearance joint that a case describes, and what results hold of it whatever it joins."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from operator import attrgetter
from typing import Final, Protocol

import numpy as np

from tribodyn.cases import groups
from tribodyn.cases.joint import PlainJoint
from tribodyn.cases.temperature import Temperature
from tribodyn.contact import HasSurfacePair
from tribodyn.core.arrays import FloatArray
from tribodyn.joints import SURFACE, BushingJoint, EntryMemory, Friction, Grid, contact_table
from tribodyn.joints.bushing import joint_report, joint_wrench
from tribodyn.kernels.joints.cylinder.data import BushingData
from tribodyn.wear import resampled

_NOT_STORED: Final = ("work_", "heat_")
"""Observed quantities that reach the user under the names of the ledger instead."""
_SAMPLES: Final = 24


class HasBushing(HasSurfacePair, Protocol):
    """A case with one clearance joint."""

    @property
    def surfaces(self) -> groups.Surfaces:
        """Its table ``[surfaces]``."""

    @property
    def contact(self) -> groups.Contact:
        """Its table ``[contact]``."""

    @property
    def joint(self) -> PlainJoint:
        """Its table ``[joint]``."""

    @property
    def temperature(self) -> Temperature:
        """Its table ``[temperature]``."""

    @property
    def solver(self) -> groups.Solver:
        """Its table ``[solver]``."""


def bushing_of(case: HasBushing) -> BushingJoint:
    """Return the clearance joint of a case with its tabulated contact law."""
    contact, liner = case.contact, case.joint.liner.layer(case.surfaces.bushing)
    geometry = case.temperature.dimensions(case.joint, case.surfaces)
    return BushingJoint(
        geometry=geometry,
        friction=Friction(case.joint.friction_coefficient, case.joint.friction, case.joint.slip_velocity),
        entry=EntryMemory(contact.onset_separation, contact.least_entry_velocity, contact.tensile_clip),
        grid=Grid(case.solver.grid.theta, case.solver.grid.z),
        roughness=case.surface_pair.roughness_rms,
        table=contact_table(
            case.joint.contact,
            contact.law_of(case.surface_pair),
            geometry,
            onset=contact.onset_separation,
            smoothing_width=contact.smoothing_width,
            liner=liner,
        ),
        contact=case.joint.contact,
        liner=liner,
        form=case.joint.form.form(),
    )


def bushing_facts(case: HasBushing) -> dict[str, object]:
    """Return what the attributes of a result say of the joint, SI units."""
    geometry = case.temperature.dimensions(case.joint, case.surfaces)
    return {
        "contact_law": case.contact.law,
        "clearance": geometry.clearance,
        "assembly_clearance": case.joint.clearance,
        "roughness": case.surface_pair.roughness_rms,
        "joint_length": geometry.length,
    }


def of_temperature(case: HasBushing, clearance: FloatArray | None = None) -> list[str]:
    """Return what the temperatures of a case change, one sentence; nothing where they change nothing.

    ``clearance`` is that over the rows of a run [m], where it does not keep still.
    """
    if clearance is not None and clearance.size:
        begin, end, least = (f"{1e6 * c:.4g} um" for c in (clearance[0], clearance[-1], clearance.min()))
        return [
            f"Temperatures take the clearance from {begin} to {end}; it is {least} at least. Radius, length, "
            "contact law, friction and wear coefficient stay those of the start."
        ]
    temperature, cold = case.temperature, case.joint.clearance
    hot = temperature.dimensions(case.joint, case.surfaces).clearance
    if hot == cold:
        return []
    words = f"At the temperatures of the run the clearance is {hot * 1e6:.4g} um, not {cold * 1e6:.4g} um."
    material = _of_material(case)
    return [f"{words} Of the material change {', '.join(material)}." if material else words]


def _of_material(case: HasBushing) -> list[str]:
    """Return what the temperature changes of the material, as far as a case takes it from its tables."""
    temperature = case.temperature
    now = temperature.at_start["bushing"] or temperature.assembly
    found = temperature.properties.values_at(temperature.assembly, now)
    return [
        f"{path} by {100.0 * (hot / cold - 1.0):+.3g} %"
        for path, (cold, hot) in found.items()
        if hot != cold and attrgetter(path)(case) == hot
    ]


def loading(case: HasBushing, joint: BushingJoint, pressure: float, separation: float) -> dict[str, float]:
    """Return how far the surfaces of a joint were loaded, by name; nothing where the contact is at points.

    Parameters
    ----------
    case, joint
        The case and its joint.
    pressure
        Largest contact pressure [Pa].
    separation
        Smallest gap [m].

    Returns
    -------
    dict
        ``hardness_share``, the pressure over the hardness of the bushing, and ``real_area_share``, the real
        area of contact over the nominal one where the gap was smallest; NaN where the contact law has none.
    """
    if joint.contact != SURFACE:
        return {"hardness_share": math.nan, "real_area_share": math.nan}
    pair = case.surface_pair
    closest = np.array([joint.asperity_separation(separation)])
    area = case.contact.law_of(pair).real_area_fraction(closest)
    return {"hardness_share": pressure / pair.hardness, "real_area_share": float(area[0])}


def pressure_at_rest(
    joint: BushingJoint,
    rows: Mapping[str, FloatArray],
    wear: FloatArray | None = None,
    clearance: FloatArray | None = None,
) -> float:
    """Return the peak pressure of surfaces at rest where that of the run was largest [Pa]; 0 without rows.

    Taken on a grid four times finer, which resolves the edge: what the peak of the run has more is damping.

    Parameters
    ----------
    joint, rows, wear, clearance
        As for :func:`grid_force_error`.
    """
    if not rows["e_x"].size:
        return 0.0
    finer = replace(joint, grid=Grid(4 * joint.grid.theta, 4 * joint.grid.z))
    fine = finer.data(None if wear is None else resampled(wear, joint.z, finer.z, finer.grid.theta))
    row = int(np.argmax(rows["p_max"]))
    return float(joint_report(_at(fine, clearance, row), _attitude(rows, row))["p_max"])


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


def grid_force_error(
    joint: BushingJoint,
    rows: Mapping[str, FloatArray],
    wear: FloatArray | None = None,
    clearance: FloatArray | None = None,
) -> float:
    """Return the largest error of the contact force on the run's grid against one four times finer [1].

    Taken at some of the run's own attitudes, without their velocities, relative to the largest force.

    Parameters
    ----------
    joint
        The joint on the run's grid.
    rows
        Columns of the run, of which the attitudes are used.
    wear
        Wear depth at the nodes during the run [m], shape (n_z + 2, n_theta); none by default.
    clearance
        Of each row [m]; that of the joint by default.
    """
    n_rows = rows["e_x"].size
    if not n_rows:
        return 0.0
    finer = replace(joint, grid=Grid(4 * joint.grid.theta, 4 * joint.grid.z))
    fine = finer.data(None if wear is None else resampled(wear, joint.z, finer.z, finer.grid.theta))
    coarse = joint.data(wear)
    largest = error = 0.0
    for i in np.unique(np.linspace(0, n_rows - 1, _SAMPLES).astype(int)):
        row = int(i)
        y = _attitude(rows, row)
        exact = joint_wrench(_at(fine, clearance, row), y)[:2]
        largest = max(largest, float(np.hypot(*exact)))
        error = max(error, float(np.hypot(*(joint_wrench(_at(coarse, clearance, row), y)[:2] - exact))))
    return error / largest if largest > 0.0 else 0.0
