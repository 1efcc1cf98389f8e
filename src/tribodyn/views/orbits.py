"""Paths of points of a shaft in its clearance circle, seen along the axis: a section and a figure."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from mebdf.arrays import FloatArray
from tribodyn.views.encode import packed, stepped
from tribodyn.views.playback import peak
from tribodyn.views.section import Payload, Section, choice

if TYPE_CHECKING:
    import xarray as xr

#: Looks of points in one circle; top, middle and bottom of a shaft.
LOOKS: Final = (
    {"colour": "blue", "dash": "solid", "symbol": "circle"},
    {"colour": "ink", "dash": "dot", "symbol": "diamond"},
    {"colour": "vermilion", "dash": "dash", "symbol": "square"},
)
_FINE: Final = 0.001  #: Rounding of a path on a page, over the clearance.


@dataclass(frozen=True)
class OrbitPath:
    """Motion of one point."""

    name: str  #: Of the point.
    path: FloatArray  #: Places over the playback that straight lines may join [µm], shape (n, 2).
    at: FloatArray  #: Places at the frames [µm], shape (n_frames, 2).


@dataclass(frozen=True)
class Orbit:
    """Points in one clearance circle."""

    name: str  #: Of the joint.
    clearance: float  #: Radius of the circle [µm].
    tracks: tuple[OrbitPath, ...]  #: Of its points.
    #: Of the area that flat walls leave, in the place of the circle [µm], shape (n, 2).
    corners: Sequence[Sequence[float]] = ()

    @property
    def reach(self) -> float:
        """Half of the width that is drawn [µm]."""
        room = [abs(x) for corner in self.corners for x in corner]
        return 1.25 * max(self.clearance, *room, *(peak(track.path) for track in self.tracks), 1e-3)

    @property
    def payload(self) -> dict[str, Any]:
        """Data of the script ``orbit``."""
        fine = _FINE * self.clearance
        return {
            "clearance": self.clearance,
            "corners": self.corners,
            "reach": self.reach,
            "joined": len(self.tracks) > 1,
            "looks": LOOKS[: len(self.tracks)],
            "places": [track.name for track in self.tracks],
            "paths": [
                dict(zip("xy", (stepped(x, fine) for x in one.path.T), strict=True)) for one in self.tracks
            ],
            "at": [dict(zip("xy", map(packed, one.at.T), strict=True)) for one in self.tracks],
        }


@dataclass(frozen=True)
class OrbitView:
    """Orbits of a result."""

    #: As those of a :class:`tribodyn.views.section.Section`.
    name: str
    title: str
    caption: str
    needs: tuple[str, ...]
    still: str
    #: Returns the circles, one for each joint, without a playback none, and in words which joints are shown.
    orbits: Callable[[xr.Dataset], tuple[Sequence[Orbit], str]]
    several: bool = True  #: Whether a reader chooses among joints.

    @property
    def section(self) -> Section:
        """The circles on a page."""
        widget = "choice" if self.several else "orbit"
        return Section(self.name, self.title, self.caption, self.needs, widget, self._payload, self.still)

    def _payload(self, dataset: xr.Dataset) -> Payload | None:
        orbits, which = self.orbits(dataset)
        parts = {orbit.name: orbit.payload for orbit in orbits}
        return choice("orbit", f"joint{which}", parts) if self.several else next(iter(parts.values()), None)
