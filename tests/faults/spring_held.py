"""Random planar mechanisms whose freedoms springs hold, and their potential energy by formulas of their own.

A base is driven along x or about z. On it hangs a chain of levers on torsion springs, or a five-bar: then the
end of the chain is a joint of a second arm on the ground. Springs between points, loads and weights act, too.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

import tribodyn as td
from tribodyn.core.arrays import FloatArray

GRAVITY: Final = 9.81
PIN: Final = {"radius": "6 mm", "length": "20 mm", "axial": "50 um", "friction_coefficient": "0"}
CLEARANCE: Final = 2e-5  #: Of each pivot that has one [m].
POSITIONS: Final = 12


@dataclass
class Lever:
    """A lever of a chain: its length, mass and mass centre, and what acts on it, in SI units."""

    length: float
    mass: float
    centre: FloatArray
    drawn: float
    stiffness: float
    preload: float
    cubic: bool  #: Torque of the spring over the cube of its angle; it has no other stiffness then.
    load: FloatArray
    #: Stiffness, free length and place on the ground of a spring at its end; none for a stiffness of zero.
    spring: tuple[float, float, FloatArray]
    real: bool


@dataclass
class Held:
    """A random mechanism."""

    chance: np.random.Generator
    #: Whether the base turns, and its speed.
    turns: bool = False
    speed: float = 0.0
    levers: list[Lever] = field(default_factory=list)  #: Of the chain.
    #: Foot and length of the arm of a five-bar; None without one.
    arm: tuple[FloatArray, float] | None = None

    def __post_init__(self) -> None:
        """Draw it."""
        draw = self.chance
        self.turns, self.speed = bool(draw.random() < 0.6), float(draw.uniform(0.05, 0.3))
        five = bool(draw.random() < 0.3)
        self.pivot = (draw.uniform(-0.05, 0.05, 2) + np.array([0.1, 0.0])) * (0.3 if five else 1.0)
        self.speed *= 1.0 if self.turns or not five else 0.2
        for number in range(2 if five else int(draw.integers(1, 4))):
            self.levers.append(self._lever(number, five))
        if five:
            end = self._ends(np.array([lever.drawn for lever in self.levers]), self.pivot)[-1]
            foot = end + draw.uniform(0.15, 0.3, 2) * [1.0, -1.0]
            self.arm = foot, float(np.linalg.norm(foot - end))

    def _lever(self, number: int, five: bool) -> Lever:
        draw = self.chance
        length, drawn = float(draw.uniform(0.2 if five else 0.1, 0.3)), float(draw.uniform(-0.6, 0.6))
        drawn -= 1.2 * number * five
        springy = float(draw.uniform(100.0, 800.0)) if draw.random() < 0.4 else 0.0
        return Lever(
            length,
            float(draw.uniform(0.1, 1.0)),
            draw.uniform(-0.3, 0.3, 2) * length + [0.5 * length, 0.0],
            drawn,
            float(10.0 ** draw.uniform(0.5, 1.5)),
            float(draw.uniform(-1.0, 1.0)),
            bool(draw.random() < 0.15),
            draw.normal(size=2) * 3.0,
            (springy, float(draw.uniform(0.02, 0.3)), draw.uniform(-0.4, 0.4, 2)),
            bool(draw.random() < 0.3),
        )

    def _ends(self, angles: FloatArray, pivot: FloatArray) -> list[FloatArray]:
        """Return the pivots of the levers and the end of the last one."""
        found = [pivot]
        for lever, angle in zip(self.levers, angles, strict=True):
            found.append(found[-1] + lever.length * np.array([math.cos(angle), math.sin(angle)]))
        return found

    def mechanism(self) -> td.Mechanism:
        """Return it in tribodyn's terms."""
        run = {"analysis": "static", "cycles": 1, "positions": POSITIONS} if self.turns else {}
        run = run or {
            "analysis": "static",
            "duration": "1 s",
            "positions": POSITIONS,
            "output_interval": "0.1 s",
        }
        drawn = td.Mechanism("Held", gravity=f"0, {-GRAVITY}, 0 m/s^2", run=run)
        angles = np.array([lever.drawn for lever in self.levers])
        ends = self._ends(angles, self.pivot)
        drawn.body("base", mass="1 kg", centre="0, 0, 0 mm", inertia="1e-2, 1e-2, 1e-2 kg m^2")
        if self.turns:
            drawn.revolute("drive", "ground", "base", point="0, 0, 0 mm", axis=[0, 0, 1])
            drawn.drive("motor", "drive", speed=f"{self.speed} rad/s")
        else:
            drawn.prismatic("drive", "ground", "base", point="0, 0, 0 mm", axis=[1, 0, 0])
            drawn.drive("motor", "drive", velocity=f"{self.speed} m/s")
        for number, (lever, start, end) in enumerate(zip(self.levers, ends, ends[1:], strict=False)):
            name, before = f"lever{number}", f"lever{number - 1}" if number else "base"
            centre = start + rotation(lever.drawn) @ lever.centre
            drawn.body(name, mass=f"{lever.mass} kg", centre=point(centre), inertia="1e-2, 1e-2, 1e-2 kg m^2")
            drawn.revolute(f"pivot{number}", before, name, point=point(start), axis=[0, 0, 1])
            if lever.real and self.arm is None:
                drawn.clearance(f"pivot{number}", radial=f"{CLEARANCE} m", **PIN)
            keys = {"preload": f"{lever.preload} N m", "stiffness": f"{lever.stiffness} N m/rad"}
            if lever.cubic:
                over = np.linspace(-8.0, 8.0, 1601)
                keys = {
                    "torque": {
                        "angles": [f"{x} rad" for x in over.tolist()],
                        "values": [f"{lever.stiffness * x**3} N m" for x in over.tolist()],
                    }
                }
            drawn.torsion_spring(f"coil{number}", joint=f"pivot{number}", **keys)
            direction, size = lever.load / np.linalg.norm(lever.load), np.linalg.norm(lever.load)
            drawn.load(
                f"push{number}", name, direction=[*direction, 0.0], point=point(end), force=f"{size} N"
            )
            if lever.spring[0]:
                drawn.spring(
                    f"spring{number}",
                    "ground",
                    name,
                    first_point=point(lever.spring[2]),
                    second_point=point(end),
                    stiffness=f"{lever.spring[0]} N/m",
                    length=f"{lever.spring[1]} m",
                )
        if self.arm is not None:
            foot, _ = self.arm
            drawn.body(
                "arm", mass="0.2 kg", centre=point(0.5 * (foot + ends[-1])), inertia="1e-3, 1e-3, 1e-3 kg m^2"
            )
            drawn.revolute("foot", "ground", "arm", point=point(foot), axis=[0, 0, 1])
            drawn.spherical("knee", f"lever{len(self.levers) - 1}", "arm", point=point(ends[-1]))
        return drawn

    def energy(self, angles: FloatArray, moved: float) -> float:
        """Return the potential energy at angles of the levers and a position of the drive."""
        base = moved if self.turns else 0.0
        pivot = rotation(base) @ self.pivot + ([0.0, 0.0] if self.turns else [moved, 0.0])
        found, ends, before, drawn_before = 0.0, self._ends(angles, pivot), base, 0.0
        for lever, angle, start, end in zip(self.levers, angles, ends, ends[1:], strict=False):
            twist = angle - before - (lever.drawn - drawn_before)
            before, drawn_before = angle, lever.drawn
            centre = start + rotation(angle) @ lever.centre
            found += lever.mass * GRAVITY * centre[1] - lever.load @ end
            linear = lever.preload * twist + 0.5 * lever.stiffness * twist**2
            found += 0.25 * lever.stiffness * twist**4 if lever.cubic else linear
            stiffness, free, place = lever.spring
            found += 0.5 * stiffness * (np.linalg.norm(end - place) - free) ** 2
        if self.arm is not None:
            foot, _ = self.arm
            found += 0.2 * GRAVITY * 0.5 * (foot + ends[-1])[1]
        return float(found)

    def gap(self, angles: FloatArray, moved: float) -> FloatArray:
        """Return by how much the arm of a five-bar is too short [m], shape (1,); shape (0,) without one."""
        if self.arm is None:
            return np.zeros(0)
        foot, length = self.arm
        pivot = rotation(moved) @ self.pivot if self.turns else self.pivot + np.array([moved, 0.0])
        return np.array([np.linalg.norm(self._ends(angles, pivot)[-1] - foot) - length])

    def nearest(self, angles: FloatArray, moved: float) -> FloatArray:
        """Return the angles of least energy near some, by Newton's method; not a number without a minimum."""
        x, push = angles.copy(), np.zeros(self.gap(angles, moved).size)
        n, each = x.size, np.eye(x.size)
        for _ in range(4):

            def lagrangian(y: FloatArray, push: FloatArray = push) -> float:
                return self.energy(y, moved) + float(push @ self.gap(y, moved))

            rows = np.array([_difference(lambda y: self.gap(y, moved), x, a) for a in each]).T
            slope = np.array([_difference(lagrangian, x, a) for a in each])
            bend = np.array(
                [
                    [_difference(lambda y, a=a: _difference(lagrangian, y, a), x, b) for a in each]
                    for b in each
                ]
            )
            free = np.linalg.svd(rows)[2][len(rows) :].T if len(rows) else each
            whole = np.block([[bend, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
            step = np.linalg.solve(whole, -np.concatenate([slope, self.gap(x, moved)]))
            x, push = x + step[:n], push + step[n:]
        return x if np.all(np.linalg.eigvalsh(free.T @ bend @ free) > 0.0) else np.full(n, np.nan)


def _difference(function: Callable[[FloatArray], Any], x: FloatArray, along: FloatArray) -> Any:
    h = 1e-3
    near, far = (function(x + k * h * along) - function(x - k * h * along) for k in (1, 2))
    return (8.0 * near - far) / (12.0 * h)


def rotation(angle: float) -> FloatArray:
    """Return the matrix of a rotation in the plane."""
    c, s = math.cos(angle), math.sin(angle)
    return np.array([[c, -s], [s, c]])


def point(place: FloatArray) -> str:
    """Write a point of the plane [m]."""
    return f"{place[0] * 1e3:.12g}, {place[1] * 1e3:.12g}, 0 mm"
