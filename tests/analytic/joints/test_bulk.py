"""Elastic bodies under the asperities: limits, bounds, and mechanisms that stopped without them."""

import dataclasses
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.faults.mechanisms.random_mechanisms import drawn
from tests.faults.mechanisms.test_random_mechanisms import BEYOND, wrong

import tribodyn as td
from tribodyn.contact import RSDC, SurfacePair, lined, tabulate
from tribodyn.contact.bulk import Bulk, elastic_bodies
from tribodyn.contact.damping_factors import rebound
from tribodyn.core.errors import InputError
from tribodyn.core.quantities import Record
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.kernels.joints.surface.joint import report
from tribodyn.kernels.joints.surface.memory import new_memory
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of

#: Random mechanisms that end where their asperities do, as long as these stand on rigid bodies.
STOPPED = (29, 37, 53, 57, 62, 71, 78, 117, 130, 141, 157, 159, 183, 184, 187)
QUICK = (53,)  #: Of which these always run.
WRIST = "joints.wrist.clearance"
SMOOTH = {"trunnion": {"roughness": "0.02 um"}, "bushing": {"roughness": "0.02 um", "hardness": "20 GPa"}}
"""Surfaces whose bodies give way by far more than their asperities."""


def reported(clearance: Clearance, d: tuple[float, float, float]) -> Record:
    data = assemble([clearance])
    memory = new_memory(data)
    report(data, memory, 0, pose_at(d))
    return memory.reports[0]


def test_a_constant_compliance_is_a_liner(make_clearance, table_1_pair):
    rigid = make_clearance("annulus")
    size = rigid.shape.surfaces(rigid.grid)[0].size
    bulk = Bulk(rigid.table, rigid.roughness, table_1_pair.composite_modulus, size)
    stiffness = rigid.roughness / bulk.compliance(size)
    layer = dataclasses.replace(rigid, table=lined(rigid.table, stiffness))
    elastic = dataclasses.replace(rigid, bulk=bulk)
    for gap in (2.0, 0.0, -2.0):
        place = (0.0, 0.0, gap * rigid.roughness - rigid.shape.clearance)
        expected, found = reported(layer, place), reported(elastic, place)
        # The tables of levels are eight times as coarse: an error below 1e-4 of what σ makes.
        assert found["F_cz"] == pytest.approx(expected["F_cz"], rel=1e-6)
        assert found["energy_contact"] == pytest.approx(expected["energy_contact"], rel=1e-6)


def test_a_tilted_pin_does_no_work_around_a_loop(make_clearance, table_1_pair):
    rigid = make_clearance("cylinder", coefficient=0.0)
    bulk = Bulk(rigid.table, rigid.roughness, table_1_pair.composite_modulus, rigid.shape.bore_radius)
    data = assemble([dataclasses.replace(rigid, bulk=bulk)])
    memory, clearance = new_memory(data), rigid.shape.clearance
    corners = clearance * np.array([[0.9, 0.0], [1.5, 0.0], [1.5, 1.0], [0.9, 1.0], [0.9, 0.0]])
    corners[:, 1] /= rigid.shape.length
    path = np.concatenate([np.linspace(a, b, 200, endpoint=False) for a, b in itertools.pairwise(corners)])
    path = np.vstack([path, corners[-1:]])
    forces, stored = np.empty_like(path), np.empty(len(path))
    for k, (off, tilt) in enumerate(path):
        report(data, memory, 0, pose_at([off, 0.0, 0.0], Rotation.from_rotvec([0.0, tilt, 0.0]).as_matrix()))
        found = memory.reports[0]
        forces[k], stored[k] = (found["F_kx"], found["M_ky"]), found["energy_contact"]
    work = 0.5 * np.sum((forces[1:] + forces[:-1]) * np.diff(path, axis=0))
    assert abs(work) < 1e-4 * stored.max()  # what 200 trapezia to a side leave


def test_stiff_bodies_are_rigid_ones(make_clearance: Callable[..., Clearance]) -> None:
    rigid = make_clearance("cylinder")
    stiff = Bulk(rigid.table, rigid.roughness, 1e20, rigid.shape.bore_radius)
    place = (17e-6, 5e-6, 0.0)
    expected = reported(rigid, place)
    found = reported(dataclasses.replace(rigid, bulk=stiff), place)
    for name in ("F_cx", "F_cy", "energy_contact", "p_max"):
        assert found[name] == pytest.approx(expected[name], rel=1e-5)


