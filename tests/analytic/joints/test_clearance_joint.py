"""Clearance joints of every shape: derivatives, power, third law, and the cylinder as the bushing."""

import dataclasses
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mebdf.arrays import FloatArray
from tribodyn.contact import SurfacePair, law
from tribodyn.contact.bulk import Bulk
from tribodyn.core.quantities import Record
from tribodyn.joints.bushing import joint_wrench
from tribodyn.joints.bushing import new_memory as bushing_memory
from tribodyn.joints.bushing import pose_at as bushing_pose
from tribodyn.joints.clearances import Clearance, assemble, contact_table, places, pose_at
from tribodyn.joints.point_contact import point_table
from tribodyn.kernels.joints.bushing import pressure_field as bushing_field
from tribodyn.kernels.joints.surface.data import SurfaceData
from tribodyn.kernels.joints.surface.joint import pressure_field, report, wrench, wrench_and_jacobian
from tribodyn.kernels.joints.surface.memory import SurfaceMemory, new_memory

MakeClearance = Callable[..., Clearance]
POINT = "point-lankarani-nikravesh"
GUIDES = ("guide", "block", "dovetail")
SHAPES = ("cylinder", "wide", "piston", "flanged", "annulus", "sphere", "ball", "mesh", *GUIDES, "slot")
POINTS = ("cylinder at points", "sphere at a point")
ELASTIC = tuple(f"elastic {shape}" for shape in SHAPES)
KINDS = (*SHAPES, *POINTS, *ELASTIC)

BALLS = ("sphere", "ball", "sphere at a point")
STENCIL = np.arange(-3.0, 4.0)
WEIGHTS = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / 60.0
#: A hundred-thousandth of what changes pressure by about e, and of v_min.
STEP = np.repeat([1.6e-11, 1.6e-9, 1e-7, 1e-5], 3)


@pytest.fixture(scope="module")
def kinds(make_clearance: MakeClearance, table_1_pair: SurfacePair) -> dict[str, Clearance]:
    """One clearance of each kind, on a coarse grid: identities hold for any.

    Rings are summed up four nodes at a time, and 26 are no multiple of four.
    """
    made = {kind: make_clearance(kind, grid=(26, 6)) for kind in SHAPES}
    for kind in ("wide", "piston"):  # whose surface speeds are larger with their radius
        made[kind] = make_clearance(kind, grid=(26, 6), slip_velocity=3e-4)
    chosen = law("rsdc", table_1_pair)
    for kind in POINTS:
        shape = kind.split(maxsplit=1)[0]
        table = contact_table(POINT, chosen, made[shape].shape, onset=4.0, smoothing_width=1.0)
        made[kind] = make_clearance(shape, contact=POINT, table=table, grid=(26, 6))
    for kind, shape in zip(ELASTIC, SHAPES, strict=True):
        rigid = made[shape]
        size = max(surface.size for surface in rigid.shape.surfaces(rigid.grid))
        bulk = Bulk(rigid.table, rigid.roughness, table_1_pair.composite_modulus, size)
        made[kind] = dataclasses.replace(rigid, bulk=bulk, hardness=table_1_pair.hardness)
    return made


def tilted(phi_x: float, phi_y: float, spin: float = 0.0) -> FloatArray:
    """Return the rotation of a journal whose axis leans by tan φ_y along X and −tan φ_x along Y."""
    axis = np.array([math.tan(phi_y), -math.tan(phi_x), 1.0])
    axis /= np.linalg.norm(axis)
    across = np.array([1.0, 0.0, 0.0]) - axis[0] * axis
    across /= np.linalg.norm(across)
    upright = np.column_stack([across, np.cross(axis, across), axis])
    return upright @ Rotation.from_rotvec([0.0, 0.0, spin]).as_matrix()


