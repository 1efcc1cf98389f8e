"""Style of figures: colours, sizes and the small parts every family uses.

Nothing here touches matplotlib's global state: no pyplot, no rcParams, so that figures can be drawn from a
thread, a test or a notebook without changing what the user set up there.
"""

from collections.abc import Sequence
from typing import Any, Final, Literal, TypeAlias

import xarray as xr
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure
from matplotlib.legend import Legend

from mebdf.arrays import FloatArray
from tribodyn.views.playback import finite

INK: Final = "#1b1b1b"
BLUE: Final = "#0072b2"
VERMILION: Final = "#d55e00"
GREEN: Final = "#009e73"
ORANGE: Final = "#e69f00"
PURPLE: Final = "#a6568a"
GREY: Final = "#767676"
PALE: Final = "#c9c9c9"
# Okabe and Ito's colours (https://jfly.uni-koeln.de/color/): distinct for colour-blind readers. Every line
# has its own dash pattern beside its colour, so that a grey print still distinguishes them.
LineStyle: TypeAlias = str | tuple[float, tuple[float, ...]]
SOLID: Final[LineStyle] = "-"
DASHED: Final[LineStyle] = (0, (5, 1.8))
DOTTED: Final[LineStyle] = (0, (1.2, 1.4))
DASHDOT: Final[LineStyle] = (0, (6, 1.6, 1.2, 1.6))

#: Curves as (values, label, colour, dash pattern).
Curves: TypeAlias = list[tuple[FloatArray, str, str, LineStyle]]

WIDTH: Final = 7.6  #: Width of a figure [in].
DPI: Final = 150
TEXT: Final = 9.0
SMALL: Final = 8.0
_ACROSS: Final = 3  #: Panels beside each other; one less where their names are long.
_LONG: Final = 18
_FACT: Final = 60  #: Characters of a fact about a run that stand below a title.


def sheet(dataset: xr.Dataset, title: str, height: float, width: float = WIDTH) -> Figure:
    """Return an empty figure with its title and the name of the run.

    ``dataset``: a result; gives the run's title and whether it was completed; ``title``: what the figure
    shows; ``height``, ``width``: size [in].
    """
    figure = Figure(figsize=(width, height), dpi=DPI, layout="constrained", facecolor="white")
    FigureCanvasAgg(figure)
    figure.get_layout_engine().set(w_pad=0.06, h_pad=0.05, rect=(0.0, 0.0, 1.0, 1.0 - 0.42 / height))  # type: ignore[union-attr, call-arg]
    margin = 0.07 / width
    figure.text(margin, 1.0 - 0.08 / height, title, va="top", size=11.5, weight="bold", color=INK)
    figure.text(margin, 1.0 - 0.29 / height, subtitle(dataset), va="top", size=SMALL, color=GREY)
    if dataset.attrs.get("failure"):
        _mark_partial(figure, dataset, height)
    return figure


