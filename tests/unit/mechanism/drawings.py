"""Mechanisms made of keys in SI units, and runs of them, for tests of the numbers."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from mebdf.arrays import FloatArray
from tribodyn.cases.signals import SpeedSignal
from tribodyn.core.problem import Statistics
from tribodyn.integrate import integrate
from tribodyn.joints.clearances import Clearance
from tribodyn.mechanism.assembly.assembly import assemble
from tribodyn.mechanism.assembly.mechanism_problem import mechanism_problem
from tribodyn.mechanism.assembly.parts_by_number import Model
from tribodyn.mechanism.joints import JOINTS
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import AXES, Observed, observed
from tribodyn.mechanism.model.body import BodyKeys
from tribodyn.mechanism.model.drives_and_loads import DriveKeys, LoadKeys
from tribodyn.mechanism.model.parts import ClearanceKeys, JointKeys, SpringKeys
from tribodyn.mechanism.run_keys import RunKeys

G = "ground"
UP, X, Y, Z = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
ORIGIN = (0.0, 0.0, 0.0)


def vector(values: ArrayLike) -> tuple[float, float, float]:
    """Return three numbers as keys hold them."""
    x, y, z = np.asarray(values, dtype=float).tolist()
    return x, y, z


def joint(
    kind: str,
    between: tuple[str, str],
    point: ArrayLike,
    axis: ArrayLike = Z,
    second: ArrayLike = X,
    stiffness: ArrayLike | None = None,
    damping: ArrayLike | None = None,
) -> JointKeys:
    """Return a joint that is drawn closed; stiffness and damping along and about its axes, shape (6,)."""
    springs = {}
    for key, values in (("stiffness", stiffness), ("damping", damping)):
        if values is not None:
            along, about = np.reshape(values, (2, 3))
            springs |= {key: vector(along), f"angular_{key}": vector(about)}
    return JointKeys(
        type=kind,
        between=between,
        point=vector(point),
        axis=vector(axis),
        second_axis=vector(second),
        **springs,
    )


def body(mass: float, centre: ArrayLike, inertia: ArrayLike) -> BodyKeys:
    """Return a body with moments of inertia about the axes of the drawing, or an inertia matrix."""
    inertia = np.asarray(inertia, dtype=float)
    moments, axes = (inertia, np.eye(3)) if inertia.ndim == 1 else np.linalg.eigh(inertia)
    first, second = axes[:, 0], axes[:, 1]
    return BodyKeys(
        mass=mass,
        centre=vector(centre),
        inertia=vector(moments),
        first_axis=vector(first),
        second_axis=vector(second),
    )


def rod(start: ArrayLike, end: ArrayLike, mass: float = 1.0, axial: float = 1e-3) -> BodyKeys:
    """Return a thin rod; ``axial`` is its moment of inertia about itself [kg m²]."""
    a, b = np.array(start, dtype=float), np.array(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    along = np.outer(b - a, b - a) / length**2
    return body(mass, 0.5 * (a + b), mass * length**2 / 12.0 * (np.eye(3) - along) + axial * along)


def mechanism(
    bodies: Mapping[str, BodyKeys],
    joints: Mapping[str, JointKeys],
    gravity: ArrayLike = ORIGIN,
    **tables: Mapping[str, DriveKeys | LoadKeys | SpringKeys],
) -> Model:
    """Return a mechanism of these parts."""
    parts = {"bodies": dict(bodies), "joints": dict(joints), **tables}
    return Model(MechanismCase(gravity=vector(gravity), run=RunKeys(duration=1.0), **parts))


def changed(model: Model, **parts: object) -> Model:
    """Return a mechanism with tables added to those it has, or ``gravity`` changed."""
    tables = {
        name: {**getattr(model.case, name), **given} if isinstance(given, Mapping) else given
        for name, given in parts.items()
    }
    return replace(model, case=model.case.model_copy(update=tables))


def with_joints(model: Model, names: object = (), **keys: object) -> Model:
    """Return a mechanism with keys of some of its joints changed; of all by default."""
    joints = {name: model.case.joints[name] for name in tuple(names) or model.joints}
    return changed(model, joints={name: old.model_copy(update=keys) for name, old in joints.items()})


def with_clearance(model: Model, clearance: Clearance, *names: str, socket: str | None = None) -> Model:
    """Return a mechanism some of whose joints are real; flanged ones are held along their axes."""
    axial = 1e-6 if clearance.shape.faces else None  # that there are faces; how large is in the clearance
    keys = ClearanceKeys(socket=socket, axial=axial)
    real = with_joints(model, names, clearance=keys)
    return replace(real, clearances=dict.fromkeys(names, clearance))


def speed_drive(joint: str, speed: float) -> DriveKeys:
    """Return a drive of constant angular velocity [rad/s]."""
    return DriveKeys(joint=joint, speed=SpeedSignal(value=speed))


def slider_crank(speed: float = 5000.0 * 2.0 * np.pi / 60.0) -> Model:
    """Return the slider-crank of the specification, crank along x."""
    r, long = 0.05, 0.12
    bodies = {
        "crank": body(0.3, (0.0, 0.0, 0.0), (1e-4, 1e-4, 1e-4)),
        "rod": body(0.21, (r + 0.5 * long, 0.0, 0.0), (1e-5, 2.5e-4, 2.5e-4)),
        "slider": body(0.14, (r + long, 0.0, 0.0), (1e-5, 1e-5, 1e-5)),
    }
    joints = {
        "main": joint("revolute", (G, "crank"), ORIGIN),
        "pin": joint("revolute", ("crank", "rod"), (r, 0.0, 0.0)),
        "wrist": joint("revolute", ("rod", "slider"), (r + long, 0.0, 0.0)),
        "guide": joint("prismatic", (G, "slider"), (r + long, 0.0, 0.0), X, Y),
    }
    return mechanism(bodies, joints, drives={"motor": speed_drive("main", speed)})


def two_four_bars() -> Model:
    """Return IFToMM's benchmark A02, two loops of a four-bar."""
    a = [(float(i), 0.0, 0.0) for i in range(3)]
    b = [(float(i), 1.0, 0.0) for i in range(3)]
    bodies = {
        "left": rod(a[0], b[0]),
        "first": rod(b[0], b[1]),
        "middle": rod(a[1], b[1]),
        "second": rod(b[1], b[2]),
        "right": rod(a[2], b[2]),
    }
    joints = {
        "A0": joint("revolute", (G, "left"), a[0]).model_copy(update={"start_speed": -1.0}),
        "B0": joint("revolute", ("left", "first"), b[0]),
        "A1": joint("revolute", (G, "middle"), a[1]),
        "B1": joint("revolute", ("first", "middle"), b[1]),
        "C1": joint("revolute", ("middle", "second"), b[1]),
        "A2": joint("revolute", (G, "right"), a[2]),
        "B2": joint("revolute", ("second", "right"), b[2]),
    }
    return mechanism(bodies, joints, gravity=(0.0, -9.81, 0.0))


