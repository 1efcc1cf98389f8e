"""Random mechanisms of any joints: each runs and obeys mechanics, or is refused in words.

What a run says of itself, balances and residuals, is not taken for granted: joints are put together anew from
the motion of the bodies, and every body that nothing but joints and weight acts on obeys Newton's law.
"""

import time
from collections.abc import Sequence
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.faults.mechanisms.random_mechanisms import Drawing, drawn
from tests.faults.mechanisms.test_random_physics import chunks

from tribodyn.core.errors import InputError
from tribodyn.mechanisms.self_checks import ENERGY_LIMIT
from tribodyn.simulation import simulate

CLOSED = 1e-10  #: Distance [m] and sine of an angle that no joint may come apart by.
#: Force missing in Newton's law over the largest one: 1e-14, more where masses differ by millions.
BALANCED = 1e-7
#: Way that is none [m]: energies are then the rounding of forces that balance, and a run says so.
REST = 1e-9
#: Computing time of a run that hangs [s]: of 200, seed 138 takes the longest, 1 to 12 s as its path goes. Its
#: rocker of 4e-8 kg shakes between bodies a million times heavier. One other takes 8 s, the rest 5 s at most.
PATIENCE = 60.0
TOO_LIGHT = "is too light beside"
#: What a run says that stops because a load, such as that on the edge of a pin, is too much for a law.
BEYOND = "closer than the contact law reaches"
FEW = (2, 5, 6, 10, 12, 27)  #: Seeds of each form and fault that take half a second each.
#: Joints whose points stay together; those of others do across the axis.
MEETS = ("revolute", "spherical", "universal", "fixed")
ALIGNED = ("revolute", "cylindrical", "prismatic")
Vectors = np.ndarray[Any, np.dtype[np.float64]]


def vector(texts: list[str] | list[float], unit: float = 1.0) -> Vectors:
    """Read three numbers of a drawing."""
    return unit * np.array([float(str(text).split()[0]) for text in texts])


def turned(quaternions: Vectors, v: Vectors) -> Vectors:
    """Turn a vector by unit quaternions, shape (n_t, 4)."""
    w, u = quaternions[:, :1], quaternions[:, 1:]
    return np.asarray(v + 2.0 * np.cross(u, np.cross(u, v) + w * v))


class Motion:
    """Where points and directions of a drawing go in a result."""

    def __init__(self, drawing: Drawing, result: xr.Dataset) -> None:
        self.drawing, self.result = drawing, result

    def point(self, body: str, drawn_at: Vectors) -> Vectors:
        """Return where a point of a body is, shape (n_t, 3)."""
        if body == "ground":
            return drawn_at
        arm = drawn_at - vector(self.drawing.bodies[body]["centre"], 1e-3)
        return np.asarray(self.result["position"].sel(body=body).values + self.direction(body, arm))

    def direction(self, body: str, drawn_as: Vectors) -> Vectors:
        """Return where a direction of a body points, shape (n_t, 3)."""
        if body == "ground":
            return drawn_as
        return turned(self.result["orientation"].sel(body=body).values, drawn_as)

    def apart(self, joint: dict[str, Any]) -> float:
        """Return by how much an ideal joint comes apart at most [m], or the sine of the angle."""
        (first, second), found = joint["between"], [0.0]
        place = vector(joint["point"], 1e-3)
        way = self.point(second, place) - self.point(first, place)
        if joint["type"] in MEETS:
            found.append(float(np.max(np.abs(way))))
        elif joint["type"] != "spring-damper":
            found.append(float(np.max(np.abs(np.cross(way, self.direction(first, vector(joint["axis"])))))))
        if joint["type"] in ALIGNED:
            axis = vector(joint["axis"])
            across = np.cross(self.direction(first, axis), self.direction(second, axis))
            found.append(float(np.max(np.abs(across))))
        return max(found)

    def unbalanced(self, body: str) -> float:
        """Return the force that Newton's law misses at a body, over the largest one on it."""
        keys = self.drawing.bodies[body]
        weight = vector(self.drawing.more["gravity"])
        inertia = float(keys["mass"].split()[0]) * (
            self.result["acceleration"].sel(body=body).values - weight
        )
        forces = [
            (1.0 if joint["between"][1] == body else -1.0)
            * self.result["reaction_force_global"].sel(joint=name).values
            for name, joint in self.drawing.joints.items()
            if body in joint["between"]
        ]
        largest = max(float(np.max(np.abs(part))) for part in (inertia, *forces))
        return float(np.max(np.abs(sum(forces) - inertia))) / largest if largest else 0.0


def pushed(drawing: Drawing) -> set[str]:
    """Return the bodies on which more than joints and weight acts."""
    loads, springs = drawing.more.get("loads", {}), drawing.more.get("springs", {})
    return {load["body"] for load in loads.values()} | {spring["between"][1] for spring in springs.values()}


def wrong(drawing: Drawing, result: xr.Dataset) -> list[str]:
    """Return what is wrong with a run, in words."""
    if BEYOND in result.attrs["failure"]:
        return []
    if result.attrs["failure"]:
        reached, notes = result.attrs["time_reached"], " ".join(result.attrs["warnings"])
        return [f"stopped at t = {reached:.4g} s: {result.attrs['failure']}. {notes}"]
    motion, found = Motion(drawing, result), []
    missed = float(result.attrs["energy_residual"])
    if not missed <= ENERGY_LIMIT and not at_rest(result):
        found.append(f"energy {missed:.1e}")
    ideal = {name: joint for name, joint in drawing.joints.items() if "clearance" not in joint}
    found += [
        f"{name} apart by {gap:.1e}"
        for name, joint in ideal.items()
        if not (gap := motion.apart(joint)) < CLOSED
    ]
    free = [body for body in drawing.bodies if body not in pushed(drawing)]
    found += [
        f"{body} out of balance by {miss:.1e}"
        for body in free
        if not (miss := motion.unbalanced(body)) < BALANCED
    ]
    return found


def at_rest(result: xr.Dataset) -> bool:
    """Tell whether nothing moves, and the run warns of the energy that it misses for that."""
    way = result["position"].max("time") - result["position"].min("time")
    return float(way.max()) < REST and "Energy is missed" in result.attrs["warnings"]


def complaint(seed: int) -> str:
    """Run the mechanism of a seed; return what is wrong, nothing where it is sound or must be refused."""
    drawing, words = drawn(seed)
    began = time.process_time()
    try:
        result = simulate(drawing.case(), stop=lambda: time.process_time() - began > PATIENCE)
    except InputError as error:
        said = str(error)
        return "" if (words and words in said) or TOO_LIGHT in said else f"refused: {said}"
    return f"not refused: {words}" if words else "; ".join(wrong(drawing, result))


@pytest.mark.parametrize("seeds", [pytest.param(FEW, id="few"), *chunks(200)])
def test_random_mechanisms(seeds: Sequence[int]) -> None:
    found = {seed: complaint(seed) for seed in seeds}
    assert not {seed: text for seed, text in found.items() if text}
