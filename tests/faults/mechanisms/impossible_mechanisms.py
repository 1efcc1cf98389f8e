"""Twins of random mechanisms, with ideal and with real joints: right ones, and some that cannot be.

Each comes from its seed: even ones are right, odd ones are impossible by construction. They do not close, are
locked, have two drives on one freedom, wrong axes, or cannot turn as far as their drive takes them, always by
far more than clearances give way.
"""

import copy
import math
from collections.abc import Callable
from typing import Any, Final

import numpy as np
from tests.faults.mechanisms import random_mechanisms as drawings
from tests.faults.mechanisms.random_mechanisms import SHAPES, Chance, Drawing, around, direction

#: What a refusal says, one of them.
WORDS: Final = ("does not close", "has nothing to drive", "drive one freedom", "nothing holds body")


def space(chance: Chance) -> Any:
    """Draw axes at random, as columns."""
    return np.linalg.qr(chance.normal(size=(3, 3)))[0]


def turned(drawing: Drawing, speed: float) -> Drawing:
    """Turn the first joint a little more than once, at constant speed [rad/s]."""
    drawing.more["gravity"] = [f"{9.81 * x:.6g} m/s^2" for x in direction(drawing.chance)]
    drawing.more["drives"] = {"motor": {"joint": "joint-0", "speed": f"{speed:.6g} rad/s"}}
    drawing.more["run"] = {"duration": f"{2.2 * math.pi / speed:.6g} s"}
    return drawing


def loop(chance: Chance, lengths: tuple[float, float, float, float], kinds: str = "revolute") -> Drawing:
    """Draw crank, coupler and rocker on a frame of these lengths [m], the crank on the frame."""
    drawing, axes = Drawing(chance), space(chance)
    crank, coupler, rocker, frame = np.array(lengths) * around(chance, 1.0, 2.0)
    reach = frame - crank
    way = (coupler**2 - rocker**2 + reach**2) / (2.0 * reach)
    top = [crank + way, math.sqrt(coupler**2 - way**2), 0.0]
    points = [axes @ point for point in ([0, 0, 0], [crank, 0, 0], top, [frame, 0, 0])]
    names = ("crank", "coupler", "rocker")
    for name, start, end in zip(names, points, points[1:], strict=False):
        drawing.bar(name, start, end)
    ends = ("ground", *names, "ground")
    for k, point in enumerate(points):
        drawing.joint(f"joint-{k}", kinds, ends[k : k + 2], point, axes[:, 2].tolist(), 0.0)
    return turned(drawing, around(chance, 20.0, 3.0))


def slider(chance: Chance, ratio: float, across: bool = False, angle: float = 0.5) -> Drawing:
    """Draw a crank, a rod so many times as long and a slider along the line through the crank's pivot."""
    drawing, axes, crank = Drawing(chance), space(chance), 0.05 * around(chance, 1.0, 2.0)
    pin = crank * np.array([math.cos(angle), math.sin(angle), 0.0])
    end = np.array([pin[0] + math.sqrt((ratio * crank) ** 2 - pin[1] ** 2), 0.0, 0.0])
    points = [axes @ point for point in (np.zeros(3), pin, end)]
    drawing.bar("crank", points[0], points[1])
    drawing.bar("rod", points[1], points[2])
    drawing.bar("slider", points[2], points[2] + 0.2 * crank * axes[:, 0])
    ends = ("ground", "crank", "rod", "slider")
    for k, point in enumerate(points):
        drawing.joint(f"joint-{k}", "revolute", ends[k : k + 2], point, axes[:, 2].tolist(), 0.0)
    way = axes[:, 1 if across else 0].tolist()
    drawing.joint("guide", "prismatic", ("ground", "slider"), points[2], way, 0.0)
    return turned(drawing, around(chance, 20.0, 3.0))


