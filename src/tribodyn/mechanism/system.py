"""A case of a mechanism as a system to integrate, and what its runs return.

One file because all of it is asked of one object, which computes assembly, start and maps once.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Any, Final, Self

import numpy as np
from numpy.typing import ArrayLike

from mebdf.arrays import FloatArray
from tribodyn.core.errors import InputError
from tribodyn.core.problem import Problem
from tribodyn.integrate import INTERRUPTED
from tribodyn.joints.clearances import Clearance, places
from tribodyn.kernels.joints.surface.data import PLASTIC
from tribodyn.mechanism.analyses.analysis import NOTES, analysed
from tribodyn.mechanism.analyses.ideal_motion import compared, led_along
from tribodyn.mechanism.analyses.sampling import sampled
from tribodyn.mechanism.analyses.statics import at_rest
from tribodyn.mechanism.analyses.vibrations import Vibrations, vibrations_of, without_friction
from tribodyn.mechanism.assembly import mechanism_problem
from tribodyn.mechanism.assembly.assembly import Assembly, assemble
from tribodyn.mechanism.assembly.clearance_surfaces import material_of
from tribodyn.mechanism.assembly.decompositions import forget_large
from tribodyn.mechanism.assembly.output_values import MOTION, Motion, Output, outputs_of
from tribodyn.mechanism.assembly.parts_by_number import Model, model_of
from tribodyn.mechanism.assembly.passage import drive_through
from tribodyn.mechanism.assembly.positions import DrivePath
from tribodyn.mechanism.assembly.start import initial_state
from tribodyn.mechanism.mechanism_case import MechanismCase
from tribodyn.mechanism.mechanism_variables import AXES, ENTRIES, Observed
from tribodyn.mechanism.model.reversals import Reversals
from tribodyn.mechanism.results import mechanism_checks as checks
from tribodyn.mechanism.results import temperature_effects
from tribodyn.mechanism.results.contacts import Contacts
from tribodyn.mechanism.results.copies import why
from tribodyn.mechanism.results.derived_columns import (
    coordinate,
    drive_limits,
    followed,
    power_columns,
    spring_columns,
    stresses,
    transmitted,
    with_motors,
)
from tribodyn.mechanism.results.fixed_joints import with_reactions
from tribodyn.mechanism.results.guides import guide_columns
from tribodyn.mechanism.results.joint_readings import TERMS, WHOLE, balance_columns
from tribodyn.mechanism.results.kept_variables import (
    Layout,
    columns,
    film_coordinates,
    film_maps,
    film_peaks,
    following,
    frames,
    layout_of,
    not_kept,
    note,
)
from tribodyn.mechanism.results.maps import Maps
from tribodyn.mechanism.results.mechanism_checks import of_slow_sliding
from tribodyn.mechanism.results.output_columns import (
    error_growth,
    instant_errors,
    kinematic_columns,
    output_coordinates,
)
from tribodyn.mechanism.results.temperature_effects import flash_temperatures
from tribodyn.mechanisms.bushing import Carried, WearNodes, Worn
from tribodyn.mechanisms.mechanism_protocol import FinishedRun, ResultPart, WearRates
from tribodyn.mechanisms.output_keys import error_share, limits_of
from tribodyn.mechanisms.output_numbers import lives
from tribodyn.mechanisms.self_checks import named, of_clearance, of_tables
from tribodyn.mechanisms.workload import frame_times, shown
from tribodyn.results.dataset import CARRIED, NOT_KEPT

_STATES: Final = 13  #: Of a body.
#: Data computed once that do not depend on temperatures over time.
_AS_DRAWN: Final = ("assembly", "maps", "outputs", "_starts")


@dataclass(frozen=True)
class MechanismSystem:
    """The mechanism of a case; see :class:`~tribodyn.mechanisms.mechanism_protocol.WearingSystem`."""

    case: MechanismCase
    begin: float = 0.0

    def beginning(self, time: float) -> Self:
        """Return the mechanism whose temperatures are those from a time on [s]; as drawn it is the same."""
        if not self.case.temperature_times:
            return self
        found = replace(self, begin=time)
        # A caller that wants to stop would not wait for these once more.
        vars(found).update({name: getattr(self, name) for name in _AS_DRAWN})
        return found

    @cached_property
    def model(self) -> Model:
        """The mechanism as drawn; kinematic analyses have ideal joints, vibrations and rest no friction."""
        found = temperature_effects.from_time(model_of(self._modelled), self.begin)
        return found.counterpart if self._analysis == "kinematic" else found

    @cached_property
    def _modelled(self) -> MechanismCase:
        if self._analysis == "kinematic":
            return self.case.without_play()
        return without_friction(self.case) if self._rests or self._analysis == "vibrations" else self.case

    @property
    def _rests(self) -> bool:
        """Whether a static analysis has no drive to lead the mechanism along."""
        return self._analysis == "static" and not self.case.moves

    @property
    def _analysis(self) -> str:
        return self.case.run.analysis

    @cached_property
    def assembly(self) -> Assembly:
        """The mechanism put together, its joints not worn, and led through its cycle."""
        found = self._assembled(None)
        passage = drive_through(found, self.case.span)
        forget_large()
        if passage.finding is not None:
            raise InputError(passage.finding.text, key=passage.finding.key)
        return replace(found, strain=passage.warning)

    def _assembled(self, depth: FloatArray | None) -> Assembly:
        found = assemble(self._worn(depth), depth)
        found.require_sound()
        return found

    def _worn(self, depth: FloatArray | None) -> Model:
        """Return the mechanism with the roughness that its joints have at a wear depth [m]."""
        found = temperature_effects.worn_model(self.model, self.maps.places, depth)
        return found if found is self.model else temperature_effects.from_time(found, self.begin)

    @cached_property
    def real(self) -> tuple[tuple[str, Clearance], ...]:
        """Names and clearances of the joints that have one."""
        return tuple(self.model.clearances.items())

    @cached_property
    def outputs(self) -> tuple[Output, ...]:
        """Motion of ideal joints for comparison."""
        return outputs_of(self.case)

    @cached_property
    def maps(self) -> Maps:
        """Layout of fields over nodes as maps of surfaces."""
        found = places([clearance for _, clearance in self.real])
        return Maps(tuple(f"{self.real[place.joint][0]}:{place.surface.name}" for place in found), found)

    @property
    def period(self) -> float:
        """Time of one cycle [s]; all of the run where nothing says how long it is."""
        return self.case.period or self.case.duration

    @property
    def nodes(self) -> WearNodes:
        """The nodes of all joints with clearance, shape (n_nodes,)."""
        return WearNodes(
            self.maps.area, temperature_effects.least_roughness(self.case), _STATES * len(self.model.bodies)
        )

    @property
    def wear_rates(self) -> WearRates:
        """Specific wear rates of socket and shaft at the nodes [m²/N], shape (n_nodes,) each."""
        rates = np.zeros((2, self.maps.area.size))
        for surface in self.maps.places:
            wear = material_of(self.case, self.real[surface.joint][0]).wear
            rates[:, surface.nodes] = [[wear.specific_wear_rate], [wear.partner_wear_rate]]
        return rates[0], rates[1]

    def check(self) -> Sequence[str]:
        """Put the mechanism together, move it through its cycle, and say what there is to know of it."""
        # A finer grid would change nothing of that, and may take much memory.
        coarse = replace(self, case=self.case.with_coarse_grids())
        touches = zip(coarse.maps.names, coarse._contacts(coarse.model).touches, strict=True)
        rough = [text for name, touch in touches for text in named(name, [of_clearance(touch)])]
        return [*coarse.assembly.remarks, *rough, *temperature_effects.of_temperatures(coarse.model)]

    def problem(self, duration: float, worn: Worn | None = None) -> Problem:
        """Return the initial value problem over ``duration`` [s]."""
        problem = mechanism_problem.mechanism_problem(
            self.assembly if worn is None else self._assembled(worn.depth),
            duration=duration,
            rtol=self.case.solver.rtol,
            state=self.start() if worn is None or worn.carried is None else None,
            carried=None if worn is None else worn.carried,
            # Of all integrators one knows the structure of these equations.
            dense=self.case.solver.name != "mebdf",
        )
        problem = replace(problem, kept=self._layout.places, picture_type="float32")
        if self._analysis != "dynamic":
            return analysed(problem, self.assembly, self._analysis, self.case.turn)
        problem = sampled(problem, self.model, self.outputs)
        return replace(problem, following=following(self.model, self.period, self.output_times(duration)))

    def start(self) -> FloatArray | None:
        """Return the state in which a run begins, shape (13 n,); None for that of the drawing.

        It is looked for once.
        """
        if not self._starts:
            wanted = self.case.run.start == "equilibrium" and self._analysis == "dynamic"
            self._starts.append(initial_state(self.assembly) if wanted else None)
            forget_large()
        return self._starts[0]

    @cached_property
    def _starts(self) -> list[FloatArray | None]:
        return []

    def output_times(self, duration: float) -> FloatArray:
        """Return the times of the rows [s], the end included."""
        if self._analysis == "vibrations" and not self.case.moves:
            return np.zeros(1)
        n = max(round(duration / self.case.output_interval), 1)
        return np.linspace(0.0, duration, n + 1)

    def picture_times(self, duration: float) -> FloatArray:
        """Return the times of the frames of the playback [s]; none where all joints are ideal."""
        if not self.real:
            return np.empty(0)
        return frame_times(duration, self.period, np.empty(0), 0.0, frames(self.case))

    def sliding_load(self, problem: Problem) -> FloatArray:
        """Return ∫P_c |s| dt at the nodes over the run [N/m], shape (n_nodes,); of bodies at rest (0,)."""
        load: FloatArray = problem.memory.contact.sliding_load
        return load[:0] if self._rests or self._analysis == "vibrations" else load

    def part_of(self, node: int) -> str:
        """Return the joint that a node belongs to, in words."""
        found = next(place for place in self.maps.places if place.nodes.start <= node < place.nodes.stop)
        return f"joint {self.real[found.joint][0]}"

    def as_field(self, depth: FloatArray) -> FloatArray:
        """Return wear depths [m] as maps of surfaces."""
        return np.asarray(self.maps(depth), dtype=np.float64)

    def carried(self, run: FinishedRun) -> Carried:
        """Return the state from which the next cycle continues."""
        return Carried(run.solution.y_end, run.problem.memory.contact.entry_velocity)

    def contact_energy(self, worn: Worn) -> float:
        """Return the energy stored in the contact [J]."""
        return mechanism_problem.stored_energy(self.problem(self.period, worn))

    def output_lives(self, run: FinishedRun, depth: FloatArray) -> dict[str, float]:
        """Return after how many cycles the errors of outputs reach their limits, by their names."""
        limits = limits_of(self.case.outputs)
        known = self._analysis == "dynamic" and not self.assembly.strain
        if not known or not np.isfinite(limits).any():
            return dict.fromkeys(self.case.outputs, np.nan)
        film = self._playback(run)
        times = run.solution.picture_times[film]
        pressure = np.asarray(run.solution.pictures[film, : self.maps.n_nodes], dtype=np.float64)
        growth = np.full((times.size, len(self.outputs)), np.nan)
        observed = self._observed(run)
        path, moved = DrivePath(run.solution.t, self.case.turn), partial(self._moved, observed)
        for _, found, numbers in led_along(self.assembly, self.outputs, path, moved):
            outputs = [self.outputs[number] for number in numbers]
            growth[:, numbers] = error_growth(found, outputs, self.maps.places, times, pressure, depth)
        columns, _ = self._of_outputs(observed, run)
        error = np.stack([np.interp(times, run.solution.t, one) for one in columns["output_error"].T], axis=1)
        return dict(zip(self.case.outputs, lives(error, growth, limits).tolist(), strict=True))

    def of_cycle(self, run: FinishedRun) -> dict[str, float]:
        """Return the numbers of one cycle that a campaign keeps."""
        found = self._observed(run)
        force = np.linalg.norm(found.couplings["reaction_force"], axis=-1)
        means = [float(np.trapezoid(f, run.solution.t)) / self.period for f in force.T[self.model.real]]
        return {
            "wear_pressure_max": float(np.max(run.problem.memory.contact.peaks["pressure_peak"])),
            "wear_roughness": float(np.max(run.problem.data.contact.surfaces["roughness"])),
            "wear_force_mean": max(means),
            "wear_error_share": error_share(self._of_outputs(found, run)[0], self.case.outputs),
        }

    def gather(self, run: FinishedRun) -> ResultPart:
        """Return the mechanism's facts about a run."""
        found = self._observed(run)
        of_outputs, notes_of_outputs = self._of_outputs(found, run)
        vibrations = self._vibrations(found, run)
        widens = any(real.bulk is not None for real in self.model.clearances.values())
        opening = widens or any(temperature_effects.opens(self.model))
        balance = balance_columns(found.whole, oiled=bool(self.model.oiled), opening=opening)
        least = mechanism_problem.least_energy(
            self.assembly, found.couplings["reaction_force"], self.case.solver.rtol
        )
        energy = {WHOLE.attribute: WHOLE.fraction(balance, least)}
        if self._analysis != "dynamic":
            energy.clear()
            del balance[WHOLE.residual]
        peaks = self._peaks(run)
        worn = self._worn(temperature_effects.depth_of(run.problem.data.contact, self.maps.places))
        contacts = self._contacts(worn)
        touching, openings = run.problem.data.contact, temperature_effects.openings(worn, run.solution.t)
        of_contacts = contacts.numbers_of(touching, found.couplings, peaks, openings) if peaks else {}
        of_guides = (
            guide_columns(worn, touching, self.maps.places, found.couplings, openings) if peaks else {}
        )
        return ResultPart(
            coordinates=self._coordinates(run, vibrations),
            columns={
                **columns(self.model, found),
                **transmitted(self.model, found.couplings),
                **stresses(self.model, found.couplings),
                **power_columns(self.model, found.couplings),
                **temperature_effects.radial_clearances(self.model, run.solution.t),
                **of_guides,
                **(spring_columns(self.model, observed_motion(found)) if self.case.springs else {}),
                **of_outputs,
                **vibrations.columns,
                **{name: values for name, values in found.whole.items() if name not in _IN_BALANCE},
                **balance,
            },
            fields={
                "clearance": self._clearances(),
                **drive_limits(self.case),
                **self._errors(of_outputs, found, run),
                **self._film_pressure(run),
                **peaks,
                **of_contacts,
                **flash_temperatures(worn, self.maps.places, contacts.touches, found.couplings),
                **film_peaks(run.problem.memory.oil, self.model),
                **self._reversals.peaks(run.solution.t, found.couplings, self._clearances()),
                **self._pressure(run),
            },
            attributes={
                **energy,
                **self._began(run),
                **({"cycle_period": self.case.period} if self.case.period is not None else {}),
                **self._reversals.attributes,
                **({NOT_KEPT: left_out} if (left_out := not_kept(self.case)) else {}),
            },
            warnings=checks.messages(
                [*self.assembly.warnings],
                vibrations.warnings,
                checks.of_start(self.case.run.start, self._began(run)),
                *(checks.of_balance(missed, found.whole["gap"]) for missed in energy.values()),
                contacts.warnings(peaks, of_contacts, float(run.solution.t_end)) if peaks else [],
                of_tables(
                    self.case.followed(), run.solution.t, partial(followed, self.case, found.couplings)
                ),
                cost={**run.cost, "restarts": run.cost["restarts"] - len(run.problem.breakpoints)},
            ),
            notes=[
                *NOTES["rest" if self._rests else self._analysis],
                *run.solution.notes,
                *(
                    of_slow_sliding(worn, self.maps.places, run.solution.t, found.couplings)
                    if self._analysis == "dynamic"
                    else []
                ),
                *self.assembly.notes,
                *vibrations.notes,
                *note(self.case),
                *temperature_effects.of_temperatures(self.model),
                *(contacts.notes(peaks, of_contacts) if peaks and self._analysis == "dynamic" else []),
                *notes_of_outputs,
                *(why(self.case, run.solution.t, of_outputs["output_error"]) if of_outputs else ()),
                *self._reversals.notes(float(run.solution.t_end), carried=run.carried),
            ],
            failure=self._failure(run),
        )

    @cached_property
    def _reversals(self) -> Reversals:
        # No impacts follow where all joints are ideal, and none are computed where nothing is integrated.
        drives = tuple(self.case.drives.values()) if self.real and self._analysis == "dynamic" else ()
        return Reversals(drives, self.period, self.case.duration)

    def _contacts(self, model: Model) -> Contacts:
        """Return the contacts of all joints of the mechanism as drawn or worn."""
        clearances = tuple(model.clearances.values())
        return Contacts(clearances, tuple(self.model.real), self.maps.names, self.maps.places)

    def _failure(self, run: FinishedRun) -> str:
        """Return why the run stopped before its end, empty if it did not."""
        reason, reached = run.solution.failure or "", float(run.solution.t_end)
        if reason in ("", INTERRUPTED):
            return reason
        return checks.failure(run.problem, self.model, self.maps.names, reached) or reason

    def _began(self, run: FinishedRun) -> dict[str, str]:
        """Return the start of a dynamic run with clearances."""
        if not self.real or self._analysis != "dynamic":
            return {}
        if run.carried:
            return {"start": CARRIED}
        return {"start": "equilibrium" if self.start() is not None else "centred"}

    def _observed(self, run: FinishedRun) -> Observed:
        rows = self._layout.observed(run.solution.rows)
        return with_motors(self.model, with_reactions(self.model, run.problem.data.parts.couplings, rows))

    @cached_property
    def _layout(self) -> Layout:
        return layout_of(self._modelled)

    def _of_outputs(self, found: Observed, run: FinishedRun) -> tuple[dict[str, FloatArray], tuple[str, ...]]:
        """Return outputs with their ideal values and errors, and notes; nothing without outputs."""
        if not self.outputs:
            return {}, ()
        motion = observed_motion(found)
        path = DrivePath(run.solution.t, self.case.turn)
        rest = partial(at_rest, self.assembly, path) if self._analysis == "static" else None
        columns, notes = compared(
            self.assembly, self.outputs, path, motion, partial(self._moved, found), rest
        )
        if self._analysis == "kinematic":
            columns |= kinematic_columns(self.assembly, self.outputs, path.times, found.couplings)
        return columns, notes

    def _moved(self, found: Observed, joint: str) -> FloatArray:
        """Return the angle or the position that a joint had in the run, shape (n_t,)."""
        turns = "angle" in self.case.joints[joint].kind.COORDINATES
        return coordinate(self.case, found.couplings, joint, "angles" if turns else "positions")

    def _errors(
        self, columns: dict[str, FloatArray], found: Observed, run: FinishedRun
    ) -> dict[str, FloatArray]:
        """Return limits of the errors of outputs, and errors at instants; nothing without outputs."""
        if not self.outputs:
            return {}
        at = instant_errors(self.case, run.solution.t, columns["output_error"], found.couplings)
        return {"output_error_limit": limits_of(self.case.outputs), **at}

    def _vibrations(self, found: Observed, run: FinishedRun) -> Vibrations:
        """Return frequencies and modes with their messages; nothing of other analyses."""
        if self._analysis != "vibrations" or run.solution.t.size == 0:
            return Vibrations()
        return vibrations_of(self.assembly, run.solution.t, found, self.case.run.modes)

    def _clearances(self) -> FloatArray:
        real = self.model.clearances
        return np.array([real[j].shape.clearance if j in real else np.nan for j in self.model.joints])

    def _peaks(self, run: FinishedRun) -> dict[str, FloatArray]:
        """Return the largest or least values of each surface at any step; NaN where it never touched."""
        if not self.real:
            return {}
        peaks: Any = run.problem.memory.contact.peaks
        found = {name: np.where(np.isfinite(peaks[name]), peaks[name], np.nan) for name in peaks.dtype.names}
        if all(math.isinf(clearance.hardness) for clearance in self.model.clearances.values()):
            del found[PLASTIC.name]
        return found

    def _coordinates(self, run: FinishedRun, vibrations: Vibrations) -> dict[str, ArrayLike]:
        parts: dict[str, ArrayLike] = {
            "body": list(self.case.bodies),
            "joint": list(self.model.joints),
            "axis": list(AXES),
            "entry": list(ENTRIES),
        }
        if self.model.elements:
            parts["element"] = [element.name for element in self.model.elements]
        if self.case.springs:
            parts["spring"] = list(self.case.springs)
        parts |= output_coordinates(self.case, self.outputs)
        parts |= vibrations.coordinates
        parts |= film_coordinates(run.problem.data.films, self.model)
        parts |= self._reversals.coordinates(float(run.solution.t_end))
        if not self.real:
            return dict(parts)
        frames = run.solution.picture_times[self._playback(run)]
        return {
            **parts,
            "surface": list(self.maps.names),
            "frame": np.arange(frames.size, dtype=np.float64),
            "frame_time": frames,
            **self.maps.coordinates(),
        }

    def _playback(self, run: FinishedRun) -> slice:
        return shown(run.solution.picture_times, run.duration, self.period)

    def _pressure(self, run: FinishedRun) -> dict[str, Any]:
        if not self.real:
            return {}
        pictures = run.solution.pictures[self._playback(run), : self.maps.n_nodes]
        return {"pressure_cycle": self.maps(pictures)}

    def _film_pressure(self, run: FinishedRun) -> dict[str, Any]:
        """Return the pressure of the films at the frames of the playback; nothing without films."""
        pictures = run.solution.pictures[self._playback(run), self.maps.n_nodes :]
        return film_maps(run.problem.data.films, pictures)


def observed_motion(found: Observed) -> Motion:
    """Return the motion of all bodies that was observed."""
    return Motion(**{name: found.bodies[name] for name in MOTION})


#: Quantities that reach the user under the names of the balance instead.
_IN_BALANCE: Final = frozenset(term.row for term in TERMS.values())

SYSTEM: Final = MechanismSystem
