"""Figures of bushings: contact pressure, paths of shafts and worn depth."""

from functools import partial
from string import ascii_lowercase
from typing import Any, Final, TypeAlias

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import Colormap, LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon
from numpy.typing import NDArray

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.figures.chart import Family
from tribodyn.figures.style import GREY, SMALL, TEXT, caption, colour_bar, note, sheet
from tribodyn.views.bushing import WALL, Unrolled, unrolled
from tribodyn.views.bushing_sections import Orbit, OrbitPath, OrbitView
from tribodyn.views.playback import series, signed
from tribodyn.views.wear import WORN, fitting_unit

# White where there is nothing, then steadily darker: a grey print keeps the order.
COLOURS: Final[Colormap] = LinearSegmentedColormap.from_list(
    "tribodyn_load", ["#ffffff", "#fde0a6", "#f7a25c", "#d9513c", "#8f1d4f", "#2a0a3c"]
)


def draw_map(
    axes: Axes, laid: Unrolled, field: FloatArray, largest: float | None = None, level: float = 0.0
) -> QuadMesh:
    """Draw a field on the unrolled bushing.

    ``axes``: where to draw; ``field``: values in the unit of the colour bar, shape (n_theta, n_z);
    ``largest``: value of the darkest colour; by default the largest one; ``level``: value along which a line
    is drawn; 0 for none.
    """
    angle, heights, values = laid.angle, laid.heights, laid.turned(field)
    look: dict[str, Any] = {"shading": "gouraud", "cmap": COLOURS, "vmin": 0.0, "rasterized": True}
    mesh = axes.pcolormesh(angle, heights, values.T, vmax=largest, **look)
    if values.min() < level < values.max():
        axes.contour(angle, heights, values.T, levels=[level], colors=[GREY], linewidths=0.8)
    if laid.empty:
        low, high = laid.drawn([-laid.empty, laid.empty])
        axes.axhspan(
            low, high, facecolor="#f4f4f4", edgecolor="#cfcfcf", hatch="////", linewidth=0.0, zorder=2
        )
    turns, texts = laid.angle_ticks
    axes.set_xticks(turns[::2], texts[::2])
    axes.set_xticks(turns[1::2], minor=True)
    axes.set_yticks(*laid.height_ticks)
    # With room beyond the edges, so that what lies on them is seen.
    reach = 1.0 + _BEYOND
    axes.set(xlim=angle[[0, -1]], ylim=(reach * heights[0], reach * heights[-1]))
    for edge in heights[[0, -1]]:
        axes.axhline(edge, color=GREY, linewidth=0.8)
    axes.tick_params(which="both", labelsize=SMALL, color=GREY, length=2)
    axes.spines[:].set_visible(False)
    return mesh


_BEYOND: Final = 0.17  #: Room beyond the edges, over half of the height.
TITLE: Final = "Contact pressure on the unrolled bushing"
Panels: TypeAlias = NDArray[np.object_]
#: The contact zone is where the pressure exceeds this share of its peak; the share is ours.
CONTACT_ZONE: Final = 0.05


def draw(
    dataset: xr.Dataset, title: str = TITLE, theta: FloatArray | None = None, label: str = WALL
) -> Figure:
    """Draw the pressure [MPa] of each snapshot: forward motion at the left, reverse at the right.

    ``dataset``: a result with snapshots of the pressure; ``title``: title of the sheet; ``theta``, ``label``:
    angles of the nodes [rad], shape (n_theta,), and what the axis calls them; by default those of the
    bushing's wall.
    """
    figure = sheet(dataset, title, 6.2)
    places = _places(dataset)
    rows = max(3, 1 + max((row for row, _ in places), default=0))
    panels = figure.subplots(rows, 2, sharex=True, sharey=True, squeeze=False)
    pressure = np.nan_to_num(dataset["pressure"].values) * 1e-6
    largest = float(pressure.max(initial=0.0)) or 1.0
    laid = unrolled(dataset, pressure, theta=theta)
    for index, place in enumerate(places):
        level = CONTACT_ZONE * float(pressure[index].max())
        mesh = draw_map(panels[place], laid, pressure[index], largest, level)
        _describe(panels[place], dataset, laid.theta, index)
    _blank(panels, set(places))
    _label(panels, laid.label, label)
    if places:
        colour_bar(figure, mesh, panels, "contact pressure [MPa]", shrink=0.6)
    return figure


