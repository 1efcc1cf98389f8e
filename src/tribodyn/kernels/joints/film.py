"""The oil film of a joint: from the pose of the shaft to the chart of the film, and back for the wrench.

The film belongs to the bore, through which the shaft passes: it is evaluated where the axis of the shaft
crosses the middle of the bore, see ``surface/station``, and for the tilt and its rate in ``surface/tilt``,
which are the coordinates of ``kernels.film.attitude`` but for the sign about Y. The speed is the angular
velocity about the axis of the bore.
"""

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels.jit import copy
from tribodyn.core.quantities import Record, record_type
from tribodyn.kernels.film.data import CONVERGED, FilmData, FilmMemory
from tribodyn.kernels.film.report import Peaks, Report, film_leakage, film_peak
from tribodyn.kernels.film.wrench import derivatives_in_chart, wrench_in_chart
from tribodyn.kernels.jit import clear, kernel
from tribodyn.kernels.joints.pose import W
from tribodyn.kernels.joints.surface.joint import add_derivatives
from tribodyn.kernels.joints.surface.station import derivatives_at_origin, fill_station, pressure_at_origin
from tribodyn.kernels.joints.surface.tilt import AXIS, fill_tilt, moment_of

SLIDES: Final = 1.0
#: Displacement of the ends of a shaft by its tilt, over the clearance, that is rounding; so with speeds.
LEVEL: Final = 1.0e-13

Oil: Final = record_type(
    ("film", "f8", (5,)),
    ("wrench", "f8", (6,)),
    *((name, "f8") for name in ("status", "power")),
    ("report", Report),
    ("peaks", Peaks),
)
"""Wrench of a film on its joint.

film, wrench
    Wrench of the film in the middle of the bore, see ``kernels.film``, and on the shaft at its origin.
status
    Why the film last had no answer, 0 if it always had; for messages.
power
    That becomes heat [W], of the last report.
report, peaks
    See ``kernels.film.quantities``.
"""


@kernel
def film_wrench(
    film: FilmData,
    memory: FilmMemory,
    pose: Record,
    scratch: Record,
    oil: Record,
    slopes: float,
    jacobian: FloatArray,
) -> None:
    """Fill ``oil.wrench`` [N, N m].

    With ``slopes`` above 0 its derivatives in d, ϑ, v and ω are added to ``jacobian`` (6, 12). ``scratch`` is
    that of the joints with clearance, ``pose`` as there.
    """
    _look(film, memory, pose, scratch)
    status = wrench_in_chart(film, memory, pose.w[2], oil.film)
    if status != CONVERGED:
        oil.status = status
    if not (status == CONVERGED and slopes > 0.0):
        _fill_wrench(scratch, oil)
        return
    derivatives_in_chart(film, memory, pose.w[2], oil.film)
    _fill_derivatives(memory.work.chart, scratch)
    _fill_parts(oil.film, scratch)
    derivatives_at_origin(scratch, pose)
    _fill_wrench(scratch, oil)
    add_derivatives(AXIS, scratch, pose, jacobian)
    _add_speed(memory.work.chart, scratch, oil.film, jacobian)


@kernel
def fill_report(film: FilmData, memory: FilmMemory, pose: Record, oil: Record) -> None:
    """Fill the report in ``oil``; the wrench there must be that of ``pose``."""
    report = oil.report
    copy(oil.wrench[:3], report.film_force)
    copy(oil.wrench[3:], report.film_moment)
    report.film_pressure_max, report.film_thickness_min = film_peak(film, memory), memory.work.least
    report.film_leakage, oil.power = film_leakage(film, memory), 0.0
    for i in range(3):
        oil.power -= oil.wrench[i] * pose.v[i] + oil.wrench[3 + i] * pose.w[i]


@kernel
def note_film_peaks(oil: Record, t: float) -> None:
    """Note the report of a film at ``t`` [s], the end of a part of an accepted step."""
    report, peaks, force = oil.report, oil.peaks, oil.report.film_force
    size = math.sqrt(force[0] ** 2 + force[1] ** 2 + force[2] ** 2)
    if size > peaks.film_force_peak:
        peaks.film_force_peak, peaks.film_force_peak_time = size, t
    if report.film_pressure_max > peaks.film_pressure_peak:
        peaks.film_pressure_peak, peaks.film_pressure_peak_time = report.film_pressure_max, t
    peaks.film_thickness_least = min(peaks.film_thickness_least, report.film_thickness_min)


