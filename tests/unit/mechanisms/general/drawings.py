"""Mechanisms described in SI units, and runs of them, for tests of the numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Statistics
from tribodyn.core.signals import constant
from tribodyn.integrate import integrate
from tribodyn.mechanisms.general.assembly import assemble
from tribodyn.mechanisms.general.description import GROUND, Body, Description, Drive, Joint, Spring
from tribodyn.mechanisms.general.joints import ROWS
from tribodyn.mechanisms.general.problem import mechanism_problem
from tribodyn.mechanisms.general.variables import AXES, Observed, observed

NOTHING = np.zeros(0)


def joint(
    name: str,
    kind: str,
    bodies: tuple[int, int],
    point: ArrayLike,
    axis: ArrayLike = (0.0, 0.0, 1.0),
    second: ArrayLike = (1.0, 0.0, 0.0),
    stiffness: ArrayLike = (),
    damping: ArrayLike = (),
) -> Joint:
    """Return a joint that is drawn closed."""
    place = np.array(point, dtype=float)
    axes = np.array([axis, second], dtype=float)
    springs = np.array(stiffness, dtype=float), np.array(damping, dtype=float)
    return Joint(name, kind, bodies, np.array([place, place]), axes, None, *springs)


def body(name: str, mass: float, centre: ArrayLike, moments: ArrayLike) -> Body:
    """Return a body with moments of inertia about the axes of the drawing."""
    return Body(name, mass, np.array(centre, dtype=float), np.diag(np.array(moments, dtype=float)))


def rod(name: str, start: ArrayLike, end: ArrayLike, mass: float = 1.0, axial: float = 1e-3) -> Body:
    """Return a thin rod; ``axial`` is its moment of inertia about itself [kg m²]."""
    a, b = np.array(start, dtype=float), np.array(end, dtype=float)
    length = float(np.linalg.norm(b - a))
    along = np.outer(b - a, b - a) / length**2
    return Body(name, mass, 0.5 * (a + b), mass * length**2 / 12.0 * (np.eye(3) - along) + axial * along)


def mechanism(
    bodies: Sequence[Body],
    joints: Sequence[Joint],
    *,
    drives: Sequence[Drive] = (),
    springs: Sequence[Spring] = (),
    gravity: ArrayLike = (0.0, 0.0, 0.0),
    speeds: Sequence[tuple[int, str, float]] = (),
) -> Description:
    """Return a description without loads."""
    parts = tuple(bodies), tuple(joints), tuple(drives)
    return Description(*parts, (), tuple(springs), np.array(gravity, dtype=float), tuple(speeds))


def speed_drive(name: str, joint: int, speed: float) -> Drive:
    """Return a drive of constant angular velocity [rad/s]."""
    return Drive(name, joint, "angle", 1, constant(speed))


def slider_crank(speed: float = 5000.0 * 2.0 * np.pi / 60.0) -> Description:
    """Return the slider-crank of the specification, crank along x."""
    r, long = 0.05, 0.12
    bodies = (
        body("crank", 0.3, (0.0, 0.0, 0.0), (1e-4, 1e-4, 1e-4)),
        body("rod", 0.21, (r + 0.5 * long, 0.0, 0.0), (1e-5, 2.5e-4, 2.5e-4)),
        body("slider", 0.14, (r + long, 0.0, 0.0), (1e-5, 1e-5, 1e-5)),
    )
    joints = (
        joint("main", "revolute", (GROUND, 0), (0.0, 0.0, 0.0)),
        joint("pin", "revolute", (0, 1), (r, 0.0, 0.0)),
        joint("wrist", "revolute", (1, 2), (r + long, 0.0, 0.0)),
        joint("guide", "prismatic", (GROUND, 2), (r + long, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    )
    return mechanism(bodies, joints, drives=(speed_drive("motor", 0, speed),))


def two_four_bars() -> Description:
    """Return IFToMM's benchmark A02, two loops of a four-bar."""
    a = [(float(i), 0.0, 0.0) for i in range(3)]
    b = [(float(i), 1.0, 0.0) for i in range(3)]
    bodies = (
        *(rod("left", a[0], b[0]), rod("first", b[0], b[1]), rod("middle", a[1], b[1])),
        *(rod("second", b[1], b[2]), rod("right", a[2], b[2])),
    )
    joints = (
        *(joint("A0", "revolute", (GROUND, 0), a[0]), joint("B0", "revolute", (0, 1), b[0])),
        *(joint("A1", "revolute", (GROUND, 2), a[1]), joint("B1", "revolute", (1, 2), b[1])),
        *(joint("C1", "revolute", (2, 3), b[1]), joint("A2", "revolute", (GROUND, 4), a[2])),
        joint("B2", "revolute", (3, 4), b[2]),
    )
    return mechanism(bodies, joints, gravity=(0.0, -9.81, 0.0), speeds=((0, "angle", -1.0),))


