"""The figures of a result as files, and a result as a film or as moving solids: GIF, MP4 or glTF."""

from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given
from tribodyn.figures import sweep
from tribodyn.figures.chart import Animation, Family, remove, save
from tribodyn.mechanisms.results import all_there, mechanism_of
from tribodyn.results.store import write_bytes
from tribodyn.views.playback import playback_times


def figures_of(dataset: xr.Dataset) -> Mapping[str, Family]:
    """Return the figures that may be drawn of a result: those of a run, or of a sweep one for each number."""
    if dataset.attrs.get("kind") == "sweep":
        return sweep.families(dataset)
    return mechanism_of(dataset).figures


def draw_all(dataset: xr.Dataset, directory: str | Path, *, part: slice = slice(None)) -> list[Path]:
    """Draw every figure that the result holds the data for, as PNG and as PDF.

    Parameters
    ----------
    dataset
        A result, whole or partial.
    directory
        Folder to write to; made if missing. A figure left by an earlier result that this one cannot
        show is removed.
    part
        Which of them: processes that share the work take every other one.

    Returns
    -------
    list of pathlib.Path
        The PNG files written, in reading order; the PDF of each is in the same folder.
    """
    folder = Path(directory)
    folder.mkdir(parents=True, exist_ok=True)
    written = []
    for family in list(figures_of(dataset).values())[part]:
        if family.drawable(dataset):
            with all_there(dataset):
                written.append(save(family.draw(dataset), folder, family.name))
        else:
            remove(folder, family.name)
    return written


_PER_SECOND: Final = 20  #: Frames in a second of film.
_LONGEST: Final = 120.0
_DPI: Final = 100
_WRITERS: Final = {".gif": "pillow", ".mp4": "ffmpeg"}
_SOLIDS: Final = ".glb"


def animate(dataset: xr.Dataset, path: Path, seconds: float) -> Path:
    """Write the last cycle of a result as a film, or as solids that move.

    ``dataset``: a result of a mechanism that can be drawn in motion; ``path``: file to write; its extension
    says what: ``.gif``, ``.mp4`` or ``.glb``; ``seconds``: length of the film [s]. Raises InputError if there
    is no motion to show, no such kind of file, or ``ffmpeg`` is missing for ``.mp4``.
    """
    animation = mechanism_of(dataset).animation
    if animation is None:
        kind = dataset.attrs.get("kind", "")
        raise InputError(
            f'a result of the kind "{kind}" has no animation; its report plays it', key="animate"
        )
    if not 1.0 <= seconds <= _LONGEST:
        raise InputError(f"given {seconds:g}; allowed: 1 to {_LONGEST:g} seconds", key="seconds")
    ending = path.suffix.lower()
    if ending not in (*_WRITERS, _SOLIDS):
        words = f"{as_given(path.name)}; allowed endings: {', '.join((*_WRITERS, _SOLIDS))}"
        raise InputError(words, key="animate")
    every = playback_times(dataset)
    if every.size < 2:
        raise InputError("this result holds no motion to show", key="animate")
    times = np.linspace(every[0], every[-1], round(_PER_SECOND * seconds))
    if ending == _SOLIDS:
        content = _solids(dataset, animation, times, seconds)
    else:
        content = _film(dataset, animation, times, _WRITERS[ending], path.name)
    write_bytes(path, content)
    return path


def _solids(dataset: xr.Dataset, animation: Animation, times: FloatArray, seconds: float) -> bytes:
    """Return the content of a file of glTF."""
    from tribodyn.views.gltf import gltf

    solids, up = animation.solids(dataset, times)
    return gltf(solids, np.linspace(0.0, seconds, times.size), up)


def _film(dataset: xr.Dataset, animation: Animation, times: FloatArray, writer: str, name: str) -> bytes:
    """Return the content of a film that matplotlib writes."""
    from matplotlib.animation import writers

    if not writers.is_available(writer):
        words = "MP4 needs the program ffmpeg, which is not found; install it, or write a .gif or .glb file"
        raise InputError(words, key="animate")
    film, made = animation.film(dataset, times), writers[writer](fps=_PER_SECOND)
    with TemporaryDirectory() as folder:
        path = Path(folder) / name
        with made.saving(film.figure, str(path), dpi=_DPI):
            for frame in range(times.size):
                film.show(frame)
                made.grab_frame()
        return path.read_bytes()
