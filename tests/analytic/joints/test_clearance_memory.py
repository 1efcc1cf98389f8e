"""What clearance joints remember: entry velocities, sliding loads and with them wear, peaks."""

import math
from collections.abc import Callable

import numpy as np
import pytest

from tribodyn.joints.clearances import Clearance, assemble, places, pose_at
from tribodyn.kernels.joints.surface.joint import pressure_field, report, slide, update_entry_velocity
from tribodyn.kernels.joints.surface.memory import new_memory, note_peaks
from tribodyn.wear import Archard

MakeClearance = Callable[..., Clearance]
V_MIN = 1e-3


@pytest.mark.parametrize(
    "shape", ["cylinder", "flanged", "annulus", "sphere", "mesh", "block", "dovetail", "slot"]
)
def test_entry_velocities_of_all_nodes(shape: str, make_clearance: MakeClearance) -> None:
    # A shaft that wanders in and out of contact, against the rules told node by node, with no windows.
    where = places([make_clearance(shape)])
    random = np.random.default_rng(6)
    wear = 2e-6 * random.random(where[-1].nodes.stop)
    data = assemble([make_clearance(shape)], wear)
    memory, expected = new_memory(data), np.zeros(wear.size)
    onset, entered, left = 4.0 * data.surfaces[0]["roughness"], 0, 0
    n = data.nodes[3:6].T
    for step in range(60):
        angle = 0.4 * step
        d = (19e-6 + 6e-6 * math.sin(1.3 * step)) * np.array(
            [math.cos(angle), math.sin(angle), 0.8 * math.sin(step)]
        )
        v = 3e-3 * random.normal(size=3)
        update_entry_velocity(data, memory, 0, pose_at(d, None, v), 1.0 if step == 0 else 0.0)
        touching = data.nodes[7] - n @ d < onset
        approach = np.zeros(wear.size) if step == 0 else np.abs(n @ v)
        fresh = np.where(expected > 0.0, expected, np.maximum(approach, V_MIN))
        entered += np.count_nonzero(touching & (expected == 0.0))
        left += np.count_nonzero(~touching & (expected > 0.0))
        expected = np.where(touching, fresh, 0.0)
        # Rounding of a sum of three products.
        np.testing.assert_allclose(memory.entry_velocity, expected, rtol=1e-12, atol=0.0)
    assert entered > 50
    assert left > 50


def test_depth_of_a_turning_pin(make_clearance: MakeClearance) -> None:
    # Archard: dh/dt = k P |s| at every node, s = ω r; edges included, which carry no area but wear.
    data = assemble([make_clearance("cylinder"), make_clearance("annulus")])
    memory, speed, law = new_memory(data), 2.0, Archard(1.1e-15)
    pose = pose_at([19e-6, 0.0, 0.0], None, (0.0, 0.0, 0.0), (0.0, 0.0, speed))
    report(data, memory, 0, pose)
    for _ in range(10):
        slide(data, memory, 0, 0.5)
        report(data, memory, 0, pose)
        slide(data, memory, 0, 0.5)
    pressures = np.zeros(data.nodes.shape[1])
    pressure_field(data, memory, 0, pose, pressures)
    depth = law.depth(memory.sliding_load)
    # Twenty sums of equal terms.
    np.testing.assert_allclose(depth, 1.1e-15 * pressures * speed * 6e-3 * 10.0, rtol=1e-12)
    assert np.count_nonzero(depth) > 20
    barrel, ring = places([make_clearance("cylinder"), make_clearance("annulus")])
    assert not depth[ring.nodes].any()  # of another joint
    assert depth[barrel.nodes].reshape(barrel.surface.field_shape)[[0, -1]].max() > 0.0


def test_a_collar_wears_with_its_radius(make_clearance: MakeClearance) -> None:
    data = assemble([make_clearance("annulus")])
    (place,) = places([make_clearance("annulus")])
    memory = new_memory(data)
    report(data, memory, 0, pose_at([0.0, 0.0, -16e-6], None, (0.0, 0.0, 0.0), (0.0, 0.0, 3.0)))
    slide(data, memory, 0, 1.0)
    load = memory.sliding_load.reshape(place.surface.field_shape)
    rho = place.surface.axes["rho"]
    # Flat, so that pressure is the same everywhere.
    np.testing.assert_allclose(load, np.outer(rho, np.full(load.shape[1], load[0, 0] / rho[0])), rtol=1e-12)


def test_worn_nodes_carry_less(make_clearance: MakeClearance) -> None:
    new = assemble([make_clearance("cylinder")])
    worn = assemble([make_clearance("cylinder")], np.full(new.nodes.shape[1], 1e-6))
    pose = pose_at([19e-6, 0.0, 0.0])
    deeper = pose_at([20e-6, 0.0, 0.0])
    before, after = np.zeros(new.nodes.shape[1]), np.zeros(new.nodes.shape[1])
    pressure_field(new, new_memory(new), 0, pose, before)
    pressure_field(worn, new_memory(worn), 0, deeper, after)
    middle = before.argmax()
    # A micrometre worn and a micrometre deeper: the same gap where they meet, to rounding of the sum.
    assert after[middle] == pytest.approx(before[middle], rel=1e-9)
    pressure_field(worn, new_memory(worn), 0, pose, after)
    assert after.max() < 0.5 * before.max()


def test_peaks(make_clearance: MakeClearance) -> None:
    data = assemble([make_clearance("cylinder"), make_clearance("sphere")])
    memory = new_memory(data)
    for t, reach in enumerate((10e-6, 19e-6, 15e-6)):
        report(data, memory, 0, pose_at([reach, 0.0, 0.0]))
        note_peaks(data, memory, 0, float(t), 1.0)
    peaks = memory.peaks[0]
    assert peaks["contact_force_peak_time"] == peaks["pressure_peak_time"] == 1.0
    assert peaks["contact_force_peak"] > 100.0
    assert peaks["separation_least"] == pytest.approx(1e-6, rel=1e-9)
    assert memory.peaks[1]["contact_force_peak"] == 0.0
    # Out of reach the gap is told all the same.
    report(data, memory, 0, pose_at([2e-6, 0.0, 0.0]))
    assert memory.reports[0]["separation_min"] == pytest.approx(18e-6, rel=1e-12)