def test_the_pressure_is_bounded_by_the_hardness(make_clearance, table_1_pair):
    rigid = make_clearance("cylinder")
    bulk = Bulk(rigid.table, rigid.roughness, table_1_pair.composite_modulus, rigid.shape.bore_radius)
    soft = dataclasses.replace(rigid, bulk=bulk, hardness=20e6)
    shares = [reported(soft, (off, 0.0, 0.0))["plastic_share"] for off in (20e-6, 40e-6, 80e-6)]
    assert shares[0] == 0.0
    assert 0.0 < shares[1] < shares[2] < 1.0
    # At most the hardness all over half the bore.
    area = 2.0 * rigid.shape.bore_radius * rigid.shape.length
    assert -reported(soft, (80e-6, 0.0, 0.0))["F_cx"] < 20e6 * area


@pytest.mark.parametrize(
    "seed", [seed if seed in QUICK else pytest.param(seed, marks=pytest.mark.long) for seed in STOPPED]
)
def test_mechanisms_go_on_where_asperities_end(seed: int) -> None:
    found = {}
    for bulk in ("none", "conformal"):
        drawing, _ = drawn(seed)
        for joint in drawing.joints.values():
            if "clearance" in joint:
                joint["clearance"]["bulk"] = bulk
        found[bulk] = td.simulate(drawing.case())
        assert not wrong(drawing, found[bulk])
    assert BEYOND in found["none"].attrs["failure"]
    assert not found["conformal"].attrs["failure"]


def test_energy_of_a_slider_crank_is_accounted_for() -> None:
    case = td.load_case("slider-crank")
    rigid, elastic = (td.simulate(case.replace({f"{WRIST}.bulk": bulk})) for bulk in ("none", "conformal"))
    assert elastic.attrs["energy_residual"] < 1e-4
    assert np.ptp(elastic["energy_expansion"].values) > 0.01 * np.ptp(elastic["energy_stored"].values)
    assert "plastic_share" in elastic
    assert "plastic_share" not in rigid


def test_a_campaign_on_elastic_bodies_wears_off_what_friction_heats() -> None:
    """By Archard's law the volume follows force and way, as heat does, wherever in the bore they are."""
    case = td.load_case("slider-crank").replace({"wear.cycles": 2000, "run.cycles": 1})
    found = []
    for bulk in ("none", "conformal"):
        run = td.simulate(case.replace({f"{WRIST}.bulk": bulk}))
        assert run.attrs["failure"] == ""
        assert run.attrs["wear_cycles_reached"] == 2000.0
        found.append(run.attrs["worn_volume"] / run["energy_friction"].values[-1])
    assert found[1] == pytest.approx(found[0], rel=0.01)


def test_shafts_on_elastic_bodies_vibrate_more_slowly_in_every_mode() -> None:
    case = td.load_case("four-bar", {"run.analysis": "vibrations", "run.positions": 2})
    real = [name for name, joint in case.joints.items() if joint.clearance is not None]
    found = []
    for bulk in ("none", "conformal"):
        run = td.simulate(case.replace({f"joints.{name}.clearance.bulk": bulk for name in real}))
        assert run.attrs["failure"] == ""
        found.append(run["natural_frequency"].values[0])
    assert found[1].size == found[0].size
    assert np.all((0.1 * found[0] < found[1]) & (found[1] < found[0]))


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"bulk": "sleeve"}, "a sleeve needs its thickness"),
        ({"bulk": "conformal", "liner.thickness": "1 mm"}, "makes a sleeve"),
        ({"liner.thickness": "1 mm", "liner.young_modulus": "100 MPa"}, "yields before asperities"),
        ({"bulk": "elastic"}, "conformal"),
    ],
)
def test_wrong_bodies_are_refused(changes: dict[str, str], words: str) -> None:
    keys = {f"{WRIST}.{key}": value for key, value in changes.items()}
    with pytest.raises(InputError, match=words):
        clearances_of(td.load_case("slider-crank").replace(keys))


