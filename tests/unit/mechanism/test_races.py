"""Ball joints without an axis: their race turns with the model."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tribodyn as td
from tribodyn.mechanism.assembly.clearance_surfaces import axes_of
from tribodyn.mechanism.builder.mechanism_builder import Mechanism

TURN = Rotation.from_rotvec([0.4, -0.7, 1.1]).as_matrix()
RACE = {"radius": "6 mm", "radial": "20 um", "nodes_around": 36, "nodes_along": 6}


def hanging(turn: np.ndarray) -> Mechanism:
    """Return a body on two ball joints, off the line between them, turned as a whole with gravity."""

    def at(*place: float) -> str:
        return ", ".join(f"{value:.15g}" for value in turn @ np.array(place)) + " mm"

    gravity = ", ".join(f"{value:.15g}" for value in turn @ np.array([1.0, 2.0, -9.0])) + " m/s^2"
    drawn = Mechanism("Hanging", gravity=gravity, run={"duration": "1 us"})
    inertia = "1e-3, 1e-3, 1e-3 kg m^2"  # the same about any axis
    drawn.body("plate", mass="1 kg", centre=at(40, 30, -50), inertia=inertia)
    for name, place in (("left", (0, 0, 0)), ("right", (80, 10, 0))):
        drawn.spherical(name, "ground", "plate", point=at(*place)).clearance(name, **RACE)
    return drawn


def test_the_race_is_normal_to_the_plane_of_joint_and_mass_centres() -> None:
    plain, turned = (hanging(turn).case() for turn in (np.eye(3), TURN))
    for before, after in zip(plain.joints.values(), turned.joints.values(), strict=True):
        np.testing.assert_allclose(axes_of(turned, after), axes_of(plain, before) @ TURN.T, atol=1e-12)
    left = plain.joints["left"]
    way = np.array(plain.bodies["plate"].centre) - left.point
    assert axes_of(plain, left)[0] @ way == pytest.approx(0.0, abs=1e-15)


def test_rotating_the_model_changes_no_force() -> None:
    before, after = (
        td.simulate(hanging(turn).case())["reaction_force_global"].isel(time=0).values
        for turn in (np.eye(3), TURN)
    )
    # The start is found to 1e-6 of the largest load; about Z as before forces differed by some per cent.
    np.testing.assert_allclose(after, before @ TURN.T, atol=1e-5 * np.abs(before).max())


@pytest.mark.parametrize("centre", ["0, 0, 0 mm", "0, 0, 70 mm"])
def test_a_mechanism_on_a_line_has_an_axis_across_it(centre: str) -> None:
    drawn = Mechanism("Bob", run={"duration": "1 us"})
    drawn.body("bob", mass="1 kg", centre=centre, inertia="1e-3, 1e-3, 1e-3 kg m^2")
    drawn.spherical("pivot", "ground", "bob", point="0, 0, 0 mm").clearance("pivot", **RACE)
    case = drawn.case()
    axis, second = axes_of(case, case.joints["pivot"])
    assert axis @ second == pytest.approx(0.0, abs=1e-15)
    assert np.linalg.norm(axis) == pytest.approx(1.0)
