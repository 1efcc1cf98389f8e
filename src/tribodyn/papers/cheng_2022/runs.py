"""The runs that figures and claims share, each computed once, and common parts of the figures."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from mebdf.arrays import FloatArray
from tribodyn.figures import style
from tribodyn.mechanisms.catalogue import load_case
from tribodyn.simulation import simulate
from tribodyn.views.playback import series

CLEARANCES: Final = (20e-6, 25e-6, 30e-6, 35e-6, 40e-6)  #: Clearances of section 5.3 [m].
#: Joints of the mechanism, as the built-in case ``vsv-joints`` calls them; Eq. 11 counts these six.
JOINTS: Final = ("crank-pivot", "crank-ball", "ring-ball", "guide", "pin", "trunnion")
LAWS: Final = ("rsdc", "ke")  #: Contact laws that section 4 compares.
FORMULATIONS: Final = ("paper", "exact")
#: Time over which the speed error is averaged [s]: several periods of what rings after the reversals.
_TREND: Final = 0.2
_STEP: Final = 5e-3  #: Time between the instants at which that is done [s].


def _silent(text: str) -> None:
    """Say nothing."""


@dataclass
class Runs:
    """Simulated cases by what was changed in them.

    ``note``: called with a description of each run before it is computed; ``clearances``: the clearances of
    :meth:`every_clearance` [m]; ``changes``: keys changed in all runs of a built-in case, by its name, such
    as those of a coarser grid.
    """

    note: Callable[[str], None] = _silent
    clearances: tuple[float, ...] = CLEARANCES
    changes: Mapping[str, Mapping[str, object]] = field(default_factory=dict)
    _done: dict[str, xr.Dataset] = field(default_factory=dict, repr=False)

    def run(self, name: str, changes: Mapping[str, object] | None = None) -> xr.Dataset:
        """Return the result of a built-in case with some keys changed, as a case file writes them."""
        given = load_case(name)
        # The paper has nothing under its asperities: where these end, its runs do.
        rigid = {"joint.bulk": "none"} if given.kind() == "vsv" else {}
        case = given.replace({**rigid, **(changes or {}), **self.changes.get(name, {})})
        key = case.to_toml()
        if key not in self._done:
            changed = ", ".join(f"{path} = {value}" for path, value in (changes or {}).items())
            self.note(f"running {name}" + (f" with {changed}" if changed else ""))
            self._done[key] = _frozen(simulate(case))
        return self._done[key]

    def vsv(
        self, formulation: str, clearance: float, changes: Mapping[str, object] | None = None
    ) -> xr.Dataset:
        """Return two cycles of the mechanism with a clearance [m]."""
        own = {"mechanism.formulation": formulation, "joint.clearance": f"{clearance * 1e6:g} um"}
        return self.run("vsv", {**own, **(changes or {})})

    def joints(
        self, clearance: float, real: Iterable[str] = JOINTS, more: Mapping[str, object] | None = None
    ) -> xr.Dataset:
        """Return two cycles of the multibody model, with a clearance [m] in some joints and more changes.

        Samples are those at output times, the same in all of these runs.
        """
        changes: dict[str, object] = {"run.step_rows": 0, **(more or {})}
        for joint in JOINTS:
            changes[f"joints.{joint}.clearance.radial"] = f"{clearance * 1e6:g} um"
            changes[f"joints.{joint}.clearance.ideal"] = joint not in real
            changes[f"joints.{joint}.clearance.bulk"] = "none"
        return self.run("vsv-joints", changes)

    def over_clearance(self, formulation: str, *names: str) -> xr.Dataset:
        """Return variables over time of the runs with all clearances, along a dimension ``clearance`` [m]."""
        return over_clearances([run[list(names)] for run in self.every_clearance(formulation)])

    def every_clearance(
        self, formulation: str, changes: Mapping[str, object] | None = None
    ) -> list[xr.Dataset]:
        """Return the runs with all clearances of the paper."""
        return [self.vsv(formulation, value, changes) for value in self.clearances]


def _frozen(run: xr.Dataset) -> xr.Dataset:
    """Return a result whose arrays are read-only: several figures and claims share it."""
    for variable in run.data_vars.values():
        variable.values.flags.writeable = False
    return run


def over_clearances(runs: list[xr.Dataset]) -> xr.Dataset:
    """Return results with several clearances side by side along a dimension ``clearance`` [m]."""
    about = {"units": "m", "long_name": "radial clearance of the joint"}
    clearances = np.array([run.attrs["clearance"] for run in runs])
    whole = joined(runs, xr.Variable("clearance", clearances, about))
    whole.attrs.pop("clearance", None)
    return whole


def joined(runs: list[xr.Dataset], index: xr.Variable) -> xr.Dataset:
    """Return results side by side along the dimension of ``index``, at the times of all of them.

    In the impacts the samples of each run follow its own steps, see :func:`at_times`. Fields over a bushing
    must have one grid, see :func:`on_grid`.
    """
    if "time" in runs[0].dims:
        times = np.unique(np.concatenate([run["time"].values for run in runs]))
        runs = [at_times(run, times) for run in runs]
    whole = xr.concat(
        runs,
        dim=index,
        data_vars="all",
        coords="minimal",
        compat="override",
        join="override",
        combine_attrs="override",
    )
    return whole.assign_coords({str(index.dims[0]): index})


def at_times(run: xr.Dataset, times: FloatArray) -> xr.Dataset:
    """Return a result at other times [s].

    Between its samples a variable with a rate, such as ``e_x`` with ``e_x_dot``, is the cubic of both; others
    are on straight lines.
    """
    old = run["time"].values
    if np.array_equal(old, times):
        return run
    over_time = {
        name: (values.dims, _between(run, str(name), times), values.attrs)
        for name, values in run.data_vars.items()
        if values.dims[:1] == ("time",)
    }
    rest = run.drop_vars([*over_time, "time"])
    return rest.assign(over_time).assign_coords(time=("time", times, run["time"].attrs))


def _between(run: xr.Dataset, name: str, times: FloatArray) -> FloatArray:
    old, values = run["time"].values, run[name].values
    rate = f"{name}_dot"
    if rate not in run:
        columns = [np.interp(times, old, one) for one in values.reshape(old.size, -1).T]
        return np.stack(columns, axis=-1).reshape(times.size, *values.shape[1:])
    return np.asarray(CubicHermiteSpline(old, values, run[rate].values)(np.clip(times, old[0], old[-1])))


def on_grid(run: xr.Dataset, theta: FloatArray, z: FloatArray) -> xr.Dataset:
    """Return fields over a bushing at other nodes, linear between their own.

    ``run``: variables over ``theta`` [rad], a full turn with constant steps, and ``z`` [m]; ``theta``, ``z``:
    the nodes wanted, increasing: angles [rad] and heights [m].
    """
    turn = run.pad(theta=1, mode="wrap")
    around = run["theta"].values
    turn = turn.assign_coords(theta=[around[-1] - 2.0 * np.pi, *around, around[0] + 2.0 * np.pi])
    return turn.interp(theta=theta, z=z)


def finer(run: xr.Dataset, parts: int = 16) -> xr.Dataset:
    """Return a result with every time between its samples parted: steps in free flight are long."""
    old = run["time"].values
    times = old[:-1, None] + np.diff(old)[:, None] * np.arange(parts) / parts
    return at_times(run, np.append(times.ravel(), old[-1]))


def is_smooth(dataset: xr.Dataset, time: FloatArray) -> NDArray[np.bool_]:
    """Return the mask of times [s] outside the impacts that follow the start and each reversal."""
    half, impact = 0.5 * float(dataset.attrs["cycle_period"]), float(dataset.attrs["impact_time"])
    return np.asarray(np.mod(time, half) > impact)


def smooth(dataset: xr.Dataset) -> xr.Dataset:
    """Return the rows in smooth motion, see :func:`is_smooth`."""
    return dataset.sel(time=is_smooth(dataset, dataset["time"].values))


def forward(dataset: xr.Dataset) -> NDArray[np.bool_]:
    """Return whether the vane angle grows in the ideal motion, shape (n_t,)."""
    return np.asarray(dataset["omega_v_ideal"].values > 0.0)


def mean_rate(time: FloatArray, error: FloatArray, run: xr.Dataset) -> tuple[FloatArray, FloatArray]:
    """Return instants of smooth motion [s] and the rate of an error there, averaged over 0.2 s.

    The mean of a rate over a time is the difference of what it is the rate of.
    """
    half = 0.5 * _TREND
    middle = np.arange(half, float(time[-1]) - half, _STEP)
    inside = is_smooth(run, middle - half) & is_smooth(run, middle + half)
    middle = middle[inside & (middle % (0.5 * float(run.attrs["cycle_period"])) > half)]
    change = np.interp(middle + half, time, error) - np.interp(middle - half, time, error)
    return middle, change / _TREND


@dataclass(frozen=True)
class PaperFigure:
    """One figure of the paper, made from our own runs, or one that it should have."""

    #: Name on the command line and of the files: ``fig12``, or what it shows where the paper has none.
    name: str
    title: str  #: What it shows.
    #: Returns the data, given the runs and the formulation (``paper`` or ``exact``).
    data: Callable[[Runs, str], xr.Dataset]
    draw: Callable[[xr.Dataset], Figure]  #: Draws it from its data, with the panels of the original.


#: Colour and dash pattern of each clearance.
STYLES: Final[tuple[tuple[str, style.LineStyle], ...]] = (
    (style.INK, style.SOLID),
    (style.BLUE, style.DASHED),
    (style.GREEN, style.DASHDOT),
    (style.ORANGE, style.DOTTED),
    (style.VERMILION, style.SOLID),
)

#: Label of an axis with θ of Eqs. 44 and 48: the direction in which the contact pushes the trunnion.
ANGLE: Final = "bushing angle θ of the paper [°]"


def by_clearance(dataset: xr.Dataset, name: str, scale: float = 1.0) -> style.Curves:
    """Return one curve a clearance of a variable (clearance, time), the widest first: it lies below."""
    labels = [f"{value * 1e6:g} µm" for value in dataset["clearance"].values]
    return [
        (series(dataset.isel(clearance=i), name, scale), label, *STYLES[i % len(STYLES)])
        for i, label in reversed(list(enumerate(labels)))
    ]


def enlarge(axes: Axes, beside: Axes, x: FloatArray, curves: style.Curves, span: tuple[float, float]) -> None:
    """Draw a stretch of the curves again in a panel of its own, and shade it in the whole.

    ``axes``: where the whole is drawn; ``beside``: where the stretch is drawn, with its own scale; ``x``:
    abscissa, shape (n,); ``curves``: as drawn in ``axes``; ``span``: first and last abscissa of the stretch.
    """
    inside = (x >= span[0]) & (x <= span[1])
    near: style.Curves = [(values[inside], label, colour, dash) for values, label, colour, dash in curves]
    style.lines(beside, x[inside], near, width=1.0)
    style.finish(beside)
    beside.set_facecolor("#fdf8ee")
    beside.locator_params(axis="x", nbins=4)
    axes.axvspan(*span, color="#f3e2c0", zorder=0)


def first_cycle(dataset: xr.Dataset) -> xr.Dataset:
    """Return the rows of the first cycle."""
    return dataset.sel(time=dataset["time"].values <= float(dataset.attrs["cycle_period"]) * (1.0 + 1e-9))


def keep(dataset: xr.Dataset, *names: str) -> xr.Dataset:
    """Return a dataset with these variables only, attributes kept."""
    return dataset[list(names)]


def limits(axes: Axes, curves: style.Curves, quiet: NDArray[np.bool_]) -> None:
    """Scale the y axis to the rows that are ``quiet``, with room; impacts may leave it."""
    values = np.concatenate([values[quiet] for values, *_ in curves])
    values = values[np.isfinite(values)]
    if values.size:
        size = max(float(np.ptp(values)), 1e-12)
        axes.set_ylim(float(values.min()) - 0.35 * size, float(values.max()) + 0.35 * size)
