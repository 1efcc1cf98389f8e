"""Coordinates in which the gap is linear, and the report of the last evaluation of a film.

The chart is u = (e_x, e_y, t_x, t_y, v_x, v_y, w_x, w_y) with t = tan φ and w = φ̇ sec²φ. At height z the
shaft axis is displaced by a = e_x − z t_y, b = e_y − z t_x (Eq. 48), with the same for the velocities. The
cross-section of a tilted shaft is an ellipse. With s = t_y cos θ + t_x sin θ,

    h = c + a cos θ + b sin θ − ½ r s².

Except for the last term the gap is linear in the chart. The derivatives in t are those at the height z + r s.
"""

from typing import Final

from mebdf.arrays import FloatArray, FloatMatrix
from mebdf.kernels.elementary import hypot, tan
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


@kernel
def chart_of(y: FloatArray, u: FloatArray) -> None:
    """Fill ``u`` (8,) from the states ``y`` (8,)."""
    for k in range(2):
        u[k] = y[k]
        u[4 + k] = y[4 + k]
        t = tan(y[2 + k])
        u[2 + k] = t
        u[6 + k] = y[6 + k] * (1.0 + t * t)


@kernel
def from_chart(u: FloatArray, y: FloatArray, chart: FloatArray, jacobian: FloatArray) -> None:
    """Carry derivatives in the chart and ω to the states and ω, both of shape (5, 9)."""
    for k in range(5):
        for i in (0, 1, 4, 5, 8):
            jacobian[k, i] = chart[k, i]
        for i in (2, 3):
            t = u[i]
            secant = 1.0 + t * t
            jacobian[k, i] = secant * (chart[k, i] + 2.0 * y[4 + i] * t * chart[k, 4 + i])
            jacobian[k, 4 + i] = secant * chart[k, 4 + i]


@kernel
def groove_direction(u: FloatArray) -> tuple[float, float]:
    """Return cosine and sine of the angle of the largest gap in the middle; of angle 0 if centred."""
    e = hypot(u[0], u[1])
    if e == 0.0:
        return 1.0, 0.0
    return u[0] / e, u[1] / e


@kernel
def turn_with_groove(u: FloatArray, out: FloatArray, chart: FloatArray) -> None:
    """Add to the derivatives at a resting groove what its turning with the line of centres adds.

    Turning grid, state and wrench together changes nothing, so with G the generator of rotations the
    derivative of the wrench W by the angle ψ of the groove is G W − (∂W/∂u) G u, and ∂ψ/∂(e_x, e_y) =
    (−e_y, e_x)/e². Rotating pairs are (e_x, e_y), (t_y, t_x), their rates, (F_x, F_y) and (M_y, M_x).
    """
    e_2 = u[0] * u[0] + u[1] * u[1]
    if e_2 == 0.0:
        return
    for k in range(5):
        by_angle = 0.0
        for i in (0, 4):
            by_angle -= chart[k, i + 1] * u[i] - chart[k, i] * u[i + 1]
            by_angle -= chart[k, i + 2] * u[i + 3] - chart[k, i + 3] * u[i + 2]
        if k == 0:
            by_angle -= out[1]
        elif k == 1:
            by_angle += out[0]
        elif k == 2:
            by_angle += out[3]
        elif k == 3:
            by_angle -= out[2]
        d_x, d_y = -u[1] / e_2, u[0] / e_2
        chart[k, 0] += by_angle * d_x
        chart[k, 1] += by_angle * d_y
