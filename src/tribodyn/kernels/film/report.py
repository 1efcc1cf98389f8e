"""Report of the last evaluation of a film besides its wrench, and its observed quantities."""

from typing import Final

from tribodyn.core.arrays import FloatMatrix
from tribodyn.core.quantities import Quantity, of_table
from tribodyn.kernels.film.data import HALF_SOMMERFELD, FilmData, FilmMemory
from tribodyn.kernels.jit import entry, kernel

#: The report of an instant.
FILM: Final = (
    Quantity("film_force", "N", "force of the oil film on the shaft, axes of the joint", size=3),
    Quantity(
        "film_moment",
        "N m",
        "moment of the oil film on the shaft, axes of the joint; about the axis that of its friction",
        size=3,
    ),
    Quantity("film_pressure_max", "Pa", "largest pressure in the oil film"),
    Quantity("film_thickness_min", "m", "smallest gap of the oil film, negative where mean surfaces overlap"),
    Quantity("film_leakage", "m3 s-1", "volume of oil that leaves both ends per second"),
)

#: Over all accepted steps; output times would miss them.
FILM_PEAKS: Final = (
    Quantity("film_force_peak", "N", "largest film force at any accepted step", ()),
    Quantity("film_force_peak_time", "s", "when the film force was largest", ()),
    Quantity("film_pressure_peak", "Pa", "largest film pressure at any accepted step", ()),
    Quantity("film_pressure_peak_time", "s", "when the film pressure was largest", ()),
    Quantity("film_thickness_least", "m", "smallest gap of the oil film at any accepted step", ()),
)

Report = of_table(FILM)
Peaks = of_table(FILM_PEAKS)


@kernel
def pressure_unit(film: FilmData) -> float:
    """Return the pressure of π = 1/s: 6 η r²/c² [Pa s]."""
    slender = film.constants.radius / film.constants.clearance
    return 6.0 * film.constants.viscosity * slender * slender


@entry
def film_pressure(film: FilmData, memory: FilmMemory, pressure: FloatMatrix) -> None:
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
            pressure[j + 1, i] = max(p, 0.0) if film.constants.cavitation == HALF_SOMMERFELD else p


@kernel
def film_peak(film: FilmData, memory: FilmMemory) -> float:
    """Return the largest pressure of the last evaluation [Pa]."""
    largest = 0.0
    for i in range(memory.pressure.shape[0]):
        for j in range(memory.pressure.shape[1]):
            largest = max(largest, memory.pressure[i, j])
    return pressure_unit(film) * largest


@entry
def film_leakage(film: FilmData, memory: FilmMemory) -> float:
    """Return the volume that leaves both ends per second [m³/s]: −∮ φ_z h³/(12 η) ∂p/∂z r dθ, outward."""
    n, m = memory.pressure.shape
    half = memory.work.effort[1] < m
    total = 0.0
    for i in range(n):
        total += _outflow(film, memory, i, 0, 1)
        total += _outflow(film, memory, i, 0, 1) if half else _outflow(film, memory, i, m - 1, -1)
    return 0.5 * film.constants.radius * film.constants.radius * film.constants.clearance * total


@kernel
def _outflow(film: FilmData, memory: FilmMemory, i: int, j: int, inward: int) -> float:
    """Return the outflow at the end next to row ``j``: slope of a parabola, conductance carried on to it."""
    first, second = memory.pressure[i, j], memory.pressure[i, j + inward]
    if film.constants.cavitation == HALF_SOMMERFELD:
        first, second = max(first, 0.0), max(second, 0.0)
    face = j if inward > 0 else j + 1
    faces = memory.fields.z_faces
    return (1.5 * faces[i, face].k_z - 0.5 * faces[i, face + inward].k_z) * (2.0 * first - 0.5 * second)
