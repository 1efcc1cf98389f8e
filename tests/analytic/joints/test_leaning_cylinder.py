"""A leaning pin in its bore against exact geometry: rays from one surface to the other.

Where the pin is longer than the bore, a ray leaves each point of the bore along its radius and meets the
displaced and tilted pin; where it is shorter, each point of the tilted pin looks for the bore.
"""

import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import brentq

from mebdf.arrays import FloatArray
from tribodyn.joints.clearances import Clearance, assemble, places, pose_at
from tribodyn.kernels.film.data import CONVERGED, OUT_OF_RANGE
from tribodyn.kernels.film.wrench import film_wrench
from tribodyn.kernels.joints.surface.joint import report, wrench
from tribodyn.kernels.joints.surface.memory import new_memory
from tribodyn.kernels.lookup import pressure_and_damping
from tribodyn.lubrication import Film, FilmGrid

MakeClearance = Callable[..., Clearance]
GRID = (96, 8)
#: Radius, length, radial clearance [m].
SIZES = list(itertools.product((6e-3, 60e-3, 380e-3), (10e-3, 40e-3), (20e-6, 40e-6)))
GUIDE = {"radius": 380e-3, "length": 10e-3}  #: The guide of the built-in case vsv-joints.


def upright(lean: FloatArray) -> FloatArray:
    """Return the rotation about a line across the axis that makes a pin lean by a vector (2,) of tangents."""
    x, y, z = np.array([*lean, 1.0]) / math.hypot(*lean, 1.0)
    cross = np.array([[0.0, 0.0, x], [0.0, 0.0, y], [-x, -y, 0.0]])
    return np.asarray(np.eye(3) + cross + cross @ cross / (1.0 + z))


def from_the_bore(
    bore: FloatArray, inwards: FloatArray, d: FloatArray, rotation: FloatArray, radius: float
) -> tuple[FloatArray, FloatArray]:
    """Return the way of rays from points of the bore (n, 3) to the pin, and the pin's normals there."""
    axis = rotation[:, 2]

    def across(vectors: FloatArray) -> FloatArray:
        return vectors - np.outer(vectors @ axis, axis)

    start, way = across(bore - d), across(inwards)
    a, b = np.sum(way * way, axis=1), np.sum(start * way, axis=1)
    c = np.sum(start * start, axis=1) - radius**2
    length = c / (-b + np.sqrt(b * b - a * c))  # the first of both crossings, without cancellation
    normal = start + length[:, None] * way
    return length, normal / np.linalg.norm(normal, axis=1)[:, None]


def exact(
    clearance: Clearance, d: FloatArray, lean: FloatArray, *, pin_is_longer: bool
) -> tuple[FloatArray, FloatArray]:
    """Return the gaps at the nodes, and the wrench of the rigid pressure on the pin about its origin."""
    surface = places([clearance])[0].surface
    rotation, radius = upright(lean), clearance.shape.radius
    bore_radius = radius + clearance.shape.clearance
    if pin_is_longer:
        bore = surface.position + clearance.shape.clearance * surface.normal
        gap, normal = from_the_bore(bore, -surface.normal, d, rotation, radius)
        arm = bore - gap[:, None] * surface.normal - d
    else:
        arm = surface.position @ rotation.T
        place = (arm + d) * [1.0, 1.0, 0.0]
        distance = np.linalg.norm(place, axis=1)
        gap, normal = bore_radius - distance, place / distance[:, None]
    pressure, h_star = np.zeros(gap.size), gap / clearance.roughness
    for k in np.flatnonzero(h_star < clearance.table.h_last):
        pressure[k] = pressure_and_damping(clearance.table, h_star[k])[0]
    force = -(surface.area * pressure)[:, None] * normal
    return gap, np.concatenate([force.sum(axis=0), np.cross(arm, force).sum(axis=0)])


