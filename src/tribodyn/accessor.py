"""``result.tribodyn``: figures and key results of a result, in a notebook or a script.

>>> figure = result.tribodyn.plot.orbit()
>>> error = result.tribodyn.summary["error_rms_um_slider"]
"""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator
from functools import partial
from html import escape
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
import xarray as xr

from tribodyn.core.errors import InputError
from tribodyn.core.quoting import as_given, meant

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from tribodyn.figures.chart import Family

ORBIT: Final = "orbit"
#: Names of the figure of a shaft in its clearance circle, by mechanism.
_ORBITS: Final = ("trajectory", "orbits")


@xr.register_dataset_accessor("tribodyn")  # type: ignore[no-untyped-call]
class Accessor:
    """Methods of tribodyn on a result.

    Parameters
    ----------
    dataset
        From :func:`tribodyn.simulate`, :func:`tribodyn.read` or a sweep.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    @property
    def plot(self) -> Plots:
        """The figures of the result, drawn by ``plot.NAME()``; ``dir(plot)`` lists them."""
        return Plots(self._dataset)

    @property
    def summary(self) -> dict[str, Any]:
        """The key results, as in ``summary.json``."""
        from tribodyn.mechanisms.results import summarise

        return summarise(self._dataset)

    @property
    def numbers(self) -> pd.DataFrame:
        """The key results as a table: by name, with label, part, value, ends of the interval and unit."""
        import pandas as pd

        from tribodyn.mechanisms.results import known

        summary = self.summary
        rows = {
            name: (
                one.label_in(summary),
                one.part,
                summary[name],
                *summary["intervals"].get(name, (np.nan, np.nan)),
                one.unit,
            )
            for name, one in known(summary, str(summary.get("kind", ""))).items()
        }
        columns = ["label", "part", "value", "low", "high", "unit"]
        return pd.DataFrame.from_dict(rows, orient="index", columns=columns).rename_axis("name")

    def sel(self, **chosen: str) -> xr.Dataset:
        """Return the part of a result of joints, bodies, outputs or others by their names.

        Raises
        ------
        InputError
            There is no such part; the message lists those that are there.

        Examples
        --------
        >>> wrist = result.tribodyn.sel(joint="wrist")
        """
        for dim, name in chosen.items():
            if dim not in self._dataset.coords:
                allowed = [str(one) for one in self._dataset.dims]
                raise InputError(
                    f"no such dimension; allowed: {', '.join(allowed)}{meant(dim, allowed)}", key=dim
                )
            names = [str(one) for one in self._dataset[dim].values]
            if str(name) not in names:
                raise InputError(
                    f"{as_given(name)}; allowed: {', '.join(names)}{meant(str(name), names)}", key=dim
                )
        return self._dataset.sel(chosen)

    def resample(self, step: float) -> xr.Dataset:
        """Return the variables over time at even times, by straight lines between samples.

        Parameters
        ----------
        step
            Time between samples [s].

        Raises
        ------
        InputError
            The step is not above zero, or longer than the run.

        Examples
        --------
        >>> even = result.tribodyn.resample(1e-3)
        """
        begin, end = (float(self._dataset["time"][k]) for k in (0, -1))
        if not 0.0 < step <= end - begin:
            words = f"given {step:g}; allowed: a time in s, above 0 and at most {end - begin:.4g}"
            raise InputError(words, key="step")
        times = begin + step * np.arange(int((end - begin) / step * (1.0 + 1e-12)) + 1)
        over = [name for name, one in self._dataset.data_vars.items() if "time" in one.dims]
        once = self._dataset[over].drop_duplicates("time")
        return once.interp(time=times, kwargs={"fill_value": "extrapolate"}).assign_attrs(self._dataset.attrs)

    def to_dataframe(self, *names: str, over: str | None = None) -> pd.DataFrame:
        """Return columns over time as a table, a row for each time, with the unit of each in its header.

        The method of this name that every dataset has makes a row for each time, joint, body, node and frame
        together, which no memory holds.

        Parameters
        ----------
        names
            Groups (``"outputs"``, ``"motion"``, ``"forces"``, ``"moments"``, ``"pressures"``, ``"energies"``,
            ``"powers"``), variables, or variables with labels after points, as ``"reaction_force.wrist.x"``.
        over
            A joint whose angle comes first [deg], or the name of a column.

        Raises
        ------
        InputError
            The result has no such group, variable or label.

        Examples
        --------
        >>> table = result.tribodyn.to_dataframe("forces", over="main")
        """
        from tribodyn.results.columns import table

        return table(self._dataset, names, over=over)

    def animate(self, path: str | PathLike[str], *, seconds: float = 6.0) -> Path:
        """Write the last cycle of a user-defined mechanism as a film, or as solids that move.

        Parameters
        ----------
        path
            File to write. Its ending says what: ``.gif``, ``.mp4`` (needs the program ffmpeg), or ``.glb``,
            solids in glTF that browsers, viewers and modellers show from all sides.
        seconds
            Length of the film [s], 1 to 120.

        Returns
        -------
        pathlib.Path
            The file.

        Raises
        ------
        InputError
            The result has no motion to show, the ending is another one, or ffmpeg is missing.

        Examples
        --------
        >>> path = result.tribodyn.animate("press.gif", seconds=1.0)
        """
        from tribodyn.report.figures import animate

        return animate(self._dataset, Path(path), seconds)

    def _repr_html_(self) -> str:
        """Return the key results as a table, with what the run says of itself."""
        return "\n".join(_page(self.summary))


class Plots:
    """The figures of a result as methods, each of which returns a :class:`matplotlib.figure.Figure`.

    Of a mechanism whose joints have names, ``joint="wrist"`` draws that joint alone, and ``over="main"``
    draws a chart over the angle of that joint instead of over time. ``plot()`` returns the first chart.
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset

    def _families(self) -> dict[str, Family]:
        from tribodyn.report.figures import figures_of

        families = {
            name: family
            for name, family in figures_of(self._dataset).items()
            if family.drawable(self._dataset)
        }
        orbit = next((families[name] for name in _ORBITS if name in families), None)
        return families | ({} if orbit is None else {ORBIT: orbit})

    def __call__(self, *, over: str | None = None) -> Figure:
        """Return the first of the charts that a result has: errors of outputs, forces, motion."""
        families = self._families()
        charted = [one for one in families.values() if one.over is not None]
        return _drawn((charted or [*families.values()])[0], self._dataset, over=over)

    def __getattr__(self, name: str) -> Callable[..., Figure]:
        """Return the drawing function of this name."""
        if name.startswith("_"):
            raise AttributeError(name)
        families = self._families()
        if name not in families:
            hint = f"{as_given(name)}; allowed: {', '.join(families)}{meant(name, families)}"
            raise AttributeError(str(InputError(hint, key="plot")))
        return partial(_drawn, families[name], self._dataset)

    def __dir__(self) -> list[str]:
        """Return the names of the figures."""
        return sorted(self._families())


