"""Sections on the joints: forces, the motion in the clearance, pressure and wear, joint by joint."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray, IntArray
from tribodyn.joints.point_contact import Cornered
from tribodyn.mechanism.assembly.skeleton import case_of
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.sections.charts import Shafts
from tribodyn.mechanism.shapes import SHAPES
from tribodyn.views.bushing import Unrolled, best_cut, shares
from tribodyn.views.bushing_sections import Orbit, OrbitPath, OrbitView
from tribodyn.views.charts import LOOKS, ChartCurve, Panel, over, over_time
from tribodyn.views.numbers import fitting
from tribodyn.views.playback import peak, playback_times
from tribodyn.views.section import Payload, Section, choice
from tribodyn.views.wear import WORN, fitting_unit

MOST: Final = 8  #: Joints that are shown one by one; of more, those that are loaded most.
_AXES: Final = "xyz"
_LINE: Final = 1.0e-3  #: Range of a force across its line, over its size, up to which it keeps its direction.
LAID_FLAT: Final = (
    "Surfaces cut open and laid flat: the angle about the axis of the joint, and height, radius of a face, "
    "or arc of a ball."
)


@dataclass(frozen=True)
class Detailed:
    """The joints that a large mechanism is shown by."""

    joints: list[int]  #: Their numbers, in the order of the case.
    of: int  #: How many there are of their kind.
    by: str  #: What is largest in these.

    @property
    def which(self) -> str:
        """Say that others are left out, as an addition to a title; nothing where none are."""
        left_out = len(self.joints) < self.of
        return f", {len(self.joints)} joints of {self.of} with the largest {self.by}" if left_out else ""


def real_joints(dataset: xr.Dataset) -> Detailed:
    """Return the joints with clearance, of many those that are pressed hardest."""
    real = np.flatnonzero(np.isfinite(dataset["clearance"].values))
    pressure = (
        dataset["pressure_max"].values if "pressure_max" in dataset else np.zeros((1, dataset.sizes["joint"]))
    )
    return _largest(real, np.nan_to_num(pressure).max(axis=0, initial=0.0), "pressures")


def loaded_joints(dataset: xr.Dataset) -> Detailed:
    """Return the joints, of many those that carry most."""
    force = np.linalg.norm(np.nan_to_num(dataset["reaction_force"].values), axis=-1).max(axis=0, initial=0.0)
    return _largest(np.arange(force.size), force, "forces")


def _largest(joints: IntArray, values: FloatArray, by: str) -> Detailed:
    order = np.argsort(-values[joints], kind="stable")[:MOST]
    return Detailed(np.sort(joints[order]).tolist(), joints.size, by)


def _names(dataset: xr.Dataset) -> list[str]:
    return [str(name) for name in dataset["joint"].values]


def reactions(dataset: xr.Dataset) -> Payload | None:
    """Return force and moment of joints over time, in their own axes."""
    force, moment = dataset["reaction_force"].values, dataset["reaction_moment"].values
    names, chosen = _names(dataset), loaded_joints(dataset)
    parts = {
        names[j]: over_time(
            dataset, [_vector("force [N]", force[:, j]), _vector("moment [N m]", moment[:, j])]
        )
        for j in chosen.joints
    }
    return choice("lines", f"joint{chosen.which}", parts)


def _vector(label: str, values: FloatArray) -> Panel:
    curves = [
        ChartCurve(axis, values[:, i], colour, dash)
        for i, (axis, (colour, dash)) in enumerate(zip(_AXES, LOOKS, strict=False))
    ]
    return Panel(label, curves)


@dataclass(frozen=True)
class Hodograph:
    """Path of the end of a force vector in a plane."""

    joint: str  #: Name.
    values: FloatArray  #: Components of the force in a unit that fits, shape (2, n_t).
    labels: tuple[str, str]  #: Of the axes.


def hodograph(dataset: xr.Dataset, joint: int) -> Hodograph | None:
    """Return the path of the force in a joint in the two of its axes along which it changes most."""
    force = dataset["reaction_force"].values[:, joint]
    if len(force) < 3:
        return None
    spread = np.ptp(np.nan_to_num(force[1:]), axis=0)
    axes = np.sort(np.argsort(-spread, kind="stable")[:2])
    unit, factor = fitting("N", [peak(force)])
    if np.min(spread[axes]) <= _LINE * peak(force):
        return None
    labels = [f"force along {_AXES[axis]} [{unit}]" for axis in axes]
    return Hodograph(_names(dataset)[joint], factor * force[1:, axes].T, (labels[0], labels[1]))


def hodographs(dataset: xr.Dataset) -> Payload | None:
    """Return the paths of the forces of joints."""
    chosen, parts = loaded_joints(dataset), {}
    for joint in chosen.joints:
        if (one := hodograph(dataset, joint)) is not None:
            panel = Panel(one.labels[1], [ChartCurve(one.joint, one.values[1], "blue", x=one.values[0])])
            parts[one.joint] = over(one.values[0], one.labels[0], [panel], equal=True)
    return choice("lines", f"joint{chosen.which}", parts)


def room_of(case: MechanismCase | None, joint: int, reach: float) -> FloatArray:
    """Return the corners of the room between walls or pads over the clearance, (n, 2); none in a bore."""
    keys = None if case is None else list(case.joints.values())[joint]
    if keys is None or keys.real is None:
        return np.zeros((0, 2))
    shape = SHAPES[keys.shape].of(keys.real, np.asarray)
    room = shape.room() / shape.clearance if isinstance(shape, Cornered) else np.zeros((0, 2))
    # A pin is free along itself: the room goes as far as its reach over the clearance.
    return room * [max(1.1 * reach, 1.0), 1.0] if keys.type == "slot" else room


def orbits(dataset: xr.Dataset) -> tuple[list[Orbit], str]:
    """Return the places of the shafts of joints with clearance, across their axes, and which joints."""
    times = playback_times(dataset)
    if times.size < 2:
        return [], ""
    names, chosen, shafts = _names(dataset), real_joints(dataset), Shafts(dataset, case_of(dataset))
    clearance = 1e6 * dataset["clearance"].values
    found = []
    for j in chosen.joints:
        path, at = (1e6 * x[:, :2] for x in (shafts.path(j), shafts.at(j, times)))
        room = clearance[j] * room_of(shafts.case, j, float(np.abs(path[:, 0]).max()) / clearance[j])
        found.append(Orbit(names[j], float(clearance[j]), (OrbitPath("shaft", path, at),), room.tolist()))
    return found, chosen.which


@dataclass(frozen=True)
class SurfaceMap:
    """A field on the surfaces of joints, or of their films, cut open and laid flat."""

    variable: str  #: Name of the field in a result.
    #: Names of its section and of its figure.
    name: str
    figure: str
    #: What it is, and how to read it.
    label: str
    caption: str
    per: str  #: Name of the dimension that counts its surfaces.
    #: Whether it is one for each frame, a pressure [MPa]; otherwise a depth in a unit that fits.
    moving: bool

    @property
    def heading(self) -> str:
        """Title of the figure, which shows the largest values of those of all frames."""
        title = self.section.title
        return f"{title}, largest in the cycle" if self.moving else title

    def unit(self, largest: float) -> tuple[str, float]:
        """Return name and size [SI] of the unit in which values up to ``largest`` are shown."""
        return ("MPa", 1e6) if self.moving else fitting_unit(largest)

    @property
    def section(self) -> Section:
        """The field on a page, frame by frame."""
        return Section(
            name=self.name,
            title=self.label.capitalize(),
            caption=self.caption,
            needs=(self.variable, *(("frame_time",) if self.moving else ()), self.per),
            widget="choice",
            data=self._payload,
            still=self.figure,
        )

    def _payload(self, dataset: xr.Dataset) -> Payload | None:
        """Return maps of surfaces that are not empty; colours reach 1.6 times the median peak of frames."""
        if self.moving and dataset[self.variable].shape[0] < 2:
            return None
        parts: dict[str, Any] = {}
        room = 1.6 if self.moving else 1.0
        for surface, place, theta, fields in surfaces(dataset, self.variable):
            largest = float(fields.max(initial=0.0))
            if not largest > 0.0:
                continue
            unit, size = self.unit(largest)
            parts[surface] = laid_flat(place, theta, fields).payload(
                fields / size, self.label, unit, lambda peaks: room * float(np.median(peaks[peaks > 0.0]))
            )
        return choice("field", f"surface{real_joints(dataset).which}", parts)


def laid_flat(place: FloatArray, theta: FloatArray, fields: FloatArray) -> Unrolled:
    """Return a surface with rows at places [m] and columns at angles [rad], cut where they are small."""
    middle = 0.5e3 * float(place[0] + place[-1])
    return Unrolled(theta, place * 1e3 - middle, best_cut(theta, shares(fields)), 0.0, middle)


def surfaces(dataset: xr.Dataset, name: str) -> Iterator[tuple[str, FloatArray, FloatArray, FloatArray]]:
    """Yield name, places of rows [m], angles [rad] and a field, shape (n, n_theta, n_rows), of the surfaces.

    Of many joints, those of the joints that are pressed hardest.
    """
    names = _names(dataset)
    chosen = [names[j] for j in real_joints(dataset).joints]
    if "film" in dataset[name].dims:
        theta = dataset["film_angle"].values
        for k, film in enumerate(dataset["film"].values):
            if str(film) in chosen:
                field = np.nan_to_num(dataset[name].isel(film=k).values)
                yield f"{film}:film", dataset["film_place"].values[k], theta, field
        return
    for k, surface in enumerate(dataset["surface"].values):
        if str(surface).rpartition(":")[0] not in chosen:
            continue
        field = np.nan_to_num(dataset[name].isel(surface=k).values)
        field = field if field.ndim == 3 else field[None]
        place, theta = dataset["row_place"].values[k], dataset["column_angle"].values[k]
        rows, columns = np.append(True, np.diff(place) > 0.0), np.append(True, np.diff(theta) > 0.0)
        if np.count_nonzero(rows) > 1:
            own = field[:, rows][:, :, columns]
            yield str(surface), place[rows], theta[columns], own.transpose(0, 2, 1)


HODOGRAPHS: Final = Section(
    name="hodographs",
    title="Direction of the force in a joint",
    caption="Path of the end of the force vector on the shaft's body, in two axes of the joint.",
    needs=("reaction_force", "joint"),
    widget="choice",
    data=hodographs,
    still="hodographs",
)
REACTIONS: Final = Section(
    name="reactions",
    title="Force and moment of a joint",
    caption="Force and moment on the shaft's body, along and about the axes of the joint: z is its axis.",
    needs=("reaction_force", "reaction_moment", "joint"),
    widget="choice",
    data=reactions,
)
ORBITS: Final = OrbitView(
    name="orbits",
    title="Shafts in their bores",
    caption=(
        "Seen along the axis of the joint, X and Y are its axes x and y. The circle is the clearance, of a "
        "guide or pads the area they leave; the mark is the centre of the shaft now, the line its path. "
        "Beyond it the mean planes of the surfaces overlap."
    ),
    needs=("displacement", "clearance", "joint", "surface"),
    still="orbits",
    orbits=orbits,
)
PRESSURE: Final = SurfaceMap(
    "pressure_cycle", "pressure", "pressure_maps", "contact pressure", LAID_FLAT, "surface", moving=True
)
FILM_PRESSURE: Final = SurfaceMap(
    "film_pressure_cycle",
    "film_pressure",
    "film_maps",
    "film pressure",
    "Oil films cut open and laid flat: the angle about the axis of the joint, and the height.",
    "film",
    moving=True,
)
WEAR: Final = SurfaceMap("wear_depth", "wear", "wear_maps", "wear depth", WORN, "surface", moving=False)
MAPS: Final = (PRESSURE, FILM_PRESSURE, WEAR)  #: Maps of surfaces, on a page and as figures.