def skew(chance: Chance, crank: float) -> Drawing:
    """Draw a crank [m] and a rocker on skew axes with a coupler between two balls."""
    drawing, axes, factor = Drawing(chance), space(chance), around(chance, 1.0, 2.0)
    near = np.array([0.1, 0.04, 0.0]) * chance.uniform(0.98, 1.02, 3)
    far = near + np.array([0.0, 0.0, 0.08])
    points = [factor * axes @ point for point in (np.zeros(3), np.array([crank, 0.0, 0.0]), far, near)]
    names = ("crank", "coupler", "rocker")
    for name, start, end in zip(names, points, points[1:], strict=False):
        drawing.bar(name, start, end)
    ends = ("ground", *names, "ground")
    for k, (kind, axis) in enumerate(
        (("revolute", 2), ("spherical", 2), ("spherical", 2), ("revolute", 0)), start=0
    ):
        drawing.joint(f"joint-{k}", kind, ends[k : k + 2], points[k], axes[:, axis].tolist(), 0.0)
    return turned(drawing, around(chance, 20.0, 3.0))


def crank_rocker(chance: Chance) -> Drawing:
    """Draw a loop whose crank turns."""
    return loop(chance, (0.03, 0.1, 0.08, 0.09))


def slider_crank(chance: Chance) -> Drawing:
    """Draw a slider-crank whose crank turns."""
    return slider(chance, float(chance.uniform(1.5, 4.0)), angle=float(chance.uniform(-math.pi, math.pi)))


def skew_crank(chance: Chance) -> Drawing:
    """Draw a spatial loop whose crank turns."""
    return skew(chance, float(chance.uniform(0.005, 0.01)))


RIGHT: Final[tuple[Callable[[Chance], Drawing], ...]] = (
    crank_rocker,
    slider_crank,
    skew_crank,
    drawings.chain,
    drawings.star,
)


def long_crank(chance: Chance) -> Drawing:
    """Draw a loop whose crank is too long to turn."""
    crank, coupler, rocker, frame = chance.uniform(0.98, 1.02, 4) * (0.05, 0.05, 0.05, 0.06)
    return loop(chance, (crank, coupler, rocker, frame))


def short_rod(chance: Chance) -> Drawing:
    """Draw a slider-crank whose rod is too short."""
    return slider(chance, float(chance.uniform(0.6, 0.9)), angle=float(chance.uniform(-0.5, 0.5)))


def long_skew_crank(chance: Chance) -> Drawing:
    """Draw a spatial loop whose crank is too long to turn."""
    return skew(chance, float(chance.uniform(0.06, 0.08)))


def crossed_guide(chance: Chance) -> Drawing:
    """Draw a slider-crank whose guide stands across."""
    return slider(chance, float(chance.uniform(1.5, 4.0)), across=True, angle=float(chance.uniform(0.0, 1.0)))


def crossed_pin(chance: Chance) -> Drawing:
    """Draw a loop in which one pin stands askew by 20° or more."""
    drawing, name = crank_rocker(chance), f"joint-{chance.integers(4)}"
    axis, askew = np.array(drawing.joints[name]["axis"]), chance.uniform(math.radians(20.0), 0.5 * math.pi)
    across = np.cross(axis, direction(chance))
    across /= np.linalg.norm(across)
    drawing.joints[name]["axis"] = (math.cos(askew) * axis + math.sin(askew) * across).tolist()
    return drawing


def welded_pin(chance: Chance) -> Drawing:
    """Draw a loop in which one pin is fixed."""
    drawing, name = crank_rocker(chance), f"joint-{chance.integers(1, 4)}"
    drawing.joints[name]["type"] = "fixed"
    del drawing.joints[name]["axis"]
    return drawing


def driven_twice(chance: Chance) -> Drawing:
    """Draw a loop or a slider-crank that is driven at both ends, by speeds that cannot agree."""
    if chance.uniform() < 0.5:
        drawing = crank_rocker(chance)
        drawing.more["drives"]["second"] = {"joint": "joint-3", "speed": "30 rad/s"}
    else:
        drawing = slider_crank(chance)
        drawing.more["drives"]["second"] = {"joint": "guide", "velocity": "1 m/s"}
    return drawing


