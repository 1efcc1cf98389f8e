"""What is told about the last evaluation of a film besides its wrench."""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.film.data import HALF_SOMMERFELD, FilmData, FilmMemory
from tribodyn.kernels.jit import entry, kernel


@kernel
def pressure_unit(film: FilmData) -> float:
    """Return the pressure of π = 1/s: 6 η r²/c² [Pa s]."""
    slender = film.radius / film.clearance
    return 6.0 * film.viscosity * slender * slender


@entry
def film_pressure(film: FilmData, memory: FilmMemory, pressure: FloatArray) -> None:
    """Fill ``pressure`` (n_z + 1, n_theta) [Pa] with the field of the last evaluation.

    With a groove, columns count from the groove.
    """
    n, m = memory.pressure.shape
    unit = pressure_unit(film)
    for i in range(n):
        pressure[0, i] = 0.0
        pressure[m + 1, i] = 0.0
        for j in range(m):
            p = unit * memory.pressure[i, j]
            pressure[j + 1, i] = max(p, 0.0) if film.cavitation == HALF_SOMMERFELD else p


@entry
def film_leakage(film: FilmData, memory: FilmMemory) -> float:
    """Return the volume that leaves both ends per second [m³/s]: −∮ φ_z h³/(12 η) ∂p/∂z r dθ, outward."""
    n, m = memory.pressure.shape
    fields, rows = memory.fields, memory.effort[1]
    half = rows < m
    total = 0.0
    for i in range(n):
        first, last = memory.pressure[i, 0], memory.pressure[i, m - 1]
        if film.cavitation == HALF_SOMMERFELD:
            first, last = max(first, 0.0), max(last, 0.0)
        total += fields.k_z[i, 0] * first
        total += (fields.k_z[i, 0] if half else fields.k_z[i, rows]) * last
    return 0.5 * film.radius * film.radius * film.clearance * total


@entry
def groove_angle(film: FilmData, memory: FilmMemory) -> float:
    """Return the angle of the first column of nodes [rad]; 0 without a groove."""
    return math.atan2(memory.fields.sin_node[0], memory.fields.cos_node[0])
