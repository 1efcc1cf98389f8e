"""One copy of a pattern alone: what carries the copies turns or slides as in a run with all of them."""

from collections.abc import Iterator, Sequence
from typing import Any, Final, cast

import numpy as np
import xarray as xr

from tribodyn.cases.case import Case, demand, with_entries
from tribodyn.mechanism.frames import GROUND
from tribodyn.mechanism.model.patterns import PATTERN, SCATTER
from tribodyn.mechanism.model.repetition import parts_that_name, repeated

_ROWS: Final = 120  #: Rows of the tables of a carrier's motion.


def one_copy(case: Any, together: xr.Dataset, instants: Sequence[float]) -> Case:
    """Return a case with the first copy of its pattern, on carriers whose motion is prescribed.

    Carriers are bodies that are not repeated and that parts of the pattern hold on to. Each is guided by one
    ideal joint on the ground. Where that turns and slides, the copy alone says how the carrier slides, with
    its share of the mass. Whatever else is not repeated is left out.

    ``case``: with one pattern; ``together``: its result with equal copies; ``instants``: times of each cycle
    at which errors of the outputs are read [s]. Raises InputError if there is no pattern or several, or a
    carrier has no such joint.
    """
    demand(len(case.pattern) == 1, PATTERN, "builds are made of the copies of one pattern")
    (pattern,) = case.pattern.values()
    values = case.written
    words = "this case was written with its copies; give the case file before it"
    demand(bool(values), PATTERN, words)
    named = parts_that_name(values)
    parts = repeated(pattern, named)
    held = {one for part in parts for one in named.get(part, ()) if one not in parts}
    carriers = sorted(name for kind, name in held if kind == "bodies" and name != GROUND)
    guides = [_guide(case, carrier) for carrier in carriers]
    kept = parts | {("bodies", one) for one in carriers} | {("joints", one) for one in guides}
    tables = {*_PARTS, *(table for table, _, _ in case.elements())}
    there = {tuple(path.split(".")[:2]) for path in values if path.count(".") > 1}
    without = [f"{kind}.{name}" for kind, name in there if kind in tables and (kind, name) not in kept]
    given = {path: value for joint in guides for path, value in _motion(case, joint, together)}
    masses = {f"bodies.{one}.mass": values.get(f"bodies.{one}.mass") for one in carriers}
    given |= {
        path: f"{mass / pattern.count!r} kg" for path, mass in masses.items() if isinstance(mass, float)
    }
    times = f"{', '.join(map(repr, instants))} s"
    given |= {f"outputs.{name}.at.times": times for kind, name in parts if kind == "outputs"}
    if case.period is not None:
        given["run.period"] = f"{case.period!r} s"
    return with_entries(cast(Case, case), given, "the copy alone", without)


_GUIDES: Final = ("revolute", "prismatic", "cylindrical")
_PARTS: Final = ("bodies", "joints", "drives", "loads", "springs", "outputs", PATTERN, SCATTER)


def _guide(case: Any, carrier: str) -> str:
    """Return the joint that guides a carrier."""
    found = [
        name
        for name, joint in case.joints.items()
        if set(joint.between) == {GROUND, carrier} and joint.real is None and joint.type in _GUIDES
    ]
    words = (
        f"copies are independent where the motion of {carrier} is prescribed: it needs one ideal joint on "
        f"the ground, {' or '.join(_GUIDES)}, and has {len(found)}"
    )
    demand(len(found) == 1, f"bodies.{carrier}", words)
    return str(found[0])


def _motion(case: Any, joint: str, together: xr.Dataset) -> Iterator[tuple[str, object]]:
    """Yield the keys of a drive that moves a joint as in a result, by a smooth curve near its rows."""
    at, found = np.linspace(0.0, case.duration, _ROWS), together.sel(joint=joint)
    turns = "angle" in case.joints[joint].kind.COORDINATES
    rows = found["joint_angle"].values if turns else found["displacement"].values[:, 2]
    values, unit = np.interp(at, together["time"].values, rows), "rad" if turns else "m"
    drive = f"drives.{joint}-alone"
    yield f"{drive}.joint", joint
    drive = f"{drive}.{'angle' if turns else 'position'}"
    yield f"{drive}.interpolation", "smooth"
    yield f"{drive}.times", f"{', '.join(map(repr, at.tolist()))} s"
    yield f"{drive}.values", f"{', '.join(map(repr, values.tolist()))} {unit}"
