"""Rings are summed up four nodes at a time, and give what their nodes give one by one.

The nodes of a surface of revolution are put into a patch, which kernels look at as a whole, node by node.
"""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mebdf.arrays import FloatArray
from tribodyn.core.quantities import Record
from tribodyn.joints.clearances import Clearance, assemble, pose_at
from tribodyn.kernels.joints.surface.data import AREA, NORMAL, POSITION, SurfaceData
from tribodyn.kernels.joints.surface.joint import (
    pressure_field,
    report,
    slide,
    update_entry_velocity,
    wrench,
    wrench_and_jacobian,
)
from tribodyn.kernels.joints.surface.memory import SurfaceMemory, new_memory

MakeClearance = Callable[..., Clearance]
SHAPES = ("cylinder", "wide", "piston", "flanged", "annulus", "sphere", "ball")
#: Whole groups of four nodes, and not; rings fill blocks of four, and do not.
GRIDS = ((24, 5), (26, 6), (5, 2))
POSES = 50
CLOSE = 1e-12  #: Of the largest entry.


def one_by_one(rings: SurfaceData) -> SurfaceData:
    """Return the same nodes in rows that are no rings and always within reach."""
    rows = rings.rows.copy()
    rows["whole"], rows["least"] = 1.0, -np.inf
    return rings._replace(rows=rows)


def draw(random: np.random.Generator) -> Record:
    """Return a pose from no contact over a small arc to contact all around, upright or tilted."""
    across, turn = random.choice([3e-6, 18e-6, 22e-6, 28e-6]), random.choice([0.0, 5e-4, 3e-3])
    return pose_at(
        d=[*random.uniform(-across, across, 2), random.uniform(-25e-6, 25e-6)],
        rotation=Rotation.from_rotvec(random.uniform(-turn, turn, 3)).as_matrix(),
        v=random.uniform(-1e-2, 1e-2, 3),
        w=random.uniform(-1.0, 1.0, 3),
    )


def close(found: FloatArray, expected: FloatArray) -> None:
    """Check entries against the largest one."""
    np.testing.assert_allclose(found, expected, rtol=0, atol=CLOSE * np.abs(expected).max())


def check_reports(found: SurfaceMemory, expected: SurfaceMemory, force: float, moment: float) -> None:
    """Check all numbers of the reports; separations out of reach are told in another way."""
    for s, other in enumerate(expected.reports):
        own = found.reports[s]
        for first in ("F_c", "M_c", "F_k", "M_k", "F_f", "M_f"):
            names = [first + axis for axis in "xyz"]
            np.testing.assert_allclose(
                [own[name] for name in names],
                [other[name] for name in names],
                rtol=0,
                atol=CLOSE * (force if first[0] == "F" else moment),
            )
        for name in ("damping_power", "friction_power", "energy_contact", "p_max"):
            assert own[name] == pytest.approx(other[name], rel=1e-9, abs=CLOSE * force)
        for name in ("tensile_clip_share", "contact_fraction"):
            assert own[name] == pytest.approx(other[name], rel=1e-12)
        if other["contact_fraction"] > 0.0:
            assert own["separation_min"] == pytest.approx(other["separation_min"], rel=1e-9, abs=1e-15)


@pytest.mark.parametrize("grid", [GRIDS[0], pytest.param(GRIDS[1], marks=pytest.mark.long), GRIDS[2]])
@pytest.mark.parametrize("shape", SHAPES)
def test_rings_give_what_their_nodes_give(make_clearance, shape, grid):
    rings = assemble([make_clearance(shape, grid=grid)])
    rings.surfaces["lean"] = 0.0  # patches know no second order
    nodes, random = one_by_one(rings), np.random.default_rng(len(shape) + sum(grid))
    touched = 0
    for number in range(POSES):
        memories = new_memory(rings), new_memory(nodes)
        forces, slopes = np.empty((2, 2, 6)), np.empty((2, 6, 12))
        fields, pose = np.zeros((2, rings.nodes.shape[1])), draw(random)
        entry = random.choice([0.0, 1e-3, 3e-3], rings.nodes.shape[1]) * random.integers(0, 2)
        for k, (data, memory) in enumerate(zip((rings, nodes), memories, strict=True)):
            memory.entry_velocity[:], memory.remembering[:] = entry, 1.0
            wrench(data, memory, 0, pose, forces[k, 0])
            wrench_and_jacobian(data, memory, 0, pose, forces[k, 1], slopes[k])
            pressure_field(data, memory, 0, pose, fields[k])
            report(data, memory, 0, pose)
            slide(data, memory, 0, 1.0)
            update_entry_velocity(data, memory, 0, pose, float(number % 2))
        for part in (slice(0, 3), slice(3, 6)):
            close(forces[0, :, part], forces[1, :, part])
            for column in range(0, 12, 3):
                close(slopes[0, part, column : column + 3], slopes[1, part, column : column + 3])
        close(fields[0], fields[1])
        entries = [memory.entry_velocity for memory in memories]
        np.testing.assert_allclose(*entries, rtol=1e-9, atol=1e-15)
        close(memories[0].sliding_load, memories[1].sliding_load)
        rigid = max(np.abs(memories[1].reports[f"F_k{axis}"]).max() for axis in "xyz")
        load = float(fields[1] @ rings.nodes[AREA] + rigid)
        check_reports(*memories, load, load * np.abs(rings.nodes[POSITION:NORMAL]).max())
        touched += bool(np.any(fields[1] > 0.0))
    assert 5 <= touched < POSES


@pytest.mark.parametrize("kind", ["friction_coefficient", "tensile_clip"])
def test_derivatives_without_friction_and_with_tension(make_clearance: MakeClearance, kind: str) -> None:
    rings, random = assemble([make_clearance("cylinder", grid=(26, 6))]), np.random.default_rng(5)
    rings.surfaces[kind] = rings.surfaces["lean"] = 0.0
    nodes = one_by_one(rings)
    for _ in range(POSES):
        forces, slopes, pose = np.empty((2, 6)), np.empty((2, 6, 12)), draw(random)
        entry = random.choice([0.0, 1e-3, 3e-3], rings.nodes.shape[1])
        for k, data in enumerate((rings, nodes)):
            memory = new_memory(data)
            memory.entry_velocity[:] = entry
            wrench_and_jacobian(data, memory, 0, pose, forces[k], slopes[k])
        for part in (slice(0, 3), slice(3, 6)):
            close(forces[0, part], forces[1, part])
            for column in range(0, 12, 3):
                close(slopes[0, part, column : column + 3], slopes[1, part, column : column + 3])


def test_a_pose_that_is_no_number_gives_none(make_clearance: MakeClearance) -> None:
    rings = assemble([make_clearance("flanged", grid=(26, 6))])
    for wrong in (np.nan, np.inf, -np.inf, 1e300):
        out = np.empty(6)
        for d in ([wrong, 0.0, 0.0], [0.0, 0.0, wrong], [wrong, wrong, wrong]):
            wrench(rings, new_memory(rings), 0, pose_at(d=d), out)
            assert wrong == 1e300 or not np.all(np.isfinite(out)) or not out.any()
