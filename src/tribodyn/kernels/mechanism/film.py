"""The oil film of a joint of a mechanism."""

from typing import Any

from tribodyn.core.quantities import Record
from tribodyn.kernels.film.data import FilmData, FilmMemory
from tribodyn.kernels.film.several import film_at, memory_at
from tribodyn.kernels.jit import kernel
from tribodyn.kernels.joints.film import fill_report, film_wrench
from tribodyn.kernels.mechanism.data import FILM, REPORTS, SLOPES


@kernel
def film_force(
    mode: float, films: FilmData, memory: FilmMemory, k: int, now: Record, scratch: Record, oil: Any
) -> None:
    """Add the wrench of film ``k`` to that of its coupling, ``now``, and what else ``mode`` asks for.

    ``scratch`` is that of the joints with clearance.
    """
    film, own, slopes = film_at(films, k), memory_at(memory, k), 1.0 if mode == SLOPES else 0.0
    film_wrench(film, own, now.pose, scratch, oil[k], slopes, now.slope)
    if mode == REPORTS:
        fill_report(film, own, now.pose, oil[k])
        now.powers[FILM] += oil[k].power
    for i in range(6):
        now.wrench[i] += oil[k].wrench[i]