def _places(dataset: xr.Dataset) -> list[tuple[int, int]]:
    """Return row and column of each snapshot.

    Forward snapshots run down the left column, reverse ones up the right column, so that a row holds
    one vane position in both directions.
    """
    forward = series(dataset, "snapshot_direction") > 0.0
    rows = max(3, int(forward.sum()), int((~forward).sum()))
    down, up = iter(range(rows)), iter(range(rows - 1, -1, -1))
    return [(next(down), 0) if ahead else (next(up), 1) for ahead in forward]


def _describe(axes: Axes, dataset: xr.Dataset, theta: FloatArray, index: int) -> None:
    """Write above a map which vane position it is and where its peak lies."""
    field = np.nan_to_num(dataset["pressure"].values[index]) * 1e-6
    angle = float(np.rad2deg(dataset["snapshot_theta_v"].values[index]))
    at_theta, at_z = np.unravel_index(int(field.argmax()), field.shape)
    around = float(np.rad2deg(theta[at_theta])) % 360.0
    z = float(dataset["z"].values[at_z]) * 1e3
    caption(axes, f"({ascii_lowercase[index % 26]})  {angle:.1f}°")
    text = f"peak {field.max():.3g} MPa at {around:.0f}°, {signed(z)} mm"
    axes.text(1.0, 1.04, text, transform=axes.transAxes, ha="right", size=SMALL - 0.5, color=GREY)


def _blank(panels: Panels, used: set[tuple[int, int]]) -> None:
    """Say in the panels without a snapshot that it was not reached."""
    for place, axes in np.ndenumerate(panels):
        if place not in used:
            note(axes, "not reached in this run")
            axes.tick_params(labelsize=SMALL, color=GREY, length=3)
            axes.spines[:].set_color("#dddddd")


def _label(panels: Panels, z_text: str, label: str) -> None:
    """Write the axis labels at the outer panels, and the direction above the columns."""
    for axes in panels[:, 0]:
        axes.set_ylabel(z_text, size=TEXT)
    for axes in panels[-1]:
        axes.set_xlabel(label, size=TEXT)
    for axes, way in zip(
        panels[0], ("forward, vane angle growing", "reverse, vane angle falling"), strict=True
    ):
        axes.annotate(
            way,
            (0.5, 1.0),
            xycoords="axes fraction",
            xytext=(0, 20),
            textcoords="offset points",
            ha="center",
            size=TEXT,
            weight="bold",
        )


FAMILY: Final = Family(
    name="pressure",
    title=TITLE,
    caption=(
        "The bushing cut open and laid flat, one map for each vane position; grey lines enclose what lies "
        "above 5 % of the peak. Rows compare the two directions of motion at one vane angle."
    ),
    needs=("pressure", "theta", "z", "snapshot_theta_v", "snapshot_direction"),
    draw=draw,
)


WEAR_TITLE: Final = "Wear depth of the bushing"


def draw_wear(dataset: xr.Dataset) -> Figure:
    """Draw the depth on the unrolled bushing, and along its two edges and its middle."""
    figure = style.sheet(dataset, WEAR_TITLE, 4.6)
    plan, profile = figure.subplots(2, 1, sharex=True, height_ratios=(1.2, 1.0))
    depth = np.nan_to_num(dataset["wear_depth"].values)
    unit, size = fitting_unit(float(depth.max(initial=0.0)))
    depth = depth / size
    laid = unrolled(dataset, depth[None])
    mesh = draw_map(plan, laid, depth, float(depth.max(initial=0.0)) or 1.0)
    _profiles(profile, laid, depth)
    _key_result(plan, dataset, depth, unit)
    plan.set_ylabel(laid.label, size=style.TEXT)
    style.finish(profile, WALL, f"depth [{unit}]")
    style.colour_bar(figure, mesh, [plan, profile], f"wear depth [{unit}]", shrink=0.7)
    return figure


