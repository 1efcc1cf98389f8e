"""A trunnion in a bushing with clearance, Eqs. 44, 45 and 48."""

import math
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np

from mebdf.arrays import FloatArray
from tribodyn.contact.bulk import Bulk, Liner
from tribodyn.core.errors import InputError
from tribodyn.core.quantities import Record, names
from tribodyn.core.remembered import ContactTable
from tribodyn.joints.clearances import Place, SurfaceLaw, fill_points, join
from tribodyn.joints.point_contact import SURFACE, Touch
from tribodyn.joints.rows import Form
from tribodyn.joints.shapes.cylinder import Cylinder
from tribodyn.joints.shapes.rings import Rings, with_edges
from tribodyn.joints.shapes.surface import Points, Surface
from tribodyn.kernels.jit import new_record
from tribodyn.kernels.joints.bushing import BushingData, report, wrench
from tribodyn.kernels.joints.memory import JointMemory
from tribodyn.kernels.joints.memory import new_memory as memory_of_surface
from tribodyn.kernels.joints.pose import Pose, fill_pose, from_report, from_wrench
from tribodyn.kernels.joints.quantities import REPORTED
from tribodyn.kernels.joints.surface.bulk import RING
from tribodyn.kernels.joints.surface.data import GAP
from tribodyn.kernels.joints.surface.tilt import AXIS

#: Friction as traction along the actual slip, or as the paper's moment without a force.
FRICTION_MODELS: Final = ("traction", "moment")


@dataclass(frozen=True)
class Friction:
    """Dry friction of the joint."""

    coefficient: float  #: μ_f [1].
    model: str  #: One of :data:`FRICTION_MODELS`.
    slip_velocity: float  #: Regularisation velocity u_s of the traction [m/s].

    def __post_init__(self) -> None:
        """Refuse an unknown friction model."""
        if self.model not in FRICTION_MODELS:
            raise InputError(
                f"given {self.model!r}; allowed: {', '.join(FRICTION_MODELS)}", key="joint.friction"
            )


@dataclass(frozen=True)
class EntryMemory:
    """Memory of a point of the bushing: the speed at which contact began."""

    onset: float  #: Separation over σ below which a point is in contact [1].
    minimum_velocity: float  #: Least entry velocity v_min [m/s].
    tensile_clip: bool  #: Whether the total pressure is kept from becoming tensile.


@dataclass(frozen=True)
class Grid:
    """Quadrature nodes: ``theta`` around the circumference, ``z`` Gauss-Legendre along the axis."""

    theta: int
    z: int


@dataclass(frozen=True)
class BushingJoint:
    """A bushing joint with its tabulated contact law."""

    #: See their classes.
    geometry: Cylinder
    friction: Friction
    entry: EntryMemory
    grid: Grid
    roughness: float  #: Combined rms roughness σ [m].
    table: ContactTable  #: Tabulated contact law, or the force of a point contact.
    contact: str = SURFACE  #: One of :data:`~tribodyn.joints.point_contact.CONTACTS`.
    #: What the asperities stand on, which the table allows for; None where that is rigid.
    liner: Liner | None = None
    form: Form = field(default_factory=Form)  #: What the surfaces stand back from cylinders.
    #: Elastic bodies under the asperities and their largest pressure [Pa].
    bulk: Bulk | None = None
    hardness: float = math.inf

    @property
    def theta(self) -> FloatArray:
        """Angles of the nodes [rad], shape (n_theta,)."""
        return 2.0 * np.pi * np.arange(self.grid.theta) / self.grid.theta

    @property
    def _rows(self) -> tuple[FloatArray, FloatArray]:
        """Axial positions of the rows of nodes, both edges included [m], and their weights [m]."""
        half = 0.5 * self.geometry.length
        return with_edges(-half, half, *self.form.quadrature(self.grid.z, self.geometry.length))

    @property
    def z(self) -> FloatArray:
        """Axial positions of the rows of nodes, both edges included [m], shape (n_z + 2,)."""
        return self._rows[0]

    @property
    def _strip(self) -> FloatArray:
        return self._rows[1] * self.geometry.bore_radius

    @property
    def node_area(self) -> FloatArray:
        """Area that a node of each row stands for [m²], shape (n_z + 2,); zero on the edges."""
        return 2.0 * np.pi / self.grid.theta * self._strip

    @property
    def form_gap(self) -> FloatArray:
        """Gap that the form adds at the nodes [m], shape (n_z + 2, n_theta)."""
        along = self.form.gap(self.z, self.geometry.length)[:, None]
        return along + self.form.measured(self.theta, self.z)

    @property
    def field_shape(self) -> tuple[int, int]:
        """Shape (n_z + 2, n_theta) of a field over the nodes."""
        return self.grid.z + 2, self.grid.theta

    @property
    def touch(self) -> Touch:
        """The two surfaces."""
        size = self.geometry
        of_law = self.roughness, self.table, self.contact, self.liner
        return Touch(*of_law, size.clearance, size.bore_radius, self.bulk)

    def data(self, wear: FloatArray | None = None) -> BushingData:
        """Return the data of the kernels, worn at the nodes [m], shape :attr:`field_shape`."""
        depth = np.zeros(self.field_shape) if wear is None else np.ascontiguousarray(wear, dtype=np.float64)
        if depth.shape != self.field_shape:
            raise InputError(f"wear depth has shape {depth.shape}, the grid {self.field_shape}")
        entry, friction, size = self.entry, self.friction, self.geometry
        law = SurfaceLaw(
            roughness=self.roughness,
            table=self.table,
            friction_coefficient=friction.coefficient,
            slip_velocity=friction.slip_velocity,
            onset=entry.onset,
            minimum_velocity=entry.minimum_velocity,
            tensile_clip=entry.tensile_clip,
            hardness=self.hardness,
            bulk=self.bulk,
        )
        place = Place(0, self.surface, slice(0, depth.size))
        surface = join((place,), (law,), depth.ravel())
        record = surface.surfaces[0]
        record["along"] = 0.0
        record["torque_radius"] = size.bore_radius if friction.model == "moment" else 0.0
        if self.bulk is not None:
            record["deepest"] = -size.bore_radius
        if self.contact != SURFACE:
            half = 0.5 * size.length
            fill_points(record, Points(size.radius, 0.0, size.length, (-half, half)))
        return BushingData(
            clearance=float(size.clearance),
            z=self.z,
            wear=surface.nodes[GAP].reshape(self.field_shape),
            surface=surface,
        )

    @property
    def surface(self) -> Surface:
        """The nodes, at angles from which the bushing presses, see ``kernels/joints/bushing.py``."""
        ones, radius = np.ones(self.z.size), self.geometry.radius
        rings = Rings(-radius * ones, self.z, -ones, 0.0 * ones, self._strip)
        surface = rings.surface("bushing", ("z", self.z), 0.0, self.grid.theta, AXIS)
        bore = self.geometry.bore_radius
        return replace(surface, gap=self.form_gap.ravel(), lean=radius, extent=RING, size=bore)


