"""A case of the variable stator vane mechanism as a system to integrate, and what its runs return."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Final, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mebdf.arrays import FloatArray
from mebdf.kernels.elementary import portable
from tribodyn.cases.joint_keys import CONFORMAL
from tribodyn.cases.temperature import cold_geometry
from tribodyn.contact.bulk import elastic_bodies
from tribodyn.core.problem import Problem
from tribodyn.core.signals import begun
from tribodyn.integrate import INTERRUPTED
from tribodyn.joints import BushingJoint
from tribodyn.joints.bushing import contact_energy
from tribodyn.kernels.joints.quantities import STATES
from tribodyn.kernels.vsv.functions import BEYOND, BEYOND_LAW
from tribodyn.kernels.vsv.quantities import OBSERVED, WATCHED
from tribodyn.mechanisms.bushing import (
    Carried,
    WearNodes,
    Worn,
    bushing_facts,
    bushing_of,
    force_parts,
    loading,
    of_temperature,
    on_finer_grid,
)
from tribodyn.mechanisms.flash import flash_of_bushing
from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart, WearRates
from tribodyn.mechanisms.output_keys import error_share, instant_coordinates, limits_of
from tribodyn.mechanisms.output_numbers import lives, shaft_displacements
from tribodyn.mechanisms.results import of_reversals, of_run
from tribodyn.mechanisms.self_checks import beyond_law, extremes, instant, of_clearance, of_tables, yielding
from tribodyn.mechanisms.workload import frame_times, merged, shown
from tribodyn.papers.cheng_2022.reduced.case import VsvCase
from tribodyn.papers.cheng_2022.reduced.checks import (
    CLEARANCE,
    GAINS_ENERGY,
    WHOLE,
    balance_columns,
    notes,
    warnings,
)
from tribodyn.papers.cheng_2022.reduced.drives import run_segments
from tribodyn.papers.cheng_2022.reduced.key_results import error_growth, output_columns, output_fields
from tribodyn.papers.cheng_2022.reduced.loads import terms_of
from tribodyn.papers.cheng_2022.reduced.parameters import AirLoads, Inertias, Vsv
from tribodyn.papers.cheng_2022.reduced.problem import vsv_problem
from tribodyn.papers.cheng_2022.reduced.reach import at_limit, ideal_at
from tribodyn.papers.cheng_2022.reduced.times import following, output_times, snapshots
from tribodyn.results.dataset import CARRIED
from tribodyn.wear import loaded_depth

#: Coordinates from which the angle of the vane follows.
_POSE: Final = ("theta_a", "e_x", "e_y", "phi_x", "phi_y")
#: Coordinates that tables over angles and speeds follow.
_FOLLOWED: Final = {
    ("the vane", "angles"): "theta_v",
    ("the crank", "angles"): "theta_a",
    ("the vane", "speeds"): "omega_v",
    ("the crank", "speeds"): "omega_a",
}


def vsv_of(case: VsvCase) -> Vsv:
    """Return the mechanism that a case describes, in the symbols of the paper."""
    m, loads = case.mechanism, case.loads
    vsv = Vsv(
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
        joint=_bushing_of(case),
    )
    opening = case.temperature.opening(cold_geometry(case.joint), case.surfaces, case.joint.liner)
    return replace(vsv, terms=tuple(terms_of(case, vsv.vane_arm)), opening=opening)


def _bushing_of(case: VsvCase) -> BushingJoint:
    """Return the clearance joint with what yields under its asperities."""
    rigid, surfaces = bushing_of(case), case.surface_pair
    if case.joint.bulk != CONFORMAL:
        return rigid
    bulk = elastic_bodies(rigid.table, case.contact.law_of(surfaces), rigid.geometry.bore_radius)
    return replace(rigid, bulk=bulk, hardness=surfaces.hardness)


@dataclass(frozen=True)
class VsvSystem:
    """The mechanism of a case; see :class:`~tribodyn.mechanisms.mechanism_protocol.WearingSystem`."""

    case: VsvCase
    begin: float = 0.0

    @cached_property
    def vsv(self) -> Vsv:
        """The mechanism in the symbols of the paper."""
        found = vsv_of(self.case)
        return found if found.opening is None else replace(found, opening=begun(found.opening, self.begin))

    def beginning(self, time: float) -> Self:
        """Return the mechanism whose temperatures are those from a time on [s]."""
        return replace(self, begin=time) if self.case.temperature_times else self

    @property
    def bushing(self) -> BushingJoint:
        """The trunnion in its bushing."""
        return self.vsv.joint

    @property
    def nodes(self) -> WearNodes:
        """The nodes of the bushing, shape (n_z + 2, n_theta)."""
        smoothest = self.case.run_in(math.inf) if self.case.wear.running_in else self.case
        return WearNodes(self._area, smoothest.surface_pair.roughness_rms, len(STATES))

    @property
    def _area(self) -> FloatArray:
        return np.broadcast_to(self.bushing.node_area[:, None], self.bushing.field_shape)

    def worn_bushing(self, depth: FloatArray | None) -> BushingJoint:
        """Return the trunnion in its bushing with the roughness that it has at a wear depth [m]."""
        case = self._worn_case(depth)
        return self.bushing if case is self.case else _bushing_of(case)

    def _worn_case(self, depth: FloatArray | None) -> VsvCase:
        """Return the case with the roughness that the bushing has at a wear depth [m]."""
        if not self.case.wear.running_in or depth is None or not depth.any():
            return self.case
        return self.case.run_in(loaded_depth(depth, self._area))

    @property
    def wear_rates(self) -> WearRates:
        """Specific wear rates of bushing and trunnion [m²/N]."""
        return self.case.wear.specific_wear_rate, self.case.wear.partner_wear_rate

    @property
    def period(self) -> float:
        """Time of one drive cycle [s]."""
        return self.case.period

    def check(self) -> Sequence[str]:
        """Put the mechanism together, its joint and contact law with it."""
        return [text for text in [of_clearance(self.vsv.joint.touch)] if text]

    def problem(self, duration: float, worn: Worn | None = None) -> Problem:
        """Return the initial value problem over ``duration`` [s]."""
        joint = self.worn_bushing(None if worn is None else worn.depth)
        problem = vsv_problem(
            replace(self.vsv, joint=joint),
            duration=duration,
            start=self.case.run.start,
            atol=self.case.solver.atol.as_tuple,
            wear=None if worn is None else worn.depth,
            carried=None if worn is None else worn.carried,
        )
        wanted = problem.memory.peaks.risen
        return replace(problem, following=following(self.case, self.vsv, duration, wanted))

    def output_times(self, duration: float) -> FloatArray:
        """Return the times of the rows [s]."""
        return output_times(self.case, self.vsv, duration)

    def picture_times(self, duration: float) -> FloatArray:
        """Return the times of snapshots and of the frames of the playback [s]."""
        turns = run_segments(self.vsv, duration).turns
        frames = frame_times(duration, self.period, turns, self.case.run.impact_window)
        return merged(snapshots(self.vsv, duration), frames, duration)

    def sliding_load(self, problem: Problem) -> FloatArray:
        """Return ∫P_c |u| dt at the nodes over the run [N/m], shape (n_z + 2, n_theta)."""
        load: FloatArray = problem.memory.joint.sliding_load
        return load

    def part_of(self, node: int) -> str:
        """Return that a node belongs to the bushing."""
        return "the bushing"

    def as_field(self, depth: FloatArray) -> FloatArray:
        """Return wear depths [m] with the angle before the height."""
        return np.swapaxes(depth, -1, -2)

    def carried(self, run: FinishedRun) -> Carried:
        """Return the state from which the next cycle continues."""
        return Carried(run.solution.y_end, run.problem.memory.joint.entry_velocity)

    def contact_energy(self, worn: Worn) -> float:
        """Return the energy stored in the contact [J]."""
        assert worn.carried is not None
        data = self.worn_bushing(worn.depth).data(worn.depth)
        return contact_energy(data, worn.carried.state, worn.carried.entry_velocity)

    def output_lives(self, run: FinishedRun, depth: FloatArray) -> dict[str, float]:
        """Return after how many cycles the errors of outputs reach their limits, by their names."""
        limits = limits_of(self.case.outputs)
        if not np.isfinite(limits).any():
            return dict.fromkeys(self.case.outputs, np.nan)
        film, rows = self._playback(run), run.rows(OBSERVED)
        times = run.solution.picture_times[film]
        states = np.stack([np.interp(times, run.solution.t, rows[name]) for name in _POSE], axis=1)
        weight = (run.solution.pictures[film, 0] * self._area).reshape(times.size, -1)
        surface = self.bushing.surface
        moved = shaft_displacements(surface.position, surface.normal, weight, depth.ravel())
        growth = error_growth(self.case.outputs, run.problem.data.mechanism, states, moved)
        error = output_columns(self.case.outputs, rows)["output_error"]
        error = np.stack([np.interp(times, run.solution.t, one) for one in error.T], axis=1)
        found = lives(error, growth, limits)
        return dict(zip(self.case.outputs, found.tolist(), strict=True))

    def of_cycle(self, run: FinishedRun) -> dict[str, float]:
        """Return the numbers of one cycle that a campaign keeps."""
        t, rows = run.solution.t, run.rows(OBSERVED)
        error = rows["theta_v"] - rows["theta_v_ideal"]
        return {
            "wear_pressure_max": of_run(run.problem.memory.peaks, WATCHED)["pressure_peak"],
            "wear_pressure_mean": _mean(t, rows["p_max"]),
            "wear_roughness": float(run.problem.data.joint.roughness),
            "wear_force_mean": _mean(t, portable.hypot(rows["F_cx"], rows["F_cy"])),
            "wear_angle_error_max": float(np.abs(error).max()),
            "wear_angle_error_rms": _mean(t, error**2) ** 0.5,
            "wear_error_share": error_share(output_columns(self.case.outputs, rows), self.case.outputs),
        }

    def gather(self, run: FinishedRun) -> ResultPart:
        """Return the mechanism's facts about a run."""
        rows = run.rows(OBSERVED)
        balance = balance_columns(rows)
        whole, of_clearance = WHOLE.fraction(balance), CLEARANCE.fraction(balance)
        worn = run.problem.data.joint.wear - self.bushing.form_gap
        bushing = self.worn_bushing(worn)
        clearance = self._clearance(run)
        moving = {} if clearance is None else {"radial_clearance": clearance}
        memory = run.problem.memory
        found = extremes(memory.joint.extremes, memory.collar)
        found |= on_finer_grid(bushing, run.problem.data.joint, rows, worn, clearance)
        largest = of_run(memory.peaks, WATCHED)
        pressure = largest["pressure_peak"]
        law = self.case.contact.law_of(self._worn_case(worn).surface_pair)
        found |= loading(law, bushing.touch, pressure, found["separation_least"])
        speed = rows["omega_v"] * bushing.geometry.radius
        outputs = output_columns(self.case.outputs, rows)
        turns, t_end = self._turns(run), float(run.solution.t_end)
        when = instant(largest["pressure_peak_time"], turns, self.vsv.drive.impact_time)
        return ResultPart(
            coordinates=self._coordinates(run),
            columns=force_parts(rows) | balance | moving | outputs,
            fields={
                **self._fields(run),
                **of_reversals(memory.peaks, WATCHED),
                **output_fields(
                    self.case.outputs, run.solution.t, outputs["output_error"], rows["theta_a"], self.period
                ),
            },
            attributes={
                "formulation": self.vsv.formulation,
                **bushing_facts(self.case),
                "friction_coefficient": self.case.joint.friction_coefficient,
                "cycle_period": self.period,
                "start": CARRIED if run.carried else self.case.run.start,
                "impact_time": self.vsv.drive.impact_time,
                "energy_residual": whole,
                "clearance_energy_residual": of_clearance,
                **found,
                **flash_of_bushing(self.case.surfaces, law, bushing, rows, speed),
            },
            warnings=[
                *warnings(self.vsv, found, whole, of_clearance, t_end, run.cost, when),
                *of_tables(
                    self.case.followed(),
                    run.solution.t,
                    lambda table: rows[_FOLLOWED[table.follows, table.over]],
                ),
            ],
            notes=[
                *of_temperature(self.case, clearance),
                *notes(self.vsv, found, pressure, t_end, turns, run.carried),
            ],
            failure=self._failure(run),
        )

    def _coordinates(self, run: FinishedRun) -> dict[str, ArrayLike]:
        pictures = run.solution.picture_times
        times = pictures[self._is_snapshot(run)]
        frames = pictures[self._playback(run)]
        turns = self._turns(run)
        return {
            "reversal": np.arange(turns.size, dtype=np.float64),
            "reversal_time": turns,
            "snapshot": np.arange(times.size, dtype=np.float64),
            "snapshot_time": times,
            "frame": np.arange(frames.size, dtype=np.float64),
            "frame_time": frames,
            "snapshot_theta_v": ideal_at(self.vsv.lengths, tuple(self.vsv.drive.angle(times).tolist())),
            "snapshot_direction": _directions(run.problem.data.actions.segments, times),
            "theta": self.bushing.theta,
            "z": self.bushing.z,
            "output": list(self.case.outputs),
            "output_unit": [output.unit for output in self.case.outputs.values()],
            **instant_coordinates(self.case.outputs),
        }

    def _clearance(self, run: FinishedRun) -> FloatArray | None:
        """Return the radial clearance at the rows [m], shape (n_t,), where it changes."""
        opening = self.vsv.opening
        return None if opening is None else self.bushing.geometry.clearance + opening(run.solution.t)

    def _turns(self, run: FinishedRun) -> FloatArray:
        """Return the times of the start and of the reversals that were reached [s]."""
        reached = int(run.problem.memory.peaks.course.stretch) + 1
        return np.concatenate([[0.0], run_segments(self.vsv, run.duration).turns])[:reached]

    def _is_snapshot(self, run: FinishedRun) -> NDArray[np.bool_]:
        """Tell of each picture whether it is a snapshot, shape (n_pictures,)."""
        return np.isin(run.solution.picture_times, snapshots(self.vsv, run.duration))

    def _playback(self, run: FinishedRun) -> slice:
        """Return the pictures that are frames of the playback."""
        return shown(run.solution.picture_times, run.duration, self.period)

    def _fields(self, run: FinishedRun) -> dict[str, NDArray[np.floating]]:
        pressure = run.solution.pictures[:, 0].transpose(0, 2, 1)
        return {
            "pressure": pressure[self._is_snapshot(run)],
            # Half the size, and more digits than a playback needs.
            "pressure_cycle": pressure[self._playback(run)].astype(np.float32),
        }

    def _failure(self, run: FinishedRun) -> str:
        """Return why the run stopped before its end, empty if it did not."""
        reason, t, y = run.solution.failure or "", run.solution.t_end, run.solution.y_end
        if reason not in ("", INTERRUPTED) and run.problem.memory.regime[BEYOND] == BEYOND_LAW:
            cause = () if self.vsv.exact else (GAINS_ENERGY.format(self.vsv.formulation),)
            advice = yielding("joint.bulk") if self.vsv.exact and self.case.joint.may_yield else ""
            return beyond_law(self.bushing.table.h_first, t, "trunnion and bushing", *cause, advice=advice)
        angle = float(self.vsv.drive.angle(np.array([t]))[0])
        if reason in ("", INTERRUPTED) or not at_limit(run.problem.data.mechanism, angle, y):
            return reason
        return (
            f"{reason}; the mechanism is at the limit of its reach with the crank at "
            f"{math.degrees(angle):.4g}° and the trunnion where it is: beyond, its parts cannot be joined"
        )


def _directions(segments: Any, times: FloatArray) -> FloatArray:
    """Return the direction of the vane's motion at times [s]."""
    return np.asarray(segments.direction[np.searchsorted(segments.begin, times, side="right") - 1])


def _mean(t: FloatArray, values: FloatArray) -> float:
    """Return the mean over time; output times crowd around events."""
    return 0.5 * float(np.sum((values[1:] + values[:-1]) * np.diff(t))) / float(t[-1] - t[0])


SYSTEM: Final = VsvSystem
