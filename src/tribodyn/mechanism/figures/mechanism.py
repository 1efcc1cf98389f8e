"""The mechanism at some moments of its cycle, and the shapes of its lowest modes."""

from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

from mebdf.arrays import FloatArray
from tribodyn.figures.chart import Family
from tribodyn.figures.style import GREY, INK, PALE, SMALL, VERMILION, finish, note, sheet
from tribodyn.mechanism.assembly.skeleton import MM, Mark, Skeleton, case_of, outline_at, skeleton, view
from tribodyn.mechanism.sections.mechanism import at_frames

TITLE: Final = "The mechanism in its cycle"
#: Bodies up to which these and their joints are named: names of more would lie on each other.
_NAMED: Final = 16
_NODE: Final = ":"  #: Part of the names of nodes of an elastic body and of its pieces, which are not named.
_AWAY: Final = 9.0  #: Distance of a name from what it names [pt].
_CLOSE: Final = 0.1  #: Distance of joints over that of all below which their names stand above each other.
#: Share of a direction to the side from which a name begins or ends there, and is not centred.
_STEEP: Final = 0.5
_MOMENTS: Final = 8  #: Moments that are drawn, evenly over the playback, all but the first pale.


def draw(dataset: xr.Dataset) -> Figure:
    """Draw every body as lines between its joints [mm], at one moment and, pale, at others."""
    figure = sheet(dataset, TITLE, 4.2)
    axes = figure.subplots()
    axes.set_aspect("equal")
    axes.margins(0.12)
    case, motion = case_of(dataset), at_frames(dataset)
    if case is None or motion is None:
        note(axes, "nothing to draw")
        return figure
    drawn, (position, orientation) = skeleton(case), motion
    eye, up = view(MM * position.reshape(-1, 3))
    plane = paper(eye, up)
    first, *others = np.linspace(0, position.shape[0] - 1, _MOMENTS + 1).astype(int)[1:]
    for k in others:
        draw_at(axes, drawn, plane, position[k], orientation[k], PALE)
    draw_at(axes, drawn, plane, position[first], orientation[first], INK)
    draw_joints(axes, drawn, plane, position[first], orientation[first])
    finish(axes, *(direction(row) for row in plane))
    return figure


def paper(eye: FloatArray, up: FloatArray) -> FloatArray:
    """Return the directions to the right and upwards on paper, shape (2, 3)."""
    right = np.cross(up, eye)
    right /= np.linalg.norm(right)
    return np.array([right, np.cross(eye, right)])


def direction(row: FloatArray) -> str:
    """Return the label of an axis on paper: that of the drawing that it is, if it is one."""
    along = int(np.argmax(np.abs(row)))
    sign = "−" if row[along] < 0.0 else ""
    return f"{sign}{'xyz'[along]} [mm]" if abs(row[along]) > 0.999 else "[mm]"


def draw_at(
    axes: Axes, drawn: Skeleton, plane: FloatArray, position: FloatArray, orientation: FloatArray, colour: str
) -> None:
    """Draw elements and bodies at one moment; names in ink alone."""
    for outline in (*drawn.outlines, *drawn.springs):
        x, y = (outline_at(drawn, outline, position, orientation) @ plane.T).T
        axes.plot(x, y, color=GREY if colour == INK else PALE, linewidth=0.7)
    for body in range(len(drawn.bodies)):
        points = drawn.lines(body, position[body], orientation[body]) @ plane.T
        hub = points.mean(axis=0)
        for point in points if len(points) > 2 else points[:1]:
            other = hub if len(points) > 2 else points[1]
            axes.plot(*np.array([other, point]).T, color=colour, linewidth=1.8 if colour == INK else 1.0)
        if colour == INK and len(drawn.bodies) <= _NAMED and _NODE not in drawn.bodies[body]:
            centre = plane @ (MM * position.mean(axis=0))
            _name(axes, drawn.bodies[body], hub, _beside(points, hub - centre), GREY)


def _beside(points: FloatArray, outwards: FloatArray) -> FloatArray:
    """Return the direction across a body, away from the centre of all, in which its name stands."""
    x, y = points[-1] - points[0]
    length = np.hypot(x, y)
    if len(points) > 2 or length == 0.0:
        return np.array([0.5, -0.9])
    across = np.array([y, -x]) / length
    return np.asarray(-across if across @ outwards < 0.0 else across)