def new_oil(n: int) -> NDArray[np.void]:
    """Return the records of ``n`` films that were never evaluated."""
    oil = np.zeros(n, dtype=Oil)
    oil["peaks"]["film_thickness_least"] = math.inf
    return oil


@kernel
def _look(film: FilmData, memory: FilmMemory, pose: Record, scratch: Record) -> None:
    """Fill tilt and station of the scratch, and the state of the film.

    A tilt of rounding is none: a level film is solved on half its length.
    """
    u, tilt, station = memory.work.state, scratch.tilt, scratch.station
    fill_tilt(AXIS, pose.rotation, pose.w, tilt)
    fill_station(SLIDES, pose, tilt, station)
    u[0], u[1], u[2], u[3] = station.d[0], station.d[1], tilt.phi[0], -tilt.phi[1]
    u[4], u[5], u[6], u[7] = station.v[0], station.v[1], tilt.rate[0], -tilt.rate[1]
    size, rate = film.constants.clearance, abs(u[4]) + abs(u[5]) + abs(pose.w[2]) * film.constants.clearance
    half = 0.5 * film.constants.length
    if half * (abs(u[2]) + abs(u[3])) < LEVEL * size and half * (abs(u[6]) + abs(u[7])) <= LEVEL * rate:
        u[2] = u[3] = u[6] = u[7] = 0.0


@kernel
def _fill_parts(film: FloatArray, scratch: Record) -> None:
    """Fill normal and friction of the scratch in the middle of the bore, from the wrench of the film (5,)."""
    normal, friction = scratch.normal, scratch.friction
    for i in range(6):
        normal[i] = friction[i] = 0.0
    normal[0], normal[1], normal[3], normal[4] = film[0], film[1], film[2], -film[3]
    friction[5] = film[4]


@kernel
def _fill_wrench(scratch: Record, oil: Record) -> None:
    """Fill the wrench on the shaft from that of the film."""
    out = oil.wrench
    _fill_parts(oil.film, scratch)
    pressure_at_origin(scratch.station, scratch.normal)
    for i in range(3):
        out[i] = scratch.normal[i]
        out[3 + i] = scratch.friction[3 + i]
    moment_of(scratch.tilt, scratch.normal[3:], out[3:])


@kernel
def _fill_derivatives(chart: FloatArray, scratch: Record) -> None:
    """Fill the derivatives of normal and friction in (d, φ) and (v, φ̇) from those of the film (5, 9)."""
    rows = (0, 1, 3, 4)
    for matrix in (
        scratch.normal_place,
        scratch.normal_rate,
        scratch.friction_place,
        scratch.friction_rate,
        scratch.friction_slip,
    ):
        clear(matrix)
    for m in range(4):
        column, sign = rows[m], -1.0 if m == 3 else 1.0
        for k in range(4):
            both = -sign if k == 3 else sign
            scratch.normal_place[rows[k], column] = both * chart[k, m]
            scratch.normal_rate[rows[k], column] = both * chart[k, 4 + m]
        scratch.friction_place[5, column] = sign * chart[4, m]
        scratch.friction_rate[5, column] = sign * chart[4, 4 + m]


@kernel
def _add_speed(chart: FloatArray, scratch: Record, film: FloatArray, jacobian: FloatArray) -> None:
    """Add the derivatives in the speed; ``film`` (5,) is work space."""
    for k in range(5):
        film[k] = chart[k, 8]
    for i in range(3):
        scratch.moment[i] = 0.0
    _fill_parts(film, scratch)
    pressure_at_origin(scratch.station, scratch.normal)
    moment_of(scratch.tilt, scratch.normal[3:], scratch.moment)
    for i in range(3):
        jacobian[i, W + 2] += scratch.normal[i]
        jacobian[3 + i, W + 2] += scratch.moment[i] + scratch.friction[3 + i]
