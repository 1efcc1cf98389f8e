"""Oil films: average Reynolds equation with flow factors and cavitation.

A :class:`Film` is made into what the kernels read and change by ``data()`` and ``memory()``; what a mechanism
calls stands in ``kernels.film``. :func:`film_state` evaluates a film at one state, :func:`film_equilibrium`
finds where it carries a load.
"""

from tribodyn.lubrication.equilibrium import FilmEquilibrium, FilmState, explain, film_equilibrium, film_state
from tribodyn.lubrication.factors import Roughness
from tribodyn.lubrication.oil_film import BOUNDARIES, CAVITATION, Film, FilmGrid, stacked_data, stacked_memory

__all__ = [
    "BOUNDARIES",
    "CAVITATION",
    "Film",
    "FilmEquilibrium",
    "FilmGrid",
    "FilmState",
    "Roughness",
    "explain",
    "film_equilibrium",
    "film_state",
    "stacked_data",
    "stacked_memory",
]