def _key_result(axes: Axes, dataset: xr.Dataset, depth: FloatArray, unit: str) -> None:
    """Write depth and number of cycles."""
    time, period = dataset["time"].values, dataset.attrs.get("cycle_period")
    after = f" after {np.ptp(time) / period:.3g} cycles" if period and time.size else ""
    if "wear_cycles_reached" in dataset.attrs:
        after = f" after {dataset.attrs['wear_cycles_reached']} cycles"
    style.caption(axes, f"deepest {depth.max(initial=0.0):.3g} {unit}{after}")


def _profiles(axes: Axes, laid: Unrolled, depth: FloatArray) -> None:
    """Draw the depth around the bushing at both edges and in the middle."""
    z, around = laid.z, laid.turned(depth)
    middle = int(np.argmin(np.abs(z)))
    curves = [
        (around[:, -1], f"top edge, z = {signed(z[-1])} mm", style.BLUE, style.SOLID),
        (around[:, middle], "middle", style.INK, style.DOTTED),
        (around[:, 0], f"bottom edge, z = {signed(z[0])} mm", style.VERMILION, style.DASHED),
    ]
    style.lines(axes, laid.angle, curves)
    axes.set_ylim(bottom=0.0)
    style.legend(axes, 3)


WEAR_FAMILY: Final = Family(
    name="wear_depth",
    title=WEAR_TITLE,
    caption=f"{WORN} Above: the bushing laid flat. Below: around its edges and its middle.",
    needs=("wear_depth", "theta", "z"),
    draw=draw_wear,
)


def family(view: OrbitView) -> Family:
    """Return the figure of orbits."""
    return Family(view.still, view.title, view.caption, view.needs, partial(draw_orbits, view))


def draw_orbits(view: OrbitView, dataset: xr.Dataset) -> Figure:
    """Draw the path of each point over the playback [µm]."""
    orbits, which = view.orbits(dataset)
    panels = [(orbit, track) for orbit in orbits for track in orbit.tracks]
    names = [orbit.name if len(orbit.tracks) == 1 else track.name for orbit, track in panels]
    figure, every = style.grid(dataset, f"{view.title}{which}", names, 2.9)
    for axes, name, panel in zip(every, names, panels, strict=False):
        _draw_track(axes, *panel)
        style.caption(axes, name)
    if not panels:
        style.note(every[0], "nothing computed")
    for axes in every:
        style.finish(axes, "X [µm]", "Y [µm]")
    return figure


def _draw_track(axes: Axes, orbit: Orbit, track: OrbitPath) -> None:
    """Draw the circle, named by the angles of maps of its wall, and one path with its first point."""
    reach = 1.1 * orbit.reach
    axes.set(aspect="equal", xlim=(-reach, reach), ylim=(-reach, reach))
    axes.plot(0.0, 0.0, "+", color=style.GREY, ms=7, mew=0.8)
    look: dict[str, Any] = {"fill": False, "edgecolor": style.GREY, "linewidth": 1.0}
    wall = Polygon(orbit.corners, **look) if orbit.corners else Circle((0.0, 0.0), orbit.clearance, **look)
    axes.add_patch(wall)
    for theta in () if orbit.corners else (0, 90, 180, 270):
        x, y = (1.12 * orbit.clearance * way(np.deg2rad(theta)) for way in (np.cos, np.sin))
        axes.text(x, y, f"{theta}°", size=style.SMALL - 1.5, color=style.GREY, ha="center", va="center")
    axes.plot(*track.path.T, color=style.BLUE, linewidth=0.8)
    axes.plot(*track.path[:1].T, "o", ms=4, mfc="white", mec=style.INK, mew=1.1, zorder=5)
