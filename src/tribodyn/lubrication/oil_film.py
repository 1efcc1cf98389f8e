"""An oil film between shaft and bushing, made into what the kernels read."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.core.errors import InputError
from tribodyn.kernels.film.data import (
    HALF_SOMMERFELD,
    JFO,
    NO_CAVITATION,
    REYNOLDS,
    SIDES,
    BandSystem,
    Cell,
    Column,
    Constants,
    FilmData,
    FilmFields,
    FilmMemory,
    Row,
    Work,
    ZFace,
)
from tribodyn.kernels.jit import new_record
from tribodyn.lubrication.factors import Roughness, flow_table

#: Cavitation models by name.
CAVITATION: Final = {
    "reynolds": REYNOLDS,
    "half-sommerfeld": HALF_SOMMERFELD,
    "none": NO_CAVITATION,
    "jfo": JFO,
}

BOUNDARIES: Final = ("periodic", "groove")  #: In θ: periodic, or p = 0 on the line of maximum gap.


@dataclass(frozen=True)
class FilmGrid:
    """Cells of the film: ``theta`` around the circumference, ``z`` (even) along the axis."""

    theta: int = 128
    z: int = 32

    def __post_init__(self) -> None:
        """Refuse grids without a middle row or too coarse to hold a film."""
        if self.theta < 8:
            raise InputError(f"{self.theta} cells around the film; give 8 or more", key="film.grid.theta")
        if self.z < 4 or self.z % 2:
            raise InputError(f"{self.z} cells along the film; give an even number from 4", key="film.grid.z")


@dataclass(frozen=True)
class Film:
    """A film of oil in a bushing."""

    viscosity: float  #: η [Pa s].
    #: Radial clearance c, shaft radius r_j and length l_z [m].
    clearance: float
    radius: float
    length: float
    roughness: Roughness = field(default_factory=Roughness)  #: Of both surfaces; smooth by default.
    #: A key of :data:`CAVITATION`. ``jfo`` conserves mass, and is for steady films with a groove.
    cavitation: str = "reynolds"
    boundary: str = "periodic"  #: One of :data:`BOUNDARIES`.
    grid: FilmGrid = field(default_factory=FilmGrid)  #: Cells in θ and z.

    def __post_init__(self) -> None:
        """Refuse impossible films."""
        for name in ("viscosity", "clearance", "radius", "length"):
            value = getattr(self, name)
            if not 0.0 < value < math.inf:
                raise InputError(f"given {value:g}; a film needs a positive value", key=f"film.{name}")
        _require(self.cavitation, tuple(CAVITATION), "film.cavitation")
        _require(self.boundary, BOUNDARIES, "film.boundary")
        if self.cavitation == "jfo" and self.boundary != "groove":
            raise InputError(
                "jfo needs film.boundary = 'groove': a periodic film with p = 0 at its ends loses oil there "
                "and has no supply, so that its steady state is dry",
                key="film.cavitation",
            )

    @property
    def theta(self) -> FloatArray:
        """Angles of the nodes [rad], shape (n_theta,); counted from the groove if there is one."""
        return 2.0 * np.pi * np.arange(self.grid.theta) / self.grid.theta

    @property
    def z(self) -> FloatArray:
        """Axial positions of the nodes, ends included [m], shape (n_z + 1,)."""
        return self.length * (np.arange(self.grid.z + 1) / self.grid.z - 0.5)

    @property
    def field_shape(self) -> tuple[int, int]:
        """Shape (n_z + 1, n_theta) of a field over the nodes."""
        return self.grid.z + 1, self.grid.theta

    def data(self, wear: FloatArray | None = None) -> FilmData:
        """Return the data of the kernels.

        Parameters
        ----------
        wear
            Wear depth at the nodes [m], shape :attr:`field_shape`; none by default.
        """
        depth = self._wear(wear)
        constants = new_record(Constants)
        for name in ("viscosity", "clearance", "radius", "length"):
            constants[name] = getattr(self, name)
        constants.roughness = self.roughness.combined
        constants.cavitation = CAVITATION[self.cavitation]
        constants.groove = self.boundary == "groove"
        constants.uniform = np.ptp(depth, axis=0).max() == 0.0
        constants.mirror = np.array_equal(depth, depth[::-1])
        return FilmData(
            constants=constants,
            columns=self._columns(),
            z_node=self.z,
            z_face=0.5 * (self.z[1:] + self.z[:-1]),
            wear_node=np.ascontiguousarray(depth.T),
            wear_theta=np.ascontiguousarray((0.5 * (depth + np.roll(depth, -1, axis=1))).T),
            wear_z=np.ascontiguousarray((0.5 * (depth[1:] + depth[:-1])).T),
            table=flow_table(self.roughness),
        )

    def _columns(self) -> NDArray[np.void]:
        """Return cosines and sines of the grid."""
        columns = np.zeros(self.grid.theta, dtype=Column)
        columns["cos_node"], columns["sin_node"] = portable.cos(self.theta), portable.sin(self.theta)
        face = self.theta + np.pi / self.grid.theta
        columns["cos_face"], columns["sin_face"] = portable.cos(face), portable.sin(face)
        return columns

    def _wear(self, wear: FloatArray | None) -> FloatArray:
        depth = np.zeros(self.field_shape) if wear is None else np.asarray(wear, dtype=np.float64)
        if depth.shape != self.field_shape:
            raise InputError(f"wear depth has shape {depth.shape}, the film {self.field_shape}")
        if self.boundary == "groove" and depth.any():
            raise InputError(
                "a worn bushing needs 'periodic': with 'groove' the grid turns with the line of centres",
                key="film.boundary",
            )
        return depth

    def memory(self) -> FilmMemory:
        """Return the cache of one thread: cavitation of the last evaluation, and scratch."""
        return new_memory(self.grid.theta, self.grid.z - 1, conserves_mass=self.cavitation == "jfo")


def new_memory(n: int, m: int, *, conserves_mass: bool) -> FilmMemory:
    """Return the cache of a film of ``n`` columns of ``m`` nodes; ``jfo`` conserves mass."""
    unknowns = (n - 1) * m if conserves_mass else 0
    return FilmMemory(
        active=np.ones((n, m), dtype=np.int8),
        pressure=np.zeros((n, m)),
        fill=np.ones((n, m)),
        adjoint=np.zeros((5, n, m)),
        gradient=np.zeros((5, 6, m + 1)),
        fields=_fields(n, m),
        system=_system(n, m),
        transport=np.zeros((unknowns, 2 * m + 1)),
        amount=np.zeros(unknowns),
        work=new_record(Work),
    )


def _require(value: str, allowed: tuple[str, ...], key: str) -> None:
    if value not in allowed:
        raise InputError(f"given {value!r}; allowed: {', '.join(allowed)}", key=key)


def _fields(n: int, m: int) -> FilmFields:
    return FilmFields(
        columns=np.zeros(n, dtype=Column),
        rows=np.zeros(m + 1, dtype=Row),
        cells=np.zeros((n, m), dtype=Cell),
        z_faces=np.zeros((n, m + 1), dtype=ZFace),
    )


def _system(n: int, m: int) -> BandSystem:
    return BandSystem(
        number=np.full((n, m), -1, dtype=np.int64),
        reach=np.zeros(n * m, dtype=np.int64),
        band=np.zeros((n * m, m + 2)),
        border=np.zeros((n * m, m)),
        corner=np.zeros((m, m)),
        right=np.zeros((n * m, SIDES)),
        single=np.zeros(n * m),
        size=np.zeros(3, dtype=np.int64),
    )


_NO_FILM: Final = Film(1.0, 1.0, 1.0, 1.0, grid=FilmGrid(8, 4))  #: Gives the arrays of no film their shapes.


def stacked_data(films: Sequence[Film], wear: Sequence[FloatArray | None]) -> FilmData:
    """Return the data of films, every array with an axis over the films before the others.

    Parameters
    ----------
    films
        Films on one grid, none with ``jfo``; there may be none.
    wear
        Wear depth of each at its nodes [m], shape ``Film.field_shape``; None without wear.

    Raises
    ------
    InputError
        If their grids differ.
    """
    if any(film.grid != films[0].grid for film in films):
        raise InputError("all films of a mechanism have one grid; give the same to each", key="film.grid")
    parts = [film.data(depth) for film, depth in zip(films, wear, strict=True)]
    data: FilmData = _stacked(parts) if parts else _none(_NO_FILM.data())
    return data


def stacked_memory(films: FilmData) -> FilmMemory:
    """Return the caches of the films of :func:`stacked_data`."""
    n_films, n = films.columns.shape
    one = new_memory(n, films.z_face.shape[1] - 1, conserves_mass=False)
    memory: FilmMemory = _stacked([one] * n_films) if n_films else _none(one)
    return memory


def _stacked(parts: Sequence[Any]) -> Any:
    """Return named tuples as one whose arrays have one axis more."""
    first = parts[0]
    if isinstance(first, tuple):
        return type(first)(*map(_stacked, zip(*parts, strict=True)))
    return np.stack(parts)


def _none(one: Any) -> Any:
    """Return the arrays of no film, with the shapes of ``one``."""
    if isinstance(one, tuple):
        return type(one)(*map(_none, one))
    return np.stack([one])[:0].copy()
