"""A ring between pads: a whole bore of pads is a bore, and a load lies on one pad or on the two beside it."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import tribodyn as td
from tribodyn.core.errors import InputError
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.joints.point_contact import resting
from tribodyn.joints.shapes import Pads
from tribodyn.kernels.joints.surface.joint import wrench_and_jacobian
from tribodyn.kernels.joints.surface.memory import new_memory
from tribodyn.mechanisms.catalogue import MECHANISMS
from tribodyn.results.reading import column

PLAY = 0.2e-3  #: Radial gap of the ring at each pad [m].
PUSH = 50.0  #: Force on the ring [N].


def carried(clearance: Clearance, turn: float) -> tuple[np.ndarray, np.ndarray]:
    """Return force and moment of a pressed and tilted shaft, and their slopes; ``turn``: about its axis."""
    data = assemble([clearance])
    memory, force, slopes = new_memory(data), np.empty(6), np.empty((6, 12))
    pose = pose_at(
        d=[19e-6, 4e-6, 0.0],
        rotation=(
            Rotation.from_rotvec([2e-4, -3e-4, 0.0]) * Rotation.from_rotvec([0.0, 0.0, turn])
        ).as_matrix(),
        v=[1e-3, 2e-3, 0.0],
        w=[0.0, 0.0, 3.0],
    )
    memory.remembering[:] = 1.0
    wrench_and_jacobian(data, memory, 0, pose, force, slopes)
    return force, slopes


@pytest.mark.parametrize("turn", [0.0, 0.3])
def test_pads_all_around_are_a_bore_at_any_rotation_of_the_ring(make_clearance, turn: float) -> None:
    sizes = {"radius": 6e-3, "clearance": 20e-6, "length": 20e-3}
    width = 2.0 * math.pi * (sizes["radius"] + sizes["clearance"]) / 3
    pads = make_clearance("pads", grid=(192, 24), **sizes, width=width, count=3, first=0.4)
    bore = make_clearance("cylinder", grid=(192, 24), **sizes)
    for found, expected in zip(carried(pads, turn), carried(bore, turn), strict=True):
        # Pads leave out the second order of the tilt, 4e-7 of 1e-6 m: some thousandths of the force.
        assert found == pytest.approx(expected, abs=5e-3 * np.abs(expected).max())
    assert np.abs(expected).max() > 1.0


def ring(*, pads: int, towards: float, **keys: object) -> td.Mechanism:
    """Return a ring between pads, pushed at an angle from the first of them [deg]."""
    way = [math.cos(math.radians(towards)), math.sin(math.radians(towards)), 0]
    sizes = {"radius": "200 mm", "radial": f"{PLAY} m", "length": "10 mm", "pads": pads, "pad_width": "20 mm"}
    return (
        td.Mechanism(
            "Ring on pads", gravity="0, 0, 0 m/s^2", run={"analysis": "static", "positions": 4, "cycles": 1}
        )
        .body("ring", mass="2 kg", centre="0, 0, 0 mm", inertia="4e-2, 4e-2, 8e-2 kg m^2")
        .revolute(
            "guide",
            "ground",
            "ring",
            point="0, 0, 0 mm",
            axis=[0, 0, 1],
            second_axis=[1, 0, 0],
            clearance={"shape": "pads", **sizes, **keys},
        )
        .drive("motor", "guide", speed="1 rad/s")
        .load("push", "ring", direction=way, force=f"{PUSH} N")
    )


def test_a_load_on_one_pad_closes_its_gap_and_between_two_that_at_the_near_edges_of_both() -> None:
    """Between two pads of four the ring lies deeper, by the cosine of the angle to the near edge of a pad."""
    places = []
    for towards in (0.0, 45.0):
        result = td.simulate(ring(pads=4, towards=towards, friction_coefficient=0))
        assert result.attrs["failure"] == ""
        across = column(result, "displacement")[-1, 0, :2]
        places.append(float(np.linalg.norm(across)))
        assert math.degrees(math.atan2(across[1], across[0])) == pytest.approx(towards, abs=0.1)
    apart = 6e-6  # roughness carries surfaces apart, by less than its onset at 4 σ
    edge = math.radians(45.0) - 0.5 * 20.0 / 200.2
    assert places[0] == pytest.approx(PLAY - 0.5 * apart, abs=0.5 * apart)
    assert places[1] == pytest.approx((PLAY - 0.5 * apart) / math.cos(edge), abs=0.5 * apart / math.cos(edge))


def test_a_rigid_ring_rests_where_loads_hold_it_and_its_room_ends_there() -> None:
    shape = Pads(200e-3, PLAY, 10e-3, 20e-3, 4)
    edge = math.radians(45.0) - 0.5 * 20.0 / 200.2
    loads = np.array([[1.0, 0.0, 7.0, 0.0, 0.0, 5.0], [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]])
    places = resting(shape, loads)
    # On the edges of one pad, and on the near ones of two.
    assert places[0, 0] == pytest.approx(PLAY / math.cos(0.5 * 20.0 / 200.2), rel=1e-6)
    assert places[1, :2] == pytest.approx(np.full(2, PLAY / math.cos(edge) / math.sqrt(2.0)), rel=1e-6)
    assert places[:, [2, 5]] == pytest.approx(np.zeros((2, 2)))
    reach = np.linalg.norm(shape.room(), axis=1).reshape(4, 3)
    assert reach == pytest.approx(np.tile([PLAY, PLAY, PLAY / math.cos(edge)], (4, 1)))


def test_costs_count_the_nodes_that_pads_have() -> None:
    case = ring(pads=5, towards=0.0, nodes_around=400, nodes_along=6).case()
    kind = MECHANISMS[case.kind()]
    assert kind.workload(case).nodes == math.prod(kind.system(case).problem(case.duration).field_shape)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"pads": 2}, "clearance.pads"),
        ({"pad_width": "400 mm"}, "joints.guide.clearance.pad_width: that of 4 pads leaves no room between"),
        ({"pad_width": None}, "pad_width"),
    ],
)
def test_pads_that_make_no_guide_are_refused(keys: dict[str, object], words: str) -> None:
    with pytest.raises(InputError, match=words):
        td.simulate(
            ring(pads=4, towards=0.0)
            .case()
            .replace({f"joints.guide.clearance.{k}": v for k, v in keys.items()})
        )
