"""Figures of studies: distributions over builds, and the shares of joints in the error of an output."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from mebdf.arrays import FloatArray
from tribodyn.figures import style

_BINS = 80
_HEIGHT = 2.1


#: A number over builds: words for it, with its unit; its quantiles, the median first; values of builds drawn,
#: and of builds simulated as a whole.
OverBuilds: TypeAlias = tuple[str, FloatArray, FloatArray, FloatArray]


def draw(numbers: Sequence[OverBuilds], title: str) -> Figure:
    """Draw the histogram of each number, its quantiles as lines, and builds as a whole as marks."""
    figure = style.sheet(xr.Dataset(attrs={"title": title}), "Builds", 0.8 + _HEIGHT * len(numbers))
    places = figure.subplots(len(numbers), 1, squeeze=False)[:, 0]
    for axes, (name, quantiles, drawn, together) in zip(places, numbers, strict=True):
        axes.hist(drawn, bins=_BINS, density=True, color=style.BLUE, alpha=0.5, label="builds drawn")
        for place, value in enumerate(quantiles):
            label = "median, 90, 99 and 99.7 %" if place == 0 else "_"
            axes.axvline(
                float(value), color=style.INK, lw=0.9, ls=style.DASHED if place else style.SOLID, label=label
            )
        if together.size:
            marks = dict(color=style.VERMILION, ms=5.0, clip_on=False)
            axes.plot(together, 0.0 * together, "|", label="builds as a whole", **marks)
        style.finish(axes, name, "density")
        style.legend(axes, 3)
    return figure


#: Part of the error that joints cause only together, in the place of a joint.
TOGETHER: Final = "only together"
_COLOURS: Final = (style.ORANGE, style.GREEN, style.PURPLE, style.VERMILION)
_ROOM: Final = 1.25  #: Height of title, axis and legend [in].
_ROW: Final = 0.34
_THICK: Final = 0.36


@dataclass(frozen=True)
class Shares:
    """Data of the picture of one output's error."""

    #: Of the figure, and the title of the case.
    title: str
    case: str
    joints: tuple[str, ...]  #: Names, n of them.
    simulated: FloatArray  #: Share of each joint [1], shape (n,).
    interaction: float  #: Share that joints cause only together [1].
    #: Share of each joint and cause by superposition [1], shape (n, m); (n, 0) without one.
    estimate: FloatArray
    causes: tuple[str, ...]  #: Names of the causes, m of them.


def draw_shares(shares: Shares) -> Figure:
    """Draw the joints with the largest share on top, and what they cause only together below."""
    order = np.argsort(-shares.simulated, kind="stable")
    names = [*(shares.joints[k] for k in order), TOGETHER]
    figure = style.sheet(
        xr.Dataset(attrs={"title": shares.case}), shares.title, _ROOM + _ROW * len(names) * 1.6
    )
    axes = figure.add_subplot()
    rows = np.arange(len(names), dtype=np.float64)
    values = 100.0 * np.append(shares.simulated[order], shares.interaction)
    known = shares.estimate.shape[1] > 0
    offset = 0.5 * _THICK if known else 0.0
    bars = axes.barh(rows - offset, values, height=_THICK, color=style.BLUE, label="simulation")
    axes.bar_label(bars, fmt="%.1f %%", padding=3, size=style.SMALL)
    left = np.zeros((2, len(order)))
    parts = 100.0 * shares.estimate[order].T
    for cause, part, colour in zip(shares.causes, parts, _COLOURS[: len(parts)], strict=True):
        side = left[(part < 0.0).astype(int), np.arange(part.size)]
        axes.barh(rows[:-1] + offset, part, _THICK, left=side, color=colour, label=cause)
        left += np.stack([np.maximum(part, 0.0), np.minimum(part, 0.0)])
    axes.axvline(0.0, color=style.INK, lw=0.8)
    axes.set_yticks(rows, [style.plain(name) for name in names])
    axes.invert_yaxis()
    axes.use_sticky_edges = False
    axes.margins(x=0.12, y=0.03)
    causes = "; causes by superposition" if known else ""
    style.finish(axes, f"share of the mean square error [%]{causes}")
    style.legend(axes, 1 + len(shares.causes))
    return figure