def _name(axes: Axes, text: str, place: FloatArray, towards: FloatArray, colour: str) -> None:
    """Write a name beside a place, above what is drawn there."""
    side = "center" if abs(towards[0]) < _STEEP else "left" if towards[0] > 0.0 else "right"
    axes.annotate(
        text,
        (place[0], place[1]),
        xytext=(_AWAY * towards[0], _AWAY * towards[1]),
        textcoords="offset points",
        size=SMALL,
        color=colour,
        ha=side,
        va="center",
        path_effects=[withStroke(linewidth=2.0, foreground="white")],
        zorder=5,
    )


def draw_joints(
    axes: Axes, drawn: Skeleton, plane: FloatArray, position: FloatArray, orientation: FloatArray
) -> None:
    """Draw the joints at one moment with their names."""
    there: dict[tuple[float, ...], list[Mark]] = {}
    for mark in drawn.marks:
        point = MM * mark.point
        if mark.body >= 0:
            point = drawn.moved(mark.point[None], mark.body, position[mark.body], orientation[mark.body])[0]
        there.setdefault(tuple((plane @ point).round(1)), []).append(mark)
    named: list[FloatArray] = []
    near = _CLOSE * float(np.max(np.ptp([*there], axis=0)))
    for (x, y), marks in there.items():
        rim = VERMILION if any(mark.real for mark in marks) else INK
        axes.plot(x, y, "o", ms=7, mfc="white", mec=rim, mew=1.4, zorder=4)
        names = ", ".join(mark.name for mark in marks if _NODE not in mark.name)
        if names and len(drawn.bodies) <= _NAMED:
            place = np.array([x, y])
            taken = any(np.hypot(*(place - other)) < near for other in named)
            _name(axes, names, place, np.array([0.7, 2.2 if taken else 1.0]), INK)
            named.append(place)


FAMILY: Final = Family(
    name="mechanism",
    title=TITLE,
    caption=(
        "Bodies as lines between their joints, to scale, early in the cycle shown and, pale, later in it. "
        "Joints with clearance have an orange rim."
    ),
    needs=("position", "orientation", "body", "joint"),
    draw=draw,
)


MODES: Final = "Shapes of the modes"
_DRAWN: Final = 3  #: Modes that are drawn, those of the lowest frequency.
_FAR: Final = 0.15  #: Largest displacement over the size of the mechanism, and largest turn [rad], as drawn.


def draw_modes(dataset: xr.Dataset) -> Figure:
    """Draw every body at rest, pale, and displaced by a mode, exaggerated."""
    figure = sheet(dataset, MODES, 3.4)
    case, modes = case_of(dataset), dataset.isel(time=slice(0, 1), mode=slice(0, _DRAWN))
    panels = figure.subplots(1, max(modes.sizes["mode"], 1), squeeze=False)[0]
    if case is None or modes["mode_shape"].size == 0:
        note(panels[0], "nothing to draw")
        return figure
    drawn, position, orientation = skeleton(case), *(modes[n].values[0] for n in ("position", "orientation"))
    lines = [drawn.lines(body, position[body], orientation[body]) for body in range(len(drawn.bodies))]
    plane, size = paper(*view(np.concatenate(lines))), np.ptp(np.concatenate(lines), axis=0).max() / MM
    for number, axes in enumerate(panels):
        way, turn = (modes[name].values[0, number] for name in ("mode_shape", "mode_rotation"))
        scale = _FAR / max(np.abs(way).max() / size, np.abs(turn).max())
        axes.set_aspect("equal")
        axes.margins(0.12)
        frequency = (
            f"mode {modes['mode'].values[number]}, {modes['natural_frequency'].values[0, number]:.4g} Hz"
        )
        draw_at(axes, drawn, plane, position, orientation, PALE)
        draw_at(axes, drawn, plane, position + scale * way, turned(orientation, scale * turn), INK)
        axes.set_title(frequency)
        finish(axes, *(direction(row) for row in plane))
    return figure


def turned(orientation: FloatArray, turn: FloatArray) -> FloatArray:
    """Return quaternions (n, 4) after small turns about global axes [rad], shape (n, 3)."""
    w, v = orientation[:, :1], orientation[:, 1:]
    found = np.hstack(
        [w - 0.5 * np.sum(turn * v, axis=1, keepdims=True), v + 0.5 * (w * turn + np.cross(turn, v))]
    )
    return np.asarray(found / np.linalg.norm(found, axis=1, keepdims=True))


MODE_SHAPES: Final = Family(
    name="mode_shapes",
    title=MODES,
    caption="Bodies at the first position at rest, pale, and displaced by the lowest modes, magnified.",
    needs=("mode_shape", "mode_rotation", "natural_frequency", "mode", "position", "orientation"),
    draw=draw_modes,
)