def grid(dataset: xr.Dataset, title: str, names: Sequence[str], height: float) -> tuple[Figure, list[Axes]]:
    """Return a sheet of panels of a height [in] for names, those that nothing is drawn in taken away."""
    n, longest = max(len(names), 1), max(map(len, names), default=0)
    columns = min(n, _ACROSS - (longest > _LONG))
    rows = -(-n // columns)
    figure = sheet(dataset, title, 0.5 + height * rows)
    panels = figure.subplots(rows, columns, squeeze=False).ravel()
    for axes in panels[n:]:
        axes.remove()
    return figure, list(panels[:n])


def subtitle(dataset: xr.Dataset) -> str:
    """Return one line that names the run; dollar signs are kept as they are."""
    facts = [str(dataset.attrs.get("title", ""))]
    if "clearance" in dataset.attrs:
        facts.append(f"clearance {dataset.attrs['clearance'] * 1e6:.4g} µm")
    if "contact_law" in dataset.attrs:
        facts.append(f"{str(dataset.attrs['contact_law']).upper()} contact")
    if "formulation" in dataset.attrs:
        facts.append(f"{dataset.attrs['formulation']} formulation")
    return plain(" · ".join(fact[:_FACT] for fact in facts if fact))


def plain(text: str) -> str:
    """Return a text that matplotlib prints as it is, without reading mathematics into it."""
    return text.replace("$", r"\$")


def _mark_partial(figure: Figure, dataset: xr.Dataset, height: float) -> None:
    """Say on the figure that the run stopped midway."""
    time = dataset["time"].values
    end = f" at t = {time[-1]:.4g} s" if time.size else " at its start"
    box = {"boxstyle": "round,pad=0.25", "facecolor": "#fff1e6", "edgecolor": VERMILION, "linewidth": 0.8}
    figure.text(
        1.0 - 0.12 / figure.get_figwidth(),
        1.0 - 0.08 / height,
        f"partial run, stopped{end}",
        ha="right",
        va="top",
        size=SMALL,
        color=INK,
        bbox=box,
    )


def finish(axes: Axes, x_label: str = "", y_label: str = "") -> None:
    """Give axes their labels, light grid and quiet frame."""
    axes.set_xlabel(x_label, size=TEXT, color=INK)
    axes.set_ylabel(y_label, size=TEXT, color=INK)
    axes.tick_params(labelsize=SMALL, color=GREY, labelcolor=INK, length=3)
    axes.grid(True, color="#e6e6e6", linewidth=0.6)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    axes.spines[["left", "bottom"]].set_color(GREY)


def caption(axes: Axes, text: str, side: Literal["left", "right"] = "left") -> None:
    """Write a short heading above axes, flush with one side."""
    axes.set_title(text, loc=side, size=TEXT, color=INK, pad=5)


def legend(axes: Axes, columns: int, **options: Any) -> Legend:
    """Put a frameless legend above axes, at the right, where it hides no line."""
    return axes.legend(
        loc="lower right",
        bbox_to_anchor=(1.0, 1.0),
        ncols=columns,
        frameon=False,
        fontsize=SMALL,
        handlelength=2.6,
        columnspacing=1.4,
        borderaxespad=0.1,
        **options,
    )


def legend_below(figure: Figure, axes: Axes, columns: int) -> None:
    """Put the frameless legend of one panel below all of them."""
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=columns, frameon=False, fontsize=SMALL)


def legend_beside(axes: Axes) -> Legend:
    """Put a frameless legend beside axes, on the right."""
    return axes.legend(
        loc="upper left", bbox_to_anchor=(1.0, 1.05), frameon=False, fontsize=SMALL, borderaxespad=0.2
    )


def colour_bar(
    figure: Figure, mesh: ScalarMappable, axes: Any, label: str, *, shrink: float = 0.9, **options: Any
) -> None:
    """Put the scale of colours beside axes, one or several."""
    bar = figure.colorbar(mesh, ax=axes, shrink=shrink, aspect=26, pad=0.02, **options)
    bar.set_label(label, size=TEXT)
    bar.ax.tick_params(labelsize=SMALL)
    bar.outline.set_visible(False)


def note(axes: Axes, text: str) -> None:
    """Write a note into the middle of axes that have nothing to show."""
    axes.text(0.5, 0.5, text, transform=axes.transAxes, ha="center", va="center", size=TEXT, color=GREY)


def lines(axes: Axes, x: FloatArray, curves: Curves, width: float = 1.3) -> None:
    """Draw curves over ``x``; say so when there is nothing to draw."""
    for values, label, colour, dash in curves:
        # A run of one sample draws no line: mark it.
        marker = "o" if finite(values).size == 1 else ""
        axes.plot(x, values, label=label, color=colour, linestyle=dash, linewidth=width, marker=marker, ms=3)
    if not any(finite(values).size for values, *_ in curves):
        note(axes, "nothing computed")
