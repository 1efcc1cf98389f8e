"""Pressure under Reynolds cavitation as what it is, a complementarity problem: p ≥ 0, r ≥ 0, p r = 0.

With A π = b the discrete Eq. 52, r = A π − b. Primal-dual active set: solve A π = b over the nodes where the
film is full, π = 0 elsewhere; nodes with π < 0 leave, nodes with r < 0 return; end when none does. A is an
M-matrix, for which this converges from any first set and, after the first solve, never gives up pressure
(Hintermüller, Ito and Kunisch, SIAM J. Optim. 13 (2003) 865-888). The first guess is the set of the last
evaluation.
"""

from mebdf.arrays import FloatArray
from tribodyn.kernels.film.band import assemble, factorise, number_unknowns, solve_one
from tribodyn.kernels.film.data import (
    CONVERGED,
    NO_CONVERGENCE,
    REYNOLDS,
    BandSystem,
    FilmData,
    FilmFields,
    FilmMemory,
    FlagArray,
)
from tribodyn.kernels.jit import kernel

#: From a bad first set the edge of the film comes back a cell a solve; from the last set one or two do.
MOST_SOLVES = 1000
#: Pressures and residuals this small beside the largest are zero: they change nothing but could alternate.
ROUNDING = 1e-13


@kernel
def solve_pressure(film: FilmData, memory: FilmMemory, rows: int) -> int:
    """Fill ``memory.pressure`` and leave the factors of the last system; return a status."""
    active, effort = memory.active, memory.work.effort
    effort[0] = 0
    _first_guess(film, memory, rows)
    for _ in range(MOST_SOLVES):
        _solve_over(memory.system, memory.fields, active, memory.pressure, rows)
        effort[0] += 1
        if film.constants.cavitation != REYNOLDS:
            return CONVERGED
        if _exchange(memory.fields, active, memory.pressure, film.constants.groove, rows) == 0:
            return CONVERGED
    return NO_CONVERGENCE


@kernel
def _first_guess(film: FilmData, memory: FilmMemory, rows: int) -> None:
    """Everything is full but the groove; with cavitation only if nothing moves, or keep the last set."""
    moving = False
    for i in range(memory.active.shape[0]):
        for j in range(rows):
            if memory.fields.cells[i, j].source != 0.0:
                moving = True
    if not moving or film.constants.cavitation != REYNOLDS:
        for i in range(memory.active.shape[0]):
            for j in range(rows):
                memory.active[i, j] = 1
    if film.constants.groove == 1:
        for j in range(rows):
            memory.active[0, j] = 0


@kernel
def _solve_over(
    system: BandSystem, fields: FilmFields, active: FlagArray, pressure: FloatArray, rows: int
) -> None:
    """Solve for the pressure of the active nodes."""
    number_unknowns(system, active, rows)
    assemble(system, fields, rows)
    factorise(system)
    for i in range(active.shape[0]):
        for j in range(rows):
            if active[i, j] == 1:
                system.single[system.number[i, j]] = fields.cells[i, j].source
    solve_one(system)
    for i in range(active.shape[0]):
        for j in range(rows):
            pressure[i, j] = system.single[system.number[i, j]] if active[i, j] == 1 else 0.0


@kernel
def _exchange(fields: FilmFields, active: FlagArray, pressure: FloatArray, groove: int, rows: int) -> int:
    """Let nodes leave and return; return how many did."""
    n = active.shape[0]
    highest = strongest = 0.0
    for i in range(n):
        for j in range(rows):
            highest = max(highest, abs(pressure[i, j]))
            strongest = max(strongest, abs(fields.cells[i, j].source))
    changes = 0
    for i in range(groove, n):
        before = i - 1 if i > 0 else n - 1
        after = i + 1 if i < n - 1 else 0
        for j in range(rows):
            if active[i, j] == 1:
                if pressure[i, j] < -ROUNDING * highest:
                    active[i, j] = 0
                    changes += 1
                continue
            inflow = fields.cells[i, j].source
            inflow += (
                fields.cells[i, j].k_theta * pressure[after, j]
                + fields.cells[before, j].k_theta * pressure[before, j]
            )
            if j > 0:
                inflow += fields.z_faces[i, j].k_z * pressure[i, j - 1]
            if j + 1 < rows:
                inflow += fields.z_faces[i, j + 1].k_z * pressure[i, j + 1]
            if inflow > ROUNDING * strongest:
                active[i, j] = 1
                changes += 1
    return changes
