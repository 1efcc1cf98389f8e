"""Types of a family of figures and of moving pictures, and figures on disk."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import xarray as xr
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure

from tribodyn.core.arrays import FloatArray
from tribodyn.results.atomic import replacing
from tribodyn.views.gltf import Solid


@dataclass(frozen=True)
class Family:
    """One figure that can be drawn from any result holding what it needs."""

    name: str  #: File name without ``.png``.
    title: str  #: What it shows.
    caption: str  #: How to read it, in a sentence or two.
    needs: tuple[str, ...]  #: Names of the variables without which it is not drawn.
    #: Draws it. A result may be short, empty or hold NaN: what is there is drawn, and a note names the rest.
    draw: Callable[[xr.Dataset], Figure]
    #: Whether a result that holds them has something to show.
    shows: Callable[[xr.Dataset], bool] = lambda dataset: True
    #: Draws it over the angle of a joint; None where it has no time axis.
    over: Callable[[xr.Dataset, str], Figure] | None = None

    def drawable(self, dataset: xr.Dataset) -> bool:
        """Whether the result holds the variables this figure needs, and something to show in them."""
        return all(name in dataset.variables for name in self.needs) and self.shows(dataset)


class MovingFigure(Protocol):
    """A figure that changes with time."""

    figure: Figure

    def show(self, frame: int) -> None:
        """Draw the state at one of the times."""


@dataclass(frozen=True)
class Animation:
    """Motion of a mechanism, as a film and as solids in space."""

    film: Callable[[xr.Dataset, FloatArray], MovingFigure]  #: From a result and times [s], shape (n_t,).
    #: Likewise the bodies with their motion, and the axis of the drawing that points upwards.
    solids: Callable[[xr.Dataset, FloatArray], tuple[list[Solid], str]]


FORMATS = (".png", ".pdf")


def save(figure: Figure, folder: Path, name: str) -> Path:
    """Write a figure as PNG and as PDF with its text as text.

    ``figure``: drawn; its layout is fixed by saving it; ``folder``: where to write; must exist; ``name``:
    file name without ending. Returns the PNG file; the PDF is in the same folder.
    """
    path = folder / f"{name}.png"
    save_png(figure, path)
    # Arranging the parts of a figure takes longer than drawing it: once is enough.
    figure.set_layout_engine("none")
    with replacing(path.with_suffix(".pdf")) as part:
        # Without a date the same result gives the same file.
        FigureCanvasPdf(figure).print_pdf(part, metadata={"CreationDate": None})
    return path


def save_png(figure: Figure, path: Path) -> None:
    """Write a figure as PNG.

    ``figure``: drawn; ``path``: file to write; its folder must exist.
    """
    with replacing(path) as part:
        # Figure.savefig would draw it twice, the first time only to arrange its parts.
        FigureCanvasAgg(figure).print_png(part)


def remove(folder: Path, name: str) -> None:
    """Remove the files of a figure, as far as there are any."""
    for ending in FORMATS:
        (folder / f"{name}{ending}").unlink(missing_ok=True)
