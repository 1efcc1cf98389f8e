"""Charts and sections of any shaft in a bushing: forces, tilt, pressure on the unrolled bushing, path."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.core.splines import Cubics
from tribodyn.views.bushing import shares, unrolled
from tribodyn.views.charts import Chart, ChartCurve, Panel
from tribodyn.views.encode import packed, stepped
from tribodyn.views.playback import LINE_ERROR, dense_times, peak, playback_times, series, signed
from tribodyn.views.section import Payload, Section, choice

#: Looks of points in one circle; top, middle and bottom of a shaft.
_LOOKS: Final = (
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
            "looks": _LOOKS[: len(self.tracks)],
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


def _forces(dataset: xr.Dataset) -> list[Panel]:
    """Return total, rigid and damping force and friction along X and Y [N]."""
    return [_force(dataset, axis) for axis in "xy"]


def _force(dataset: xr.Dataset, axis: str) -> Panel:
    curves = (
        ChartCurve("total contact force", series(dataset, f"F_c{axis}"), "pale", width=4.5),
        ChartCurve("rigid part", series(dataset, f"F_k{axis}"), "blue"),
        ChartCurve("damping part", series(dataset, f"F_d{axis}"), "vermilion", "dash"),
        ChartCurve("friction", series(dataset, f"F_f{axis}"), "green", "dot"),
    )
    return Panel(f"along {axis.upper()} [N]", curves, smooth=True)


CONTACT_FORCE: Final = Chart(
    name="contact_force",
    title="Forces of the bushing on the trunnion",
    caption=(
        "The contact force (normal pressure) with its rigid and damping parts, and friction beside it. After "
        "each reversal the trunnion crosses the clearance and lands on the other side: zoom in there."
    ),
    needs=("F_cx", "F_cy", "F_kx", "F_ky", "F_dx", "F_dy", "F_fx", "F_fy"),
    panels=_forces,
    fading="damping part",
)


def _tilts(dataset: xr.Dataset) -> list[Panel]:
    """Return tilts [mrad], offsets [µm] and peak pressure [MPa]."""
    return [
        Panel("tilt [mrad]", _pair(dataset, "phi", 1e3)),
        Panel("offset [µm]", _pair(dataset, "e", 1e6)),
        Panel(
            "peak pressure [MPa]", [ChartCurve("peak pressure", series(dataset, "p_max", 1e-6))], smooth=True
        ),
    ]


def _pair(dataset: xr.Dataset, symbol: str, scale: float) -> list[ChartCurve]:
    return [
        ChartCurve("X: φx, ex", series(dataset, f"{symbol}_x", scale), "blue"),
        ChartCurve("Y: φy, ey", series(dataset, f"{symbol}_y", scale), "vermilion", "dash"),
    ]


TILT: Final = Chart(
    name="tilt",
    title="Tilt and offset of the trunnion, and peak pressure",
    caption=(
        "A tilted trunnion bears on the edges of the bushing. Where the two angles change, the loaded edge "
        "moves and the peak pressure follows."
    ),
    needs=("phi_x", "phi_y", "e_x", "e_y", "p_max"),
    panels=_tilts,
)


def _pressure(dataset: xr.Dataset) -> Payload | None:
    """Return the frames in 255 steps of their own peaks [MPa], on the bushing laid flat."""
    fields = np.nan_to_num(dataset["pressure_cycle"].values) * 1e-6
    if fields.shape[0] < 2 or not fields.max(initial=0.0) > 0.0:
        return None
    laid = unrolled(dataset, fields, shares(fields))
    return laid.payload(fields, "contact pressure", "MPa", lambda peaks: 1.6 * float(np.median(peaks)))


PRESSURE: Final = Section(
    name="pressure",
    title="Contact pressure on the unrolled bushing",
    caption=(
        "The bushing cut open and laid flat. The angle names points of the bushing as the marks on the wall "
        "of the clearance circle do."
    ),
    needs=("pressure_cycle", "frame_time", "theta", "z"),
    widget="field",
    data=_pressure,
    still="pressure",
)


def centre(dataset: xr.Dataset, z: float) -> tuple[FloatArray, FloatArray]:
    """Return the displacement of the trunnion axis at height ``z`` [m], two arrays of shape (n_t,) [µm].

    It is (e_x - z tan phi_y, e_y - z tan phi_x).
    """
    x = series(dataset, "e_x") - z * np.tan(series(dataset, "phi_y"))
    y = series(dataset, "e_y") - z * np.tan(series(dataset, "phi_x"))
    return x * 1e6, y * 1e6


def _motion(dataset: xr.Dataset, z: float) -> Cubics:
    """Return the same over time: cubics through rows and rates, as flights across the clearance need it."""
    rates = [
        series(dataset, f"e_{axis}_dot")
        - z * series(dataset, f"{tilt}_dot") / np.cos(series(dataset, tilt)) ** 2
        for axis, tilt in (("x", "phi_y"), ("y", "phi_x"))
    ]
    places, slopes = np.stack(centre(dataset, z), axis=-1), 1e6 * np.stack(rates, axis=-1)
    good = np.isfinite(places).all(axis=1) & np.isfinite(slopes).all(axis=1)
    return Cubics(series(dataset, "time")[good], places[good], slopes[good])


def _path(motion: Cubics, times: FloatArray, clearance: float) -> FloatArray:
    """Return places of a motion between the first and last of times that lines may join, shape (n, 2)."""
    inside = (motion.x >= times[0]) & (motion.x <= times[-1])
    rows = motion.x[inside], motion.values[inside], motion.slopes[inside]
    return motion(dense_times(*rows, LINE_ERROR * clearance)) if rows[0].size > 1 else rows[1]


def _at(motion: Cubics, times: FloatArray) -> FloatArray:
    """Return the places of a centre at the frames, shape (n_frames, 2); NaN where a run hardly began."""
    if motion.x.size < 2:
        return np.full((times.size, 2), np.nan)
    return motion(np.clip(times, motion.x[0], motion.x[-1]))


def _orbit(dataset: xr.Dataset) -> tuple[list[Orbit], str]:
    """Return the top, middle and bottom centres of the trunnion in the clearance."""
    times = playback_times(dataset)
    if times.size < 2:
        return [], ""
    half = 0.5 * float(dataset.attrs.get("joint_length", 0.0))
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    places = {
        f"top, z = {signed(half * 1e3)} mm": half,
        "middle": 0.0,
        f"bottom, z = {signed(-half * 1e3)} mm": -half,
    }
    motions = {name: _motion(dataset, z) for name, z in places.items()}
    tracks = (OrbitPath(name, _path(one, times, clearance), _at(one, times)) for name, one in motions.items())
    return [Orbit("trunnion", clearance, tuple(tracks))], ""


ORBIT: Final = OrbitView(
    name="orbit",
    title="The trunnion in its bushing",
    caption=(
        "Seen along the axis: the circle is the clearance, the marks are the top, middle and bottom of the "
        "trunnion axis now, the lines their paths. Beyond the circle the mean planes of the surfaces "
        "overlap. Angles at the wall are those of the pressure map."
    ),
    needs=("e_x", "e_y", "phi_x", "phi_y", "e_x_dot", "e_y_dot", "phi_x_dot", "phi_y_dot"),
    still="trajectory",
    orbits=_orbit,
    several=False,
)
