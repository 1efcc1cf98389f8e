"""The energy ledger of the journal: rates at an instant, and their integrals along the motion.

Works and heats are integrated with Simpson's rule over every part of an accepted step, from forces times
velocities of the numerical solution. Energies are functions of the state. What is left over measures the
integration. Loads and drive put work in; friction, damping and film turn it into heat.
"""

from __future__ import annotations

import math

from tribodyn.core.arrays import FloatArray
from tribodyn.kernels.arrays import copy
from tribodyn.kernels.bushing import report as joint_report
from tribodyn.kernels.bushing.joint import report
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.journal.data import JournalData, JournalMemory
from tribodyn.kernels.journal.equations import film_force, spread

LOADS, FRICTION, DAMPING, DRIVE, FILM = 0, 1, 2, 3, 4
"""Work of the loads, of joint friction; damping heat; work of the drive that keeps ω; work of the film."""
N_INTEGRALS = 5

PEAK_FORCE, PEAK_FORCE_TIME, PEAK_PRESSURE, PEAK_PRESSURE_TIME = 0, 1, 2, 3
"""Largest contact force [N] and pressure [Pa] at any mark, and when [s]."""
LEAST_SEPARATION, CLIPPED = 4, 5
"""Smallest gap between mean planes [m]; time integral of the share of the contact where the clip acts [s]."""
TOUCHING, REBOUNDS = 6, 7
"""1 while any point is in contact; how often all points have left contact again."""
PEAK_FILM_FORCE, PEAK_FILM_FORCE_TIME = 8, 9
"""Largest film force [N] at any mark, and when [s]."""
N_EXTREMES = 10


@kernel
def evaluate(data: JournalData, y: FloatArray, memory: JournalMemory) -> None:
    """Fill ``scratch.state``, ``scratch.report`` and ``scratch.film`` of one instant."""
    scratch = memory.scratch
    spread(y, scratch.state)
    report(data.joint, memory.entry_velocity, scratch.state, data.speed, data.sign, scratch.report)
    film_force(data.film, memory.film, data.speed, scratch)


@kernel
def fill_rates(data: JournalData, memory: JournalMemory) -> None:
    """Fill ``scratch.rates`` [W] from the scratch arrays of this instant."""
    scratch = memory.scratch
    out, rates, state = scratch.report, scratch.rates, scratch.state
    load_power = 0.0
    for i in range(4):
        load_power += data.load[i] * state[4 + i]
    rates[LOADS] = load_power
    rates[FRICTION] = out[joint_report.POWER_FRICTION]
    rates[DAMPING] = out[joint_report.HEAT_DAMPING]
    film = scratch.film
    rates[DRIVE] = -(out[joint_report.M_JF] + film[4]) * data.speed
    rates[FILM] = (
        film[0] * state[4]
        + film[1] * state[5]
        + (1.0 + math.tan(state[2]) ** 2) * film[2] * state[6]
        + (1.0 + math.tan(state[3]) ** 2) * film[3] * state[7]
        + film[4] * data.speed
    )


@kernel
def begin(data: JournalData, t: float, y: FloatArray, memory: JournalMemory) -> None:
    """Set the mark at ``t``, from which :func:`add_part` goes on."""
    evaluate(data, y, memory)
    fill_rates(data, memory)
    copy(memory.scratch.rates, memory.rates)
    memory.last_time[0] = t


@kernel
def note_extremes(t: float, h: float, memory: JournalMemory) -> None:
    """Keep the peaks at the end ``t`` of a part of length ``h`` [s]; output times would miss them."""
    extremes, out = memory.extremes, memory.scratch.report
    force = math.hypot(out[joint_report.F_CX], out[joint_report.F_CY])
    if force > extremes[PEAK_FORCE]:
        extremes[PEAK_FORCE], extremes[PEAK_FORCE_TIME] = force, t
    carried = math.hypot(memory.scratch.film[0], memory.scratch.film[1])
    if carried > extremes[PEAK_FILM_FORCE]:
        extremes[PEAK_FILM_FORCE], extremes[PEAK_FILM_FORCE_TIME] = carried, t
    if out[joint_report.P_MAX] > extremes[PEAK_PRESSURE]:
        extremes[PEAK_PRESSURE], extremes[PEAK_PRESSURE_TIME] = out[joint_report.P_MAX], t
    extremes[LEAST_SEPARATION] = min(extremes[LEAST_SEPARATION], out[joint_report.SEPARATION_MIN])
    extremes[CLIPPED] += h * out[joint_report.CLIPPED]


@kernel
def add_part(
    data: JournalData, t_a: float, t_b: float, y_m: FloatArray, y_b: FloatArray, memory: JournalMemory
) -> None:
    """Add the path integrals over ``[t_a, t_b]`` by Simpson's rule and move the mark to ``t_b``."""
    sixth = (t_b - t_a) / 6.0
    integrals, rates = memory.integrals, memory.scratch.rates
    for k in range(N_INTEGRALS):
        integrals[k] += sixth * memory.rates[k]
    evaluate(data, y_m, memory)
    fill_rates(data, memory)
    for k in range(N_INTEGRALS):
        integrals[k] += 4.0 * sixth * rates[k]
    evaluate(data, y_b, memory)
    fill_rates(data, memory)
    for k in range(N_INTEGRALS):
        integrals[k] += sixth * rates[k]
    note_extremes(t_b, t_b - t_a, memory)
    copy(rates, memory.rates)
    memory.last_time[0] = t_b


@kernel
def count_rebound(data: JournalData, gap: float, memory: JournalMemory) -> None:
    """Count a rebound where the journal, in contact at the last step, touches nowhere now.

    ``gap`` is the smallest gap of the bushing [m].
    """
    extremes = memory.extremes
    touching = gap < data.joint.onset * data.joint.roughness
    if extremes[TOUCHING] > 0.0 and not touching:
        extremes[REBOUNDS] += 1.0
    extremes[TOUCHING] = 1.0 if touching else 0.0


@kernel
def kinetic_energy(data: JournalData, state: FloatArray) -> float:
    """Return the kinetic energy of the motion in the clearance [J]; that of the rotation does not change."""
    energy = 0.0
    for i in range(4):
        energy += 0.5 * data.inertia[i] * state[4 + i] ** 2
    return energy