def test_the_coefficient_follows_the_arc(make_clearance, table_1_pair):
    """Of a larger contact it is larger, by the root of the overlap: Hertz's line contact has K = κ E/a."""
    rigid = make_clearance("cylinder")
    bulk = Bulk(rigid.table, rigid.roughness, table_1_pair.composite_modulus, rigid.shape.bore_radius)
    room, radius = 10e-3, rigid.shape.bore_radius
    near, far = (bulk.of_arc(-gap, room, radius) for gap in (160e-6, 40e-6))
    assert near / far == pytest.approx(2.0, rel=0.02)
    half = radius * math.acos(1.0 - 160e-6 / (room + 160e-6))
    assert near == pytest.approx(bulk.compliance(half), rel=0.04)


def dropped(room: float, kind: str, loss: dict[str, float], contact: dict[str, str]) -> tuple[float, float]:
    """Drop a pin or ball through its clearance [µm] on undamped asperities; return speed and restitution."""
    bushing = SMOOTH["bushing"] | {"young_modulus": "3 GPa"} | loss
    surfaces, run = (
        SMOOTH | {"bushing": bushing},
        {"duration": "30 ms", "start": "centred", "output_interval": "5 us"},
    )
    drawing = td.Mechanism(
        "Drop",
        gravity="0, 0, -9.81 m/s^2",
        run=run,
        surfaces=surfaces,
        contact={"law": "ke"} | contact,
        solver={"rtol": 1e-7},
    )
    drawing.body("pin", mass="0.2 kg", centre="0, 0, 0 mm", inertia="1e-5, 1e-5, 1e-5 kg m^2")
    sizes = {"radius": "10 mm", "radial": f"{room} um", "friction_coefficient": 0.0, "bulk": "conformal"}
    if kind == "cylinder":
        drawing.revolute("bearing", "ground", "pin", point="0, 0, 0 mm", axis=[0, 1, 0])
        drawing.clearance("bearing", **sizes, length="10 mm", axial="1 mm", nodes_around=768, nodes_along=4)
    else:
        drawing.spherical("bearing", "ground", "pin", point="0, 0, 0 mm")
        drawing.clearance("bearing", **sizes, nodes_around=384, nodes_along=64)
    result = td.simulate(drawing.case())
    assert not result.attrs["failure"]
    assert result.attrs["energy_residual"] < 1e-3
    velocity = result["velocity"].sel(body="pin").values[:, 2]
    first = int(velocity.argmin())
    return -velocity[first], velocity[first:].max() / -velocity[first]


@pytest.mark.parametrize(("kind", "within"), [("cylinder", 0.02), ("sphere", 0.15)])
@pytest.mark.parametrize("room", [100.0, 1000.0])
def test_bodies_with_a_loss_factor_return_the_same_at_any_speed(kind, within, room):
    _, restitution = dropped(room, kind, {"loss_factor": 0.1}, {})
    # Nodes of a sphere begin to touch at various speeds.
    assert 1.0 - restitution == pytest.approx(1.0 - math.exp(-0.05 * math.pi), rel=within)


@pytest.mark.parametrize("room", [10.0, 100.0, 1000.0])
def test_bodies_with_a_loss_in_proportion_to_the_speed_return_less_of_a_fast_impact(room: float) -> None:
    speed, restitution = dropped(room, "cylinder", {}, {"loss_coefficient": "0.3 s/m"})
    # Of its own a - ln(1 + a) = -x - ln(1 - x) with a = 1.5 alpha v, x = a e.
    expected = rebound(np.array([0.45 * speed]))[0]
    assert 1.0 - restitution == pytest.approx(1.0 - expected, rel=0.05)


def test_damping_never_drives(table_1_pair: SurfacePair) -> None:
    pair = dataclasses.replace(table_1_pair, loss_factor=(0.01, 0.2))
    law = RSDC(pair, "lankarani-nikravesh")
    found = elastic_bodies(tabulate(law), law, 6e-3)
    lossless = dataclasses.replace(found, loss=0.0)
    for table, without in zip(found.levels, lossless.levels, strict=True):
        assert np.all(table.nodes[:, 2] >= without.nodes[:, 2])
    # The softer body has most of the compliance, and of the loss.
    assert 0.19 < pair.composite_loss < 0.2
    assert "return all of it" in " ".join(
        td.load_case("vsv").replace({"joint.bulk": "conformal"}).remarks().notes
    )


def test_joints_of_one_pair_share_their_levels(table_1_pair: SurfacePair) -> None:
    law = RSDC(table_1_pair, "lankarani-nikravesh")
    table = tabulate(law)
    small, large = (elastic_bodies(table, law, size).levels for size in (5e-3, 7e-3))
    assert small is large
