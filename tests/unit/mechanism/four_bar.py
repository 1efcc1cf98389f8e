"""A crank and rocker of four revolute joints as calls, for tests of what clearance takes."""

import math

from tribodyn.mechanism.builder.mechanism_builder import Mechanism

CRANK, COUPLER, ROCKER, FRAME = 30.0, 100.0, 80.0, 90.0  #: [mm]; the crank turns fully.
JOINTS = ("main", "pin", "top", "pivot")


def four_bar(tilt: float = 0.0, real: tuple[str, ...] = ()) -> Mechanism:
    """Return it with the axis of ``pivot`` tilted [rad], and joints of 50 µm clearance and 20 mm length."""
    small, reach = "1e-4, 1e-4, 1e-4 kg m^2", FRAME - CRANK
    way = (COUPLER**2 - ROCKER**2 + reach**2) / (2.0 * reach)
    top = CRANK + way, math.sqrt(COUPLER**2 - way**2)
    drawn = (
        Mechanism("Four-bar", run={"duration": "20 ms"})
        .body("crank", mass="0.3 kg", centre=f"{CRANK / 2}, 0, 0 mm", inertia=small)
        .body("coupler", mass="0.3 kg", centre=f"{(CRANK + top[0]) / 2}, {top[1] / 2}, 0 mm", inertia=small)
        .body("rocker", mass="0.3 kg", centre=f"{(FRAME + top[0]) / 2}, {top[1] / 2}, 0 mm", inertia=small)
        .revolute("main", "ground", "crank", point="0, 0, 0 mm", axis=[0, 0, 1])
        .revolute("pin", "crank", "coupler", point=f"{CRANK}, 0, 0 mm", axis=[0, 0, 1])
        .revolute("top", "coupler", "rocker", point=f"{top[0]}, {top[1]}, 0 mm", axis=[0, 0, 1])
        .revolute("pivot", "rocker", "ground", point=f"{FRAME}, 0, 0 mm", axis=[math.tan(tilt), 0, 1])
        .drive("motor", "main", speed="600 rpm")
    )
    sizes = {"radius": "6 mm", "radial": "50 um", "length": "20 mm", "axial": "50 um"}
    for name in real:
        drawn = drawn.clearance(name, **sizes, nodes_around=24, nodes_along=4)
    return drawn