def pressed(
    clearance: Clearance, lean: FloatArray, way: FloatArray, *, pin_is_longer: bool
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Push a leaning pin along ``way`` until its least gap is σ; return displacement, gaps and wrench."""

    def excess(size: float) -> float:
        gaps, _ = exact(clearance, size * way, lean, pin_is_longer=pin_is_longer)
        return float(gaps.min()) - clearance.roughness

    size = brentq(excess, 0.0, 2.0 * clearance.shape.clearance, xtol=1e-13)
    return size * way, *exact(clearance, size * way, lean, pin_is_longer=pin_is_longer)


@pytest.mark.parametrize("pin_is_longer", [True, pytest.param(False, marks=pytest.mark.long)])
@pytest.mark.parametrize(("radius", "length", "radial"), SIZES)
def test_wrench_and_least_gap_are_those_of_exact_geometry(
    radius: float, length: float, radial: float, pin_is_longer: bool, make_clearance: MakeClearance
) -> None:
    sizes = {"radius": radius, "clearance": radial, "length": length}
    if not pin_is_longer:
        sizes |= {"length": 2.0 * length, "pin_length": length}
    clearance = make_clearance("cylinder", grid=GRID, coefficient=0.0, **sizes)
    data, out = assemble([clearance]), np.empty(6)
    half = 0.5 * length
    most = (math.sqrt(half**2 + 2.0 * radius * radial) - half) / radius  # r φ²/2 + l φ/2 = c
    for share, angle in itertools.product((0.3, 0.8), (0.0, 0.7, 0.5 * math.pi)):
        lean = share * most * np.array([math.cos(0.3), math.sin(0.3)])
        way = np.array([math.cos(0.3 + angle), math.sin(0.3 + angle), 0.0])
        d, gaps, expected = pressed(clearance, lean, way, pin_is_longer=pin_is_longer)
        memory, pose = new_memory(data), pose_at(d, upright(lean))
        wrench(data, memory, 0, pose, out)
        report(data, memory, 0, pose)
        # Left out are e²/2r of an eccentricity e across the line of contact, and tilts to the fourth.
        assert memory.reports["separation_min"][0] == pytest.approx(gaps.min(), abs=5e-3 * 1.6e-6)
        size = np.linalg.norm(expected[:3]) * np.array([1.0, 1.0, 1.0, *[half] * 3])
        np.testing.assert_allclose(out / size, expected / size, rtol=0.0, atol=1e-2)


@pytest.mark.parametrize(("radial", "tilt"), [(20e-6, 3.2e-3), (40e-6, 6.4e-3)])
def test_a_wide_short_guide_bears_a_lean_early(radial, tilt, make_clearance):
    # Without r φ²/2 moments are 40 and more times too small.
    clearance = make_clearance("cylinder", grid=GRID, coefficient=0.0, clearance=radial, **GUIDE)
    data, out = assemble([clearance]), np.empty(6)
    lean = np.array([tilt, 0.0])
    _, expected = exact(clearance, np.zeros(3), lean, pin_is_longer=True)
    wrench(data, new_memory(data), 0, pose_at(rotation=upright(lean)), out)
    assert expected[4] < -10.0
    assert out[4] == pytest.approx(expected[4], rel=1e-2)


@pytest.mark.parametrize("radius", [6e-3, 60e-3, 380e-3])
def test_a_smooth_film_is_squeezed_out_where_exact_geometry_touches(radius: float) -> None:
    # A film has no answer from the tilt on at which its last cell in reach of an end has no gap left.
    clearance, grid = 20e-6, FilmGrid(48, 16)
    half = 0.5 * 10e-3 * (1.0 - 1.0 / grid.z)
    touching = (math.sqrt(half**2 + 2.0 * radius * clearance) - half) / radius
    film = Film(0.01, clearance, radius, 10e-3, grid=grid)
    found = [
        film_wrench(film.data(), film.memory(), np.array([0.0, 0.0, tilt, *[0.0] * 5]), 1.0, np.empty(5))
        for tilt in (0.999 * touching, 1.001 * touching)
    ]
    assert found == [CONVERGED, OUT_OF_RANGE]
