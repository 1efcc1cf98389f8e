"""Charts over time of any mechanism, and the motion of shafts between the rows of a result."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
import xarray as xr

from mebdf.arrays import FloatArray
from tribodyn.core.splines import Cubics
from tribodyn.mechanism.assembly.skeleton import case_of
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.results.copies import copies_of, worst
from tribodyn.mechanism.results.joint_readings import WHOLE, offset, sizes
from tribodyn.results.variables import ERROR_UNITS
from tribodyn.views.charts import LOOKS, Chart, ChartCurve, Panel
from tribodyn.views.energy_balance import balance_chart
from tribodyn.views.playback import LINE_ERROR, dense_times, in_playback


@dataclass(frozen=True)
class Shafts:
    """Shafts of the joints of a result."""

    dataset: xr.Dataset  #: The result.
    case: MechanismCase | None  #: Its case; without one the motion is that of straight lines between rows.

    def path(self, joint: int) -> FloatArray:
        """Return places in the bore over the playback, which straight lines may join [m], shape (n, 3)."""
        inside = in_playback(self.dataset)
        time, values = self.dataset["time"].values[inside], self._displacement(joint)[inside]
        if time.size < 2 or not self._has_rates:
            return values
        rates = self._rates(joint)[inside]
        if not (np.isfinite(values).all() and np.isfinite(rates).all()):
            return values
        room = LINE_ERROR * float(self.dataset["clearance"].values[joint])
        return Cubics(time, values, rates)(dense_times(time, values[:, :2], rates[:, :2], room))

    def at(self, joint: int, times: FloatArray) -> FloatArray:
        """Return the places at other times [s] in the axes of the joint [m], shape (n, 3)."""
        time, values = self.dataset["time"].values, self._displacement(joint)
        if self._has_rates:
            return Cubics(time, values, self._rates(joint))(times)
        return np.stack([np.interp(times, time, column) for column in values.T], axis=-1)

    def _displacement(self, joint: int) -> FloatArray:
        return np.asarray(self.dataset["displacement"].values[:, joint])

    @property
    def _has_rates(self) -> bool:
        """Whether velocities are the rates of displacements: analyses without dynamics have others."""
        dynamic = self.case is not None and self.case.run.analysis == "dynamic"
        return dynamic and "relative_velocity" in self.dataset and self.dataset.sizes["time"] > 1

    def _rates(self, joint: int) -> FloatArray:
        """Return the velocity of the shaft [m/s], shape (n_t, 3): results hold that of the second body."""
        assert self.case is not None
        sign = self.case.joints[str(self.dataset["joint"].values[joint])].sign
        return np.asarray(sign * self.dataset["relative_velocity"].values[:, joint])


DEG: Final = 180.0 / np.pi


def curves(names: list[str], values: FloatArray) -> list[ChartCurve]:
    """Return the largest of some curves, as many as have a look of their own; values of shape (n_t, n)."""
    reach = np.nan_to_num(np.abs(values)).max(axis=0, initial=0.0)
    chosen = sorted(np.argsort(-reach, kind="stable")[: len(LOOKS)].tolist())
    looks = zip(chosen, LOOKS, strict=False)
    return [ChartCurve(names[k], values[:, k], colour, dash) for k, (colour, dash) in looks if reach[k] > 0.0]


def _names(dataset: xr.Dataset, part: str) -> list[str]:
    return [str(name) for name in dataset[part].values]


def _panels(*panels: tuple[str, list[ChartCurve]]) -> list[Panel]:
    drawn = [panel for panel in panels if panel[1]] or panels[:1]
    # A legend comes with the second curve.
    return [Panel(f"{label}\n{found[0].name}" if len(found) == 1 else label, found) for label, found in drawn]


def motion(dataset: xr.Dataset) -> list[Panel]:
    """Return angles of joints [°] and speeds of bodies [m/s]."""
    joints, bodies = _names(dataset, "joint"), _names(dataset, "body")
    return _panels(
        ("angle [°]", curves(joints, DEG * dataset["joint_angle"].values)),
        ("speed of\nmass centre [m/s]", curves(bodies, sizes(dataset, "velocity"))),
        ("acceleration of\nmass centre [m/s²]", curves(bodies, sizes(dataset, "acceleration"))),
    )


def _efforts(dataset: xr.Dataset, effort: str) -> list[ChartCurve]:
    """Return efforts of the drives, and lines at their limits on the sides that they reach."""
    names, values = _names(dataset, "joint"), dataset[effort].values
    found = curves(names, values)
    limits = dataset[f"{effort}_limit"].values if f"{effort}_limit" in dataset else np.empty(0)
    for k in np.flatnonzero(np.isfinite(limits)):
        for side, sign in (("upper", 1.0), ("lower", -1.0)):
            if np.any(sign * values[:, k] > 0.0):
                line = np.full(len(values), sign * limits[k])
                found.append(ChartCurve(f"{side} limit, {names[k]}", line, "vermilion", "longdash"))
    return found


def joint_forces(dataset: xr.Dataset) -> list[Panel]:
    """Return sizes of the forces in the joints [N] and the efforts of drives."""
    joints = _names(dataset, "joint")
    return _panels(
        ("force in joint [N]", curves(joints, sizes(dataset, "reaction_force"))),
        ("drive moment [N m]", _efforts(dataset, "drive_moment")),
        ("drive force [N]", _efforts(dataset, "drive_force")),
    )


def clearances(dataset: xr.Dataset) -> list[Panel]:
    """Return offsets of shafts in their bores [µm], peak pressures [MPa], clearances [µm]."""
    real = np.isfinite(dataset["clearance"].values)
    names = [name for name, wanted in zip(_names(dataset, "joint"), real, strict=True) if wanted]
    warming = []
    if "radial_clearance" in dataset:
        warming = [("clearance [µm]", curves(names, 1e6 * dataset["radial_clearance"].values[:, real]))]
    return _panels(
        ("offset [µm]", curves(names, 1e6 * offset(dataset)[:, real])),
        ("peak pressure [MPa]", curves(names, 1e-6 * dataset["pressure_max"].values[:, real])),
        *warming,
    )


def output_errors(dataset: xr.Dataset) -> list[Panel]:
    """Return the errors of outputs against the ideal motion [µm, °, mm/s]."""
    names, units = _names(dataset, "output"), dataset["output_unit"].values
    error = dataset["output_error"].values
    repeated = [k for numbers in copies_of(dataset).values() for k in numbers]
    panels = []
    for unit, (_, shown, scale) in ERROR_UNITS.items():
        chosen = np.setdiff1d(np.flatnonzero(units == unit), repeated)
        panels.append((f"error [{shown}]", curves([names[k] for k in chosen], scale * error[:, chosen])))
    return _panels(*_of_copies(dataset), *panels)


def _of_copies(dataset: xr.Dataset) -> Iterator[tuple[str, list[ChartCurve]]]:
    """Yield a panel of each repeated output: band, mean, and the copy furthest from the mean."""
    for name, numbers in copies_of(dataset).items():
        unit = ERROR_UNITS[str(dataset["output_unit"].values[numbers[0]])]
        error = unit.scale * dataset["output_error"].values[:, numbers]
        k = worst(error, dataset["time"].values)
        lines = {"largest": error.max(axis=1), "mean": error.mean(axis=1), "least": error.min(axis=1)}
        lines[f"{name}[{k + 1}]"] = error[:, k]
        drawn = [
            ChartCurve(label, line, *look) for (label, line), look in zip(lines.items(), LOOKS, strict=False)
        ]
        yield f"error of {name}\nover copies [{unit.shown}]", drawn


def error_estimates(dataset: xr.Dataset) -> list[Panel]:
    """Return the errors that joints cause by superposition, a panel for each output [µm, °]."""
    names = _names(dataset, "joint")
    error = dataset["error_estimate"].values.sum(axis=-1)
    units = [ERROR_UNITS[str(unit)] for unit in dataset["output_unit"].values]
    return _panels(
        *(
            (f"error of {output} [{unit.shown}]", curves(names, unit.scale * error[:, k]))
            for k, (output, unit) in enumerate(zip(_names(dataset, "output"), units, strict=True))
        )
    )


def modes(dataset: xr.Dataset) -> list[Panel]:
    """Return the lowest natural frequencies [Hz] and the damping ratios of their modes."""
    names = [f"mode {name}" for name in _names(dataset, "mode")][: len(LOOKS)]
    return [
        Panel(label, [ChartCurve(name, values[:, k], *LOOKS[k]) for k, name in enumerate(names)])
        for label, values in (
            ("natural frequency [Hz]", dataset["natural_frequency"].values),
            ("damping ratio", dataset["damping_ratio"].values),
        )
    ]


MODES: Final = Chart(
    name="modes",
    title="Natural frequencies",
    caption=(
        "Small vibrations about each position at rest, with drives and loads held as at that time: the modes "
        "of the lowest frequency. A damping ratio below zero marks a position that is unstable."
    ),
    needs=("natural_frequency", "damping_ratio", "mode"),
    panels=modes,
)
ERROR_ESTIMATES: Final = Chart(
    name="error_estimates",
    title="Errors by superposition",
    caption=(
        "Error of each output that a joint causes by itself: smooth, rigid surfaces, the shaft against the "
        "side of its bore that carries the reaction of the ideal joint."
    ),
    needs=("error_estimate", "output_unit", "output", "joint"),
    panels=error_estimates,
)
OUTPUT_ERRORS: Final = Chart(
    name="output_errors",
    title="Errors of the outputs",
    caption="How far each output is from where ideal joints with the same drives would have it.",
    needs=("output_error", "output_unit", "output"),
    panels=output_errors,
)


def films(dataset: xr.Dataset) -> list[Panel]:
    """Return forces of oil films [N], their peak pressures [MPa] and least gaps [µm]."""
    oiled = np.isfinite(dataset["film_pressure_peak"].values)
    names = [name for name, wanted in zip(_names(dataset, "joint"), oiled, strict=True) if wanted]
    return _panels(
        ("film force [N]", curves(names, sizes(dataset, "film_force")[:, oiled])),
        ("peak film pressure [MPa]", curves(names, 1e-6 * dataset["film_pressure_max"].values[:, oiled])),
        ("least film [µm]", curves(names, 1e6 * dataset["film_thickness_min"].values[:, oiled])),
    )


MOTION: Final = Chart(
    name="motion",
    title="Motion",
    caption="Angles of the joints from the initial model, speeds and accelerations of the bodies.",
    needs=("joint_angle", "velocity", "acceleration", "joint", "body"),
    panels=motion,
)
JOINT_FORCES: Final = Chart(
    name="joint_forces",
    title="Forces in the joints",
    caption=(
        "Sizes of the forces that the joints carry, and what the drives give. Where joints have clearance, "
        "rows follow the steps of the integration: a spike is an impact of a pin in its bore."
    ),
    needs=("reaction_force", "drive_moment", "drive_force", "joint"),
    panels=joint_forces,
)
CLEARANCES: Final = Chart(
    name="clearances",
    title="Motion in the clearances",
    caption="How far shafts leave the middle of their bores, across the axis, and the highest pressures.",
    needs=("displacement", "clearance", "pressure_max", "joint"),
    panels=clearances,
)


def guides(dataset: xr.Dataset) -> list[Panel]:
    """Return the contact of blocks with their guides as steps, and their tilts in the play [°]."""
    real = np.isfinite(dataset["guide_contact"].values).any(axis=0)
    names = [name for name, wanted in zip(_names(dataset, "joint"), real, strict=True) if wanted]
    tilt, case = np.hypot(*(dataset[name].values[:, real] for name in ("tilt_x", "tilt_y"))), case_of(dataset)
    # A pin turns in its slot, which is no tilt in a play.
    tilt[:, [case is not None and case.joints[name].type == "slot" for name in names]] = 0.0
    return _panels(
        (
            "contact: free 0, corner 1,\nface 2, opposite faces 3",
            curves(names, dataset["guide_contact"].values[:, real]),
        ),
        ("tilt in the play [°]", curves(names, DEG * tilt)),
    )


GUIDES: Final = Chart(
    name="guides",
    title="Blocks in their guides",
    caption=(
        "Where a block, or a pin in a slot, touches its walls: 0 nowhere, 1 at one corner, 2 at two "
        "corners of one face or on all of it, 3 on opposite faces, tilted as far as its play goes."
    ),
    needs=("guide_contact", "tilt_x", "tilt_y", "joint"),
    panels=guides,
)
FILMS: Final = Chart(
    name="films",
    title="Oil films",
    caption="Forces of the oil films, their highest pressures and smallest gaps.",
    needs=("film_force", "film_pressure_max", "film_thickness_min", "film_pressure_peak", "joint"),
    panels=films,
)
#: In reading order, of the report and of ``figures/``; the energy balance follows.
CHARTS: Final = (MODES, OUTPUT_ERRORS, ERROR_ESTIMATES, JOINT_FORCES, CLEARANCES, GUIDES, FILMS, MOTION)
ENERGY: Final = balance_chart(
    WHOLE,
    name="energy",
    title="Energy balance",
    caption=(
        "What drives and loads put in, what is stored and what became heat since the start. The residual is "
        "what the sum misses: an error of the integration would show there."
    ),
)
