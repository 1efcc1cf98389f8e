"""A chain of N closed four-bars: 2 N + 1 bodies in N loops, each with three redundant constraints."""

from __future__ import annotations

import math
from typing import Any, Final, TypeAlias

PITCH: Final = 0.12  #: Distance of the pivots on the ground [m].
LENGTH: Final = 0.05  #: Of the rockers [m].
LEAN: Final = math.radians(70.0)  #: Angle of the rockers in the drawing [rad].
Point: TypeAlias = tuple[float, float]


def case(n: int, cycles: float = 1.0) -> Any:
    """Return the case of a chain of ``n`` four-bars, whose rockers swing by 15° to each side."""
    import tribodyn as td

    feet = [(k * PITCH, 0.0) for k in range(n + 1)]
    tops = [(x + LENGTH * math.cos(LEAN), LENGTH * math.sin(LEAN)) for x, _ in feet]
    bodies = {f"rocker{k}": _rod(feet[k], tops[k]) for k in range(n + 1)}
    joints = {f"pivot{k}": _revolute("ground", f"rocker{k}", feet[k]) for k in range(n + 1)}
    for k in range(n):
        bodies[f"coupler{k}"] = _rod(tops[k], tops[k + 1])
        for name, rocker in (("left", k), ("right", k + 1)):
            joints[f"{name}{k}"] = _revolute(f"rocker{rocker}", f"coupler{k}", tops[rocker])
    angle = {"value": "0 deg", "swing": "15 deg", "angular_frequency": "6 rad/s"}
    return td.Mechanism(
        f"Chain of {n} four-bars",
        bodies=bodies,
        joints=joints,
        drives={"crank": {"joint": "pivot0", "angle": angle}},
        run={"cycles": cycles, "output_interval": "5 ms"},
    ).case()


def _rod(start: Point, end: Point) -> dict[str, Any]:
    """Return a rod of 1 kg for each metre."""
    length = math.dist(start, end)
    along = [(b - a) / length for a, b in zip(start, end, strict=True)]
    across = length**3 / 12.0
    return {
        "mass": f"{length} kg",
        "centre": _place(*((a + b) / 2.0 for a, b in zip(start, end, strict=True))),
        "inertia": f"{0.1 * across}, {across}, {across} kg m2",
        "first_axis": [*along, 0.0],
        "second_axis": [-along[1], along[0], 0.0],
    }


def _revolute(first: str, second: str, point: Point) -> dict[str, Any]:
    return {"type": "revolute", "between": [first, second], "point": _place(*point), "axis": [0, 0, 1]}


def _place(x: float, y: float) -> str:
    return f"{1e3 * x:.12g}, {1e3 * y:.12g}, 0 mm"