def _drawn(
    family: Family, dataset: xr.Dataset, *, joint: str | None = None, over: str | None = None
) -> Figure:
    if "IPython" in sys.modules:
        _show_pictures()
    chosen = dataset if joint is None else _with_joint(dataset, family, joint)
    if over is None:
        return family.draw(chosen)
    if family.over is None:
        raise InputError(f"{as_given(over)}; allowed: none, {family.name} has no time axis", key="over")
    return family.over(chosen, over)


def _with_joint(dataset: xr.Dataset, family: Family, joint: str) -> xr.Dataset:
    """Return a result with one of its joints, and its surfaces, for a figure that shows joints.

    Raises
    ------
    InputError
        There is no such joint, or the figure does not show joints one by one.
    """
    names = [str(name) for name in dataset["joint"].values] if {"joint", "surface"} & {*family.needs} else []
    if joint not in names:
        allowed = ", ".join(names) or f"none: {family.name} does not show joints one by one"
        raise InputError(f"{as_given(joint)}; allowed: {allowed}{meant(joint, names)}", key="joint")
    surfaces = [str(name).rpartition(":")[0] == joint for name in dataset["surface"].values]
    return dataset.isel(joint=[names.index(joint)], surface=np.flatnonzero(surfaces))


def _show_pictures() -> None:
    """Have a notebook show figures as pictures; it would print their names until pyplot is used."""
    shell = importlib.import_module("IPython").get_ipython()
    if shell is not None:
        importlib.import_module("IPython.core.pylabtools").select_figure_formats(shell, {"png"})


def _page(summary: dict[str, Any]) -> Iterator[str]:
    from tribodyn.mechanisms.results import known
    from tribodyn.results.summary import caution
    from tribodyn.views.numbers import fitting, interval, rounded

    yield f"<strong>{escape(str(summary.get('title', '')))}</strong>"
    warning = summary.get("doubtful")
    yield (
        f"<p><strong>{escape(caution(warning))}</strong></p><table style='color:gray'>"
        if warning
        else "<table>"
    )
    for name, key_result in known(summary, str(summary.get("kind", ""))).items():
        value = summary[name]
        unit, factor = fitting(key_result.unit, [value])
        shown = isinstance(value, float)
        number = f"{rounded(value * factor, key_result.digits):.4g}" if shown else str(value)
        number = interval(summary, name, factor) or number
        label = escape(key_result.label_in(summary))
        yield f"<tr><td style='text-align:left'>{label}</td><td>{number} {escape(unit)}</td></tr>"
    yield "</table>"
    for kind in ("warnings", "notes"):
        yield from (f"<p>{kind[:-1]}: {escape(text)}</p>" for text in summary.get(kind, ()))
