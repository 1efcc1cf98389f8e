"""Types of sections and chapters of the report; angles of joints that charts are drawn over."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, TypeAlias

import numpy as np

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant
from tribodyn.views.encode import stepped
from tribodyn.views.playback import series

if TYPE_CHECKING:
    import xarray as xr

    from mebdf.arrays import FloatArray


#: Data for the script of a figure: texts, numbers, lists, mappings and arrays.
Payload: TypeAlias = Mapping[str, Any]


@dataclass(frozen=True)
class Section:
    """One figure of the page, drawn in the browser from data that travel with it."""

    name: str  #: Identifier in the page, unique among the sections of a page.
    title: str  #: What it shows.
    caption: str  #: How to read it, in a sentence or two.
    #: Names of the variables without which it is left out; the page says that they are its data.
    needs: tuple[str, ...]
    widget: str  #: Which script draws it: a name in ``widgets`` of ``assets``.
    #: Returns what the script reads, or nothing where the result does not hold enough to draw.
    data: Callable[[xr.Dataset], Payload | None]
    #: Name of the figure in ``figures/`` that stands for it on paper and where scripts do not run.
    still: str = ""

    def payload(self, dataset: xr.Dataset) -> Payload | None:
        """Return the data of the script; nothing where the result does not hold it."""
        if any(name not in dataset.variables for name in self.needs):
            return None
        return self.data(dataset)


@dataclass(frozen=True)
class Chapter:
    """Sections under one heading."""

    name: str  #: Identifier in the page.
    title: str  #: Heading; also its entry in the table of contents.
    lead: str  #: A sentence below the heading.
    sections: tuple[Section, ...]  #: In reading order.
    playback: bool = False  #: Whether the sections follow the time slider, which then stands with them.


#: Lead of a chapter of charts.
OVER_TIME: Final = (
    "Drag across a plot to zoom. By keyboard: go to a plot with Tab, then +, −, arrows, and 0 for the whole."
)


def choice(widget: str, label: str, parts: Mapping[str, Payload | None]) -> Payload | None:
    """Return the data of the script ``choice``; nothing where there is nothing to choose.

    ``widget``: script that draws each of them; ``label``: what is chosen; ``parts``: what that script reads,
    by name.
    """
    there = {name: part for name, part in parts.items() if part is not None}
    if not there:
        return None
    return {"widget": widget, "label": label, "names": list(there), "parts": list(there.values())}


_MOST: Final = 6  #: Joints over whose angle a reader may have charts.
_FINE: Final = 0.02  #: Rounding of such an angle on a page [deg].
_LEAST: Final = 1.0  #: Range of an angle over which a chart is of use [deg].


def angle_of(dataset: xr.Dataset, joint: str) -> tuple[str, FloatArray]:
    """Return label and values of a joint's angle within one turn [deg], NaN where a turn ends.

    Of a slide that is driven it is the position [mm].

    Raises InputError if there is no such joint.
    """
    names = [str(name) for name in dataset["joint"].values] if "joint_angle" in dataset else []
    if joint not in names:
        words = f"{as_given(joint)}; allowed: a joint, {', '.join(names) or 'none here'}{meant(joint, names)}"
        raise InputError(words, key="over")
    label, values = _coordinates(dataset)[names.index(joint)]
    if label.startswith("angle") and np.ptp(values) > 360.0:
        values = values % 360.0
        values[1:][np.abs(np.diff(values)) > 180.0] = np.nan
    return label, values


def _coordinates(dataset: xr.Dataset) -> list[tuple[str, FloatArray]]:
    """Return label and values of the coordinate of each joint: position of a driven slide, or angle."""
    names, angles = dataset["joint"].values, dataset["joint_angle"].values
    found = [(f"angle of {name} [°]", np.degrees(angles[:, k])) for k, name in enumerate(names)]
    if "displacement" in dataset:
        places = dataset["displacement"].values
        for k in np.flatnonzero(np.nan_to_num(dataset["drive_force"].values).any(axis=0)):
            found[k] = f"position of {names[k]} [mm]", 1e3 * places[:, k, 2]
    return found


def coordinates(dataset: xr.Dataset, scale: float) -> list[dict[str, Any]]:
    """Return coordinates of joints over time, those of driven joints first, as the page reads them.

    ``scale``: of the times of the page.
    """
    if "joint_angle" not in dataset or "drive_moment" not in dataset:
        return []
    labels, columns = zip(*_coordinates(dataset), strict=True)
    values, time, names = np.stack(columns, axis=1), series(dataset, "time", scale), dataset["joint"].values
    efforts = (np.nan_to_num(np.abs(dataset[name].values)) for name in ("drive_moment", "drive_force"))
    driven = sum(efforts).max(axis=0) > 0.0
    order = np.lexsort((-np.ptp(values, axis=0), ~driven))
    chosen = [k for k in order.tolist() if np.ptp(values[:, k]) > _LEAST][:_MOST]
    return [
        {
            "name": str(names[k]),
            "label": labels[k],
            "x": stepped(time, 0.0),
            "y": stepped(values[:, k], _FINE),
        }
        for k in chosen
    ]
