"""A figure on disk: PNG to look at, PDF for a paper."""

from __future__ import annotations

from pathlib import Path

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure

from tribodyn.results.atomic import replacing

FORMATS = (".png", ".pdf")


def save(figure: Figure, folder: Path, name: str) -> Path:
    """Write a figure as PNG and as PDF with its text as text.

    Parameters
    ----------
    figure
        Drawn; its layout is fixed by saving it.
    folder
        Where to write; must exist.
    name
        File name without ending.

    Returns
    -------
    pathlib.Path
        The PNG file; the PDF is in the same folder.
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

    Parameters
    ----------
    figure
        Drawn.
    path
        File to write; its folder must exist.
    """
    with replacing(path) as part:
        # Figure.savefig would draw it twice, the first time only to arrange its parts.
        FigureCanvasAgg(figure).print_png(part)


def remove(folder: Path, name: str) -> None:
    """Remove the files of a figure, as far as there are any."""
    for ending in FORMATS:
        (folder / f"{name}{ending}").unlink(missing_ok=True)