def spatial_slider_crank() -> Description:
    """Return the spatial slider-crank of Haug's book with the numbers of the specification."""
    pivot = np.array([0.0, 0.1, 0.12])
    top = pivot + np.array([0.0, 0.0, 0.08])
    end = np.array([np.sqrt(0.3**2 - top[1] ** 2 - top[2] ** 2), 0.0, 0.0])
    along = (end - top) / 0.3
    inertia = 4e-3 * (np.eye(3) - np.outer(along, along)) + 4e-4 * np.outer(along, along)
    bodies = (
        body("crank", 0.12, 0.5 * (pivot + top), (1e-4, 1e-4, 1e-5)),
        Body("rod", 0.5, 0.5 * (top + end), inertia),
        body("slider", 2.0, end, (1e-4, 1e-4, 1e-4)),
    )
    x, y = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)
    joints = (
        joint("main", "revolute", (GROUND, 0), pivot, x, y),
        joint("ball", "spherical", (0, 1), top),
        joint("cardan", "universal", (2, 1), end, x, np.cross(x, along)),
        joint("guide", "prismatic", (GROUND, 2), end, x, y),
    )
    return mechanism(bodies, joints, gravity=(0.0, 0.0, -9.81), speeds=((0, "angle", 6.0),))


def bricard() -> Description:
    """Return a linkage of Bricard's along six edges of a cube, five rods of 1 m and 1 kg, redundant."""
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1), (0, 0, 1)]
    axes = [(0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0)]
    bodies = [rod(f"rod {k}", corners[k], corners[k + 1], axial=1.0 / 600.0) for k in range(5)]
    pairs = [(GROUND, 0), (0, 1), (1, 2), (2, 3), (3, 4), (4, GROUND)]
    seconds = [(1, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 0, 0), (0, 1, 0)]
    parts = zip(range(6), pairs, corners, axes, seconds, strict=True)
    joints = [joint(f"P{k}", "revolute", *place) for k, *place in parts]
    return mechanism(bodies, joints, gravity=(0.0, -9.81, 0.0))


def governor() -> Description:
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
    arms = []
    for name, end in zip(("right", "left"), ends, strict=True):
        arm = rod(name, top, end, mass, square)
        centre = (mass * arm.centre + ball * end) / (mass + ball)
        inertia = arm.inertia + sum(
            m * (float(way @ way) * np.eye(3) - np.outer(way, way))
            for m, way in ((mass, arm.centre - centre), (ball, end - centre))
        )
        arms.append(Body(name, mass + ball, centre, inertia))
    bodies = (
        rod("shaft", (0.0, 0.0, 0.0), top, mass, square),
        *arms,
        body("slider", cube, slider, np.full(3, cube * 0.01 / 6.0)),
    )
    up, x, z = (0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    joints = (
        joint("bearing", "revolute", (GROUND, 0), (0.0, 0.0, 0.0), up, x),
        joint("right hinge", "revolute", (0, 1), top, z, x),
        joint("left hinge", "revolute", (0, 2), top, z, x),
        joint("guide", "prismatic", (0, 3), slider, up, x),
    )
    springs = [Spring(f"rod {k}", (k, 3), np.array([middles[k - 1], slider]), 8e5, 4e4, 0.5) for k in (1, 2)]
    speeds = ((0, "angle", 2.0 * np.pi),)
    return mechanism(bodies, joints, springs=springs, gravity=(0.0, -9.81, 0.0), speeds=speeds)


def chain(n: int) -> Description:
    """Return a chain of n links from the ground, with pins at right angles to each other in turn."""
    bodies = [rod(f"link {k}", (0.1 * k, 0.0, 0.0), (0.1 * (k + 1), 0.0, 0.0), 0.1, 1e-5) for k in range(n)]
    axes = [(0.0, 0.0, 1.0), (0.0, 1.0, 0.0)]
    joints = [
        joint(f"pin {k}", "revolute", (k - 1 if k else GROUND, k), (0.1 * k, 0.0, 0.0), axes[k % 2])
        for k in range(n)
    ]
    return mechanism(bodies, joints, gravity=(0.0, 0.0, -9.81))


def with_springs(description: Description, stiffness: float, turning: float, share: float) -> Description:
    """Return a mechanism with springs and dampers in place of the constraints of its joints.

    Parameters
    ----------
    description
        With joints that spring-dampers can stand for: those that leave axes free that they have springs for.
    stiffness, turning
        Of the springs [N/m], [N m/rad].
    share
        Damping over stiffness [s].
    """
    joints = []
    for old in description.joints:
        rows = set(ROWS[old.kind])
        held = [(0, 2, 0) in rows, (0, 0, 0) in rows, (0, 1, 0) in rows]
        held += [(1, 1, 0) in rows, (1, 1, 2) in rows, (1, 0, 2) in rows]
        k = np.array([*[stiffness] * 3, *[turning] * 3]) * held
        joints.append(replace(old, kind="spring-damper", stiffness=k, damping=share * k))
    return replace(description, joints=tuple(joints))


@dataclass(frozen=True)
class Run:
    """Observed rows of a run.

    Attributes
    ----------
    description
        What ran.
    t
        Output times [s].
    rows
        Observed rows.
    statistics
        What it cost.
    """

    description: Description
    t: FloatArray
    rows: FloatArray
    statistics: Statistics

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
        return observed(self.rows, len(self.description.bodies))

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
    description: Description,
    times: ArrayLike,
    rtol: float,
    solver: str = "mebdf",
    state: FloatArray | None = None,
) -> Run:
    """Run a mechanism from 0 to the last of some times and return what was observed at them.

    It begins in ``state``, shape (13 n,); in that of its assembly by default.
    """
    t = np.asarray(times, dtype=float)
    assembly = assemble(description)
    assembly.require_sound()
    problem = mechanism_problem(
        assembly, duration=float(t[-1]), rtol=rtol, state=state, dense=solver != "mebdf"
    )
    solution = integrate(problem, rtol=rtol, output_times=t, solver=solver)
    assert solution.complete, solution.failure
    return Run(description, t, solution.rows, solution.statistics)
