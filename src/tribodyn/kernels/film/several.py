"""Several films: arrays of one film each, with an axis over the films before the others.

All films of a mechanism have one grid, so that one of them is a view of these arrays, of the same types as a
film by itself: nothing is compiled for several films.
"""

from typing import Any

from tribodyn.kernels.film.data import BandSystem, FilmData, FilmFields, FilmMemory, FlowTable
from tribodyn.kernels.jit import inlined


@inlined
def film_at(films: FilmData, k: int) -> FilmData:
    """Return the data of film ``k``."""
    table: Any = films.table
    return FilmData(
        films.constants[k],
        films.columns[k],
        films.z_node[k],
        films.z_face[k],
        films.wear_node[k],
        films.wear_theta[k],
        films.wear_z[k],
        FlowTable(table.inverse_step[k], table.factors[k], table.gap_step[k], table.mean_gap[k]),
    )


@inlined
def memory_at(memory: FilmMemory, k: int) -> FilmMemory:
    """Return the memory of film ``k``."""
    fields, system = memory.fields, memory.system
    return FilmMemory(
        memory.active[k],
        memory.pressure[k],
        memory.fill[k],
        memory.adjoint[k],
        memory.gradient[k],
        FilmFields(fields.columns[k], fields.rows[k], fields.cells[k], fields.z_faces[k]),
        BandSystem(
            system.number[k],
            system.reach[k],
            system.band[k],
            system.border[k],
            system.corner[k],
            system.right[k],
            system.single[k],
            system.size[k],
        ),
        memory.transport[k],
        memory.amount[k],
        memory.work[k],
    )