def draw(kind: str, seed: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Return displacement, rotation, velocity and angular velocity of a journal in contact."""
    random, elastic = np.random.default_rng(seed), kind in ELASTIC
    kind = kind.removeprefix("elastic ")
    direction = random.normal(size=3) * [1.0, 1.0, 0.2]
    d = direction / np.linalg.norm(direction) * (24e-6 if "point" in kind or elastic else 19e-6)
    if kind in ("annulus", "flanged"):
        d[2] = -16e-6 if kind == "annulus" else -12e-6
    # A ball has no tilt, a square journal is held in its tube.
    lean = random.uniform(-1.0, 1.0, 2) * (0.5 if kind in BALLS else 1e-3)
    rotation = tilted(*lean, spin=1e-3 if kind in ("mesh", *GUIDES) else 1.0)
    if kind == "slot":  # whose pin turns about x, and leans along the slot
        rotation = Rotation.from_euler("ZYX", [3e-4 * np.sign(lean[0]), 0.3, 2.0]).as_matrix()
        d = np.array([1e-3, 19e-6 * np.sign(d[1]), 5e-3 * random.normal()])
    if "cylinder" in kind or kind in ("wide", "guide"):  # which may have slid along their axis
        d += 5e-3 * random.normal() * rotation[:, 2] / rotation[2, 2]
    if kind == "ball":
        d[2] = 5e-3 * random.normal()
    slow = 1e-3 if seed % 2 else 1.0  # slip of the order of the slip velocity
    return d, rotation, slow * 2e-3 * random.normal(size=3), slow * 0.3 * random.normal(size=3)


def remembering(data: SurfaceData) -> SurfaceMemory:
    """Return a memory with entry velocities everywhere: without one there is a kink at v_min."""
    memory = new_memory(data)
    choice = np.random.default_rng(5).choice([1e-3, 3e-3], size=memory.entry_velocity.size)
    memory.entry_velocity[:] = choice
    return memory


def moved(d: FloatArray, rotation: FloatArray, v: FloatArray, w: FloatArray, k: int, step: float) -> Record:
    """Return the pose with one of displacement, turning, velocity and angular velocity changed."""
    change = step * np.eye(12)[k]
    turned = Rotation.from_rotvec(change[3:6]).as_matrix() @ rotation
    return pose_at(d + change[:3], turned, v + change[6:9], w + change[9:])


@pytest.mark.parametrize("kind", KINDS)
def test_derivatives_against_differences(kind: str, kinds: dict[str, Clearance]) -> None:
    data = assemble([kinds[kind]])
    memory, out, jacobian = remembering(data), np.empty(6), np.empty((6, 12))

    def at(pose: Record) -> FloatArray:
        wrench(data, memory, 0, pose, out)
        return out.copy()

    for seed in range(10):
        state = draw(kind, seed)
        wrench_and_jacobian(data, memory, 0, pose_at(*state), out, jacobian)
        both = out.copy()
        np.testing.assert_allclose(both, at(pose_at(*state)), rtol=0.0, atol=1e-12 * np.abs(both).max())
        expected = np.column_stack(
            [WEIGHTS @ [at(moved(*state, k, m * STEP[k])) for m in STENCIL] / STEP[k] for k in range(12)]
        )
        largest = np.abs(expected * STEP).max(axis=1)
        assert largest.max() > 0.0
        # The relative size of rounding in a difference over 1e-5 of what makes e of a pressure; 1e-9 is seen.
        assert (np.abs(jacobian - expected) * STEP <= 1e-8 * np.maximum(largest, 1e-12)[:, None]).all(), seed


@pytest.mark.parametrize("kind", KINDS)
def test_power_is_heat_and_stored_energy(kind: str, kinds: dict[str, Clearance]) -> None:
    data = assemble([kinds[kind]])
    memory, out = remembering(data), np.empty(6)
    for seed in range(10):
        d, rotation, v, w = draw(kind, seed)
        pose = pose_at(d, rotation, v, w)
        wrench(data, memory, 0, pose, out)
        report(data, memory, 0, pose)
        heat = memory.reports["damping_power"].sum()
        friction, widening = memory.reports["friction_power"].sum(), memory.reports["expansion_power"].sum()
        assert heat >= 0.0
        assert friction < 0.0
        step = 2e-11 / max(np.abs(v).max(), 1e-2 * np.abs(w).max())  # as the differences above
        energies = []
        for m in STENCIL:
            turned = Rotation.from_rotvec(m * step * w).as_matrix() @ rotation
            report(data, memory, 0, pose_at(d + m * step * v, turned, v, w))
            energies.append(memory.reports["energy_contact"].sum())
        stored = WEIGHTS @ energies / step - widening
        terms = np.array([*out * np.concatenate([v, w]), heat, friction, stored])
        power = out[:3] @ v + out[3:] @ w
        # Rounding of the differences, as for the bushing.
        assert power + heat - friction + terms[-1] == pytest.approx(0.0, abs=1e-8 * np.abs(terms).max())


@pytest.mark.parametrize("kind", KINDS)
def test_the_report_adds_up_to_the_wrench(kind: str, kinds: dict[str, Clearance]) -> None:
    data = assemble([kinds[kind]])
    memory, out = remembering(data), np.empty(6)
    for seed in range(6):
        pose = pose_at(*draw(kind, seed))
        wrench(data, memory, 0, pose, out)
        report(data, memory, 0, pose)
        parts = (
            ("F_cx", "F_cy", "F_cz", "M_cx", "M_cy", "M_cz"),
            ("F_fx", "F_fy", "F_fz", "M_fx", "M_fy", "M_fz"),
        )
        total = sum(np.array([memory.reports[name].sum() for name in names]) for names in parts)
        np.testing.assert_allclose(total, out, rtol=0.0, atol=1e-13 * np.abs(out).max())


def frictionless(kind: str, kinds: dict[str, Clearance], make_clearance: MakeClearance) -> SurfaceData:
    """Return the data of a joint of a kind that has no friction."""
    known = {"contact": kinds[kind].contact, "table": kinds[kind].table}
    return assemble([make_clearance(kind.split(maxsplit=1)[0], coefficient=0.0, grid=(24, 6), **known)])


@pytest.mark.parametrize(
    "kind", ["cylinder", "wide", "piston", "flanged", "annulus", "sphere", "ball", "cylinder at points"]
)
def test_a_journal_of_revolution_spins_freely_without_friction(kind, kinds, make_clearance):
    # Tilted and pressed, it may have no moment about its own axis: spinning changes no gap. With the angular
    # velocity instead of the rate of the tilt in the approach speeds it would have one, of first order in it.
    data = frictionless(kind, kinds, make_clearance)
    memory, out, still = remembering(data), np.empty(6), np.empty(6)
    for seed in range(6):
        d, rotation, v, _ = draw(kind, seed)
        axis = rotation[:, 2]
        wrench(data, memory, 0, pose_at(d, rotation, v), still)
        wrench(data, memory, 0, pose_at(d, rotation, v, 40.0 * axis), out)
        assert np.abs(still).max() > 0.0
        # Rounding of φ̇: 40 rad/s over the entry velocity of 1e-3 m/s, with arms of 1e-2 m.
        np.testing.assert_allclose(out, still, rtol=0.0, atol=1e-10 * np.abs(still).max())
        assert out[3:] @ axis == pytest.approx(0.0, abs=1e-14 * np.abs(out).max())


@pytest.mark.parametrize(
    "kind", ["cylinder", "wide", "piston", "ball", *GUIDES, "slot", "cylinder at points"]
)
def test_what_slides_is_free_to(kind, kinds, make_clearance):
    # However far along its axis, a shaft has the same gaps: no force on it along its axis, and the same
    # forces on the socket. A ball and a piston slide along the bore.
    data = frictionless(kind, kinds, make_clearance)
    memory, out, far = remembering(data), np.empty(6), np.empty(6)
    for seed in range(6):
        d, rotation, v, w = draw(kind, seed)
        with_the_pin = kind in ("ball", "piston", "block", "dovetail", "slot")
        along = np.array([0.0, 0.0, 1.0]) if with_the_pin else rotation[:, 2] / rotation[2, 2]
        slid = d + 30e-3 * along
        wrench(data, memory, 0, pose_at(d, rotation, v, w), out)
        v_there = v if with_the_pin else v + np.cross(w, slid - d)
        wrench(data, memory, 0, pose_at(slid, rotation, v_there, w), far)
        size = np.abs(out).max()
        assert size > 0.0
        assert out[:3] @ along == pytest.approx(0.0, abs=1e-13 * size)
        if with_the_pin:
            np.testing.assert_allclose(far, out, rtol=0.0, atol=1e-12 * size)
        else:
            on_socket = [f[3:] + np.cross(place, f[:3]) for f, place in ((out, d), (far, slid))]
            # Positions of 30 mm and gaps of a micrometre: rounding is 1e-11 of σ.
            np.testing.assert_allclose(far[:3], out[:3], rtol=0.0, atol=1e-9 * size)
            np.testing.assert_allclose(on_socket[1], on_socket[0], rtol=0.0, atol=1e-9 * size)


BUSHING_GRID = (48, 8)


@pytest.mark.parametrize("radius", [6e-3, 200e-3])
@pytest.mark.parametrize("worn", [False, True])
@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_a_cylinder_is_the_bushing(friction, worn, radius, make_joint, make_clearance):
    # The bushing names the point at −(cos θ, sin θ) θ, so its nodes are half a turn on; its φ_y and M_y are
    # left-handed, its moments those that work on tilts. It slides around the axis only: with friction the
    # journal stands upright.
    n = BUSHING_GRID[0]
    bushing = make_joint(coefficient=friction, grid=BUSHING_GRID)
    bushing = dataclasses.replace(bushing, geometry=dataclasses.replace(bushing.geometry, radius=radius))
    random = np.random.default_rng(3)
    wear = 2e-6 * random.random(bushing.field_shape) if worn else np.zeros(bushing.field_shape)
    data = assemble(
        [make_clearance("cylinder", coefficient=friction, grid=BUSHING_GRID, radius=radius)],
        np.roll(wear, n // 2, axis=1).ravel(),
    )
    old = bushing.data(wear)
    memory, out = new_memory(data), np.empty(6)
    scratch = memory.scratch
    for _ in range(20):
        tilt = random.uniform(-1.0, 1.0, 2) * (0.0 if friction else 1.2e-3)
        reach = 20e-6 - random.uniform(-1.0, 4.0) * bushing.roughness - 0.01 * np.hypot(*tilt)
        angle, v = random.uniform(0.0, 2.0 * np.pi), 3e-3 * random.normal(size=2)
        entry = random.choice([0.0, 1e-3, 3e-3], size=wear.shape)
        memory.entry_velocity[:] = np.roll(entry, n // 2, axis=1).ravel()
        y = np.array([reach * np.cos(angle), reach * np.sin(angle), *tilt, *v, 0.0, 0.0])
        rotation = tilted(tilt[0], -tilt[1])
        pose = pose_at([*y[:2], 0.0], rotation, [*v, 0.0], 0.3 * rotation[:, 2])
        wrench(data, memory, 0, pose, out)
        expected = joint_wrench(old, y, omega=0.3, entry_velocity=entry)
        found = scratch.normal + scratch.friction
        order = found[[0, 1, 3, 4, 5]] * [1, 1, 1, -1, 1]
        np.testing.assert_allclose(order, expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())
        pressures, before = np.empty(memory.entry_velocity.size), np.empty(wear.shape)
        pressure_field(data, memory, 0, pose, pressures)
        bushing_field(old, bushing_memory(old, entry), bushing_pose(y, omega=0.3), before)
        turned = np.roll(pressures.reshape(wear.shape), -(n // 2), axis=1)
        np.testing.assert_allclose(turned, before, rtol=0.0, atol=1e-12 * before.max())


def test_ends_at_points_are_those_of_the_bushing(make_joint, make_clearance, table_1_pair):
    bushing = make_joint()
    table = point_table(POINT, law("rsdc", table_1_pair), bushing.geometry)
    old = dataclasses.replace(bushing, contact=POINT, table=table).data()
    data = assemble([make_clearance("cylinder", contact=POINT, table=table)])
    memory, out = new_memory(data), np.empty(6)
    y = np.array([18e-6, 14e-6, 0.0, 0.0, 2e-3, -1e-3, 0.0, 0.0])
    wrench(data, memory, 0, pose_at([*y[:2], 0.0], None, [2e-3, -1e-3, 0.0], [0.0, 0.0, 0.3]), out)
    expected = joint_wrench(old, y, omega=0.3)
    np.testing.assert_allclose(out[[0, 1, 3, 4, 5]], expected, rtol=0.0, atol=1e-12 * np.abs(expected).max())


def test_joints_of_a_mechanism_do_not_disturb_each_other(kinds: dict[str, Clearance]) -> None:
    together, out, alone = assemble(list(kinds.values())), np.empty(6), np.empty(6)
    memory = new_memory(together)
    for j, (kind, clearance) in enumerate(kinds.items()):
        single = assemble([clearance])
        pose = pose_at(*draw(kind, 3))
        wrench(together, memory, j, pose, out)
        wrench(single, new_memory(single), 0, pose, alone)
        assert np.array_equal(out, alone)
    assert places(list(kinds.values()))[-1].nodes.stop == memory.entry_velocity.size


@pytest.mark.parametrize("kind", SHAPES)
def test_no_node_in_reach_is_left_out(kind: str, kinds: dict[str, Clearance]) -> None:
    # The field looks at every node, the report at those inside the windows.
    random = np.random.default_rng(1)
    where = places([kinds[kind]])
    data = assemble([kinds[kind]], 3e-6 * random.random(where[-1].nodes.stop))
    memory = remembering(data)
    pressures = np.empty(memory.entry_velocity.size)
    for seed in range(30):
        d, rotation, v, w = draw(kind, seed)
        pose = pose_at(d * random.uniform(0.3, 1.2), rotation, v, w)
        pressure_field(data, memory, 0, pose, pressures)
        report(data, memory, 0, pose)
        for place, told in zip(where, memory.reports, strict=True):
            peak = pressures[place.nodes].max()
            # The same sum in another order: 1e-12 of the gap is 1e-11 of a pressure.
            assert told.p_max == pytest.approx(peak, rel=1e-9)
