"""Simulation of the variable stator vane mechanism."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from tribodyn.cases.vsv import Vsv as VsvCase
from tribodyn.core.arrays import FloatArray
from tribodyn.core.problem import Problem, Solution
from tribodyn.integrate import INTERRUPTED, integrate
from tribodyn.kernels.vsv.functions import vane_direction
from tribodyn.kernels.vsv.quantities import OBSERVED
from tribodyn.mechanisms.vsv import AirLoads, Carried, Inertias, Vsv, ideal_vane_angle, vsv_problem
from tribodyn.mechanisms.vsv.problem import reversals
from tribodyn.mechanisms.vsv.reach import at_limit
from tribodyn.results import build
from tribodyn.simulation.checks import grid_force_error, peaks, warnings
from tribodyn.simulation.frames import frame_times, merged, shown
from tribodyn.simulation.joint import joint
from tribodyn.simulation.ledger import ledger_columns, residual_fractions
from tribodyn.simulation.provenance import provenance
from tribodyn.simulation.times import output_times, snapshots
from tribodyn.wear import Archard, worn_volume

NOT_STORED = ("work_", "heat_")
"""Observed quantities that reach the user under the names of the ledger instead."""


def simulate_vsv(
    case: VsvCase,
    *,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> xr.Dataset:
    """Simulate a ``vsv`` case, see :func:`tribodyn.simulation.simulate`."""
    vsv = mechanism(case)
    problem, solution = integrated(case, vsv, case.duration, progress=progress, stop=stop)
    depth = archard(case).depth(problem.memory.joint.sliding_load)
    return Gathered(case, vsv, problem, solution, depth).dataset(linear_life(case, solution.t_end, depth))


def integrated(
    case: VsvCase,
    vsv: Vsv,
    duration: float,
    *,
    wear: FloatArray | None = None,
    carried: Carried | None = None,
    progress: Callable[[float], None] | None = None,
    stop: Callable[[], bool] | None = None,
) -> tuple[Problem, Solution]:
    """Integrate the mechanism over ``duration`` [s] from its start, or from where another run ended.

    Parameters
    ----------
    case, vsv
        The case and its mechanism.
    duration
        Simulated time [s].
    wear, carried
        As for :func:`tribodyn.mechanisms.vsv.vsv_problem`.
    progress, stop
        As for :func:`tribodyn.simulation.simulate`.
    """
    atol = case.solver.atol
    problem = vsv_problem(
        vsv,
        duration=duration,
        start=case.run.start,
        atol=(atol.position, atol.tilt, atol.velocity, atol.tilt_rate),
        wear=wear,
        carried=carried,
    )
    frames = frame_times(
        duration, vsv.drive.period, np.array(reversals(vsv, duration)), case.run.impact_window
    )
    solution = integrate(
        problem,
        solver=case.solver.name,
        rtol=case.solver.rtol,
        output_times=output_times(case, vsv, duration),
        picture_times=merged(snapshots(vsv, duration), frames, duration),
        progress=progress,
        stop=stop,
    )
    return problem, solution


def archard(case: VsvCase) -> Archard:
    """Return the wear law of a case."""
    return Archard(case.wear.specific_wear_rate, case.wear.paper_hardness_divisor)


def linear_life(case: VsvCase, t_end: float, depth: FloatArray) -> More:
    """Return after how many cycles the depth limit is reached if the wear of this run goes on."""
    limit, cycles, deepest = case.wear.depth_limit, t_end / case.period, float(depth.max(initial=0.0))
    if limit is None or cycles < 1.0 - 1e-9 or deepest == 0.0:
        return More()
    return More(attributes={"wear_life_cycles": limit * cycles / deepest})


def mechanism(case: VsvCase) -> Vsv:
    """Return the mechanism that a case describes, in the symbols of the paper."""
    m, loads = case.mechanism, case.loads
    return Vsv(
        formulation=m.formulation,
        lengths=case.lengths,
        inertias=Inertias(
            m_1=m.crank_mass,
            m_2=m.drag_link_mass,
            m_3=m.ring_mass,
            m_v=m.vane_mass,
            J_1=m.crank_inertia,
            J_2=m.drag_link_inertia,
            J_3=m.ring_inertia,
            J_v=m.vane_inertia,
            J_vz=m.vane_spin_inertia,
        ),
        drive=case.crank,
        air=AirLoads(
            loads.air_force_x, loads.air_force_y, loads.air_moment, loads.switch_angle, loads.switch_width
        ),
        gravity=m.gravity,
        collar_radius=case.joint.collar_radius,
        joint=joint(case),
    )


@dataclass(frozen=True)
class More:
    """What a run adds to its dataset: coordinates, fields, attributes, warnings."""

    coordinates: Mapping[str, FloatArray] = field(default_factory=dict)
    fields: Mapping[str, FloatArray] = field(default_factory=dict)
    attributes: Mapping[str, object] = field(default_factory=dict)
    warnings: Sequence[str] = ()


@dataclass(frozen=True)
class Gathered:
    """A finished or interrupted run on its way to a dataset.

    Attributes
    ----------
    case, vsv, problem, solution
        The case, its mechanism, and what was integrated.
    depth
        Wear depth at the nodes after the run [m], shape (n_z + 2, n_theta).
    statistics
        Cost, where it is more than that of ``solution``.
    """

    case: VsvCase
    vsv: Vsv
    problem: Problem
    solution: Solution
    depth: FloatArray
    statistics: Mapping[str, float] = field(default_factory=dict)

    @property
    def duration(self) -> float:
        """Simulated time that was asked for [s]."""
        return float(self.problem.t_span[1])

    def dataset(self, more: More) -> xr.Dataset:
        """Return the result."""
        rows = {name: self.solution.rows[:, i] for i, name in enumerate(OBSERVED)}
        ledger = ledger_columns(rows)
        kept = {name: values for name, values in rows.items() if not name.startswith(NOT_STORED)}
        kept["F_dx"] = rows["F_cx"] - rows["F_kx"]
        kept["F_dy"] = rows["F_cy"] - rows["F_ky"]
        kept["friction_power"] = -rows["friction_power"]
        return build(
            coordinates={**self._coordinates(), **more.coordinates},
            columns=kept | ledger,
            fields={**self._fields(), **more.fields},
            attributes={**self._attributes(rows, ledger, more.warnings), **more.attributes},
        )

    def _coordinates(self) -> dict[str, FloatArray]:
        times = self.solution.picture_times[self._is_snapshot()]
        theta_a = self._crank_angle(times)
        frames = self.solution.picture_times[self._film()]
        return {
            "time": self.solution.t,
            "snapshot": np.arange(times.size, dtype=np.float64),
            "snapshot_time": times,
            "frame": np.arange(frames.size, dtype=np.float64),
            "frame_time": frames,
            "snapshot_theta_v": ideal_vane_angle(self.vsv.lengths, theta_a),
            "snapshot_direction": np.array(
                [vane_direction(self.problem.data.mechanism, t, self.problem.memory) for t in times]
            ),
            "theta": self.vsv.joint.theta,
            "z": self.vsv.joint.z,
        }

    def _crank_angle(self, times: FloatArray) -> FloatArray:
        drive = self.vsv.drive
        return drive.start_angle + 0.5 * drive.swing * (1.0 - np.cos(drive.angular_frequency * times))

    def _is_snapshot(self) -> NDArray[np.bool_]:
        """Tell of each picture whether it is a snapshot, shape (n_pictures,)."""
        return np.isin(self.solution.picture_times, snapshots(self.vsv, self.duration))

    def _film(self) -> slice:
        """Return which pictures are the frames of the animation."""
        return shown(self.solution.picture_times, self.duration, self.vsv.drive.period)

    def _fields(self) -> dict[str, NDArray[np.floating[Any]]]:
        pressure = self.solution.pictures[:, 0].transpose(0, 2, 1)
        return {
            "pressure": pressure[self._is_snapshot()],
            # Half the size, and more digits than an animation needs.
            "pressure_cycle": pressure[self._film()].astype(np.float32),
            "wear_depth": self.depth.T,
        }

    def _attributes(
        self, rows: dict[str, FloatArray], ledger: dict[str, FloatArray], more: Sequence[str]
    ) -> dict[str, object]:
        whole, clearance = residual_fractions(ledger)
        grid_error = grid_force_error(self.vsv.joint, rows, self.problem.data.joint.wear)
        found = peaks(self.problem.memory)
        t_end = float(self.solution.t_end)
        told = warnings(self.vsv, found, whole, clearance, grid_error, t_end, self._cost())
        return {
            "title": self.case.title,
            "case": self.case.to_toml(),
            **provenance(),
            "solver": self._solver(),
            "formulation": self.vsv.formulation,
            "contact_law": self.case.contact.law,
            "friction_coefficient": self.case.joint.friction_coefficient,
            "clearance": self.case.joint.clearance,
            "roughness": self.vsv.joint.roughness,
            "joint_length": self.case.joint.length,
            "cycle_period": self.vsv.drive.period,
            "energy_residual": whole,
            "clearance_energy_residual": clearance,
            "grid_force_error": grid_error,
            **found,
            "worn_volume": worn_volume(self.depth, self.vsv.joint.node_area),
            "time_reached": t_end,
            "failure": self._failure(),
            "warnings": [*told, *more],
        }

    def _failure(self) -> str:
        """Return why the run stopped before its end, empty if it did not."""
        reason, t, y = self.solution.failure or "", self.solution.t_end, self.solution.y_end
        if reason in ("", INTERRUPTED) or not at_limit(self.problem.data.mechanism, t, y):
            return reason
        angle = math.degrees(float(self._crank_angle(np.array([t]))[0]))
        return (
            f"{reason}; the mechanism is at the limit of its reach with the crank at {angle:.4g}° and the "
            "trunnion where it is: beyond, its parts cannot be joined"
        )

    def _solver(self) -> dict[str, object]:
        return {
            "name": self.case.solver.name,
            "rtol": self.case.solver.rtol,
            **self._cost(),
        }

    def _cost(self) -> Mapping[str, float]:
        return self.statistics or vars(self.solution.statistics)