def spatial_slider_crank() -> Model:
    """Return the spatial slider-crank of Haug's book with the numbers of the specification."""
    pivot = np.array([0.0, 0.1, 0.12])
    top = pivot + np.array([0.0, 0.0, 0.08])
    end = np.array([np.sqrt(0.3**2 - top[1] ** 2 - top[2] ** 2), 0.0, 0.0])
    along = (end - top) / 0.3
    inertia = 4e-3 * (np.eye(3) - np.outer(along, along)) + 4e-4 * np.outer(along, along)
    bodies = {
        "crank": body(0.12, 0.5 * (pivot + top), (1e-4, 1e-4, 1e-5)),
        "rod": body(0.5, 0.5 * (top + end), inertia),
        "slider": body(2.0, end, (1e-4, 1e-4, 1e-4)),
    }
    joints = {
        "main": joint("revolute", (G, "crank"), pivot, X, Y).model_copy(update={"start_speed": 6.0}),
        "ball": joint("spherical", ("crank", "rod"), top),
        "cardan": joint("universal", ("slider", "rod"), end, X, np.cross(X, along)),
        "guide": joint("prismatic", (G, "slider"), end, X, Y),
    }
    return mechanism(bodies, joints, gravity=(0.0, 0.0, -9.81))


def bricard() -> Model:
    """Return a linkage of Bricard's along six edges of a cube, five rods of 1 m and 1 kg, redundant."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), (0, 0, 1)]
    axes = [(0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0)]
    bodies = {f"rod {k}": rod(corners[k], corners[k + 1], axial=1.0 / 600.0) for k in range(5)}
    names = [G, *bodies, G]
    seconds = [(1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0)]
    joints = {
        f"P{k}": joint("revolute", (names[k], names[k + 1]), corners[k], axes[k], seconds[k])
        for k in range(6)
    }
    return mechanism(bodies, joints, gravity=(0.0, -9.81, 0.0))


def governor() -> Model:
    """Return IFToMM's benchmark A05, a flyball governor whose lower rods are stiff springs with dampers."""
    lean = np.radians(30.0)
    top = np.array([0.0, 1.0, 0.0])
    ends = [top + np.array([side * np.sin(lean), -np.cos(lean), 0.0]) for side in (1.0, -1.0)]
    middles = [0.5 * (top + end) for end in ends]
    # The spring is as long as half a rod and leans as much.
    slider = np.array([0.0, middles[0][1] - 0.5 * np.cos(lean), 0.0])
    density, section = 3000.0, 0.01
    mass = density * section**2
    square, ball, cube = mass * section**2 / 6.0, 5.0, density * 1e-3
    arms = {}
    for name, end in zip(("right", "left"), ends, strict=True):
        along = np.outer(end - top, end - top)
        centre = (mass * 0.5 * (top + end) + ball * end) / (mass + ball)
        inertia = mass / 12.0 * (np.eye(3) - along) + square * along
        for m, way in ((mass, 0.5 * (top + end) - centre), (ball, end - centre)):
            inertia = inertia + m * (float(way @ way) * np.eye(3) - np.outer(way, way))
        arms[name] = body(mass + ball, centre, inertia)
    bodies = {
        "shaft": rod(ORIGIN, UP, mass, square),
        **arms,
        "slider": body(cube, slider, np.full(3, cube * 0.01 / 6.0)),
    }
    bearing = joint("revolute", (G, "shaft"), ORIGIN, UP, X)
    joints = {
        "bearing": bearing.model_copy(update={"start_speed": 2.0 * np.pi}),
        "right hinge": joint("revolute", ("shaft", "right"), top, Z, X),
        "left hinge": joint("revolute", ("shaft", "left"), top, Z, X),
        "guide": joint("prismatic", ("shaft", "slider"), slider, UP, X),
    }
    springs = {
        f"rod {name}": SpringKeys(
            between=(name, "slider"),
            first_point=vector(middle),
            second_point=vector(slider),
            stiffness=8e5,
            damping=4e4,
            length=0.5,
        )
        for name, middle in zip(arms, middles, strict=True)
    }
    return mechanism(bodies, joints, springs=springs, gravity=(0.0, -9.81, 0.0))


