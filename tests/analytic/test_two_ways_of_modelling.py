"""One bearing, modelled in two ways: a long cylinder against two short ones at its ends."""

import numpy as np
import pytest

import tribodyn as td
from tribodyn.mechanism.builder.mechanism_builder import Mechanism

WEIGHT = 9.81 * 2.0  #: Of the shaft [N].
#: What a start may leave: loads are balanced to a millionth of the largest one met on the way to the wall.
SETTLED = 1e-4
PIN = {"radius": "6 mm", "radial": "20 um", "friction_coefficient": 0.0, "nodes_around": 96}


def shaft(bearings: dict[str, tuple[float, float]]) -> Mechanism:
    """Return a shaft along y in bearings, each with its place along the shaft and its length [mm]."""
    drawn = Mechanism("Shaft", gravity="0, 0, -9.81 m/s^2", run={"duration": "10 us"})
    drawn.body("shaft", mass="2 kg", centre="0, 0, 0 mm", inertia="1e-3, 1e-3, 1e-3 kg m^2")
    for name, (place, length) in bearings.items():
        drawn.cylindrical(name, "ground", "shaft", point=f"0, {place}, 0 mm", axis=[0, 1, 0])
        drawn.clearance(name, length=f"{length} mm", **PIN)
    return drawn


def test_two_short_cylinders_share_what_one_long_one_carries() -> None:
    one, two = (
        td.simulate(shaft(bearings).case()).isel(time=0)
        for bearings in ({"middle": (0.0, 20.0)}, {"left": (-5.0, 10.0), "right": (5.0, 10.0)})
    )
    forces = np.linalg.norm(two["reaction_force"], axis=-1)
    assert forces == pytest.approx([WEIGHT / 2.0, WEIGHT / 2.0], rel=SETTLED)
    assert float(np.linalg.norm(one["reaction_force"])) == pytest.approx(WEIGHT, rel=SETTLED)
    # A shaft that does not tilt has the same gap all along, so the same pressure.
    pressure = float(one["pressure_max"].max())
    assert pressure > 0.0
    assert two["pressure_max"].values == pytest.approx([pressure, pressure], rel=SETTLED)
    down = np.linalg.norm(one["displacement"], axis=-1)
    assert np.linalg.norm(two["displacement"], axis=-1) == pytest.approx([*down, *down], rel=SETTLED)
