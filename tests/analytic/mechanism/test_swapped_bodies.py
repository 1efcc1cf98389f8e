"""Equal mechanisms whose joints name their two bodies in the other order: equal motion, opposite reactions.

The first body carries the axes of a joint and, with clearance, the bore; where that makes a difference, the
swapped description says so: by ``socket``, and by the axes of a universal joint.
"""

from typing import Any

import numpy as np
import pytest
import xarray as xr

import tribodyn as td
from tribodyn.mechanism.builder.mechanism_builder import Mechanism

#: Not all: the ball of a pin-slot belongs to the second body, and a spring-damper acts along axes of the
#: first one, so that swapped bodies are another mechanism.
TYPES: dict[str, dict[str, Any]] = {
    "fixed": {},
    "revolute": {"axis": [0.0, 0.6, 0.8]},
    "cylindrical": {"axis": [0.0, 0.6, 0.8]},
    "prismatic": {"axis": [0.0, 0.6, 0.8]},
    "planar": {"axis": [0.0, 0.6, 0.8]},
    "spherical": {},
    "universal": {"axis": [0.0, 0.6, 0.8], "second_axis": [1.0, 0.0, 0.0]},
}
SIZES = {"radius": "6 mm", "radial": "20 um", "nodes_around": 24, "nodes_along": 8, "socket": "arm"}
REAL = {
    "revolute": {"length": "12 mm", "axial": "50 um"},
    "cylindrical": {"length": "12 mm"},
    "spherical": {},
}


def arms(kind: str, swapped: bool, keys: dict[str, Any], clearance: dict[str, Any] | None) -> xr.Dataset:
    """Return the motion of two arms, the first on the ground, which are joined and held by a spring."""
    drawn = Mechanism(
        "Arms", gravity="1, -9.81, 3 m/s^2", run={"duration": "8 ms"}, solver={"rtol": 1e-8, "name": "mebdf"}
    )
    for k, name in enumerate(("arm", "hand")):
        drawn.body(name, mass="0.4 kg", centre=f"{100 * k + 50}, 4, 7 mm", inertia="1e-4, 4e-4, 4e-4 kg m^2")
    drawn.revolute("shoulder", "ground", "arm", point="0, 0, 0 mm", axis=[0, 0, 1], start_speed="20 rad/s")
    if swapped and kind == "universal":
        keys = {"axis": keys["second_axis"], "second_axis": keys["axis"]}
    bodies = ("hand", "arm") if swapped else ("arm", "hand")
    drawn.joint("elbow", kind, *bodies, point="100, 0, 0 mm", **keys)
    if clearance is not None:
        drawn.clearance("elbow", **SIZES, **clearance)
    ends = {"first_point": "180, 90, 20 mm", "second_point": "190, 5, 9 mm"}
    drawn.spring("rope", "ground", "hand", stiffness="5 N/mm", damping="4 N s/m", length="60 mm", **ends)
    return td.simulate(drawn.case())


def assert_same(kind: str, keys: dict[str, Any], clearance: dict[str, Any] | None, digits: float) -> None:
    one, other = (arms(kind, swapped, keys, clearance) for swapped in (False, True))
    assert not one.attrs["failure"]
    for name in ("position", "orientation", "velocity", "angular_velocity"):
        expected = one[name].values
        difference = np.abs(other[name].sel(time=one["time"], method="nearest").values - expected).max()
        assert difference < digits * np.abs(expected).max(), name
    forces = [found["reaction_force_global"].sel(joint="elbow") for found in (one, other)]
    expected = forces[0].values
    assert np.abs(expected).max() > 1.0
    swapped_force = forces[1].sel(time=one["time"], method="nearest").values
    assert np.abs(swapped_force + expected).max() < 100.0 * digits * np.abs(expected).max()


@pytest.mark.parametrize("kind", TYPES)
def test_ideal_joints(kind: str) -> None:
    assert_same(kind, TYPES[kind], None, 1e-7)


@pytest.mark.parametrize("kind", REAL)
def test_joints_with_clearance(kind: str) -> None:
    # Without an axis that of the race follows from the bodies, and its grid begins elsewhere.
    assert_same(kind, TYPES[kind] | {"axis": [0.0, 0.6, 0.8]}, REAL[kind], 1e-9)
