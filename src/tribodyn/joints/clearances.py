"""All clearance joints of a mechanism, put into the arrays that kernels read."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import ArrayLike

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.contact import Liner
from tribodyn.contact.bulk import LEVELS, Bulk
from tribodyn.contact.contact_law import ContactLaw
from tribodyn.core.errors import InputError
from tribodyn.core.problem import ask
from tribodyn.core.quantities import Record
from tribodyn.core.remembered import ContactTable
from tribodyn.core.signals import Signal
from tribodyn.joints.point_contact import SURFACE, point_table, surface_table
from tribodyn.joints.rows import angles_of, rings_of, rows_of
from tribodyn.joints.shapes import Points, Shape, Surface
from tribodyn.kernels.jit import new_record
from tribodyn.kernels.joints.surface import data as kernel
from tribodyn.kernels.joints.surface.bulk import KAPPA
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.tilt import Pose

if TYPE_CHECKING:
    from tribodyn.lubrication import Film

SPHERE: Final = "point-lankarani-nikravesh"  #: The point contact that a ball in a race can have.


@dataclass(frozen=True, kw_only=True)
class SurfaceLaw:
    """Contact of two surfaces."""

    roughness: float  #: Combined rms roughness σ [m].
    table: ContactTable  #: Contact law, tabulated.
    #: μ and its regularisation u_s [m/s].
    friction_coefficient: float
    slip_velocity: float
    #: See ``joints.EntryMemory``.
    onset: float
    minimum_velocity: float
    tensile_clip: bool
    hardness: float = math.inf  #: Largest pressure [Pa]; a law without one ends with its table.
    #: Elastic bodies under the asperities, where their compliance follows the contact.
    bulk: Bulk | None = None


@dataclass(frozen=True, kw_only=True)
class Clearance(SurfaceLaw):
    """Clearance of a joint: two surfaces and the forces between them."""

    shape: Shape  #: Where the surfaces are, with their dimensions.
    grid: tuple[int, int]  #: Nodes along the two directions of the shape.
    law: ContactLaw  #: Contact law that is tabulated.
    contact: str  #: ``surface``, or a point contact of ``joints.CONTACTS``.
    liner: Liner | None = None  #: What the asperities stand on; None where that is rigid.
    slides: bool = False  #: Whether the shaft is meant to slide along its axis, however far.
    film: Film | None = None  #: Oil film in the bore of a cylinder; None where it is dry.
    #: What temperatures add to the radial clearance and to the play along the axis over time [m, s]; None
    #: where these are constant.
    openings: tuple[Signal | None, Signal | None] = (None, None)


@dataclass(frozen=True)
class Place:
    """Place of a surface in the arrays of a mechanism."""

    joint: int  #: Number of the clearance joint.
    surface: Surface  #: The surface itself.
    nodes: slice  #: Its part of every array over nodes.


def contact_table(
    contact: str,
    law: ContactLaw,
    shape: Shape,
    *,
    onset: float,
    smoothing_width: float,
    liner: Liner | None = None,
) -> ContactTable:
    """Return the contact table of a shape; a point contact has no smoothing, and is rigid below."""
    if contact == SURFACE:
        return surface_table(law, onset=onset, smoothing_width=smoothing_width, liner=liner)
    points = shape.points()
    if not points.length and contact != SPHERE:
        raise InputError(f"{contact} is for cylinders; a ball has {SPHERE}", key="contact")
    return point_table(contact, law, points, len(points.heights))


def places(clearances: Sequence[Clearance]) -> tuple[Place, ...]:
    """Return the places of the surfaces of clearance joints, joint by joint.

    Raises ``Stopped`` if the caller wants to stop: a surface of a fine grid takes a tenth of a second.
    """
    found: list[Place] = []
    for joint, clearance in enumerate(clearances):
        for surface in clearance.shape.surfaces(clearance.grid):
            ask()
            first = found[-1].nodes.stop if found else 0
            found.append(Place(joint, surface, slice(first, first + surface.area.size)))
    return tuple(found)


def assemble(
    clearances: Sequence[Clearance], wear: FloatArray | None = None, where: Sequence[Place] | None = None
) -> SurfaceData:
    """Return the data of the kernels of ``kernels/joints/surface``, for clearance joints in their order.

    ``wear`` is the depth at all nodes [m], shape (n_nodes,); ``where`` from :func:`places`, where the caller
    has it. Raises ``Stopped`` if the caller wants to stop.
    """
    where = places(clearances) if where is None else where
    data = join(where, clearances, wear)
    for record, place in zip(data.surfaces, where, strict=True):
        clearance = clearances[place.joint]
        if clearance.contact != SURFACE:
            fill_points(record, clearance.shape.points())
        record["reach"] = _reach(clearance, data.nodes[:, place.nodes])
    return data


def join(where: Sequence[Place], laws: Sequence[SurfaceLaw], wear: FloatArray | None) -> SurfaceData:
    """Return surfaces in the arrays that kernels read, with the laws of their joints and wear."""
    tables, surfaces, first_row = _Tables(), np.zeros(len(where), dtype=kernel.Surface), 0
    for record, place in zip(surfaces, where, strict=True):
        record["first_row"], record["last_row"] = first_row, first_row + place.surface.rows.size
        first_row = record["last_row"]
        record["first_node"], record["last_node"] = place.nodes.start, place.nodes.stop
        record["tilt"], record["area"] = place.surface.tilt, place.surface.area.sum()
        record["opens"] = place.surface.opens
        record["slides"] = 1.0 if place.surface.slides else 0.0
        record["lean"], record["along"] = place.surface.lean, 1.0
        law = laws[place.joint]
        tables.fill(record, law.table)
        _fill_law(record, law)
        if law.bulk is not None:
            _fill_bulk(record, tables, law.bulk, place.surface)
    nodes = _nodes(where, wear)
    rows = rows_of([(place.surface.rows, place.nodes.start) for place in where], nodes)
    return SurfaceData(
        joints=np.searchsorted([place.joint for place in where], np.arange(len(laws) + 1)),
        surfaces=surfaces,
        rows=rows,
        nodes=nodes,
        angles=angles_of(rows),
        rings=rings_of(rows, nodes),
        table_nodes=tables.joined("nodes", 1, (0, 4)),
        energy=tables.joined("energy", 1, (0,)),
        cubics=tables.joined("cubics", 0, (0,)),
    )


class _Tables:
    """Contact tables, one after the other, each once."""

    def __init__(self) -> None:
        self.tables: list[ContactTable] = []

    def fill(self, record: Record, table: ContactTable, *others: ContactTable) -> None:
        """Tell a surface where its table lies, which ``others`` follow."""
        if not any(known is table for known in self.tables):
            self.tables += [table, *others]
        at = next(k for k, known in enumerate(self.tables) if known is table)
        record["first_interval"] = sum(_intervals(known) for known in self.tables[:at])
        record["last_interval"] = record["first_interval"] + _intervals(table)
        for name in ("h_first", "h_last", "inverse_step"):
            record[name] = getattr(table, name)

    def joined(self, name: str, padding: int, empty: tuple[int, ...]) -> FloatArray:
        """Return an array of all tables, each followed by ``padding`` zeros: all count in intervals."""
        blank = np.zeros((padding, *empty[1:]))
        parts = [part for table in self.tables for part in (getattr(table, name), blank)]
        return np.concatenate([np.zeros(empty), *parts])


def _intervals(table: ContactTable) -> int:
    """Return the number of intervals of a table, with those below and above it."""
    return int(table.nodes.shape[0]) + 1


def _fill_law(record: Record, law: SurfaceLaw) -> None:
    """Tell a surface how it touches."""
    for name in ("roughness", "friction_coefficient", "slip_velocity", "onset"):
        record[name] = getattr(law, name)
    record["minimum_entry_velocity"], record["hardness"] = law.minimum_velocity, law.hardness
    record["deepest"] = law.table.h_first * law.roughness if math.isinf(law.hardness) else -math.inf
    record["tensile_clip"] = 1.0 if law.tensile_clip else 0.0


def _fill_bulk(record: Record, tables: _Tables, bulk: Bulk, surface: Surface) -> None:
    """Tell a surface of elastic bodies."""
    if surface.rows["whole"].any():
        tables.fill(record, bulk.on(bulk.compliance(surface.size)))
        return
    tables.fill(record, *bulk.levels)
    record["levels"], record["extent"], record["bore"] = LEVELS, surface.extent, surface.size
    record["pitch"], record["clearance"] = record["last_interval"] - record["first_interval"], surface.room
    record["softness"] = LEVELS * math.sqrt(KAPPA * surface.size / bulk.size)
    record["growth"] = 2.0 * bulk.softest / (bulk.roughness * LEVELS**2)


def fill_points(record: Record, points: Points) -> None:
    """Let a surface touch at points."""
    record["points"], record["radius"] = len(points.heights), points.radius
    record["clearance"] = points.clearance
    record["heights"][: len(points.heights)] = points.heights


def _reach(clearance: Clearance, nodes: FloatArray) -> tuple[float, float]:
    """Return the play of a shaft across and along its axis within a surface of these nodes [m].

    Across it has left its bore when the wall is thinner than the shaft and behind it. Along, where it is not
    meant to slide, when nothing of it is left in the bore.
    """
    x, y, z = nodes[kernel.POSITION : kernel.NORMAL]
    across = float(np.max(portable.hypot(x, y)) + np.max(nodes[kernel.GAP]))
    # Faces have no height: they stop the shaft themselves.
    return across, np.inf if clearance.slides or not np.ptp(z) else float(np.ptp(z))


def _nodes(where: Sequence[Place], wear: FloatArray | None) -> FloatArray:
    """Return the array of all nodes, see ``kernels/joints/surface/data.py``."""
    n = where[-1].nodes.stop if where else 0
    depth = np.zeros(n) if wear is None else np.asarray(wear, dtype=np.float64)
    if depth.shape != (n,):
        raise InputError(f"wear depth has shape {depth.shape}, the joints have {n} nodes")
    nodes = np.zeros((kernel.N_NODE, n))
    for number, place in enumerate(where):
        if number > 0:
            ask()
        surface, here = place.surface, nodes[:, place.nodes]
        here[kernel.POSITION : kernel.NORMAL] = surface.position.T
        here[kernel.NORMAL : kernel.AREA] = surface.normal.T
        here[kernel.AREA] = surface.area
        here[kernel.GAP] = surface.gap
    nodes[kernel.GAP] += depth
    return nodes


def pose_at(
    d: ArrayLike = (0.0, 0.0, 0.0),
    rotation: ArrayLike | None = None,
    v: ArrayLike = (0.0, 0.0, 0.0),
    w: ArrayLike = (0.0, 0.0, 0.0),
) -> Record:
    """Return the pose of a shaft as drawn or elsewhere, see ``kernels/joints/surface/tilt.py``."""
    pose = new_record(Pose)
    pose.rotation[:] = np.eye(3) if rotation is None else rotation
    pose.d[:], pose.v[:], pose.w[:] = d, v, w
    return pose
