"""Elastic bodies under the asperities: limits, bounds, and mechanisms that stopped without them."""

import dataclasses
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from tests.faults.random_mechanisms import drawn
from tests.faults.test_random_mechanisms import BEYOND, wrong

import tribodyn as td
from tribodyn.contact import SurfacePair, lined
from tribodyn.contact.bulk import Bulk
from tribodyn.core.errors import InputError
from tribodyn.core.quantities import Record
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.kernels.joints.surface.joint import report
from tribodyn.kernels.joints.surface.memory import new_memory
from tribodyn.mechanism.assembly.clearance_surfaces import clearances_of

#: Random mechanisms that end where their asperities do, as long as these stand on rigid bodies.
STOPPED = (29, 37, 53, 57, 62, 71, 78, 117, 130, 141, 157, 159, 183, 184, 187)
FEW = 3  #: Of which so many always run.
WRIST = "joints.wrist.clearance"


def reported(clearance: Clearance, d: tuple[float, float, float]) -> Record:
    data = assemble([clearance])
    memory = new_memory(data)
    report(data, memory, 0, pose_at(d))
    return memory.reports[0]


def test_a_constant_compliance_is_a_liner(
    make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair
) -> None:
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


def test_a_tilted_pin_does_no_work_around_a_loop(
    make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair
) -> None:
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


def test_the_pressure_is_bounded_by_the_hardness(
    make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair
) -> None:
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
    "seed", [*STOPPED[:FEW], *(pytest.param(seed, marks=pytest.mark.long) for seed in STOPPED[FEW:])]
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


def test_the_coefficient_follows_the_arc(
    make_clearance: Callable[..., Clearance], table_1_pair: SurfacePair
) -> None:
    """Of a larger contact it is larger, by the root of the overlap: Hertz's line contact has K = κ E/a."""
    rigid = make_clearance("cylinder")
    bulk = Bulk(rigid.table, rigid.roughness, table_1_pair.composite_modulus, rigid.shape.bore_radius)
    room, radius = 10e-3, rigid.shape.bore_radius
    near, far = (bulk.of_arc(-gap, room, radius) for gap in (160e-6, 40e-6))
    assert near / far == pytest.approx(2.0, rel=0.02)
    half = radius * math.acos(1.0 - 160e-6 / (room + 160e-6))
    assert near == pytest.approx(bulk.compliance(half), rel=0.04)
