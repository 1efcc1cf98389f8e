"""Random mechanisms, each from its seed: chains, stars and loops of all joints, ideal or with clearance.

Bodies are bars between the points of a random drawing. What moves them, drives, weights, loads, springs,
is drawn with them. ``SPOILED`` makes mechanisms wrong or extreme on purpose.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np

from tribodyn.mechanism.builder.mechanism_builder import Mechanism
from tribodyn.mechanism.mechanism_case import MechanismCase

Chance = np.random.Generator
Keys = dict[str, Any]

LAWS: Final = ("rsdc", "ke", "gw", "linear")
IN_SERIES: Final = (
    "revolute",
    "spherical",
    "cylindrical",
    "prismatic",
    "universal",
    "pin-slot",
    "spring-damper",
)
#: Joints that leave no way; a chain of them cannot fall apart.
HELD_ALONG: Final = ("revolute", "spherical", "universal")
SHAPES: Final = {"revolute": "cylinder", "cylindrical": "cylinder", "spherical": "sphere", "pin-slot": "ball"}


def around(chance: Chance, value: float, factor: float) -> float:
    """Draw from ``value / factor`` to ``value * factor``, evenly on a logarithmic scale."""
    return value * float(factor ** chance.uniform(-1.0, 1.0))


def direction(chance: Chance) -> list[float]:
    """Draw a direction evenly."""
    drawn = chance.normal(size=3)
    return [float(x) for x in drawn / np.linalg.norm(drawn)]


def millimetres(point: Any) -> list[str]:
    """Write a point [m]."""
    return [f"{1e3 * float(x):.9g} mm" for x in point]


@dataclass
class Drawing:
    """A mechanism while it is drawn."""

    chance: Chance  #: What draws it.
    #: Tables of its case by name; the last one holds the others.
    bodies: dict[str, Keys] = field(default_factory=dict)
    joints: dict[str, Keys] = field(default_factory=dict)
    more: dict[str, Any] = field(default_factory=dict)

    def case(self) -> MechanismCase:
        """Return the case; what is wrong with it raises."""
        return Mechanism("Random", bodies=self.bodies, joints=self.joints, **self.more).case()

    def bar(self, name: str, start: Any, end: Any) -> None:
        """Add a bar between two points [m], its mass centre a little aside."""
        start, end = np.asarray(start, float), np.asarray(end, float)
        length = max(float(np.linalg.norm(end - start)), 0.02)
        mass, width = around(self.chance, 0.3, 5.0), length * float(self.chance.uniform(0.1, 0.5))
        along = (end - start) / np.linalg.norm(end - start)
        across = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
        centre = 0.5 * (start + end) + 0.1 * width * np.array(direction(self.chance))
        bulky, slim = mass * (length**2 + width**2) / 12.0, mass * width**2 / 6.0
        self.bodies[name] = {
            "mass": f"{mass:.6g} kg",
            "centre": millimetres(centre),
            "inertia": [f"{moment:.6g} kg m^2" for moment in (slim, bulky, bulky)],
            "first_axis": along.tolist(),
            "second_axis": (across / np.linalg.norm(across)).tolist(),
        }

    def joint(
        self, name: str, kind: str, between: tuple[str, str], point: Any, axis: list[float], real: float
    ) -> None:
        """Add a joint; with a probability it has clearance."""
        chance, keys = self.chance, {"type": kind, "between": list(between), "point": millimetres(point)}
        if kind not in ("spherical", "fixed", "spring-damper"):
            keys["axis"] = axis
        if kind == "universal":
            across = np.cross(axis, direction(chance))
            keys["second_axis"] = (across / np.linalg.norm(across)).tolist()
        if kind == "spring-damper":
            keys["stiffness"] = [f"{around(chance, 100, 10):.4g} N/mm" for _ in range(3)]
            keys["damping"] = [f"{around(chance, 30, 3):.4g} N s/m" for _ in range(3)]
            keys["angular_stiffness"] = [f"{around(chance, 30, 10):.4g} N m/rad" for _ in range(3)]
        if kind in SHAPES and chance.uniform() < real:
            keys["clearance"] = self.clearance(kind, between)
        self.joints[name] = keys

    def clearance(self, kind: str, between: tuple[str, str]) -> Keys:
        """Draw a clearance from 1 µm to 1 mm, and what stands around it."""
        chance = self.chance
        radius = around(chance, 8e-3, 2.0)
        radial = min(around(chance, 30e-6, 30.0), 0.05 * radius)
        keys: Keys = {
            "radius": f"{1e3 * radius:.6g} mm",
            "radial": f"{1e6 * radial:.6g} um",
            "friction_coefficient": float(chance.uniform(0.0, 0.3)),
            "socket": str(chance.choice(between)),
            "nodes_around": int(chance.choice([24, 48])),
            "nodes_along": int(chance.choice([4, 6])),
        }
        if SHAPES[kind] == "cylinder":
            keys["length"] = f"{1e3 * radius * chance.uniform(1.0, 4.0):.6g} mm"
        if kind == "revolute":
            keys["axial"] = f"{around(chance, 50, 10):.6g} um"
        if chance.uniform() < 0.3:
            keys["pair"] = self.pair()
        return keys

    def pair(self) -> str:
        """Add surfaces and a contact law of their own; return their name."""
        chance, pairs = self.chance, self.more.setdefault("pairs", {})
        name = f"pair-{len(pairs)}"
        pairs[name] = {
            "contact": {"law": str(chance.choice(LAWS)), "restitution": float(chance.uniform(0.3, 0.9))},
            "surfaces": {
                "bushing": {
                    "young_modulus": f"{around(chance, 10, 5):.4g} GPa",
                    "roughness": f"{around(chance, 1, 2):.4g} um",
                }
            },
        }
        return name

    def spring(self, body: str, point: Any) -> None:
        """Hold a point of a body by a spring with a damper."""
        far = np.asarray(point, float) + 0.1 * np.array(direction(self.chance))
        springs = self.more.setdefault("springs", {})
        springs[f"spring-{len(springs)}"] = {
            "between": ["ground", body],
            "first_point": millimetres(far),
            "second_point": millimetres(point),
            "stiffness": f"{around(self.chance, 3, 10):.4g} N/mm",
            "damping": f"{around(self.chance, 3, 10):.4g} N s/m",
        }

    def load(self, body: str) -> None:
        """Push a body: by a constant, a sine, in its own axes, or against its motion."""
        chance, loads = self.chance, self.more.setdefault("loads", {})
        size = f"{around(chance, 10, 10):.4g} N"
        swinging = {
            "value": size,
            "amplitude": size,
            "angular_frequency": f"{around(chance, 100, 3):.4g} rad/s",
        }
        loads[f"load-{len(loads)}"] = {
            "body": body,
            "direction": direction(chance),
            "frame": str(chance.choice(["ground", "body", "motion"])),
            "force": swinging if chance.uniform() < 0.5 else size,
        }

    def drive(self, joint: str) -> None:
        """Move the free coordinate of a joint: by itself, its speed, or its effort."""
        chance, drives = self.chance, self.more.setdefault("drives", {})
        turning = self.joints[joint]["type"] != "prismatic" and self.joints[joint]["type"] != "pin-slot"
        frequency = around(chance, 60, 3)
        given = {
            True: {
                "angle": {"value": "0 deg", "swing": f"{chance.uniform(5, 25):.4g} deg"},
                "speed": f"{around(chance, 20, 5):.4g} rad/s",
                "torque": f"{around(chance, 0.3, 10):.4g} N m",
            },
            False: {
                "position": {"value": "0 mm", "swing": f"{chance.uniform(2, 10):.4g} mm"},
                "velocity": f"{around(chance, 0.2, 5):.4g} m/s",
                "force": f"{around(chance, 3, 10):.4g} N",
            },
        }[turning]
        key = str(chance.choice(list(given)))
        signal = given[key]
        if isinstance(signal, dict):
            signal["angular_frequency"] = f"{frequency:.4g} rad/s"
        drives[f"drive-{len(drives)}"] = {"joint": joint, key: signal}


def surroundings(drawing: Drawing) -> None:
    """Add weight, loads, springs and how long it runs."""
    chance = drawing.chance
    drawing.more["gravity"] = [f"{9.81 * x:.6g} m/s^2" for x in direction(chance)]
    for body in drawing.bodies:
        if chance.uniform() < 0.2:
            drawing.load(body)
    drawing.more["run"] = {"duration": f"{around(chance, 15, 2):.4g} ms", "start": "equilibrium"}
    if chance.uniform() < 0.2:
        drawing.more["run"]["start"] = "centred"
    drawing.more["solver"] = {"rtol": around(chance, 1e-5, 10.0)}


def chain(chance: Chance) -> Drawing:
    """Draw bodies in a row that hang on the ground by any joints."""
    drawing, above, point = Drawing(chance), "ground", np.zeros(3)
    for k in range(int(chance.integers(1, 6))):
        name, end = f"link-{k}", point + around(chance, 0.1, 3.0) * np.array(direction(chance))
        drawing.bar(name, point, end)
        kind = str(chance.choice(IN_SERIES))
        drawing.joint(f"joint-{k}", kind, (above, name), point, direction(chance), 0.5)
        if kind not in HELD_ALONG and kind != "spring-damper":
            drawing.spring(name, end)
        above, point = name, end
    if chance.uniform() < 0.5 and drawing.joints["joint-0"]["type"] in (
        "revolute",
        "cylindrical",
        "prismatic",
    ):
        drawing.drive("joint-0")
    surroundings(drawing)
    return drawing


def star(chance: Chance) -> Drawing:
    """Draw arms around a hub that turns."""
    drawing, axis = Drawing(chance), direction(chance)
    drawing.bar("hub", [-0.02, 0.0, 0.0], [0.02, 0.0, 0.0])
    drawing.joint("bearing", "revolute", ("ground", "hub"), np.zeros(3), axis, 0.3)
    for k in range(int(chance.integers(2, 6))):
        start = 0.05 * np.array(direction(chance))
        end = start + around(chance, 0.1, 2.0) * np.array(direction(chance))
        drawing.bar(f"arm-{k}", start, end)
        kind = str(chance.choice(HELD_ALONG))
        drawing.joint(f"joint-{k}", kind, ("hub", f"arm-{k}"), start, direction(chance), 0.5)
    if chance.uniform() < 0.7:
        drawing.drive("bearing")
    surroundings(drawing)
    return drawing


def flat_loop(chance: Chance) -> Drawing:
    """Draw a crank and rocker of parallel revolute joints, which hold more than a flat loop needs."""
    drawing, turn = Drawing(chance), np.linalg.qr(chance.normal(size=(3, 3)))[0]
    crank, coupler, rocker, frame = 0.03, 0.1, 0.08, 0.09
    sizes = (
        around(chance, 1.0, 3.0) * np.array([crank, coupler, rocker, frame]) * chance.uniform(0.95, 1.05, 4)
    )
    angle = chance.uniform(-math.pi, math.pi)
    pin = sizes[0] * np.array([math.cos(angle), math.sin(angle), 0.0])
    pivot = np.array([sizes[3], 0.0, 0.0])
    reach = float(np.linalg.norm(pivot - pin))
    along, up = (pivot - pin) / reach, np.cross([0.0, 0.0, 1.0], (pivot - pin) / reach)
    way = (sizes[1] ** 2 - sizes[2] ** 2 + reach**2) / (2.0 * reach)
    top = pin + way * along + math.sqrt(sizes[1] ** 2 - way**2) * up
    points = [turn @ point for point in (np.zeros(3), pin, top, pivot)]
    names, axis = ("crank", "coupler", "rocker"), turn[:, 2].tolist()
    for name, start, end in zip(names, points, points[1:], strict=False):
        drawing.bar(name, start, end)
    ends = ("ground", *names, "ground")
    for k, point in enumerate(points):
        kind = (
            "revolute" if k == 0 else str(chance.choice(["revolute", "revolute", "spherical", "cylindrical"]))
        )
        drawing.joint(f"joint-{k}", kind, ends[k : k + 2], point, axis, 0.4)
    if chance.uniform() < 0.8:
        drawing.drive("joint-0")
    surroundings(drawing)
    return drawing


def spatial_loop(chance: Chance) -> Drawing:
    """Draw a ring of bodies between two points of the ground, mobile or not."""
    drawing, n = Drawing(chance), int(chance.integers(2, 6))
    points = [0.1 * np.array([k, 0.0, 0.0]) + 0.05 * np.array(direction(chance)) for k in range(n + 1)]
    names = [f"link-{k}" for k in range(n)]
    for name, start, end in zip(names, points, points[1:], strict=False):
        drawing.bar(name, start, end)
    ends = ("ground", *names, "ground")
    for k, point in enumerate(points):
        kind = str(chance.choice(["spherical", *HELD_ALONG, "cylindrical"]))
        drawing.joint(f"joint-{k}", kind, ends[k : k + 2], point, direction(chance), 0.4)
    surroundings(drawing)
    return drawing


FORMS: Final[tuple[Callable[[Chance], Drawing], ...]] = (chain, star, flat_loop, spatial_loop)


def twice(drawing: Drawing) -> str:
    """Say a joint twice: it is redundant."""
    name = next(iter(drawing.joints))
    drawing.joints["again"] = {
        key: value for key, value in drawing.joints[name].items() if key != "clearance"
    }
    return ""


def apart(drawing: Drawing) -> str:
    """Tie a body to the ground at a place that it cannot reach."""
    body = list(drawing.bodies)[-1]
    drawing.joints["rope"] = {
        "type": "spherical",
        "between": ["ground", body],
        "point": "0, 0, 0 m",
        "other_point": "9, 9, 9 m",
    }
    far = {"type": "fixed", "between": ["ground", body], "point": ["7 m", "0 m", "0 m"]}
    drawing.joints["rope-end"] = far
    return "does not close"


def floating(drawing: Drawing) -> str:
    """Leave a body without a joint."""
    drawing.bar("lost", [0.5, 0.0, 0.0], [0.6, 0.0, 0.0])
    return "nothing holds body lost"


def two_motors(drawing: Drawing) -> str:
    """Drive one freedom twice, at joints on one axis."""
    drawing.bar("rotor", [0.0, 0.5, 0.0], [0.1, 0.5, 0.0])
    for k in range(2):
        drawing.joint(
            f"rotor-{k}", "revolute", ("ground", "rotor"), [0.0, 0.5, 0.1 * k], [0.0, 0.0, 1.0], 0.0
        )
        drawing.more.setdefault("drives", {})[f"rotor-{k}"] = {
            "joint": f"rotor-{k}",
            "speed": f"{k + 1} rad/s",
        }
    return "drive one freedom"


def locked_motor(drawing: Drawing) -> str:
    """Drive a hinge of a body that is also fixed."""
    drawing.bar("rotor", [0.0, 0.5, 0.0], [0.1, 0.5, 0.0])
    drawing.joint("hinge", "revolute", ("ground", "rotor"), [0.0, 0.5, 0.0], [0.0, 0.0, 1.0], 0.0)
    drawing.joint("weld", "fixed", ("ground", "rotor"), [0.1, 0.5, 0.0], [0.0, 0.0, 1.0], 0.0)
    drawing.more.setdefault("drives", {})["motor"] = {"joint": "hinge", "speed": "1 rad/s"}
    return "has nothing to drive"


def extreme(drawing: Drawing) -> str:
    """Give bodies masses from 1e-9 to 1e3 kg."""
    for body in drawing.bodies.values():
        times = 10.0 ** drawing.chance.uniform(-9.0, 3.0) / float(body["mass"].split()[0])
        for key in ("mass", "inertia"):
            given = body[key] if key == "inertia" else [body[key]]
            changed = [f"{times * float(text.split()[0]):.6g} {text.split(' ', 1)[1]}" for text in given]
            body[key] = changed if key == "inertia" else changed[0]
    return ""


def wide(drawing: Drawing) -> str:
    """Make every clearance 1 µm or 1 mm."""
    for joint in drawing.joints.values():
        if "clearance" in joint:
            joint["clearance"] |= {"radius": "20 mm", "radial": str(drawing.chance.choice(["1 um", "1 mm"]))}
            joint["clearance"].pop("flange", None)
    return ""


SPOILED: Final[tuple[Callable[[Drawing], str], ...]] = (
    twice,
    apart,
    floating,
    two_motors,
    locked_motor,
    extreme,
    wide,
)


def drawn(seed: int) -> tuple[Drawing, str]:
    """Return the drawing of a seed, and words of the message with which it must be refused, if it must."""
    chance = np.random.default_rng(seed)
    drawing = FORMS[seed % len(FORMS)](chance)
    if chance.uniform() < 0.6:
        return drawing, ""
    return drawing, SPOILED[int(chance.integers(len(SPOILED)))](drawing)
