"""Journal: where its centre goes inside the clearance circle, law beside law."""

from __future__ import annotations

from typing import Final

import numpy as np
import xarray as xr

from tribodyn.figures.journal import laws, of_law
from tribodyn.figures.style import peak, series
from tribodyn.report.base import Payload, Section
from tribodyn.report.encode import packed
from tribodyn.report.film import film_times
from tribodyn.report.sections.journal_curves import LAWS

_SYMBOLS: Final = ("circle", "square", "diamond")


def data(dataset: xr.Dataset) -> Payload | None:
    """Return paths and positions at the frames [µm], one for each law."""
    times, time = film_times(dataset), series(dataset, "time")
    names = laws(dataset)
    if times.size < 2 or not names:
        return None
    clearance = float(dataset.attrs.get("clearance", 0.0)) * 1e6
    paths = [tuple(of_law(dataset, axis, k, 1e6) for axis in ("e_x", "e_y")) for k in range(len(names))]
    reach = max(clearance, *(peak(values) for path in paths for values in path), 1e-3)
    return {
        "clearance": clearance,
        "reach": 1.25 * reach,
        "joined": False,
        "looks": [_look(k) for k in range(len(names))],
        "places": names,
        "paths": [{"x": packed(x), "y": packed(y)} for x, y in paths],
        "at": [
            {axis: packed(np.interp(times, time, values)) for axis, values in zip("xy", path, strict=True)}
            for path in paths
        ],
    }


def _look(law: int) -> dict[str, str]:
    """Return colour, dash and mark of a law: the colours are those of its curves."""
    colour, dash = LAWS[law % len(LAWS)]
    return {"colour": colour, "dash": dash, "symbol": _SYMBOLS[law % len(_SYMBOLS)]}


SECTION: Final = Section(
    name="path",
    title="The journal in its clearance",
    caption=(
        "The circle is the clearance, the marks are the centre of the journal now, one for each contact law, "
        "the lines its paths. Beyond the circle the mean planes of the surfaces overlap."
    ),
    needs=("e_x", "e_y"),
    widget="orbit",
    data=data,
    still="journal_orbit",
)