def chain(n: int) -> Model:
    """Return a chain of n links from the ground, with pins at right angles to each other in turn."""
    bodies = {f"link {k}": rod((0.1 * k, 0.0, 0.0), (0.1 * (k + 1), 0.0, 0.0), 0.1, 1e-5) for k in range(n)}
    names = [G, *bodies]
    joints = {
        f"pin {k}": joint("revolute", (names[k], names[k + 1]), (0.1 * k, 0.0, 0.0), (Z, Y)[k % 2])
        for k in range(n)
    }
    return mechanism(bodies, joints, gravity=(0.0, 0.0, -9.81))


def with_springs(model: Model, stiffness: float, turning: float, share: float) -> Model:
    """Return a mechanism with springs and dampers in place of the constraints of its joints.

    Parameters
    ----------
    model
        With joints that spring-dampers can stand for: those that leave axes free that they have springs for.
    stiffness, turning
        Of the springs [N/m], [N m/rad].
    share
        Damping over stiffness [s].
    """
    joints = {}
    for name, old in model.case.joints.items():
        rows = set(JOINTS[old.type].ROWS)
        held = [(0, 2, 0) in rows, (0, 0, 0) in rows, (0, 1, 0) in rows]
        held += [(1, 1, 0) in rows, (1, 1, 2) in rows, (1, 0, 2) in rows]
        k = np.array([*[stiffness] * 3, *[turning] * 3]) * held
        soft = joint("spring-damper", old.between, old.point, old.axis, old.second_axis, k, share * k)
        joints[name] = soft.model_copy(update={"start_speed": old.start_speed})
    return changed(model, joints=joints)


@dataclass(frozen=True)
class Run:
    """Observed rows of a run."""

    model: Model  #: What ran.
    t: FloatArray  #: Output times [s].
    rows: FloatArray  #: Observed rows.
    statistics: Statistics  #: What it cost.

    def whole(self, name: str) -> FloatArray:
        """Return a quantity of the whole, shape (n_t,)."""
        return self._observed.whole[name]

    def body(self, number: int, name: str, axis: str = "") -> FloatArray:
        """Return a quantity of a body or one component of it, shape (n_t,)."""
        return self._component(self._observed.bodies[name][:, number], axis)

    def joint(self, number: int, name: str, axis: str = "") -> FloatArray:
        """Return a quantity of a coupling or one component of it, shape (n_t,)."""
        return self._component(self._observed.couplings[name][:, number], axis)

    @cached_property
    def _observed(self) -> Observed:
        return observed(self.rows, len(self.model.bodies))

    @staticmethod
    def _component(values: FloatArray, axis: str) -> FloatArray:
        return values[:, AXES.index(axis)] if axis else values

    @property
    def energy(self) -> FloatArray:
        """Kinetic, potential and stored energy [J], shape (n_t,)."""
        return self.whole("energy_kinetic") + self.whole("energy_gravity") + self.whole("energy_stored")

    @property
    def imbalance(self) -> float:
        """What the energy books leave over, in units of the largest energy or heat."""
        heat = self.whole("heat_damping") + self.whole("heat_friction")
        left = self.energy - self.energy[0] - self.whole("work_in") + heat
        largest = max(np.abs(self.whole("energy_kinetic")).max(), np.abs(heat).max())
        return float(np.abs(left).max() / largest)


def run(
    model: Model, times: ArrayLike, rtol: float, solver: str = "mebdf", state: FloatArray | None = None
) -> Run:
    """Run a mechanism from 0 to the last of some times and return what was observed at them.

    It begins in ``state``, shape (13 n,); in that of its assembly by default.
    """
    t = np.asarray(times, dtype=float)
    assembly = assemble(model)
    assembly.require_sound()
    problem = mechanism_problem(
        assembly, duration=float(t[-1]), rtol=rtol, state=state, dense=solver != "mebdf"
    )
    solution = integrate(problem, rtol=rtol, output_times=t, solver=solver)
    assert solution.complete, solution.failure
    return Run(model, t, solution.rows, solution.statistics)
