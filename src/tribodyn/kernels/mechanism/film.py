"""The oil film of a joint, which the kernels of a mechanism call by its address."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

from tribodyn.core.quantities import Record
from tribodyn.kernels.address import ByAddress
from tribodyn.kernels.film.data import FilmData, FilmMemory
from tribodyn.kernels.film.several import film_at, memory_at
from tribodyn.kernels.jit import entry
from tribodyn.kernels.joints.film import Oil, fill_report, film_wrench
from tribodyn.kernels.joints.surface.memory import Scratch
from tribodyn.kernels.mechanism.data import FILM, REPORTS, SLOPES, CouplingNow


@entry
def film_force(
    mode: float,
    films: FilmData,
    memory: FilmMemory,
    k: int,
    now: Record,
    scratch: Record,
    oil: Any,
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


@entry
def no_film(
    mode: float,
    films: FilmData,
    memory: FilmMemory,
    k: int,
    now: Record,
    scratch: Record,
    oil: Any,
) -> None:
    """Do nothing: what a mechanism without films holds in the place of :func:`film_force`."""


def by_address(films: FilmData, memory: FilmMemory) -> ByAddress:
    """Return :func:`film_force` for the films of a mechanism, and where there are none :func:`no_film`."""
    import numba

    now, scratch, oil = _records()
    types = map(numba.typeof, (films, memory))
    signature = numba.void(numba.float64, *types, numba.int64, now, scratch, oil[::1])
    function: Callable[..., None] = film_force if films.constants.size else no_film
    return ByAddress(function, signature)


@cache
def _records() -> tuple[Any, Any, Any]:
    """Return the types of a coupling, of the scratch of joints and of an oil film in compiled code."""
    import numba

    now, scratch, oil = map(numba.from_dtype, (CouplingNow, Scratch, Oil))
    return now, scratch, oil