def new_memory(data: BushingData, entry_velocity: FloatArray | None = None) -> JointMemory:
    """Return the memory of a bushing that never touched, or with entry velocities [m/s]."""
    memory = memory_of_surface(data.surface, data.wear.shape, data.clearance)
    if entry_velocity is not None:
        memory.entry_velocity[:] = entry_velocity
    return memory


def pose_at(y: FloatArray, *, omega: float = 0.0, sign: float = 0.0) -> Record:
    """Return the pose of a trunnion, see ``kernels/joints/pose.py``.

    ``y`` holds attitude and rates (e_x, e_y, φ_x, φ_y, ė_x, ė_y, φ̇_x, φ̇_y), ``omega`` is the vane speed ω_v
    [rad/s], ``sign`` s' of Eq. 45, against the direction of rotation; the friction moment alone uses it.
    """
    pose = new_record(Pose)
    fill_pose(np.asarray(y, dtype=np.float64), float(omega), -float(sign), pose)
    return pose


def joint_wrench(
    data: BushingData,
    y: FloatArray,
    *,
    omega: float = 0.0,
    sign: float = 1.0,
    entry_velocity: FloatArray | None = None,
    memory: JointMemory | None = None,
) -> FloatArray:
    """Return the wrench (F_x, F_y, M_x, M_y, M_z) on the trunnion [N, N m], shape (5,), signs of the paper.

    For ``y``, ``omega`` and ``sign`` see :func:`pose_at`. Remembered entry velocities [m/s] have the shape
    (n_z + 2, n_theta); a memory from :func:`new_memory` has its own and serves many wrenches of one joint.
    """
    memory, out = memory or new_memory(data, entry_velocity), np.empty(5)
    found = memory.scratch.wrench
    wrench(data, memory, pose_at(y, omega=omega, sign=sign), found)
    from_wrench(found, out)
    return out


def joint_report(
    data: BushingData,
    y: FloatArray,
    *,
    omega: float = 0.0,
    sign: float = 1.0,
    entry_velocity: FloatArray | None = None,
) -> dict[str, float]:
    """Return the report of a joint, see ``kernels/joints/quantities.py``; arguments as above."""
    memory, pose = new_memory(data, entry_velocity), pose_at(y, omega=omega, sign=sign)
    out = memory.scratch.report
    report(data, memory, pose)
    from_report(out)
    return {name: float(out[name]) for name in names(REPORTED)}


def contact_energy(data: BushingData, y: FloatArray, entry_velocity: FloatArray | None = None) -> float:
    """Return the energy stored in the contact [J]; arguments as for :func:`joint_wrench`."""
    return joint_report(data, y, entry_velocity=entry_velocity)["energy_contact"]