def _spoiled(spoil: Callable[[Drawing], str]) -> Callable[[Chance], Drawing]:
    """Return a maker of right mechanisms that are spoiled then."""

    def draw(chance: Chance) -> Drawing:
        drawing = RIGHT[int(chance.integers(len(RIGHT)))](chance)
        spoil(drawing)
        return drawing

    return draw


IMPOSSIBLE: Final[tuple[Callable[[Chance], Drawing], ...]] = (
    long_crank,
    short_rod,
    long_skew_crank,
    crossed_guide,
    crossed_pin,
    welded_pin,
    driven_twice,
    *map(_spoiled, (drawings.apart, drawings.floating, drawings.two_motors, drawings.locked_motor)),
)


def twins(seed: int, duration: float) -> tuple[bool, Drawing, Drawing]:
    """Return whether a mechanism is right, and it with ideal joints and with real ones.

    A right one runs for ``duration`` [s] at most.
    """
    chance, right = np.random.default_rng(seed), seed % 2 == 0
    family = RIGHT if right else IMPOSSIBLE
    ideal = family[seed // 2 % len(family)](chance)
    for joint in ideal.joints.values():
        joint.pop("clearance", None)
    if right:
        ideal.more["run"]["duration"] = f"{min(_seconds(ideal), duration):.6g} s"
    real = copy.deepcopy(ideal)
    able = [name for name, joint in real.joints.items() if joint["type"] in SHAPES]
    for name in able:
        if chance.uniform() < 0.6 or name == able[-1]:
            real.joints[name]["clearance"] = _clearance(real, real.joints[name])
    return right, ideal, real


def _seconds(drawing: Drawing) -> float:
    """Return how long a mechanism runs [s]."""
    value, unit = drawing.more["run"]["duration"].split()
    return float(value) * {"s": 1.0, "ms": 1e-3}[unit]


def _clearance(drawing: Drawing, joint: dict[str, Any]) -> dict[str, Any]:
    """Draw a clearance from 10 to 100 µm.

    A tilted pin needs the number of rings that is the default: with 4 to 6 of them, the gap at the edge,
    which no area belongs to, is below −4 σ under loads that the default grid carries.
    """
    keys = drawing.clearance(joint["type"], tuple(joint["between"]))
    keys["radial"] = f"{around(drawing.chance, 30.0, 3.0):.4g} um"
    keys["nodes_along"] = 16
    return keys


def applied(drawing: Drawing) -> float:
    """Return the size of what acts on a mechanism [N]: weights, loads, springs, and inertia of its drives."""
    points = np.array([_vector(joint["point"]) for joint in drawing.joints.values()])
    size = float(np.linalg.norm(np.ptp(points, axis=0))) + 0.1
    rate = 20.0
    for drive in drawing.more.get("drives", {}).values():
        for signal in drive.values():
            text = signal.get("angular_frequency", "0") if isinstance(signal, dict) else str(signal)
            rate = max(rate, abs(float(text.split()[0])) if text.split()[0][0] in "-.0123456789" else 0.0)
    mass = sum(float(body["mass"].split()[0]) for body in drawing.bodies.values())
    loads = sum(_largest(load["force"]) for load in drawing.more.get("loads", {}).values())
    springs = sum(
        1e3 * float(spring["stiffness"].split()[0]) * 0.1 * size
        for spring in drawing.more.get("springs", {}).values()
    )
    return mass * (9.81 + rate**2 * size) + loads + springs


def _largest(force: Any) -> float:
    """Return the largest value of a load [N]."""
    parts = (force["value"], force["amplitude"]) if isinstance(force, dict) else (force,)
    return sum(float(part.split()[0]) for part in parts)


def _vector(point: Any) -> Any:
    """Return a point [m] of a drawing."""
    texts = point.split(",") if isinstance(point, str) else point
    return np.array([1e-3 * float(str(text).split()[0]) for text in texts])
